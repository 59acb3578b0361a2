#pragma once
/// Values to bytes and back, with every read checked against what is left. Little-endian machines only, as
/// the rest of the engine. Private to this folder.

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace acentric {

class ByteWriter {
 public:
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(&v, sizeof v);
  }
  void flag(bool v) { value(std::uint8_t(v)); }
  void text(const std::string& v) {
    value(std::uint64_t(v.size()));
    append(v.data(), v.size());
  }
  template <class T>
  void array(const std::vector<T>& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(std::uint64_t(v.size()));
    append(v.data(), v.size() * sizeof(T));
  }
  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  void append(const void* data, std::size_t size) {
    if (size == 0) return;
    const auto* from = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), from, from + size);
  }
  std::vector<std::byte> bytes_;
};

/// After the first read beyond the end every read gives zeros and `sound()` is false.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  void value(T& out) {
    static_assert(std::is_trivially_copyable_v<T>);
    out = T{};
    if (take(sizeof out)) std::memcpy(&out, bytes_.data() + at_ - sizeof out, sizeof out);
  }
  /// An enumeration or flag stored in one byte, at most `last`.
  template <class T>
  void small(T& out, int last) {
    std::uint8_t byte = 0;
    value(byte);
    if (byte > last) sound_ = false, byte = 0;
    out = static_cast<T>(byte);
  }
  void text(std::string& out) {
    const std::size_t size = length(1);
    out.assign(reinterpret_cast<const char*>(bytes_.data() + at_), size);
    at_ += size;
  }
  template <class T>
  void array(std::vector<T>& out) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t size = length(sizeof(T));
    out.resize(size);
    if (size > 0) std::memcpy(out.data(), bytes_.data() + at_, size * sizeof(T));
    at_ += size * sizeof(T);
  }
  /// A count of things that each take at least `least` bytes: never more than fit in what is left.
  std::size_t length(std::size_t least) {
    std::uint64_t count = 0;
    value(count);
    if (count > (bytes_.size() - at_) / least) sound_ = false;
    return sound_ ? std::size_t(count) : 0;
  }
  bool sound() const { return sound_; }
  bool atEnd() const { return at_ == bytes_.size(); }

 private:
  bool take(std::size_t size) {
    sound_ = sound_ && size <= bytes_.size() - at_;
    if (sound_) at_ += size;
    return sound_;
  }
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  bool sound_ = true;
};

}  // namespace acentric
