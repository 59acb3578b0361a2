#include "engine/pipeline/export_bundle.h"

#include <fmt/format.h>

#include "engine/base/contract.h"
#include "engine/geometry/conventions.h"
#include "engine/pipeline/walk_source.h"

namespace acentric {
namespace {

BundlePose poseOf(const PathPose& pose) {
  return {pose.eye, pose.yawRadians, pose.pitchRadians, pose.seconds};
}

struct Missing {
  std::size_t captures = 0, cameras = 0;
  bool light = false;
};

/// "kitchen.acentric.json" -> "kitchen".
std::string nameOf(const std::filesystem::path& project) {
  std::string name = project.filename().string();
  for (const std::string_view ending : {".json", ".acentric"})
    if (name.ends_with(ending)) name.resize(name.size() - ending.size());
  return name;
}

Result<BundleStoreyInput> storeyInput(const OpenProject& open, const CaptureStore& store,
                                      const std::stop_token& stop, Missing& missing) {
  auto start = startWalk(open, nullptr);
  if (!start) return tl::unexpected(start.error());
  BundleStoreyInput input;
  input.name = open.project.current().name;
  input.layout = open.layout;
  input.start = open.project.spawn().position, input.startYaw = open.project.spawn().yawRadians;
  if (start->walk.surfaceLightKey == open.surfaceLightKey) input.light = start->walk.walk.surfaceLight;
  const auto best = bestKeys(open, store);
  for (std::size_t c = 0; c < best.size(); ++c) {
    const bool full = best[c] && *best[c] == open.keys[c];
    input.full.push_back(full ? best[c] : std::nullopt);
    input.coarse.push_back(full ? std::nullopt : best[c]);
    ++missing.cameras;
    missing.captures += full ? 0 : 1;
  }
  missing.light |= input.light == nullptr;
  input.local = [source = start->source, stop,
                 &open](int region) -> Result<std::shared_ptr<const LocalGeometry>> {
    const LocalPart part = source->local(region, stop);
    if (part.geometry) return part.geometry;
    return fail(ErrorKind::cancelled, "writing the bundle was stopped", open.file.string());
  };
  return input;
}

Status refuseMissing(const Missing& missing, const std::filesystem::path& project) {
  if (missing.captures == 0 && !missing.light) return {};
  std::string what = missing.captures > 0
                         ? fmt::format("{} of {} captures", missing.captures, missing.cameras)
                         : std::string();
  if (missing.light) what += what.empty() ? "the light of near surfaces" : " and the light of near surfaces";
  return fail(
      ErrorKind::notFound,
      fmt::format("{} {} not baked yet: run `acentric bake {}` first, or export what there is with "
                  "--allow-missing",
                  what, missing.captures > 1 || (missing.captures > 0 && missing.light) ? "are" : "is",
                  project.string()),
      project.string());
}

}  // namespace

Result<BundleReport> exportBundle(std::span<const OpenProject> storeys, const std::filesystem::path& folder,
                                  const ExportBundleOptions& options, TaskRunner& runner,
                                  const Progress& progress, std::stop_token stop) {
  require(!storeys.empty(), "a project has a storey");
  const OpenProject& open = storeys.front();
  const auto store = openCaptures(open.file);
  if (!store) return tl::unexpected(store.error());
  BundleInput input;
  Missing missing;
  for (const OpenProject& storey : storeys) {
    auto part = storeyInput(storey, *store, stop, missing);
    if (!part) return tl::unexpected(part.error());
    input.storeys.push_back(std::move(*part));
  }
  if (!options.allowMissing)
    if (Status complete = refuseMissing(missing, open.file); !complete)
      return tl::unexpected(complete.error());

  const Project& project = open.project;
  input.generator = options.generator, input.name = nameOf(open.file);
  input.scene = open.drawn->sharedScene(), input.plan = open.plan, input.mirrors = open.mirrors;
  input.exposure = project.exposure;
  input.fov = radians(project.fovDegrees);
  input.view = project.view;
  input.store = &*store;
  input.colourQuality =
      options.colourQuality.value_or(std::min(project.bake.colourQuality, kShippedColourQuality));
  for (const Bookmark& b : project.bookmarks)
    input.bookmarks.push_back(
        {b.name, b.storey, {b.eye, b.yawRadians, b.pitchRadians}, radians(b.fovDegrees)});
  for (const WalkPath& path : project.paths) {
    BundlePath out{path.name, path.storey, {}};
    for (const PathPose& pose : path.path.poses) out.poses.push_back(poseOf(pose));
    input.paths.push_back(std::move(out));
  }
  input.storey = project.storey;
  return writeBundle(input, folder, runner, progress, stop);
}

}  // namespace acentric
