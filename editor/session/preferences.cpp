#include "editor/session/preferences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "editor/session/engine_texts.h"
#include "editor/session/project_files.h"
#include "editor/session/settings_file.h"
#include "editor/session/user_folder.h"
#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t kLargestPreferences = std::size_t(1) << 20;

/// A value that is missing, of another kind or not finite leaves `value`; one out of range is put into it.
template <class Number>
void readNumber(const Json& json, const char* name, Number& value, double least, double most) {
  const auto found = json.find(name);
  if (found == json.end() || !found->is_number()) return;
  const double read = found->get<double>();
  if (std::isfinite(read)) value = Number(std::clamp(read, least, most));
}

void readFlag(const Json& json, const char* name, bool& value) {
  if (const auto found = json.find(name); found != json.end() && found->is_boolean())
    value = found->get<bool>();
}

template <class Enum>
void readName(const Json& json, const char* name, Enum& value, std::span<const char* const> names) {
  const auto found = json.find(name);
  if (found == json.end() || !found->is_string()) return;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (found->get<std::string>() == names[i]) value = Enum(i);
}

std::string textOf(const Json& json, const char* name) {
  const auto found = json.find(name);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

void readPublished(const Json& json, std::vector<RememberedPlace>& published) {
  const auto list = json.find("published");
  if (list == json.end() || !list->is_array()) return;
  for (const Json& entry : *list) {
    if (!entry.is_object() || published.size() == Preferences::kMostPublished) continue;
    RememberedPlace known{textOf(entry, "project"), {textOf(entry, "folder")}};
    known.place.publicAddress = textOf(entry, "publicAddress");
    readFlag(entry, "oneFile", known.place.oneFile);
    readFlag(entry, "openBrowser", known.place.openBrowser);
    if (!known.project.empty() && known.place.folder.is_absolute()) published.push_back(std::move(known));
  }
}

constexpr std::array<const char*, 2> kThemes = {"dark", "light"};
constexpr std::array<const char*, 3> kGraphics = {"automatic", "processor", "card"};
constexpr std::array<const char*, 3> kStartUps = {"sample", "lastProject", "nothing"};

/// A splitter that was dragged off the window is of no use: such a length is left at its default.
void readLength(const Json& json, const char* name, float& value) {
  float read = value;
  readNumber(json, name, read, 0, 1e6);
  if (read >= 50 && read <= 10000) value = read;
}

}  // namespace

void Preferences::addRecent(const fs::path& file) {
  std::erase(recent, file);
  recent.insert(recent.begin(), file);
  if (recent.size() > kMostRecent) recent.resize(kMostRecent);
}

void Preferences::rememberPublished(const fs::path& project, const PublishPlace& place) {
  std::erase_if(published, [&](const RememberedPlace& known) { return known.project == project; });
  published.insert(published.begin(), {project, place});
  if (published.size() > kMostPublished) published.resize(kMostPublished);
}

void Preferences::resetSettings() {
  Preferences fresh;
  fresh.recent = std::move(recent);
  fresh.published = std::move(published);
  fresh.lastFolder = std::move(lastFolder);
  fresh.guideSeen = guideSeen;
  fresh.keepLayoutOf(*this);
  *this = std::move(fresh);
}

void Preferences::resetLayout() { keepLayoutOf(Preferences()); }

void Preferences::keepLayoutOf(const Preferences& other) {
  settingsWidth = other.settingsWidth;
  walkWidth = other.walkWidth;
  bottomHeight = other.bottomHeight;
  showSettings = other.showSettings;
  showBottom = other.showBottom;
  fourViews = other.fourViews;
  fourColumn = other.fourColumn;
  fourRow = other.fourRow;
}

fs::path startUpFile(const Preferences& preferences, const fs::path& sample) {
  switch (preferences.startUp) {
    case StartUp::sample:
      return sample;
    case StartUp::lastProject:
      return preferences.recent.empty() ? sample : preferences.recent.front();
    case StartUp::nothing:
      break;
  }
  return {};
}

fs::path preferencesFile() {
  const fs::path folder = userFolder("XDG_CONFIG_HOME", ".config");
  return folder.empty() ? folder : folder / "editor.json";
}

