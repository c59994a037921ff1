// Joining words and numbers into a message. Out of line and without printf, which dozens of messages would pay for.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <string>

namespace handlebody {

/** A piece of a message: text, or a number as people write it (integers in full, others to three significant digits). */
class Word {
 public:
  Word(const char* text) : kind_(Kind::text), text_(text) {}                                              // NOLINT
  Word(std::integral auto number) : kind_(Kind::integer), integer_(static_cast<std::int64_t>(number)) {}  // NOLINT
  Word(double number) : kind_(Kind::real), real_(number) {}                                               // NOLINT

  void append_to(std::string& message) const;

 private:
  enum class Kind { text, integer, real } kind_;
  union {
    const char* text_;
    std::int64_t integer_;
    double real_;
  };
};

std::string join(std::initializer_list<Word> words);

}  // namespace handlebody
