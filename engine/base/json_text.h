#pragma once
/// JSON as text, read and written here alone. Text that is read is hostile: how deep it may nest is limited,
/// since what walks through JSON does so by calling itself. Text that is written holds names of files, which
/// may be any bytes: what is not UTF-8 becomes U+FFFD. Neither throws.

#include <fmt/format.h>

#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace acentric {

/// Files of this program nest about ten levels, glTF with its extensions not many more.
inline constexpr int kMostJsonLevels = 100;

/// `indent` < 0: on one line.
template <class Json>
std::string jsonText(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// Only such text comes back from JSON as it went in.
inline bool isUtf8(const std::string& text) {
  try {
    static_cast<void>(nlohmann::json(text).dump());
    return true;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

/// `malformed` with where in the text it stops being JSON, or that it nests too deep.
template <class Json = nlohmann::json>
Result<Json> parseJson(std::string_view text, const std::string& where = {}) {
  struct TooDeep {};
  try {
    return Json::parse(text, [](int depth, typename Json::parse_event_t, Json&) {
      if (depth > kMostJsonLevels) throw TooDeep{};
      return true;
    });
  } catch (const TooDeep&) {
    return fail(ErrorKind::malformed, fmt::format("is nested more than {} levels deep", kMostJsonLevels),
                where);
  } catch (const nlohmann::detail::exception& problem) {
    return fail(ErrorKind::malformed, fmt::format("is not JSON that can be read: {}", problem.what()), where);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory", where);
  }
}

}  // namespace acentric
