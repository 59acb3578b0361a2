#include "engine/pipeline/schema_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>
#include <vector>

#include "engine/base/json_text.h"

namespace acentric {
namespace {

using Json = nlohmann::ordered_json;

/// valijson decides what is wrong; its words are for those who know the schema. This finds others, for the
/// keywords that schemas here use.
class Explainer {
 public:
  explicit Explainer(const Json& root) : root_(root) {}

  /// "POINTER: REASON" of the first thing that is wrong; nothing if it finds nothing.
  std::optional<std::string> explain(const Json& value, const Json& schema,
                                     const std::string& pointer) const {
    if (schema.contains("$ref"))
      return explain(value, root_.at(Json::json_pointer(schema.at("$ref").get<std::string>().substr(1))),
                     pointer);
    std::string wrong = wrongType(value, schema);
    if (wrong.empty()) wrong = wrongValue(value, schema);
    if (wrong.empty()) wrong = wrongCount(value, schema);
    if (wrong.empty()) wrong = wrongFields(value, schema);
    if (!wrong.empty()) return fmt::format("{}: {}", pointer.empty() ? "/" : pointer, wrong);
    return explainParts(value, schema, pointer);
  }

 private:
  static std::string shortText(const Json& value) {
    constexpr std::size_t kMost = 60;
    std::string text = jsonText(value);
    if (text.size() > kMost) text = text.substr(0, kMost) + "…";
    return text;
  }

  static std::string wrongType(const Json& value, const Json& schema) {
    if (!schema.contains("type")) return {};
    const auto type = schema.at("type").get<std::string>();
    const bool right =
        (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
        (type == "string" && value.is_string()) || (type == "boolean" && value.is_boolean()) ||
        (type == "number" && value.is_number()) ||
        (type == "integer" && value.is_number() && value.get<double>() == std::trunc(value.get<double>()));
    if (right) return {};
    const std::string_view named = type == "object"    ? "an object"
                                   : type == "array"   ? "a list"
                                   : type == "string"  ? "a text in quotes"
                                   : type == "boolean" ? "true or false"
                                   : type == "integer" ? "a whole number"
                                                       : "a number";
    return fmt::format("must be {}, not {}", named, shortText(value));
  }

  static std::string wrongValue(const Json& value, const Json& schema) {
    if (schema.contains("const") && value != schema.at("const"))
      return fmt::format("must be {}, not {}", jsonText(schema.at("const")), shortText(value));
    if (schema.contains("enum") && std::ranges::find(schema.at("enum"), value) == schema.at("enum").end()) {
      std::vector<std::string> choices;
      for (const Json& choice : schema.at("enum")) choices.push_back(jsonText(choice));
      return fmt::format("must be one of {}, not {}", fmt::join(choices, ", "), shortText(value));
    }
    if (!value.is_number()) return {};
    if (schema.contains("minimum") && !(value.get<double>() >= schema.at("minimum").get<double>()))
      return fmt::format("must be at least {}, not {}", jsonText(schema.at("minimum")), shortText(value));
    if (schema.contains("maximum") && !(value.get<double>() <= schema.at("maximum").get<double>()))
      return fmt::format("must be at most {}, not {}", jsonText(schema.at("maximum")), shortText(value));
    return {};
  }

  /// Of a list's entries or a text's characters.
  static std::string wrongCount(const Json& value, const Json& schema) {
    if (!value.is_array() && !value.is_string()) return {};
    const bool list = value.is_array();
    const auto limit = [&](const char* ofList, const char* ofText, double otherwise) {
      return schema.value(list ? ofList : ofText, otherwise);
    };
    const std::string text = list ? "" : value.get<std::string>();
    const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; };  // of UTF-8
    const auto count = list ? std::ptrdiff_t(value.size()) : std::ranges::count_if(text, begins);
    const double least = limit("minItems", "minLength", 0), most = limit("maxItems", "maxLength", 1e18);
    const std::string_view of = list ? "entries" : "characters";
    if (least == most && double(count) != least)
      return fmt::format("must have {} {}, not {}", least, of, count);
    if (double(count) < least) return fmt::format("must have at least {} {}, not {}", least, of, count);
    if (double(count) > most) return fmt::format("must have at most {} {}, not {}", most, of, count);
    return {};
  }

