#pragma once
/// What shows where parts of a picture meet: the border of local geometry; and what happens to the picture
/// where a walk changes region, beside what an ordinary step does to it.

#include <optional>
#include <vector>

#include "engine/cli/path_frames.h"
#include "engine/measure/seams.h"
#include "engine/pipeline/region_crossings.h"

namespace acentric::cli {

/// Between two frames of a walk at 1.5 m/s, 60 frames a second.
inline constexpr double kOrdinaryStep = 0.025;  // metres

struct Pop {
  std::size_t storey = 0;
  RegionCrossing crossing;
  PerspectiveView before, after;
  Change change;               ///< from one region's picture to the other's, of the same eye
  std::optional<Change> step;  ///< of a picture as the eye goes on by kOrdinaryStep, if it stays in a region
  double psnrBefore = 0, psnrAfter = 0;  ///< of both pictures, against the truth
};

/// Where a walk changes region, at most `most` of these places, evenly chosen; 0 = all. Only the views are
/// filled in.
std::vector<Pop> crossingsAlong(const PathWalk& walk, int most);

/// At most `most` of the crossings along a walk, evenly chosen; 0 = all.
Result<std::vector<Pop>> measurePopping(const PathWalk& walk, int most, FrameMaker& maker, int truthSamples,
                                        TaskRunner& runner, const Common& common);

struct SeamReport {
  Json json;
  std::string text;
};
SeamReport reportPopping(const std::vector<Pop>& pops);

SeamReport reportSeam(const SeamSums& sums);

}  // namespace acentric::cli
