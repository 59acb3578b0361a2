#pragma once
/// What each way of taking panoramas leaves open: the paper's Fig. 13 on a region of a project. The same
/// walk, from the middle of a ring to the left, seen by ray tracing, from one panorama (TPV), from the ring
/// (APV), from both, and from the ring's layered captures; hole share, PSNR and SSIM of each frame. Frames
/// are compared with what is open filled on the screen, all of them.

#include <optional>
#include <string>
#include <vector>

#include "engine/measure/compare.h"
#include "engine/pipeline/bake_forecast.h"

namespace acentric {

struct HoleBenchOptions {
  int frames = 5;  ///< 1..1000
  int width = 640, height = 360;
  double fovDegrees = 0;             ///< 0 = the project's
  std::optional<glm::dvec2> place;   ///< in the ring, or in a gap near it; none = where the walk begins
  std::optional<double> yawRadians;  ///< none = as the walk begins
  int truthSamples = 1;
  BakeTeller tell;  ///< none: nothing is foretold
  Status check() const;
};

struct HoleBenchMethod {
  std::string name, description;
  std::vector<Comparison> comparisons;  ///< by frame
  std::vector<double> openShares;       ///< by frame: pixels without a sample, also where the truth is sky
  std::vector<ColourImage> pictures;    ///< by frame; what is open is transparent, not filled
  std::uint64_t samples = 0;            ///< of its captures
};

struct HoleBench {
  CellId region;
  std::vector<PerspectiveView> views;
  std::vector<ColourImage> truth;
  std::vector<HoleBenchMethod> methods;
};

/// Bakes the ring's cameras and a panorama at its centre, with one layer and with the project's settings;
/// nothing is written. Light on near surfaces is taken from the project where it is baked. Fails where the
/// layout has no ring.
Result<HoleBench> benchHoles(const OpenProject& open, const HoleBenchOptions& options, TaskRunner& runner,
                             const Progress& progress = {}, std::stop_token stop = {});

}  // namespace acentric
