#pragma once
/// How well the captures would serve the surfaces that a walker can see, told before anything is baked.
///
/// A point of a surface is seen from a region if one of the region's eyes sees it. The region then shows it
/// as local geometry (within its near band), or from a capture: that of the camera whose piece of the
/// region's cover holds the point, if the bake's rays of that camera end on it (capture_reach.h); else the
/// region misses it: a predicted hole.
///
/// Density: `points` points spread evenly over all surfaces, each judged against every eye of every region
/// (`eyes.perRegion`) and every camera of their covers. Each of these answers is exact; nothing is carried
/// over from one point to another. While it runs, snapshots show the points judged so far: an even sample of
/// all.

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "engine/base/task_runner.h"
#include "engine/inspect/capture_reach.h"
#include "engine/inspect/standing_eyes.h"
#include "engine/inspect/surface_points.h"

namespace acentric {

enum class SurfaceClass : std::uint8_t {
  unseen,        ///< no eye sees it
  neverSampled,  ///< every region that sees it misses it
  local,         ///< local geometry for every region that sees it and does not miss it
  under,         ///< less than half a sample per pixel
  fine,
  over  ///< more than two samples per pixel
};
inline constexpr int kSurfaceClasses = 6;
const char* nameOf(SurfaceClass surfaceClass);  ///< "neverSampled"

struct PointCoverage {
  SurfacePoint point;
  SurfaceClass surfaceClass = SurfaceClass::unseen;
  std::uint32_t eyesSeeing = 0, eyesMissing = 0;  ///< missing: in a region that misses it
  std::vector<std::uint32_t> seenFrom;            ///< regions
  std::vector<std::uint32_t> missedFrom;          ///< of those
  /// The nearest eye that is shown the point from a capture: its region, how far away it is (metres), and the
  /// camera that serves it best. -1: there is none.
  int nearestRegion = -1;
  double nearestDistance = 0;
  int camera = -1;
  double samplesPerMetre = 0;  ///< of that camera, in the direction on the surface that is worst off
  double pixelsPerMetre = 0;   ///< that this eye needs, in the same direction
};

struct SurfaceCoverageOptions {
  int points = 20000;
  EyeOptions eyes;
  double focalPixels = 1000;  ///< of the walk's display
  bool everyCover = true;     ///< panoramas too; false: only the cover of the paper's choice of hand
  double firstSeconds = 0.1;  ///< after which the first snapshot is shown
  double laterSeconds = 0.5;  ///< between the others
  Status check() const;
};

/// Sums over points; shares of what is seen.
struct CoverageSummary {
  std::uint64_t points = 0, seen = 0;
  std::array<std::uint64_t, kSurfaceClasses> ofClass{};
  std::uint64_t partlyMissed = 0;  ///< some regions that see it miss it, others do not
  std::uint64_t eyesSeeing = 0, eyesMissing = 0;
  void add(const PointCoverage& point);
  double share(SurfaceClass surfaceClass) const;
  double missingShare() const;  ///< of all pairs of an eye and a point that it sees: those that are missed
};

inline constexpr int kRatioBins =
    13;  ///< samples per pixel: factors of sqrt 2 from 1/8 to 8, open at the ends

struct SurfaceCoverage {
  std::vector<PointCoverage> points;  ///< judged so far
  int wanted = 0;                     ///< all of them, at rest
  double squareMetresPerPoint = 0;    ///< at rest
  bool complete = false;
  CoverageSummary all;
  std::vector<CoverageSummary> byMesh, byMaterial;
  std::vector<std::uint64_t> seenByRegion, missedByRegion;
  std::array<std::uint64_t, kRatioBins> byRatio{};  ///< sampled points, not local ones
};
using SurfaceCoveragePtr = std::shared_ptr<const SurfaceCoverage>;

/// Bin of SurfaceCoverage::byRatio, and its lower bound (0 for the first).
int ratioBin(double samplesPerPixel);
double ratioBinStart(int bin);

/// Judges one point.
class SurfaceJudge {
 public:
  /// Refers to `reach`.
  SurfaceJudge(const CaptureReach& reach, const SurfaceCoverageOptions& options);
  PointCoverage judge(const SurfacePoint& point) const;
  const std::vector<std::vector<glm::dvec3>>& eyes() const { return eyes_; }
  const SurfaceCoverageOptions& options() const { return options_; }

 private:
  struct Sampling;
  /// Covers that are painted for an eye that looks at the place.
  std::span<const Cover> coversFor(std::size_t region, const glm::dvec3& eye, const glm::dvec2& place) const;

  const CaptureReach& reach_;
  SurfaceCoverageOptions options_;
  std::vector<std::vector<glm::dvec3>> eyes_;
  std::vector<std::vector<Cover>> covers_;  ///< that each region with eyes is drawn from
};

/// Runs to the end, or to a stop: then the last snapshot is all there is, and the result is `cancelled`.
/// `show` is called on the calling thread; what it is given never changes.
Result<SurfaceCoveragePtr> measureSurfaceCoverage(
    ScenePtr scene, const CaptureReach& reach, const SurfaceCoverageOptions& options, TaskRunner& runner,
    const std::function<void(const SurfaceCoveragePtr&)>& show = {}, std::stop_token stop = {});

}  // namespace acentric
