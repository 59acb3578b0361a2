#include "engine/inspect/point_sampling.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "engine/inspect/sampling_rate.h"

namespace acentric {
namespace {

constexpr double kPixelsPerDegree = 1;

std::optional<glm::dvec3> nearestEye(const CaptureReach& reach, const SurfaceJudge& judge,
                                     const glm::dvec3& point) {
  std::vector<std::pair<double, glm::dvec3>> eyes;
  for (const auto& ofRegion : judge.eyes())
    for (const glm::dvec3& eye : ofRegion) eyes.emplace_back(glm::distance(eye, point), eye);
  std::ranges::sort(eyes, {}, &std::pair<double, glm::dvec3>::first);
  for (const auto& [distance, eye] : eyes)
    if (!hidden(reach.tracer(), eye, point)) return eye;
  return std::nullopt;
}

/// Each once, in order.
std::set<int> candidates(const CaptureReach& reach, const SurfaceJudge& judge,
                         const PointCoverage& coverage) {
  const Layout& layout = reach.layout();
  const glm::dvec2 place(coverage.point.position);
  std::set<int> cameras;
  for (const std::uint32_t r : coverage.seenFrom) {
    const Region& region = layout.regions[r];
    if (region.grown.containsClosed(place)) continue;  // local geometry
    const std::vector<Cover> covers =
        judge.options().everyCover ? drawnCovers(layout, int(r)) : region.covers;
    for (const Cover& cover : covers)
      if (const Piece* piece = pieceAt(cover, place)) cameras.insert(piece->camera);
  }
  return cameras;
}

}  // namespace

PointSampling samplingOfPoint(const CaptureReach& reach, const SurfaceJudge& judge,
                              const SurfacePoint& point) {
  PointSampling out;
  out.coverage = judge.judge(point);
  if (out.coverage.eyesSeeing == 0) return out;
  out.eye = nearestEye(reach, judge, point.position);
  const SurfaceAxes axes = axesOf(point.normal);
  for (const int camera : candidates(reach, judge, out.coverage)) {
    const ColumnCamera& columns = reach.columns(camera);
    const glm::dvec3 offset = point.position - columns.centreOfProjection;
    CameraSampling found;
    found.camera = camera;
    found.distance = glm::length(offset);
    found.angle = std::acos(std::clamp(std::abs(glm::dot(offset, point.normal)) / found.distance, 0.0, 1.0));
    const glm::dmat2 samples = samplesPerMetre(columns, point.position, axes);
    found.samplesPerMetre = compareRates(samples, glm::dmat2(1)).rate;
    if (out.eye) {
      const double focal = degrees(kPixelsPerDegree);  // so that a pixel is a degree
      found.samplesPerDegree =
          compareRates(samples, pixelsPerMetre(*out.eye, focal, point.position, axes)).ratio();
    }
    found.held = reach.holds(camera, point.position);
    found.hidden = hidden(reach.tracer(), columns.centreOfProjection, point.position);
    out.cameras.push_back(found);
  }
  std::ranges::stable_sort(out.cameras, [](const CameraSampling& a, const CameraSampling& b) {
    return std::tuple(!a.held, -a.samplesPerMetre) < std::tuple(!b.held, -b.samplesPerMetre);
  });
  return out;
}

}  // namespace acentric
