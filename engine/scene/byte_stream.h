#pragma once
/// Values to bytes and back, one behind the other, with every read checked against what is left.
/// Little-endian machines only, as the rest of the engine. Private to this folder.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace acentric {

class ByteWriter {
 public:
  using Sink = std::function<void(std::span<const std::byte>)>;
  explicit ByteWriter(Sink sink) : sink_(std::move(sink)) {}

  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(&v, sizeof v);
  }
  /// As ByteReader's of the same names.
  template <class T>
  void small(const T& v, int) {
    value(static_cast<std::uint8_t>(v));
  }
  void number(int v) { value(std::int32_t(v)); }
  template <class T>
  void each(const std::vector<T>& things, const auto& write) {
    value(std::uint64_t(things.size()));
    for (const T& thing : things) write(thing);
  }
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

 private:
  void append(const void* data, std::size_t size) {
    if (size > 0) sink_({static_cast<const std::byte*>(data), size});
  }
  Sink sink_;
};

/// After the first read beyond the end, or one that the source cannot serve, every read gives zeros and
/// `sound()` is false.
class ByteReader {
 public:
  /// Fills the bytes, or is false.
  using Source = std::function<bool(std::span<std::byte>)>;
  /// `left`: how many bytes the source has.
  ByteReader(Source source, std::uint64_t left) : source_(std::move(source)), left_(left) {}

  template <class T>
  void value(T& out) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (!take(&out, sizeof out)) out = T{};
  }
  /// An enumeration or flag stored in one byte, at most `last`.
  template <class T>
  void small(T& out, int last) {
    std::uint8_t byte = 0;
    value(byte);
    if (byte > last) sound_ = false, byte = 0;
    out = static_cast<T>(byte);
  }
  void number(int& out) {
    std::int32_t number = 0;
    value(number);
    out = number;
  }
  template <class T>
  void each(std::vector<T>& things, const auto& read) {
    const std::size_t count = length(8);
    for (std::size_t i = 0; i < count && sound(); ++i) read(things.emplace_back());
  }
  void text(std::string& out) { fill(out); }
  template <class T>
  void array(std::vector<T>& out) {
    static_assert(std::is_trivially_copyable_v<T>);
    fill(out);
  }
  /// A count of things that each take at least `least` bytes: never more than fit in what is left.
  std::size_t length(std::size_t least) {
    std::uint64_t count = 0;
    value(count);
    if (count > left_ / least) sound_ = false;
    return sound_ ? std::size_t(count) : 0;
  }
  /// What was read cannot be.
  void refuse() { sound_ = false; }
  bool sound() const { return sound_; }
  bool atEnd() const { return left_ == 0; }

 private:
  /// Memory is touched as bytes arrive: a size that is a lie costs no more than what there is.
  template <class Container>
  void fill(Container& out) {
    using T = typename Container::value_type;
    constexpr std::size_t kStep = (std::size_t(1) << 20) / sizeof(T) + 1;
    const std::size_t size = length(sizeof(T));
    out.clear();
    out.reserve(size);
    while (out.size() < size && sound_) {
      const std::size_t had = out.size();
      out.resize(std::min(size, had + kStep));
      if (!take(out.data() + had, (out.size() - had) * sizeof(T))) out.clear();
    }
  }
  bool take(void* to, std::size_t size) {
    sound_ = sound_ && size <= left_ && source_({static_cast<std::byte*>(to), size});
    if (sound_) left_ -= size;
    return sound_;
  }
  Source source_;
  std::uint64_t left_;
  bool sound_ = true;
};

}  // namespace acentric
