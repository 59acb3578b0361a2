#include "editor/session/window_places.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "editor/session/settings_file.h"
#include "editor/session/unsaved_work.h"
#include "engine/base/file.h"
#include "engine/base/json_text.h"

namespace acentric::editor {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t kLargestPlaces = std::size_t(1) << 16;
constexpr double kMostPixels = 1e6;

/// Two whole numbers of a length that occurs.
std::optional<glm::ivec2> pairOf(const Json& json, const char* name) {
  const auto found = json.find(name);
  if (found == json.end() || !found->is_array() || found->size() != 2) return std::nullopt;
  glm::ivec2 pair(0);
  for (int i = 0; i < 2; ++i) {
    const Json& number = (*found)[std::size_t(i)];
    if (!number.is_number() || !(std::abs(number.get<double>()) <= kMostPixels)) return std::nullopt;
    pair[i] = int(number.get<double>());
  }
  return pair;
}

std::optional<ui::WindowPlace> placeOf(const Json& json) {
  if (!json.is_object()) return std::nullopt;
  const auto monitor = json.find("monitor"), maximised = json.find("maximised");
  const auto monitorSize = pairOf(json, "monitorSize"), at = pairOf(json, "at"), size = pairOf(json, "size");
  if (monitor == json.end() || !monitor->is_string() || !monitorSize || !at || !size) return std::nullopt;
  const bool filled = maximised != json.end() && maximised->is_boolean() && maximised->get<bool>();
  return ui::WindowPlace{monitor->get<std::string>(), *monitorSize, {*at, *size}, filled};
}

Json toJson(const ui::WindowPlace& place) {
  return {{"monitor", place.monitor},
          {"monitorSize", {place.monitorSize.x, place.monitorSize.y}},
          {"at", {place.rect.at.x, place.rect.at.y}},
          {"size", {place.rect.size.x, place.rect.size.y}},
          {"maximised", place.maximised}};
}

}  // namespace

fs::path windowPlacesFile() {
  const fs::path unsaved = unsavedWorkFolder();
  return unsaved.empty() ? fs::path() : unsaved.parent_path() / "windows.json";
}

std::vector<ui::WindowPlace> loadWindowPlaces(const fs::path& file) {
  std::vector<ui::WindowPlace> places;
  if (file.empty()) return places;
  const auto text = readText(file, kLargestPlaces);
  if (!text) return places;
  const Json json = parseJson<Json>(*text).value_or(Json());
  if (!json.is_array()) return places;
  for (const Json& entry : json)
    if (auto place = placeOf(entry); place && places.size() < ui::kMostWindowPlaces)
      places.push_back(std::move(*place));
  return places;
}

Status keepWindowPlace(const ui::WindowPlace& place, const fs::path& file) {
  if (file.empty()) return {};
  std::vector<ui::WindowPlace> places = loadWindowPlaces(file);
  ui::remember(places, place);
  Json json = Json::array();
  for (const ui::WindowPlace& known : places) json.push_back(toJson(known));
  return saveSettings(json, file);
}

}  // namespace acentric::editor
