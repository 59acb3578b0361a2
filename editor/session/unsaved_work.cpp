#include "editor/session/unsaved_work.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "editor/session/user_folder.h"
#include "engine/base/file.h"
#include "engine/base/hash.h"
#include "engine/base/json_text.h"
#include "engine/pipeline/project_lock.h"

namespace acentric::editor {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t kLargestAutosave = std::size_t(64) << 20;
constexpr const char* kEnding = ".unsaved.json";
constexpr const char* kFormat = "acentric-unsaved";

/// Or of one of another machine, of which nobody knows.
bool isOfLivingProcess(const Json& json) {
  LockOwner owner;
  try {
    owner.process = json.at("process");
    owner.processStart = json.at("processStart");
    owner.machine = json.at("machine");
  } catch (const Json::exception&) {
    return false;
  }
  return !isStale(owner);
}

Result<Json> readJson(const fs::path& autosave) {
  const auto text = readText(autosave, kLargestAutosave);
  if (!text) return tl::unexpected(text.error());
  auto json = parseJson<Json>(*text);
  if (!json || !json->is_object() || json->value("format", Json()) != kFormat)
    return fail(ErrorKind::malformed, "is no autosave that could be read", autosave.string());
  return json;
}

}  // namespace

fs::path unsavedWorkFolder() {
  const fs::path folder = userFolder("XDG_STATE_HOME", ".local/state");
  return folder.empty() ? folder : folder / "unsaved";
}

fs::path unsavedWorkFile(const fs::path& folder, const fs::path& projectFile) {
  const std::string key = Hasher().text(projectFile.string()).finish().toHex();
  return folder / fmt::format("{}-{}{}", key, ::getpid(), kEnding);
}

Status writeUnsavedWork(const fs::path& folder, const fs::path& projectFile, const Project& project) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    return fail(ErrorKind::unreadable, "the folder cannot be made: " + error.message(), folder.string());
  const auto stated = parseJson<Json>(formatProject(project), projectFile.string());
  if (!stated) return tl::unexpected(stated.error());
  const LockOwner owner = thisOwner();
  const Json json = {
      {"format", kFormat},        {"file", projectFile.string()},       {"since", owner.since},
      {"process", owner.process}, {"processStart", owner.processStart}, {"machine", owner.machine},
      {"project", *stated}};
  return writeTextAtomically(unsavedWorkFile(folder, projectFile), jsonText(json, 2) + "\n");
}

Result<UnsavedWork> readUnsavedWork(const fs::path& autosave) {
  const auto json = readJson(autosave);
  if (!json) return tl::unexpected(json.error());
  try {
    auto project = parseProject(jsonText(json->at("project")), autosave.string());
    if (!project) return tl::unexpected(project.error());
    return UnsavedWork{autosave, json->at("file").get<std::string>(), json->at("since"), std::move(*project)};
  } catch (const Json::exception&) {
    return fail(ErrorKind::malformed, "is no autosave that could be read", autosave.string());
  }
}

UnsavedWorks listUnsavedWork(const fs::path& folder) {
  UnsavedWorks list;
  std::error_code error;
  if (folder.empty()) return list;
  std::vector<std::pair<fs::file_time_type, UnsavedWork>> found;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (!entry.path().filename().string().ends_with(kEnding)) continue;
    const auto json = readJson(entry.path());
    if (json && isOfLivingProcess(*json)) continue;
    std::error_code ignored;
    auto work = readUnsavedWork(entry.path());
    if (work)
      found.emplace_back(entry.last_write_time(ignored), std::move(*work));
    else
      list.damaged.push_back(entry.path());
  }
  std::ranges::sort(found, std::greater(), [](const auto& each) { return each.first; });
  for (auto& [time, work] : found) list.works.push_back(std::move(work));
  return list;
}

}  // namespace acentric::editor