  static std::vector<std::string> keysOf(const Json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    return keys;
  }

  static std::string wrongFields(const Json& value, const Json& schema) {
    if (!value.is_object()) return {};
    for (const Json& name : schema.value("required", Json::array()))
      if (!value.contains(name.get<std::string>())) return fmt::format("has no {}", jsonText(name));
    const Json known = schema.value("properties", Json::object());
    if (schema.value("additionalProperties", Json(true)) == Json(false))
      for (const std::string& key : keysOf(value))
        if (!known.contains(key))
          return fmt::format("has \"{}\", which is none of the fields here: {}", key.substr(0, 60),
                             fmt::join(keysOf(known), ", "));
    std::vector<std::string> alternatives;
    for (const Json& alternative : schema.value("oneOf", Json::array()))
      for (const Json& name : alternative.value("required", Json::array()))
        alternatives.push_back(jsonText(name));
    const auto given = std::ranges::count_if(alternatives, [&](const std::string& name) {
      return value.contains(name.substr(1, name.size() - 2));
    });
    if (!alternatives.empty() && given != 1)
      return fmt::format("must have just one of {}", fmt::join(alternatives, " and "));
    return {};
  }

  std::optional<std::string> explainParts(const Json& value, const Json& schema,
                                          const std::string& pointer) const {
    if (value.is_object() && schema.contains("properties"))
      for (const auto& [key, part] : schema.at("properties").items())
        if (value.contains(key))
          if (auto wrong = explain(value.at(key), part, pointer + "/" + key)) return wrong;
    if (value.is_array() && schema.contains("items"))
      for (std::size_t i = 0; i < value.size(); ++i)
        if (auto wrong = explain(value[i], schema.at("items"), fmt::format("{}/{}", pointer, i)))
          return wrong;
    return std::nullopt;
  }

  const Json& root_;
};

/// Of the deepest error: those above it only repeat that something below is wrong.
std::string valijsonsWords(valijson::ValidationResults& results) {
  std::string pointer = "/", reason = "is not what the schema asks for";
  std::size_t depth = 0;
  for (valijson::ValidationResults::Error error; results.popError(error);)
    if (error.context.size() >= depth) {
      depth = error.context.size();
      pointer.clear();
      for (std::size_t i = 1; i < error.context.size(); ++i) {  // [0] is "<root>"; entries look like "[name]"
        const std::string& part = error.context[i];
        pointer += "/" + (part.size() > 2 && part.front() == '[' ? part.substr(1, part.size() - 2) : part);
      }
      if (pointer.empty()) pointer = "/";
      reason = error.description;
    }
  return fmt::format("{}: {}", pointer, reason);
}

}  // namespace

Status checkSchema(const Json& json, std::string_view schemaText, const std::string& where) {
  const nlohmann::json plain = json;  // the adapter reads nlohmann::json
  const auto parsedSchema = parseJson<Json>(schemaText, "schema");
  if (!parsedSchema) return tl::unexpected(parsedSchema.error());
  const Json& schemaJson = *parsedSchema;
  valijson::Schema schema;
  valijson::SchemaParser parser;
  const nlohmann::json plainSchema = schemaJson;
  parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(plainSchema), schema);
  valijson::Validator validator;
  valijson::ValidationResults results;
  if (validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(plain), &results)) return {};
  const auto explained = Explainer(schemaJson).explain(json, schemaJson, "");
  return fail(ErrorKind::malformed, explained ? *explained : valijsonsWords(results), where);
}

}  // namespace acentric
