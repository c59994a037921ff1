#include "core/errors/result.hpp"

namespace handlebody {

Error::Error(hb_status error_code, std::initializer_list<Word> what, std::initializer_list<Word> advice, hb_culprit whose,
             std::int64_t which)
    : code(error_code), message(join(what)), remedy(join(advice)), culprit(whose), index(which) {}

Error::Error(const Error&) = default;
Error::~Error() = default;

}  // namespace handlebody
