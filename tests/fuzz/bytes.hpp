// What a fuzzer's bytes stand for: counts, indices and numbers, most of them sound, so that inputs get past the checks. Where the
// bytes end, noise that they seed goes on: an input of ten bytes makes a whole mesh, and the same one every time.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace handlebody::fuzz {

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) { wild_ = byte() % 4 == 0; }

  std::uint8_t byte() {
    if (at_ < size_) {
      noise_ = (noise_ ^ data_[at_]) * 0x100000001b3u;
      return data_[at_++];
    }
    noise_ ^= noise_ << 13, noise_ ^= noise_ >> 7, noise_ ^= noise_ << 17;
    return static_cast<std::uint8_t>(noise_ >> 32);
  }

  bool flip() { return byte() % 2 != 0; }

  /** 0 to `count` − 1; 0 where `count` is. */
  std::uint32_t below(std::uint32_t count) {
    if (count == 0) return 0;
    return (count <= 256 ? byte() : byte() * 256u + byte()) % count;
  }

  std::uint32_t from_to(std::uint32_t low, std::uint32_t high) { return low + below(high - low + 1); }

  /** True for a few draws of one input in four: time for something that no caller should do. */
  bool wildly() { return wild_ && byte() < 12; }

  /** An index below `count`, or wildly one that is not. */
  std::uint32_t index(std::uint32_t count) {
    if (!wildly()) return below(count);
    const std::array<std::uint32_t, 6> wrong{count, count + 1, 0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff};
    return wrong[below(6)];
  }

  /** `count`, or wildly one that no array of two-byte numbers or larger ones has. */
  std::uint32_t count(std::uint32_t count) {
    if (!wildly()) return count;
    constexpr std::array<std::uint32_t, 6> wrong{0x7fffffff, 0x80000000, 0x80000003, 0xaaaaaaab, 0xfffffffd, 0xffffffff};
    return wrong[below(6)];
  }

  /** An option from `low` to `high`, or wildly any number. */
  std::uint32_t option(std::uint32_t low, std::uint32_t high) {
    if (!wildly()) return from_to(low, high);
    const std::array<std::uint32_t, 6> wrong{low - 1, high + 1, 0, 0x7fffffff, 0x80000000, 0xffffffff};
    return wrong[below(6)];
  }

  /** A number of a size that people use: from −4 to 4, whole or with many digits. Wildly one that hurts. */
  double number() {
    if (wildly()) return hurting();
    const std::uint8_t kind = byte();
    if (kind < 64) return kind % 9 - 4;
    const double fine = (kind * 256 + byte()) / 8192.0 - 4;
    return kind < 80 ? fine / 1024 : fine;
  }

  /** A positive one, or wildly any. */
  double positive() {
    const double number_ = number();
    return number_ == 0 ? 1 : std::abs(number_);
  }

  /** A power of ten that a whole input is scaled by: most often 1. */
  double scale() {
    const std::uint8_t kind = byte();
    if (kind < 200) return 1;
    return std::pow(10., kind < 240 ? kind % 13 - 6 : static_cast<int>(byte()) * 2 - 256);
  }

  std::vector<double> numbers(std::size_t count) {
    std::vector<double> made(count);
    for (double& number_ : made) number_ = number();
    return made;
  }

  template <typename T>
  T one_of(std::initializer_list<T> choices) {
    return choices.begin()[below(static_cast<std::uint32_t>(choices.size()))];
  }

 private:
  double hurting() {
    using Limits = std::numeric_limits<double>;
    return one_of({Limits::quiet_NaN(),
                   Limits::infinity(),
                   -Limits::infinity(),
                   Limits::max(),
                   -Limits::max(),
                   Limits::min(),
                   Limits::denorm_min(),
                   -Limits::denorm_min(),
                   -0.0,
                   1e150,
                   -1e150,
                   1e-150,
                   1e-60,
                   1e60,
                   3.5e38,
                   -1e20,
                   1e-20,
                   2147483648.0,
                   -2147483649.0,
                   4294967296.0,
                   1e19,
                   1e16,
                   1e-9,
                   1 + 1e-15});
  }

  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
  std::uint64_t noise_ = 0xcbf29ce484222325u;
  bool wild_ = false;
};

}  // namespace handlebody::fuzz
