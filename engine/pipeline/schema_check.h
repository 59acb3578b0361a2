#pragma once
/// A JSON document against a JSON Schema (draft 7), with words for a person: where, what is wrong, what would
/// be right.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace acentric {

/// Fails with the first thing that the schema refuses, as "/layout/cellSize: must be at least 0.0001, not
/// -1".
Status checkSchema(const nlohmann::ordered_json& json, std::string_view schema, const std::string& where);

}  // namespace acentric
