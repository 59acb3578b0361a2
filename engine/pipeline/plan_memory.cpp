#include "engine/pipeline/plan_memory.h"

#include <sys/stat.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/file.h"
#include "engine/base/program_file.h"
#include "engine/scene/import_cache.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostBytes = std::size_t(256) << 20;

void addState(Hasher& hasher, const fs::path& path) {
  struct stat state {};
  const bool there = ::stat(path.c_str(), &state) == 0;
  hasher.text(path.string()).value(there);
  if (there)
    hasher.value(state.st_size).value(state.st_mtim.tv_sec).value(state.st_mtim.tv_nsec).value(state.st_ino);
}

std::string stateOfFiles(const std::vector<fs::path>& files) {
  Hasher hasher;
  for (const fs::path& path : files) addState(hasher, path);
  return hasher.finish().toHex();
}

Json toJson(const PlannedCapture& capture) {
  Json parts = Json::array();
  for (const KeyPart& part : capture.parts) parts.push_back({part.name, part.key.high, part.key.low});
  return {capture.subject, capture.pixels, std::move(parts)};
}

PlannedCapture captureFrom(const Json& json) {
  PlannedCapture capture{json.at(0).get<std::string>(), json.at(1).get<double>(), {}, {}};
  for (const Json& part : json.at(2))
    capture.parts.push_back(
        {part.at(0).get<std::string>(), {part.at(1).get<std::uint64_t>(), part.at(2).get<std::uint64_t>()}});
  capture.key = keyOf(capture.parts);
  return capture;
}

}  // namespace

PlanMemory::PlanMemory(const fs::path& file, std::optional<int> storey, const std::string& text,
                       const ImportHost& host)
    : file_(file), host_(host) {
  std::error_code error;
  const fs::path absolute = fs::weakly_canonical(fs::absolute(file, error), error);
  const fs::path folder = host.cacheFolder.empty() ? keptFolder("plans") : host.cacheFolder / "plans";
  const std::string name =
      Hasher().text(absolute.string()).value(storey.value_or(-1)).finish().toHex() + ".acplan";
  entry_ = folder / name;
  Hasher hasher;
  addState(hasher, ownProgram());
  asked_ =
      hasher.text("acentric plan 1").text(absolute.string()).value(storey.value_or(-1)).text(text).finish();
}

std::optional<BakePlan> PlanMemory::recall() const try {
  const auto text = host_.useCache ? readText(entry_, kMostBytes) : Result<std::string>(std::string());
  constexpr std::size_t kSum = 32;
  if (!text || text->size() < kSum) return std::nullopt;
  const std::string_view body = std::string_view(*text).substr(kSum);
  if (Hasher().text(body).finish().toHex() != text->substr(0, kSum)) return std::nullopt;
  const Json json = Json::from_cbor(body);
  if (json.at("asked") != asked_.toHex()) return std::nullopt;
  std::vector<fs::path> files;
  for (const Json& path : json.at("files")) files.emplace_back(path.get<std::string>());
  if (json.at("state") != stateOfFiles(files)) return std::nullopt;
  BakePlan plan;
  plan.file = file_;
  for (const Json& entry : json.at("storeys")) {
    StoreyPlan storey;
    storey.storey = entry.at("storey").get<std::string>();
    storey.order = entry.at("order").get<std::vector<int>>();
    storey.light = captureFrom(entry.at("light"));
    for (const Json& camera : entry.at("cameras")) storey.cameras.push_back(captureFrom(camera));
    plan.storeys.push_back(std::move(storey));
  }
  return plan;
} catch (const Json::exception&) {
  return std::nullopt;  // not as this program writes it
}

void PlanMemory::keep(const BakePlan& plan, const fs::path& scene, const ImportOptions& import,
                      fs::file_time_type opened) const {
  const std::vector<fs::path> files = importedFiles(scene, import, host_);
  const bool settled = std::ranges::all_of(files, [&](const fs::path& path) {
    std::error_code error;
    const auto written = fs::last_write_time(path, error);
    return error || written < opened;
  });
  if (files.empty() || !settled) return;
  Json json = {{"asked", asked_.toHex()}, {"files", Json::array()}, {"state", stateOfFiles(files)}};
  for (const fs::path& path : files) json["files"].push_back(path.string());
  json["storeys"] = Json::array();
  for (const StoreyPlan& storey : plan.storeys) {
    Json cameras = Json::array();
    for (const PlannedCapture& camera : storey.cameras) cameras.push_back(toJson(camera));
    json["storeys"].push_back({{"storey", storey.storey},
                               {"order", storey.order},
                               {"light", toJson(storey.light)},
                               {"cameras", std::move(cameras)}});
  }
  std::string body;
  Json::to_cbor(json, nlohmann::detail::output_adapter<char>(body));
  (void)writeTextAtomically(entry_, Hasher().text(body).finish().toHex() + body);
}

}  // namespace acentric