Preferences loadPreferences(const fs::path& file, std::string* problem) {
  Preferences preferences;
  if (file.empty()) return preferences;
  const auto text = readText(file, kLargestPreferences);
  if (!text) {
    if (problem != nullptr && text.error().kind != ErrorKind::notFound)
      *problem = trf("The preferences cannot be read: {}", engineText(text.error()));
    return preferences;
  }
  const Json json = parseJson<Json>(*text).value_or(Json());
  if (!json.is_object()) {
    const fs::path aside = putAside(file);
    if (problem != nullptr)
      *problem = aside.empty() ? tr("The preferences were damaged and begin anew.")
                               : trf("The preferences were damaged and begin anew; the old ones are in {}",
                                     aside.string());
    return preferences;
  }
  if (const auto recent = json.find("recent"); recent != json.end() && recent->is_array())
    for (const Json& entry : *recent)
      if (entry.is_string() && preferences.recent.size() < Preferences::kMostRecent)
        preferences.recent.emplace_back(entry.get<std::string>());
  preferences.lastFolder = textOf(json, "lastFolder");
  readPublished(json, preferences.published);
  using P = Preferences;
  readNumber(json, "bakeThreads", preferences.bakeThreads, 0, 256);
  readNumber(json, "bakeMegabytes", preferences.bakeMegabytes, 16, 1'000'000);
  readNumber(json, "walkMegabytes", preferences.walkMegabytes, 0, 1'000'000);
  readNumber(json, "walkMetresPerSecond", preferences.walkMetresPerSecond, 0.1, 20);
  readNumber(json, "historyMegabytes", preferences.historyMegabytes, 1, 1'000'000);
  readFlag(json, "reimportAutomatically", preferences.reimportAutomatically);
  readName(json, "graphics", preferences.graphics, kGraphics);
  readNumber(json, "lookSensitivity", preferences.lookSensitivity, P::kLeastLookSensitivity,
             P::kMostLookSensitivity);
  readFlag(json, "invertLook", preferences.invertLook);
  readNumber(json, "autosaveSeconds", preferences.autosaveSeconds, P::kLeastAutosaveSeconds,
             P::kMostAutosaveSeconds);
  readName(json, "theme", preferences.theme, kThemes);
  if (const std::string code = textOf(json, "language"); isLanguage(code)) preferences.language = code;
  readNumber(json, "scalePercent", preferences.scalePercent, 0, P::kMostScalePercent);
  if (preferences.scalePercent > 0)
    preferences.scalePercent = std::max(preferences.scalePercent, P::kLeastScalePercent);
  readName(json, "startUp", preferences.startUp, kStartUps);
  readFlag(json, "guideSeen", preferences.guideSeen);
  readLength(json, "settingsWidth", preferences.settingsWidth);
  readLength(json, "walkWidth", preferences.walkWidth);
  readLength(json, "bottomHeight", preferences.bottomHeight);
  readFlag(json, "showSettings", preferences.showSettings);
  readFlag(json, "showBottom", preferences.showBottom);
  readFlag(json, "fourViews", preferences.fourViews);
  readNumber(json, "fourColumn", preferences.fourColumn, P::kLeastShare, 1 - P::kLeastShare);
  readNumber(json, "fourRow", preferences.fourRow, P::kLeastShare, 1 - P::kLeastShare);
  return preferences;
}

Status savePreferences(const Preferences& preferences, const fs::path& file) {
  if (file.empty()) return {};
  Json recent = Json::array();
  for (const fs::path& path : preferences.recent) recent.push_back(path.string());
  Json published = Json::array();
  for (const RememberedPlace& known : preferences.published)
    published.push_back({{"project", known.project.string()},
                         {"folder", known.place.folder.string()},
                         {"oneFile", known.place.oneFile},
                         {"openBrowser", known.place.openBrowser},
                         {"publicAddress", known.place.publicAddress}});
  const Json json = {{"recent", std::move(recent)},
                     {"published", std::move(published)},
                     {"lastFolder", preferences.lastFolder.string()},
                     {"bakeThreads", preferences.bakeThreads},
                     {"bakeMegabytes", preferences.bakeMegabytes},
                     {"walkMegabytes", preferences.walkMegabytes},
                     {"walkMetresPerSecond", preferences.walkMetresPerSecond},
                     {"historyMegabytes", preferences.historyMegabytes},
                     {"reimportAutomatically", preferences.reimportAutomatically},
                     {"graphics", kGraphics[std::size_t(preferences.graphics)]},
                     {"lookSensitivity", preferences.lookSensitivity},
                     {"invertLook", preferences.invertLook},
                     {"autosaveSeconds", preferences.autosaveSeconds},
                     {"language", preferences.language},
                     {"theme", kThemes[std::size_t(preferences.theme)]},
                     {"scalePercent", preferences.scalePercent},
                     {"startUp", kStartUps[std::size_t(preferences.startUp)]},
                     {"guideSeen", preferences.guideSeen},
                     {"settingsWidth", preferences.settingsWidth},
                     {"walkWidth", preferences.walkWidth},
                     {"bottomHeight", preferences.bottomHeight},
                     {"showSettings", preferences.showSettings},
                     {"showBottom", preferences.showBottom},
                     {"fourViews", preferences.fourViews},
                     {"fourColumn", preferences.fourColumn},
                     {"fourRow", preferences.fourRow}};
  return saveSettings(json, file);
}

}  // namespace acentric::editor
