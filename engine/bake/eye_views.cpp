#include "engine/bake/eye_views.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace acentric {
namespace {

/// Four rays show one plane when they depart from it by no more than this share.
constexpr double kFlat = 4e-3;
/// Of the limit: one part in so many.
constexpr std::size_t kSightShare = 3;

}  // namespace

HiddenMap::HiddenMap(const CubeLattice& lattice, const std::vector<float>& inverseZ)
    : below_(sizeOf(lattice.side()), 0) {
  const int side = lattice.side();
  for (int face = 0; face < CubeLattice::kFaces; ++face)
    for (int row = 0; row < side; ++row) {
      const float* low = inverseZ.data() + lattice.index(face, 0, row);
      const float* high = low + lattice.cornersPerEdge();
      for (int column = 0; column < side; ++column) {
        const float least =
            std::min({low[column], low[column + 1], high[column], high[column + 1]}) * float(1 - kBehind);
        if (least > 0)
          below_[std::size_t(indexOf(side, face, column, row))] =
              std::uint16_t(std::bit_cast<std::uint32_t>(least) >> 16);
      }
    }
}

std::size_t EyeView::bytesOf(int texelsPerEdge) {
  return CubeLattice(texelsPerEdge).size() * sizeof(float) +
         HiddenMap::sizeOf(texelsPerEdge) * sizeof(std::uint16_t);
}

EyeView::EyeView(const glm::dvec3& eye, int texelsPerEdge)
    : eye_(eye), lattice_(texelsPerEdge), inverseZ_(lattice_.size(), -1.0f) {}

EyeView::Sees EyeView::looksAt(const glm::dvec3& point) const {
  const glm::dvec3 way = point - eye_;
  if (way == glm::dvec3(0)) return Sees::yes;  // the eye itself
  const CubeLattice::Place place = lattice_.placeOf(way);
  const double inverse = 1 / place.size;
  const auto [first, right, up, both] = lattice_.cornersOf(place);
  const double a = double(inverseZ_[first]), b = double(inverseZ_[right]), c = double(inverseZ_[up]),
               d = double(inverseZ_[both]);
  const double least = std::min({a, b, c, d}), most = std::max({a, b, c, d});
  if (least < 0) return Sees::unsure;
  if (inverse >= most * (1 - kSameSurface)) return Sees::yes;
  if (inverse < least * (1 - kBehind)) return Sees::no;
  // Never "no": a straight edge before something farther away looks as flat as a slanted plane.
  if (least > 0.5 * most && std::abs(a + d - b - c) <= kFlat * most) {
    const double u = place.within.x, v = place.within.y;
    const double surface = (a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v;
    if (inverse >= surface * (1 - kSameSurface)) return Sees::yes;
  }
  return Sees::unsure;
}

bool nothingBefore(const RayScene& scene, const glm::dvec3& eye, const glm::dvec3& point, double tolerance,
                   RayCounts& rays) {
  const glm::dvec3 way = point - eye;
  const double distance = glm::length(way), farthest = distance - tolerance;
  if (!(farthest > 0)) return true;
  ++rays.visibility;
  auto end = float(farthest);
  if (double(end) < farthest) end = std::nextafter(end, std::numeric_limits<float>::infinity());
  return !scene.isOccluded({glm::vec3(eye), glm::vec3(way / distance), 0, end});
}

bool seesPoint(const RayScene& scene, const EyeView& view, const glm::dvec3& point, double tolerance,
               RayCounts& rays) {
  const EyeView::Sees shown = view.looksAt(point);
  if (shown != EyeView::Sees::unsure) return shown == EyeView::Sees::yes;
  return nothingBefore(scene, view.eye(), point, tolerance, rays);
}

bool seesByRay(const RayScene& scene, const EyeView& view, const glm::dvec3& point, double tolerance,
               RayCounts& rays) {
  return view.looksAt(point) != EyeView::Sees::no && nothingBefore(scene, view.eye(), point, tolerance, rays);
}

bool seesClosely(const RayScene& scene, const EyeView& view, const glm::dvec3& point, RayCounts& rays) {
  return seesByRay(scene, view, point, kRounding * glm::length(point - view.eye()), rays);
}

EyeViews::EyeViews(const RayScene& scene, const ElevationRange& elevations, const BakeSettings& settings,
                   MemoryBudget& budget)
    : scene_(scene), elevations_(elevations), budget_(budget) {
  // Half as fine as the captures is enough, since edges are traced; finer than four to a degree gains
  // nothing.
  constexpr double kFinest = 4;
  const double perDegree = std::clamp(0.5 * settings.samplesPerDegree, 1.0, kFinest);
  texelsPerEdge_ = EyeView::kCoarsest * int(std::ceil(90 * perDegree / EyeView::kCoarsest));
}

std::shared_ptr<const EyeView> EyeViews::at(const glm::dvec3& eye, TaskRunner& runner, RayCounts& rays,
                                            const std::stop_token& stop) {
  const std::array place{eye.x, eye.y, eye.z};
  if (const auto known = views_.find(place); known != views_.end()) {
    known->second.lastUse = ++uses_;
    return known->second.view;
  }
  const std::size_t bytes = EyeView::bytesOf(texelsPerEdge_);
  while (!views_.empty() && bytes_ + bytes > budget_.limit() / kSightShare) dropOldest();
  MemoryBudget::Share held(budget_);
  if (!held.setWhenRoom(bytes, stop)) return nullptr;
  auto view = EyeView::trace(scene_, eye, texelsPerEdge_, elevations_, runner, rays, stop, std::move(held));
  if (!view) return nullptr;
  views_[place] = {view, ++uses_};
  ++traced_;
  bytes_ += bytes;
  return view;
}

void EyeViews::dropOldest() {
  const auto oldest = std::ranges::min_element(
      views_, [](const auto& a, const auto& b) { return a.second.lastUse < b.second.lastUse; });
  bytes_ -= oldest->second.view->bytes();
  views_.erase(oldest);
}

}  // namespace acentric
