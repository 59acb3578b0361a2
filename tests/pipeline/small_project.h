#pragma once
/// Projects that are in no file, of scenes made by hand.

#include <filesystem>
#include <memory>

#include "engine/pipeline/pipeline.h"
#include "tests/bake/scene_builder.h"

namespace acentric::test {

/// Cells of 1.2 m over a square around the origin, so many metres from its middle to its sides. Captures keep
/// every bit of their colours, so that what is drawn of them can be compared with what was baked.
inline Project smallProject(double halfSize, double samplesPerDegree) {
  Project project;
  const double h = halfSize;
  project.layout().cellSize = 1.2;
  project.layout().nearBand = 0.6;
  project.layout().outline.loops = {{{-h, -h}, {h, -h}, {h, h}, {-h, h}}};
  project.bake.samplesPerDegree = samplesPerDegree;
  project.bake.colourQuality = kLosslessColours;
  return project;
}

/// As if read from `file`; its captures would lie beside it.
inline OpenProject openWith(RayScenePtr rays, const Project& project,
                            const std::filesystem::path& file = {}) {
  OpenProject open;
  open.file = file;
  open.project = project;
  open.rays = std::move(rays);
  open.scene = open.rays->sharedScene();
  open.drawn = std::make_shared<const DrawnScene>(open.scene);
  open.plan = open.rays->plan();
  open.mirrors = flatMirrorsOf(*open.scene, open.plan);
  open.layout = std::make_shared<const Layout>(buildLayout(project.layout()).value());
  open.keys = captureKeys(*open.scene, open.plan, project.bake, *open.layout);
  open.surfaceLightKey = {1, 2};
  return open;
}

}  // namespace acentric::test
