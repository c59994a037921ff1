#include "core/errors/text.hpp"

#include <cmath>

namespace handlebody {
namespace {

std::string digits(std::uint64_t number) {
  char buffer[20];
  char* first = buffer + sizeof buffer;
  do *--first = static_cast<char>('0' + number % 10);
  while (number /= 10);
  return {first, buffer + sizeof buffer};
}

/** `number` ≥ 0 to three significant digits: 0, 0.00125, 42, 1.5e+30. */
std::string rounded(double number) {
  if (number == 0) return "0";
  int exponent = 0;  // the mantissa has three digits, then fewer
  for (; number >= 999.5; number /= 10) ++exponent;
  for (; number < 99.95; number *= 10) --exponent;
  auto mantissa = static_cast<std::uint64_t>(std::lround(number));
  for (; mantissa % 10 == 0; mantissa /= 10) ++exponent;

  std::string text = digits(mantissa);
  const int places = static_cast<int>(text.size());
  if (exponent + places < -3 || exponent > 6) {  // d.dde±n
    if (places > 1) text.insert(1, 1, '.');
    exponent += places - 1;
    return text + (exponent < 0 ? "e-" : "e+") + digits(static_cast<std::uint64_t>(std::abs(exponent)));
  }
  if (exponent >= 0) return text.append(static_cast<std::size_t>(exponent), '0');
  if (-exponent >= places) text.insert(0, static_cast<std::size_t>(1 - exponent - places), '0');
  return text.insert(text.size() - static_cast<std::size_t>(-exponent), 1, '.');
}

}  // namespace

void Word::append_to(std::string& message) const {
  if (kind_ == Kind::text) {
    message += text_;
    return;
  }
  if (kind_ == Kind::integer ? integer_ < 0 : real_ < 0) message += '-';
  if (kind_ == Kind::integer) {
    message += digits(integer_ < 0 ? -static_cast<std::uint64_t>(integer_) : static_cast<std::uint64_t>(integer_));
  } else if (!std::isfinite(real_)) {
    message += std::isnan(real_) ? "NaN" : "infinity";
  } else {
    message += rounded(std::abs(real_));
  }
}

std::string join(std::initializer_list<Word> words) {
  std::string message;
  for (const Word& word : words) word.append_to(message);
  return message;
}

}  // namespace handlebody
