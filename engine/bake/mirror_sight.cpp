#include "engine/bake/mirror_sight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace acentric {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Of a unit direction: what runs along a mirror more closely never meets it.
constexpr double kLeastSlope = 1e-6;

bool holds(const FlatMirror& mirror, const glm::dvec2& p) {
  return p.x >= mirror.low.x && p.x <= mirror.high.x && p.y >= mirror.low.y && p.y <= mirror.high.y;
}

/// Which shares of the way from a to b lie in the mirror's rectangle; empty (first > second) if none.
std::pair<double, double> clipped(const FlatMirror& mirror, const glm::dvec2& a, const glm::dvec2& b) {
  double from = 0, to = 1;
  for (int i = 0; i < 2; ++i) {
    const double way = b[i] - a[i];
    if (way == 0) {
      if (a[i] < mirror.low[i] || a[i] > mirror.high[i]) return {1, 0};
      continue;
    }
    const double p = (mirror.low[i] - a[i]) / way, q = (mirror.high[i] - a[i]) / way;
    from = std::max(from, std::min(p, q));
    to = std::min(to, std::max(p, q));
  }
  return {from, to};
}

/// Is all of the way from a to b on the far side of one of the mirror's edges, by more than `clipped` rounds?
/// Most are, and this takes no division.
bool passesBy(const FlatMirror& mirror, const glm::dvec2& a, const glm::dvec2& b) {
  constexpr double kRoundings = 1e-12;
  for (int i = 0; i < 2; ++i) {
    const double slack = kRoundings * (std::abs(a[i]) + std::abs(b[i]));
    if (std::max(a[i], b[i]) < mirror.low[i] - slack || std::min(a[i], b[i]) > mirror.high[i] + slack)
      return true;
  }
  return false;
}

/// From where an eye sees surfaces that a mirror shows it.
struct ImageIn {
  const FlatMirror& mirror;
  glm::dvec3 operator()(const EyeView& view) const { return mirror.imageOf(view.eye()); }
};

}  // namespace

MirrorSight::MirrorSight(const RayScene& scene, const FlatMirrors& mirrors, const RegionSight& sight)
    : scene_(&scene), mirrors_(&mirrors), sight_(&sight) {
  const std::vector<glm::dvec3> eyes = sight.eyes();
  for (const FlatMirror& mirror : mirrors.sides()) {
    Faced faced{mirror, {}, glm::dvec2(kInfinity), glm::dvec2(-kInfinity), kInfinity, 0};
    for (const glm::dvec3& eye : eyes) {
      const double height = mirror.height(eye);
      if (!(height > double(mirrors.slack()))) continue;
      const glm::dvec2 foot = mirror.inPlane(eye - mirror.point);
      faced.eyes.push_back({foot, height});
      faced.lowFoot = glm::min(faced.lowFoot, foot), faced.highFoot = glm::max(faced.highFoot, foot);
      faced.lowest = std::min(faced.lowest, height), faced.highest = std::max(faced.highest, height);
    }
    if (!faced.eyes.empty()) faced_.push_back(std::move(faced));
  }
}

/// While a place moves along the ray from the mirror's plane to infinity, the place where an eye sees it in
/// the plane moves straight on from where the ray starts to where the eye's parallel to the ray ends.
void MirrorSight::spansAlong(const glm::dvec3& origin, const glm::dvec3& direction,
                             std::vector<Span>& spans) const {
  spans.clear();
  for (const Faced& faced : faced_) {
    const FlatMirror& mirror = faced.mirror;
    const double slope = -glm::dot(mirror.normal, direction);
    if (!(slope > kLeastSlope)) continue;
    const double start = mirror.height(origin) / slope;
    const glm::dvec2 along = mirror.inPlane(direction);
    const glm::dvec2 first = mirror.inPlane(origin - mirror.point) + start * along;
    const glm::dvec2 least = glm::min(faced.lowest / slope * along, faced.highest / slope * along);
    const glm::dvec2 most = glm::max(faced.lowest / slope * along, faced.highest / slope * along);
    if (glm::any(glm::lessThan(glm::max(first, faced.highFoot + most), mirror.low)) ||
        glm::any(glm::greaterThan(glm::min(first, faced.lowFoot + least), mirror.high)))
      continue;
    Span span{&mirror, kInfinity, 0};
    for (const EyeBefore& eye : faced.eyes) {
      const glm::dvec2 last = eye.foot + eye.height / slope * along;
      if (passesBy(mirror, first, last)) continue;
      const auto [low, high] = clipped(mirror, first, last);
      if (low > high) continue;
      const auto distanceAt = [&](double share) {
        return share < 1 ? start + eye.height * share / (1 - share) / slope : kInfinity;
      };
      span.from = std::min(span.from, std::max(distanceAt(low), 0.0));
      span.to = std::max(span.to, distanceAt(high));
    }
    if (span.from < span.to) spans.push_back(span);
  }
}

