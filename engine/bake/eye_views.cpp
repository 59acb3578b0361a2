#include "engine/bake/eye_views.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "engine/bake/flush_denormals.h"

namespace acentric {
namespace {

/// Of an inverse distance: what is farther than this behind the surface of the map is behind it, wherever
/// between four rays the point lies.
constexpr double kBehind = 1e-2;
/// Four rays show one plane when they depart from it by no more than this share.
constexpr double kFlat = 4e-3;
/// Of the limit: one part in so many.
constexpr std::size_t kSightShare = 3;

/// Eyes of neighbouring regions at one corner differ by rounding; this makes them the same.
glm::dvec3 snapped(const glm::dvec2& place, double z, double scale) {
  const double step = std::ldexp(1.0, std::ilogb(scale) - 20);
  const auto snap = [&](double value) { return std::nearbyint(value / step) * step; };
  return {snap(place.x), snap(place.y), z};
}

/// -1, 0 or 1, by the place alone.
int heightOf(const glm::dvec3& place) {
  Hasher hasher;
  hasher.value(place.x + 0.0).value(place.y + 0.0);  // -0 as 0
  return int(hasher.finish().low % 3) - 1;
}

}  // namespace

std::vector<glm::dvec3> testEyes(const ConvexPolygon& polygon, double eyeZ, const BakeSettings& settings) {
  std::vector<glm::dvec3> eyes;
  const std::size_t n = polygon.size(), wanted = std::size_t(settings.testEyes);
  if (n < 3) return eyes;
  const double scale = glm::distance(polygon.corners[0], polygon.corners[1]);
  const auto add = [&](const glm::dvec2& place) {
    if (eyes.size() >= wanted) return;
    glm::dvec3 eye = snapped(place, eyeZ, scale);
    eye.z += settings.eyeRange * heightOf(eye);
    eyes.push_back(eye);
  };
  const std::size_t corners = std::min(n, wanted);
  for (std::size_t i = 0; i < corners; ++i) add(polygon.corners[i * n / corners]);
  const glm::dvec2 centre = polygon.centroid();
  add(centre);
  for (std::size_t i = 0; i < n; ++i) add(0.5 * (polygon.corners[i] + polygon.corners[(i + 1) % n]));
  // Inside: a triangle of the fan around the centre by turns, and in it the additive recurrence of the
  // plastic number, which spreads evenly however many follow.
  constexpr double kPlastic = 1.32471795724474602596;
  for (std::size_t i = 0; eyes.size() < wanted; ++i) {
    double a = std::fmod(0.5 + double(i + 1) / kPlastic, 1),
           b = std::fmod(0.5 + double(i + 1) / (kPlastic * kPlastic), 1);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    add(centre + a * (polygon.corners[i % n] - centre) + b * (polygon.corners[(i + 1) % n] - centre));
  }
  return eyes;
}

std::size_t EyeView::bytesOf(int texelsPerEdge) { return CubeLattice(texelsPerEdge).size() * sizeof(float); }

EyeView::EyeView(const glm::dvec3& eye, int texelsPerEdge)
    : eye_(eye), lattice_(texelsPerEdge), inverseZ_(lattice_.size(), -1.0f) {}

std::shared_ptr<const EyeView> EyeView::trace(const RayScene& scene, const glm::dvec3& eye, int texelsPerEdge,
                                              const ElevationRange& elevations, TaskRunner& runner,
                                              RayCounts& rays, const std::stop_token& stop,
                                              MemoryBudget::Share held) {
  const std::shared_ptr<EyeView> view(new EyeView(eye, texelsPerEdge));
  view->held_ = std::move(held);
  const int samples = view->lattice_.cornersPerEdge();
  const double low = std::sin(elevations.bottom), high = std::sin(elevations.top);
  std::atomic<std::uint64_t> traced = 0;
  runner.parallelFor(std::size_t(CubeLattice::kFaces * samples), [&](std::size_t line) {
    if (stop.stop_requested()) return;
    const FlushDenormals flush;
    const int face = int(line) / samples, row = int(line) % samples;
    float* out = view->inverseZ_.data() + line * std::size_t(samples);
    RayPacket packet;
    packet.origin = glm::vec3(eye);
    std::array<int, RayPacket::kSize> columns{};
    std::array<double, RayPacket::kSize> along{};  // metres along the axis per metre of ray
    const auto flush8 = [&] {
      std::array<float, RayPacket::kSize> distances;
      scene.occluderDistances(packet, distances);
      for (std::size_t i = 0; i < std::size_t(packet.count); ++i)
        out[columns[i]] = float(1 / (double(distances[i]) * along[i]));
      traced += std::uint64_t(packet.count);
      packet.count = 0;
    };
    for (int column = 0; column < samples; ++column) {
      const glm::dvec3 way = view->lattice_.direction(face, column, row);
      const double length = glm::length(way), up = way.z / length;
      if (up < low || up > high) continue;
      const auto n = std::size_t(packet.count++);
      packet.direction[n] = glm::vec3(way / length);
      columns[n] = column;
      along[n] = 1 / length;
      if (packet.count == RayPacket::kSize) flush8();
    }
    if (packet.count > 0) flush8();
  });
  rays.visibility += traced;
  if (stop.stop_requested()) return nullptr;
  return view;
}

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
  if (least > 0.5 * most && std::abs(a + d - b - c) <= kFlat * most) {
    const double u = place.within.x, v = place.within.y;
    const double surface = (a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v;
    if (inverse >= surface * (1 - kSameSurface)) return Sees::yes;
    if (inverse < surface * (1 - kBehind)) return Sees::no;
  }
  return Sees::unsure;
}

namespace {

bool nothingBefore(const RayScene& scene, const EyeView& view, const glm::dvec3& point, double tolerance,
                   RayCounts& rays) {
  const glm::dvec3 way = point - view.eye();
  const double distance = glm::length(way), farthest = distance - tolerance;
  if (!(farthest > 0)) return true;
  ++rays.visibility;
  return !(double(scene.occluderDistance(
               {glm::vec3(view.eye()), glm::vec3(way / distance), 0, float(farthest)})) < farthest);
}

}  // namespace

bool seesPoint(const RayScene& scene, const EyeView& view, const glm::dvec3& point, double tolerance,
               RayCounts& rays) {
  const EyeView::Sees shown = view.looksAt(point);
  if (shown != EyeView::Sees::unsure) return shown == EyeView::Sees::yes;
  return nothingBefore(scene, view, point, tolerance, rays);
}

bool seesClosely(const RayScene& scene, const EyeView& view, const glm::dvec3& point, RayCounts& rays) {
  return view.looksAt(point) != EyeView::Sees::no &&
         nothingBefore(scene, view, point, kRounding * glm::length(point - view.eye()), rays);
}

EyeViews::EyeViews(const RayScene& scene, const ElevationRange& elevations, const BakeSettings& settings,
                   MemoryBudget& budget)
    : scene_(scene), elevations_(elevations), budget_(budget) {
  // Half as fine as the captures is enough, since edges are traced; finer than four to a degree gains
  // nothing.
  constexpr double kFinest = 4;
  const double perDegree = std::clamp(0.5 * settings.samplesPerDegree, 1.0, kFinest);
  texelsPerEdge_ = int(std::ceil(90 * perDegree));
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
