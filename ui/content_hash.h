#pragma once
/// What something is drawn from, told by a number: equal numbers stand for equal pixels.

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace acentric::ui {

class ContentHash {
 public:
  void add(const void* data, std::size_t bytes);
  /// Of values without padding.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void add(const T& value) { add(&value, sizeof value); }
  template <class T>
  void add(std::span<const T> values) {
    add(values.data(), values.size_bytes());
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0;
};

}  // namespace acentric::ui
