#include "engine/pipeline/bake_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/base/file.h"
#include "engine/pipeline/plan_memory.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

std::string subjectOf(const std::string& storey, const CameraId& id) {
  return fmt::format("camera {},{},{},{},{} {}", id.i, id.j, id.corner, id.direction, id.level, storey);
}

/// What follows from other parts is no reason of its own where they changed.
void dropConsequences(std::vector<std::string>& names) {
  const auto has = [&](const char* name) { return std::ranges::find(names, name) != names.end(); };
  if (has("geometry") || has("materials") || has("lights")) std::erase(names, "scene");
  if (names.size() > 1) std::erase(names, "image");
}

std::string wordsFor(const std::string& part) {
  static const std::map<std::string, std::string, std::less<>> kPartWords = {
      {"program", "this version bakes otherwise"},  {"scene", "the scene changed"},
      {"geometry", "the scene's geometry changed"}, {"materials", "the scene's materials changed"},
      {"lights", "the scene's lights changed"},     {"effects", "effects were switched"},
      {"settings", "bake settings changed"},        {"place", "it moved"},
      {"regions", "its regions changed"},           {"image", "the part of the view that it covers changed"}};
  const auto found = kPartWords.find(part);
  return found == kPartWords.end() ? part + " changed" : found->second;
}

/// What earlier bakes left, asked for once and only if something is missing.
class Former {
 public:
  Former(const CaptureStore& store, const BakePlan& plan) : store_(store) {
    for (const StoreyPlan& storey : plan.storeys) {
      for (const PlannedCapture& camera : storey.cameras) known_.push_back(camera.key);
      known_.push_back(storey.light.key);
    }
  }
  const CaptureRecord* of(const std::string& subject) {
    if (!records_) records_ = store_.formerRecords(known_);
    const auto found = records_->find(subject);
    return found == records_->end() ? nullptr : &found->second;
  }

 private:
  const CaptureStore& store_;
  std::vector<ContentKey> known_;
  std::optional<std::map<std::string, CaptureRecord>> records_;
};

Result<CaptureState> stateOf(const PlannedCapture& planned, const CaptureStore& store, Former& former) {
  const auto found = store.inspect(planned.key);
  if (!found) return tl::unexpected(found.error());
  CaptureState state;
  state.recorded = found->recorded;
  if (found->condition == CaptureStore::Condition::sound) return state;
  if (found->condition == CaptureStore::Condition::damaged) {
    state.reason = BakeReason::damaged;
    for (const Error& error : found->damage) state.damage.push_back(error.describe());
    return state;
  }
  state.reason = BakeReason::neverBaked;
  if (const CaptureRecord* before = former.of(planned.subject)) {
    state.changed = changedParts(before->parts, planned.parts);
    dropConsequences(state.changed);
    if (!state.changed.empty()) state.reason = BakeReason::changed;
  }
  return state;
}

}  // namespace

std::string bakeKeyOf(const OpenProject& open) {
  Hasher hasher;
  hasher.array(std::span<const ContentKey>(open.keys)).value(open.surfaceLightKey.high);
  return hasher.value(open.surfaceLightKey.low).finish().toHex();
}

StoreyPlan planStorey(const OpenProject& open) {
  StoreyPlan plan;
  plan.storey = open.project.current().name;
  plan.order = bakingOrder(open);
  for (std::size_t c = 0; c < open.layout->cameras.size(); ++c) {
    const LayoutCamera& camera = open.layout->cameras[c];
    const ColumnCamera columns = columnCameraFor(camera, *open.layout, open.scene->bounds, open.project.bake);
    plan.cameras.push_back({subjectOf(plan.storey, camera.id), double(columns.columns) * columns.rows,
                            open.keys[c], captureKeyParts(open, int(c))});
  }
  plan.light = {"light " + plan.storey, 0, open.surfaceLightKey, surfaceLightKeyParts(open)};
  return plan;
}

