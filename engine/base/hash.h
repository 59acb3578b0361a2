#pragma once
/// Content keys: XXH3 128-bit over everything that can change a result. Not cryptographic.

#include <array>
#include <compare>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/base/result.h"

namespace acentric {

struct ContentKey {
  std::uint64_t high = 0;
  std::uint64_t low = 0;
  auto operator<=>(const ContentKey&) const = default;
  std::string toHex() const;  ///< 32 lower-case hexadecimal digits
  static Result<ContentKey> fromHex(std::string_view text);
};

/// Streams bytes into a key. Values go in as their object bytes: only feed types without padding.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(Hasher&&) noexcept;
  Hasher& operator=(Hasher&&) noexcept;

  Hasher& bytes(const void* data, std::size_t size);
  Hasher& text(std::string_view value);  ///< length first, so that "ab"+"c" differs from "a"+"bc"
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T> Hasher& value(T v) {
    if constexpr (std::is_floating_point_v<T>)
      if (v == T(0)) v = T(0);  // -0 and +0 are one value
    return bytes(&v, sizeof v);
  }
  template <class T>
  Hasher& array(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(static_cast<std::uint64_t>(values.size()));
    return bytes(values.data(), values.size_bytes());
  }
  ContentKey finish() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A key made of named parts: when it changed, one can tell which of them did.
struct KeyPart {
  std::string name;  ///< one word
  ContentKey key;
  bool operator==(const KeyPart&) const = default;
};
using KeyParts = std::vector<KeyPart>;
ContentKey keyOf(const KeyParts& parts);

/// Key of a file's bytes.
Result<ContentKey> hashFile(const std::filesystem::path& path);

}  // namespace acentric
