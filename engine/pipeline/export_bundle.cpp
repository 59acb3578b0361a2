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

/// "kitchen.acentric.json" -> "kitchen".
std::string nameOf(const std::filesystem::path& project) {
  std::string name = project.filename().string();
  for (const std::string_view ending : {".json", ".acentric"})
    if (name.ends_with(ending)) name.resize(name.size() - ending.size());
  return name;
}

Result<BundleStoreyInput> storeyInput(const OpenProject& open, const CaptureStore& store,
                                      const std::stop_token& stop) {
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
  }
  input.local = [source = start->source, stop,
                 &open](int region) -> Result<std::shared_ptr<const LocalGeometry>> {
    const LocalPart part = source->local(region, stop);
    if (part.geometry) return part.geometry;
    return fail(ErrorKind::cancelled, "writing the bundle was stopped", open.file.string());
  };
  return input;
}

tl::unexpected<Error> refuse(const BakeGaps& gaps, const std::filesystem::path& project) {
  return fail(ErrorKind::notFound,
              fmt::format("{}: run `acentric bake {}` first, or export what there is with --allow-missing",
                          gaps.describe(), project.string()),
              project.string());
}

}  // namespace

std::string BakeGaps::describe() const {
  if (!any()) return {};
  std::string what = missing > 0 ? fmt::format("{} of {} captures", missing, cameras) : std::string();
  if (light) what += what.empty() ? "the light of near surfaces" : " and the light of near surfaces";
  return fmt::format("{} {} not baked yet", what, missing > 1 || (missing > 0 && light) ? "are" : "is");
}

Result<BakeGaps> bakeGaps(std::span<const OpenProject> storeys) {
  require(!storeys.empty(), "a project has a storey");
  const auto store = openCaptures(storeys.front().file);
  if (!store) return tl::unexpected(store.error());
  BakeGaps gaps;
  for (const OpenProject& open : storeys) {
    const auto best = bestKeys(open, *store);
    gaps.cameras += best.size();
    for (std::size_t c = 0; c < best.size(); ++c) {
      gaps.missing += best[c] && *best[c] == open.keys[c] ? 0 : 1;
      gaps.empty += best[c] ? 0 : 1;
    }
    gaps.light |= !store->hasSurfaceLight(open.surfaceLightKey);
  }
  return gaps;
}

Result<BundleReport> exportBundle(std::span<const OpenProject> storeys, const std::filesystem::path& folder,
                                  const ExportBundleOptions& options, TaskRunner& runner,
                                  const Progress& progress, std::stop_token stop) {
  require(!storeys.empty(), "a project has a storey");
  const OpenProject& open = storeys.front();
  const auto store = openCaptures(open.file);
  if (!store) return tl::unexpected(store.error());
  if (!options.allowMissing) {
    const auto gaps = bakeGaps(storeys);
    if (!gaps) return tl::unexpected(gaps.error());
    if (gaps->any()) return refuse(*gaps, open.file);
  }
  BundleInput input;
  for (const OpenProject& storey : storeys) {
    auto part = storeyInput(storey, *store, stop);
    if (!part) return tl::unexpected(part.error());
    if (!options.allowMissing && part->light == nullptr)  // it is there, and damaged
      return refuse({.light = true}, open.file);
    input.storeys.push_back(std::move(*part));
  }

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
  input.storey = options.storey;
  input.former = options.former;
  return writeBundle(input, folder, runner, progress, stop);
}

}  // namespace acentric
