#pragma once
/// One point of a surface asked about in full: what surface_coverage.h judges of it, and every camera that a
/// region which sees the point could show it from, with the rate at which it samples the surface there.

#include <optional>
#include <vector>

#include "engine/inspect/surface_coverage.h"

namespace acentric {

struct CameraSampling {
  int camera = 0;               ///< into Layout::cameras
  double distance = 0;          ///< metres
  double angle = 0;             ///< radians between its ray and the surface's normal: 0 = head on
  double samplesPerMetre = 0;   ///< in the direction on the surface that is worst off
  double samplesPerDegree = 0;  ///< as PointSampling::eye sees it, worst direction; 0 without an eye
  bool held = false;            ///< its capture would hold the point
  bool hidden = false;          ///< something opaque lies between: held only in a deeper layer
};

struct PointSampling {
  PointCoverage coverage;
  std::optional<glm::dvec3> eye;  ///< the nearest of the judge's eyes that sees the point
  /// Of the covers that are painted for regions which see the point from outside their near band: each camera
  /// once, those that hold it first, the finest first.
  std::vector<CameraSampling> cameras;
};

/// `judge` is one of `reach`.
PointSampling samplingOfPoint(const CaptureReach& reach, const SurfaceJudge& judge,
                              const SurfacePoint& point);

}  // namespace acentric
