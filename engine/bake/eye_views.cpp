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
constexpr int kFaces = 6;
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

std::size_t EyeView::bytesOf(int texelsPerEdge) {
  const std::size_t samples = std::size_t(texelsPerEdge) + 1;
  return kFaces * samples * samples * sizeof(float);
}

EyeView::EyeView(const glm::dvec3& eye, int texelsPerEdge)
    : eye_(eye), side_(texelsPerEdge), inverseZ_(bytesOf(texelsPerEdge) / sizeof(float), -1.0f) {}

/// Face 2a + s: axis a, s = 0 its positive half. Its columns run along axis a + 1, its rows along a + 2.
glm::dvec3 EyeView::directionOf(int face, int column, int row) const {
  const int axis = face / 2;
  glm::dvec3 direction;
  direction[axis] = face % 2 == 0 ? 1 : -1;
  direction[(axis + 1) % 3] = 2.0 * column / side_ - 1;
  direction[(axis + 2) % 3] = 2.0 * row / side_ - 1;
  return direction;
}

std::shared_ptr<const EyeView> EyeView::trace(const RayScene& scene, const glm::dvec3& eye, int texelsPerEdge,
                                              const ElevationRange& elevations, TaskRunner& runner,
                                              RayCounts& rays, const std::stop_token& stop,
                                              MemoryBudget* budget) {
  const std::shared_ptr<EyeView> view(new EyeView(eye, texelsPerEdge));
  if (budget != nullptr) {
    view->share_ = MemoryBudget::Share(*budget);
    view->share_.set(view->bytes());
  }
  const int samples = texelsPerEdge + 1;
  const double low = std::sin(elevations.bottom), high = std::sin(elevations.top);
  std::atomic<std::uint64_t> traced = 0;
  runner.parallelFor(std::size_t(kFaces * samples), [&](std::size_t line) {
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
      const glm::dvec3 way = view->directionOf(face, column, row);
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

/// `far`: one over the distance along the axis of `way`, per unit of that axis of it.
EyeView::Sees EyeView::look(const glm::dvec3& way, double far) const {
  const glm::dvec3 size = glm::abs(way);
  const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  if (!(size[axis] > 0)) return Sees::yes;  // the eye itself
  const double inverse = far / size[axis];
  const auto cell = [&](int other) {
    return std::clamp((way[other] / size[axis] + 1) * 0.5 * side_, 0.0, double(side_));
  };
  const double x = cell((axis + 1) % 3), y = cell((axis + 2) % 3);
  const int column = std::min(int(x), side_ - 1), row = std::min(int(y), side_ - 1);
  const std::size_t samples = std::size_t(side_) + 1;
  const float* at =
      inverseZ_.data() +
      ((std::size_t(2 * axis + (way[axis] < 0 ? 1 : 0)) * samples + std::size_t(row)) * samples +
       std::size_t(column));
  const double a = double(at[0]), b = double(at[1]), c = double(at[samples]), d = double(at[samples + 1]);
  const double least = std::min({a, b, c, d}), most = std::max({a, b, c, d});
  if (least < 0) return Sees::unsure;
  if (far == 0) return least == 0 ? Sees::yes : Sees::no;
  if (inverse >= most * (1 - kSameSurface)) return Sees::yes;
  if (inverse < least * (1 - kBehind)) return Sees::no;
  if (least > 0.5 * most && std::abs(a + d - b - c) <= kFlat * most) {
    const double u = x - column, v = y - row;
    const double surface = (a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v;
    if (inverse >= surface * (1 - kSameSurface)) return Sees::yes;
    if (inverse < surface * (1 - kBehind)) return Sees::no;
  }
  return Sees::unsure;
}

EyeView::Sees EyeView::looksAt(const glm::dvec3& point) const { return look(point - eye_, 1); }

EyeView::Sees EyeView::looksAlong(const glm::dvec3& direction) const { return look(direction, 0); }

bool seesPoint(const RayScene& scene, const EyeView& view, const glm::dvec3& point, double tolerance,
               RayCounts& rays) {
  const EyeView::Sees shown = view.looksAt(point);
  if (shown != EyeView::Sees::unsure) return shown == EyeView::Sees::yes;
  const glm::dvec3 way = point - view.eye();
  const double distance = glm::length(way), farthest = distance - tolerance;
  if (!(farthest > 0)) return true;
  ++rays.visibility;
  return !(double(scene.occluderDistance(
               {glm::vec3(view.eye()), glm::vec3(way / distance), 0, float(farthest)})) < farthest);
}

bool seesAlong(const RayScene& scene, const EyeView& view, const glm::dvec3& direction, RayCounts& rays) {
  const EyeView::Sees shown = view.looksAlong(direction);
  if (shown != EyeView::Sees::unsure) return shown == EyeView::Sees::yes;
  ++rays.visibility;
  return !std::isfinite(scene.occluderDistance({glm::vec3(view.eye()), glm::vec3(direction)}));
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
  if (!budget_.waitForRoom(bytes, stop)) return nullptr;
  auto view = EyeView::trace(scene_, eye, texelsPerEdge_, elevations_, runner, rays, stop, &budget_);
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
