#pragma once
/// JSON as text, read and written here alone. Text that is read is hostile: how deep it may nest is limited,
/// since what walks through JSON does so by calling itself. Text that is written holds names of files, which
/// may be any bytes: what is not UTF-8 becomes U+FFFD. Neither throws.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace acentric {

/// Files of this program nest about ten levels, glTF with its extensions not many more.
inline constexpr int kMostJsonLevels = 100;

/// Json: nlohmann::json or nlohmann::ordered_json. Compiled once: the library's parser is large.
/// `indent` < 0: on one line.
template <class Json>
std::string jsonText(const Json& json, int indent = -1);

/// Only such text comes back from JSON as it went in.
bool isUtf8(const std::string& text);

/// `malformed` with where in the text it stops being JSON, or that it nests too deep.
template <class Json = nlohmann::json>
Result<Json> parseJson(std::string_view text, const std::string& where = {});

}  // namespace acentric
