#pragma once
/// Adaptive binary range coding (FORMAT.md, "Range-coded streams"): bits whose chances are learnt while they
/// are written, a likely one taking a small part of a bit in the file. Writer and reader share the code that
/// walks the data: both have `bit`, which takes what is to be written and gives what is in the file.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace acentric {

/// How likely a bit of some context is 0, learnt at two paces, as parts of 65536.
struct BitChance {
  std::uint16_t quick = 0x8000, slow = 0x8000;

  std::uint32_t zero() const { return (std::uint32_t(quick) + slow) / 2; }
  void learn(bool bit) {
    constexpr int kQuick = 4, kSlow = 7;
    if (bit) {
      quick = std::uint16_t(quick - (quick >> kQuick));
      slow = std::uint16_t(slow - (slow >> kSlow));
    } else {
      quick = std::uint16_t(quick + ((0xffff - quick) >> kQuick));
      slow = std::uint16_t(slow + ((0xffff - slow) >> kSlow));
    }
  }
  /// Of a range of at least 2^24 the part that means 0: never nothing, never all, since learning stops short.
  std::uint32_t part(std::uint32_t range) const { return (range >> 16) * zero(); }
};

class RangeWriter {
 public:
  static constexpr bool kReads = false;
  bool bit(BitChance& chance, bool value) {
    const std::uint32_t part = chance.part(range_);
    if (value) {
      low_ += part;
      range_ -= part;
    } else {
      range_ = part;
    }
    chance.learn(value);
    settle();
    return value;
  }
  /// `count` bits of which nothing is known.
  std::uint32_t plain(std::uint32_t value, int count) {
    for (int n = count; n-- > 0;) {
      range_ >>= 1;
      if ((value >> n & 1u) != 0) low_ += range_;
      settle();
    }
    return value;
  }
  /// All that was written.
  std::vector<std::byte> finish() && {
    for (int n = 0; n < 5; ++n) shift();
    return std::move(out_);
  }

 private:
  void settle() {
    while (range_ < (1u << 24)) {
      range_ <<= 8;
      shift();
    }
  }
  /// One byte out; it waits while a carry may still reach it.
  void shift() {
    if (low_ < 0xff000000u || low_ >> 32 != 0) {
      const auto carry = std::uint8_t(low_ >> 32);
      if (begun_) out_.push_back(std::byte(std::uint8_t(cache_ + carry)));
      for (; waiting_ > 0; --waiting_) out_.push_back(std::byte(std::uint8_t(0xff + carry)));
      cache_ = std::uint8_t(low_ >> 24);
      begun_ = true;
    } else {
      ++waiting_;
    }
    low_ = low_ << 8 & 0xffffffffu;
  }

  std::vector<std::byte> out_;
  std::uint64_t low_ = 0, waiting_ = 0;
  std::uint32_t range_ = 0xffffffffu;
  std::uint8_t cache_ = 0;
  bool begun_ = false;
};

/// Reads any bytes; of those behind the end it takes zeros, and tells.
class RangeReader {
 public:
  static constexpr bool kReads = true;
  explicit RangeReader(std::span<const std::byte> bytes) : bytes_(bytes) {
    for (int n = 0; n < 4; ++n) code_ = code_ << 8 | next();
  }
  bool bit(BitChance& chance, bool = false) {
    const std::uint32_t part = chance.part(range_);
    const bool value = code_ >= part;
    if (value) {
      code_ -= part;
      range_ -= part;
    } else {
      range_ = part;
    }
    chance.learn(value);
    settle();
    return value;
  }
  std::uint32_t plain(std::uint32_t, int count) {
    std::uint32_t value = 0;
    for (int n = 0; n < count; ++n) {
      range_ >>= 1;
      const bool one = code_ >= range_;
      if (one) code_ -= range_;
      value = value << 1 | std::uint32_t(one);
      settle();
    }
    return value;
  }
  /// Was more asked for than there is, or less?
  bool atEnd() const { return at_ == bytes_.size(); }

 private:
  std::uint8_t next() { return at_ < bytes_.size() ? std::uint8_t(bytes_[at_++]) : over(); }
  std::uint8_t over() {
    at_ = bytes_.size() + 1;
    return 0;
  }
  void settle() {
    while (range_ < (1u << 24)) {
      range_ <<= 8;
      code_ = code_ << 8 | next();
    }
  }

  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  std::uint32_t range_ = 0xffffffffu, code_ = 0;
};

/// A number of kBits bits, the highest first, each by those before it.
template <std::size_t kBits>
class BitTree {
 public:
  template <class Coder>
  std::uint32_t code(Coder& coder, std::uint32_t value) {
    std::uint32_t at = 1;
    for (std::size_t b = kBits; b-- > 0;)
      at = at << 1 | std::uint32_t(coder.bit(chances_[at], (value >> b & 1u) != 0));
    return at - (1u << kBits);
  }

 private:
  std::array<BitChance, 1u << kBits> chances_;
};

}  // namespace acentric
