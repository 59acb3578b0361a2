#pragma once
/// JSON that is read once, each value checked as it is taken. The first that is wrong ends the reading: its
/// JSON pointer is put together then.

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <iterator>
#include <new>
#include <string>
#include <string_view>

#include "engine/base/json_text.h"
#include "engine/base/result.h"
#include "engine/export/bundle_json.h"

namespace acentric {

/// A value and the way to it.
class CheckedJson {
 public:
  explicit CheckedJson(const BundleJson& json) : json_(&json) {}

  /// Thrown by what follows, caught by parseChecked.
  struct Refused {
    std::string pointer, reason;
  };
  [[noreturn]] void refuse(std::string reason) const {
    throw Refused{way_.empty() ? "/" : way_, std::move(reason)};
  }

  bool isNull() const { return json_->is_null(); }
  bool has(const char* key) const { return json_->is_object() && json_->contains(key); }
  CheckedJson operator[](const char* key) const {
    if (!json_->is_object()) refuse("must be an object");
    const auto found = json_->find(key);
    if (found == json_->end()) refuse(fmt::format("lacks '{}'", key));
    return CheckedJson(*found, way_ + "/" + key);
  }
  std::size_t size() const { return json_->size(); }
  /// `index` is below size().
  CheckedJson operator[](std::size_t index) const {
    return CheckedJson((*json_)[index], way_ + "/" + std::to_string(index));
  }

  void list(std::size_t least, std::size_t most) const {
    if (!json_->is_array()) refuse("must be a list");
    if (json_->size() < least || json_->size() > most)
      refuse(fmt::format("must have {} to {} entries, not {}", least, most, json_->size()));
  }
  double number(double low, double high) const {
    if (!json_->is_number()) refuse("must be a number");
    const double value = json_->get<double>();
    if (!(value >= low && value <= high)) refuse(fmt::format("must lie in {} .. {}", low, high));
    return value;
  }
  std::int64_t integer(std::int64_t low, std::int64_t high) const {
    if (!json_->is_number_integer()) refuse("must be a whole number");
    if (json_->is_number_unsigned() && json_->get<std::uint64_t>() > std::uint64_t(INT64_MAX))
      refuse("is too large");
    const auto value = json_->get<std::int64_t>();
    if (value < low || value > high) refuse(fmt::format("must lie in {} .. {}", low, high));
    return value;
  }
  bool boolean() const {
    if (!json_->is_boolean()) refuse("must be true or false");
    return json_->get<bool>();
  }
  std::string text(std::size_t most = 10'000) const {
    if (!json_->is_string()) refuse("must be a text");
    const auto& value = json_->get_ref<const std::string&>();
    if (value.size() > most) refuse(fmt::format("is longer than {} bytes", most));
    return value;
  }
  /// Number of one of some words.
  template <std::size_t Count>
  std::size_t word(const char* const (&words)[Count]) const {
    const std::string value = text();
    for (std::size_t i = 0; i < Count; ++i)
      if (value == words[i]) return i;
    refuse(fmt::format("'{}' is not known here", value));
  }

 private:
  CheckedJson(const BundleJson& json, std::string way) : json_(&json), way_(std::move(way)) {}

  const BundleJson* json_;
  std::string way_;  ///< a JSON pointer
};

/// `read` of the root. What is wrong with the text becomes an error of `where`.
template <class Value, class Read>
Result<Value> parseChecked(const std::string& text, const std::string& where, const Read& read) {
  try {
    const auto json = parseJson<BundleJson>(text, where);
    if (!json) return tl::unexpected(json.error());
    return read(CheckedJson(*json));
  } catch (const CheckedJson::Refused& refused) {
    return fail(ErrorKind::malformed, refused.pointer + ": " + refused.reason, where);
  } catch (const BundleJson::exception& problem) {
    return fail(ErrorKind::malformed, std::string("is no JSON: ") + problem.what(), where);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory", where);
  }
}

}  // namespace acentric
