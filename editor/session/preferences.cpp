#include "editor/session/preferences.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "engine/base/file.h"

namespace acentric::editor {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t kMostBytes = std::size_t(1) << 20;

float readLength(const Json& json, const char* name, float otherwise) {
  const auto found = json.find(name);
  if (found == json.end() || !found->is_number()) return otherwise;
  const double value = found->get<double>();
  return std::isfinite(value) && value >= 50 && value <= 10000 ? float(value) : otherwise;
}

}  // namespace

void Preferences::addRecent(const fs::path& file) {
  std::erase(recent, file);
  recent.insert(recent.begin(), file);
  if (recent.size() > kMostRecent) recent.resize(kMostRecent);
}

fs::path preferencesFile() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && *config == '/') return fs::path(config) / "acentric" / "editor.json";
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home != '\0') return fs::path(home) / ".config" / "acentric" / "editor.json";
  return {};
}

Preferences loadPreferences(const fs::path& file) {
  Preferences preferences;
  if (file.empty()) return preferences;
  const auto text = readText(file, kMostBytes);
  if (!text) return preferences;
  const Json json = Json::parse(*text, nullptr, false);
  if (!json.is_object()) return preferences;
  if (const auto recent = json.find("recent"); recent != json.end() && recent->is_array())
    for (const Json& entry : *recent)
      if (entry.is_string() && preferences.recent.size() < Preferences::kMostRecent)
        preferences.recent.emplace_back(entry.get<std::string>());
  if (const auto folder = json.find("lastFolder"); folder != json.end() && folder->is_string())
    preferences.lastFolder = folder->get<std::string>();
  if (const auto threads = json.find("bakeThreads"); threads != json.end() && threads->is_number_integer())
    preferences.bakeThreads = std::clamp(threads->get<int>(), 0, 256);
  if (const auto memory = json.find("bakeMegabytes"); memory != json.end() && memory->is_number_integer())
    preferences.bakeMegabytes = std::clamp(memory->get<int>(), 16, 1'000'000);
  if (const auto memory = json.find("walkMegabytes"); memory != json.end() && memory->is_number_integer())
    preferences.walkMegabytes = std::clamp(memory->get<int>(), 0, 1'000'000);
  if (const auto speed = json.find("walkMetresPerSecond"); speed != json.end() && speed->is_number())
    preferences.walkMetresPerSecond = std::clamp(speed->get<double>(), 0.1, 20.0);
  preferences.settingsWidth = readLength(json, "settingsWidth", preferences.settingsWidth);
  preferences.walkWidth = readLength(json, "walkWidth", preferences.walkWidth);
  preferences.bottomHeight = readLength(json, "bottomHeight", preferences.bottomHeight);
  return preferences;
}

Status savePreferences(const Preferences& preferences, const fs::path& file) {
  if (file.empty()) return {};
  Json recent = Json::array();
  for (const fs::path& path : preferences.recent) recent.push_back(path.string());
  const Json json = {{"recent", std::move(recent)},
                     {"lastFolder", preferences.lastFolder.string()},
                     {"bakeThreads", preferences.bakeThreads},
                     {"bakeMegabytes", preferences.bakeMegabytes},
                     {"walkMegabytes", preferences.walkMegabytes},
                     {"walkMetresPerSecond", preferences.walkMetresPerSecond},
                     {"settingsWidth", preferences.settingsWidth},
                     {"walkWidth", preferences.walkWidth},
                     {"bottomHeight", preferences.bottomHeight}};
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error)
    return fail(ErrorKind::unreadable, "the folder cannot be made: " + error.message(),
                file.parent_path().string());
  // Names that are not UTF-8 are replaced rather than refused: losing a recent entry is no reason to fail.
  return writeTextAtomically(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace acentric::editor