Result<BakePlan> planBake(const fs::path& file, std::optional<int> storey, const ImportHost& host,
                          const Progress& progress, std::stop_token stop) {
  const auto began = fs::file_time_type::clock::now();
  const auto text = readText(file);
  if (!text) return tl::unexpected(text.error());
  const PlanMemory memory(file, storey, *text, host);
  if (auto known = memory.recall()) return std::move(*known);

  const auto project = parseProject(*text, file.string());
  if (!project) return tl::unexpected(project.error());
  auto plan = planBake(file, *project, storey, host, progress, std::move(stop));
  if (plan) memory.keep(*plan, file.parent_path() / project->scene, project->import, began);
  return plan;
}

Result<BakePlan> planBake(const fs::path& file, Project project, std::optional<int> storey,
                          const ImportHost& host, const Progress& progress, std::stop_token stop) {
  if (storey) project.storey = *storey;
  auto open = openUnsaved(file, project, host, progress, stop);
  if (!open) return tl::unexpected(open.error());
  BakePlan plan;
  plan.file = file;
  if (storey) {
    plan.open.push_back(std::move(*open));
  } else {
    auto all = openStoreys(*open, host, progress, stop);
    if (!all) return tl::unexpected(all.error());
    plan.open = std::move(*all);
  }
  for (const OpenProject& each : plan.open) plan.storeys.push_back(planStorey(each));
  return plan;
}

const char* nameOf(BakeReason reason) {
  switch (reason) {
    case BakeReason::baked:
      return "baked";
    case BakeReason::neverBaked:
      return "neverBaked";
    case BakeReason::damaged:
      return "damaged";
    case BakeReason::changed:
      return "changed";
  }
  return "";
}

std::string describe(const CaptureState& state) {
  if (state.reason == BakeReason::baked) return "baked";
  if (state.reason == BakeReason::neverBaked) return "never baked";
  if (state.reason == BakeReason::damaged) return "damaged";
  std::string text;
  for (const std::string& part : state.changed) text += (text.empty() ? "" : ", ") + wordsFor(part);
  return text;
}

Result<std::vector<StoreyState>> stateOf(const BakePlan& plan) {
  std::vector<StoreyState> states;
  std::error_code error;
  const fs::path folder = captureFolderFor(plan.file);
  if (!fs::is_directory(folder, error)) {  // nothing was ever baked; asking makes no folder
    CaptureState never;
    never.reason = BakeReason::neverBaked;
    for (const StoreyPlan& storey : plan.storeys)
      states.push_back({std::vector<CaptureState>(storey.cameras.size(), never), never});
    return states;
  }
  const auto store = CaptureStore::open(folder);
  if (!store) return tl::unexpected(store.error());
  Former former(*store, plan);
  for (const StoreyPlan& storey : plan.storeys) {
    StoreyState& state = states.emplace_back();
    for (const PlannedCapture& camera : storey.cameras) {
      auto found = stateOf(camera, *store, former);
      if (!found) return tl::unexpected(found.error());
      state.cameras.push_back(std::move(*found));
    }
    auto light = stateOf(storey.light, *store, former);
    if (!light) return tl::unexpected(light.error());
    state.light = std::move(*light);
  }
  return states;
}

CapturesOnDisk capturesOnDisk(const OpenProject& open) {
  const std::size_t cameras = open.keys.size();
  CapturesOnDisk there{bakedCameras(open), std::vector<bool>(cameras, false),
                       std::vector<std::uint64_t>(cameras, 0)};
  std::error_code error;
  const fs::path folder = captureFolderFor(open.file);
  if (!fs::is_directory(folder, error)) return there;
  const auto store = CaptureStore::open(folder);
  if (!store) return there;
  for (std::size_t c = 0; c < cameras; ++c)
    if (there.baked[c]) there.bytes[c] = store->bytesOf(open.keys[c]);
  if (std::ranges::find(there.baked, false) == there.baked.end()) return there;
  std::vector<ContentKey> known = open.keys;  // coarser ones of the project as it is now are not of before
  for (const Quality quality : {Quality::preview, Quality::draft})
    std::ranges::copy(atQuality(open, quality).keys, std::back_inserter(known));
  const auto former = store->formerRecords(known);
  if (former.empty()) return there;
  const std::string& storey = open.project.current().name;
  for (std::size_t c = 0; c < cameras; ++c)
    there.stale[c] = !there.baked[c] && former.contains(subjectOf(storey, open.layout->cameras[c].id));
  return there;
}

}  // namespace acentric