/// Is the mirror at `at`, do all see what lies onwards, and the eye sees the mirror there?
std::optional<MirrorSight::Seen> MirrorSight::meets(const EyeView& view, const FlatMirror& mirror,
                                                    const glm::dvec3& at, const Ray& onwards,
                                                    RayCounts& rays) const {
  if (!holds(mirror, mirror.inPlane(at - mirror.point)) || view.looksAt(at) == EyeView::Sees::no)
    return std::nullopt;
  if (onwards.farthest > 0) {
    ++rays.visibility;
    if (scene_->isOccluded(onwards)) return std::nullopt;
  }
  const glm::vec3 eye(view.eye());
  const glm::vec3 way = glm::normalize(glm::vec3(at) - eye);
  ++rays.visibility;
  const Hit hit = scene_->traceSolid({eye, way});
  if (!hit.found() || mirrors_->at(hit.mesh, hit.triangle, -way) != mirror.number) return std::nullopt;
  return Seen{hit, -way};
}

std::optional<MirrorSight::Seen> MirrorSight::sees(std::size_t role, const FlatMirror& mirror,
                                                   const MetSurface& surface, double tolerance, Hints& hints,
                                                   RayCounts& rays) const {
  const double depth = mirror.height(surface.point());
  const double lift = 2 * double(mirrors_->slack());
  if (!(depth > lift)) return std::nullopt;
  const glm::dvec3 place = mirror.imageOf(surface.point());
  std::optional<Seen> seen;
  const auto seesIt = [&](const EyeView& view, bool closely) {
    const double height = mirror.height(view.eye());
    if (!(height > lift)) return false;
    const glm::dvec3 at = view.eye() + height / (height + depth) * (place - view.eye());
    const glm::dvec3 from = at + lift * mirror.normal, way = surface.point() - from;
    const double distance = glm::length(way);
    seen = meets(view, mirror, at,
                 {glm::vec3(from), glm::vec3(way / distance), 0,
                  float(distance - (closely ? kRounding * distance : tolerance))},
                 rays);
    return seen.has_value();
  };
  const Side side =
      sight_->sideSeen(role, surface, hints, ImageIn{mirror}, seesIt, [](std::size_t) { return false; });
  if (seen) seen->side = side;
  return seen;
}

bool MirrorSight::isOn(Side side, std::size_t role, const FlatMirror& mirror,
                       const MetSurface& surface) const {
  return sight_->isOn(side, role, surface, ImageIn{mirror});
}

std::optional<MirrorSight::Seen> MirrorSight::seesAlong(std::size_t role, const FlatMirror& mirror,
                                                        const glm::dvec3& direction, Hints& hints,
                                                        RayCounts& rays) const {
  const double slope = -glm::dot(mirror.normal, direction);
  const double lift = 2 * double(mirrors_->slack());
  if (!(slope > kLeastSlope)) return std::nullopt;
  const glm::vec3 onwards(mirror.reflected(direction));
  std::optional<Seen> seen;
  sight_->any(role, hints, [&](const EyeView& view, std::size_t) {
    const double height = mirror.height(view.eye());
    if (!(height > lift)) return false;
    const glm::dvec3 at = view.eye() + height / slope * direction;
    seen = meets(view, mirror, at, {glm::vec3(at + lift * mirror.normal), onwards}, rays);
    return seen.has_value();
  });
  return seen;
}

}  // namespace acentric
