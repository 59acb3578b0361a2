#include "engine/bench/panorama_places.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/conventions.h"
#include "engine/inspect/greedy_places.h"
#include "engine/inspect/rooms.h"
#include "engine/pipeline/coverage.h"

namespace acentric {
namespace {

/// Eyes stand within so many times the panoramas' mean distance of those that they are drawn.
constexpr double kReach = 3;

double meanSpacing(const Workplace& at, std::size_t count) {
  return std::sqrt(at.open.layout->spec.outline.area() / double(count));
}

Result<PanoramaSet> setOf(const Workplace& at, const std::vector<std::vector<glm::dvec2>>& groups,
                          std::size_t drawn) {
  if (groups.empty())
    return fail(ErrorKind::invalidArgument, "there is no walkable outline to stand in: draw one",
                "panoramas");
  return panoramaSet(at.open.layout->spec, groups, drawn, kReach * meanSpacing(at, groups.size()));
}

Result<PanoramaSet> singles(const Workplace& at, const std::vector<glm::dvec2>& places) {
  std::vector<std::vector<glm::dvec2>> groups;
  for (const glm::dvec2& place : places) groups.push_back({place});
  return setOf(at, groups, kPanoramasDrawn);
}

/// The corner, or as far towards it as one may stand.
glm::dvec2 cornerIn(const StandingArea& area, const glm::dvec2& centre, glm::dvec2 corner) {
  constexpr int kHalvings = 6;
  for (int n = 0; n < kHalvings && !area.contains(corner); ++n) corner = glm::mix(centre, corner, 0.5);
  return corner;
}

}  // namespace

std::size_t panoramasIn(const Layout& layout) {
  double turns = 0;
  for (const LayoutCamera& camera : layout.cameras) turns += camera.fovRadians / kTwoPi;
  return std::max<std::size_t>(1, std::size_t(std::lround(turns)));
}

Result<PanoramaSet> roomPanoramas(const Workplace& at) {
  return singles(at, roomCentres(standingAreaOf(*at.open.layout)));
}

Result<PanoramaSet> gridPanoramas(const Workplace& at, std::size_t count) {
  return singles(at, gridIn(standingAreaOf(*at.open.layout), count));
}

Result<PanoramaSet> greedyPanoramas(const Workplace& at, std::size_t count) {
  const StandingArea area = standingAreaOf(*at.open.layout);
  const auto grid = gridIn(area, count);
  const auto places = greedyPlaces(area, at.open.layout->eyeZ(), at.open.scene,
                                   *opaqueTracerFor(at.open.rays), grid.size(), grid, at.runner);
  if (!places) return tl::unexpected(places.error());
  return singles(at, *places);
}

Result<PanoramaSet> boxPanoramas(const Workplace& at, std::size_t count) {
  const StandingArea area = standingAreaOf(*at.open.layout);
  const auto centres = gridIn(area, count);
  if (centres.empty()) return setOf(at, {}, 1);
  const double half = 0.5 * meanSpacing(at, centres.size());
  std::vector<std::vector<glm::dvec2>> boxes;
  for (const glm::dvec2& centre : centres) {
    std::vector<glm::dvec2>& box = boxes.emplace_back(std::vector{centre});
    for (const glm::dvec2& side : {glm::dvec2(1, 1), {-1, 1}, {-1, -1}, {1, -1}})
      box.push_back(cornerIn(area, centre, centre + half * side));
  }
  return setOf(at, boxes, 1);
}

}  // namespace acentric
