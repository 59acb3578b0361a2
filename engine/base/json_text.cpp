#include "engine/base/json_text.h"

#include <fmt/format.h>

#include <new>

namespace acentric {

template <class Json>
std::string jsonText(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

bool isUtf8(const std::string& text) {
  try {
    static_cast<void>(nlohmann::json(text).dump());
    return true;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

template <class Json>
Result<Json> parseJson(std::string_view text, const std::string& where) {
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

template std::string jsonText(const nlohmann::json&, int);
template std::string jsonText(const nlohmann::ordered_json&, int);
template Result<nlohmann::json> parseJson(std::string_view, const std::string&);
template Result<nlohmann::ordered_json> parseJson(std::string_view, const std::string&);

}  // namespace acentric
