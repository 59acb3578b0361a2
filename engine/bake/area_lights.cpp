#include "engine/bake/area_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "engine/bake/ray_scene.h"
#include "engine/bake/spherical_triangle.h"
#include "engine/image/colour.h"
#include "engine/scene/emitters.h"

namespace acentric {
namespace {

/// A part of the hierarchy is opened while taking it as a point may be wrong by more than this share of all
/// light that arrives (Walter et al., "Lightcuts", SIGGRAPH 2005), as long as there are no more than
/// kMostParts.
constexpr float kMostError = 0.01f;
/// A single triangle is taken as a point from this many radii on.
constexpr float kFarRadii = 16;
/// Groups at least this large get a table of intensities; smaller ones are added up.
constexpr std::uint32_t kTabledEmitters = 32;
/// Directions of a table: corners of a grid over the octahedron unfolded to a square.
constexpr int kTableCells = 16, kTableSide = kTableCells + 1;
/// Shadow rays end this share before the light, so that it does not shade itself.
constexpr float kShortOfLight = 1 - 1e-4f;

glm::dvec3 octahedronDirection(double x, double y) {
  glm::dvec3 v(x, y, 1 - std::abs(x) - std::abs(y));
  if (v.z < 0) v = {std::copysign(1 - std::abs(y), x), std::copysign(1 - std::abs(x), y), v.z};
  return glm::normalize(v);
}

glm::vec2 octahedronPlace(const glm::vec3& d) {
  const glm::vec3 v = d / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
  if (v.z >= 0) return {v.x, v.y};
  return {std::copysign(1 - std::abs(v.y), v.x), std::copysign(1 - std::abs(v.x), v.y)};
}

}  // namespace

glm::vec3 AreaLights::Emitter::middle() const { return (corners[0] + corners[1] + corners[2]) / 3.0f; }
double AreaLights::Emitter::power() const { return double(luminance(radiance) * area); }

AreaLights::AreaLights(const Scene& scene, const EffectPlan& plan) {
  if (!plan.on(Effect::areaLights)) return;
  lighting_ = lightingMeshes(scene);
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    if (lighting_[m] == 0) continue;
    const Mesh& mesh = scene.meshes[m];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      Emitter e;
      for (int c = 0; c < 3; ++c) e.corners[c] = mesh.positions[mesh.triangles[t][c]];
      const glm::dvec3 a(e.corners[0]), b(e.corners[1]), c(e.corners[2]);
      e.area = float(0.5 * glm::length(glm::cross(b - a, c - a)));
      e.normal = triangleNormal(mesh, t);
      e.radiance = meanEmission(scene, mesh, t);
      e.twoSided = scene.materials[std::size_t(mesh.material)].doubleSided;
      if (e.area > 0 && luminance(e.radiance) > 0) emitters_.push_back(e);
    }
  }
  if (emitters_.empty()) return;
  nodes_.reserve(2 * emitters_.size());
  build(0, std::uint32_t(emitters_.size()));
  strengthBefore_.push_back(0);
  for (const Emitter& e : emitters_) strengthBefore_.push_back(strengthBefore_.back() + e.power());
}

/// Parts emitters in two across an axis, at one of kBins places: where their mean square distance from the
/// centre of their part, weighted by power, is least (Otsu's threshold). Returns how many are in the first.
std::uint32_t AreaLights::split(std::uint32_t first, std::uint32_t count) {
  constexpr int kBins = 32;
  struct Bin {
    std::uint32_t count = 0;
    double power = 0;
    glm::dvec3 moment{0};
    void add(const Bin& other) { count += other.count, power += other.power, moment += other.moment; }
  };
  const std::span<Emitter> emitters(emitters_.data() + first, count);
  Bounds middles;
  for (const Emitter& e : emitters) middles.add(e.middle());
  const glm::vec3 size = middles.size();
  const auto binOf = [&](const Emitter& e, int axis) {
    const float along = (e.middle()[axis] - middles.min[axis]) / size[axis];
    return std::min(int(along * kBins), kBins - 1);
  };
  double most = -1;
  int axis = 0, threshold = 0;
  std::uint32_t half = 0;
  for (int a = 0; a < 3; ++a) {
    if (!(size[a] > 0)) continue;
    std::array<Bin, kBins> bins;
    Bin all, before;
    for (const Emitter& e : emitters)
      bins[std::size_t(binOf(e, a))].add({1, e.power(), e.power() * glm::dvec3(e.middle() - middles.min)});
    for (const Bin& bin : bins) all.add(bin);
    for (int b = 0; b + 1 < kBins; ++b) {
      before.add(bins[std::size_t(b)]);
      const double rest = all.power - before.power;
      const glm::dvec3 other = all.moment - before.moment;
      const double between =
          glm::dot(before.moment, before.moment) / before.power + glm::dot(other, other) / rest;
      if (before.power > 0 && rest > 0 && before.count < count && between > most)
        most = between, axis = a, threshold = b, half = before.count;
    }
  }
  if (half == 0) return count / 2;  // all at one place
  std::ranges::partition(emitters, [&](const Emitter& e) { return binOf(e, axis) <= threshold; });
  return half;
}

std::uint32_t AreaLights::build(std::uint32_t first, std::uint32_t count) {
  const auto index = std::uint32_t(nodes_.size());
  Node node;
  node.first = first, node.count = count;
  const std::span<const Emitter> emitters(emitters_.data() + first, count);
  glm::dvec3 centre(0);
  double whole = 0;
  for (const Emitter& e : emitters) {
    centre += e.power() * glm::dvec3(e.middle());
    whole += e.power();
    node.strength += e.radiance * e.area;
  }
  node.centre = glm::vec3(centre / whole);
  for (const Emitter& e : emitters)
    for (const glm::vec3& corner : e.corners)
      node.radius = std::max(node.radius, glm::distance(corner, node.centre));
  node.power = luminance(node.strength);
  nodes_.push_back(node);
  if (count == 1) {
    const Emitter& e = emitters_[first];
    facets_.push_back({e.normal, float(e.power()), e.twoSided ? -1.0f : 0.0f});
    return index;
  }
  const std::uint32_t half = split(first, count);
  build(first, half);
  const std::uint32_t second = build(first + half, count - half);
  nodes_[index].second = second;
  if (count >= kTabledEmitters) fillTable(index);
  return index;
}

/// Intensity by direction over the sum of strengths, in luminance; from the children's tables where they have
/// some.
void AreaLights::fillTable(std::uint32_t index) {
  Node& node = nodes_[index];
  const Node &left = nodes_[index + 1], &right = nodes_[node.second];
  node.table = std::int32_t(tables_.size());
  const double whole = double(node.power);
  const auto intensity = [&](const Node& child, std::size_t place, const glm::vec3& direction) {
    if (child.table >= 0) return double(child.power * tables_[std::size_t(child.table) + place]);
    double sum = 0;
    for (std::uint32_t i = child.first; i < child.first + child.count; ++i)
      sum += double(facets_[i].power * facets_[i].shareOf(direction));
    return sum;
  };
  std::size_t place = 0;
  for (int y = 0; y < kTableSide; ++y)
    for (int x = 0; x < kTableSide; ++x, ++place) {
      const glm::vec3 direction(octahedronDirection(2.0 * x / kTableCells - 1, 2.0 * y / kTableCells - 1));
      const double sum = intensity(left, place, direction) + intensity(right, place, direction);
      tables_.push_back(whole > 0 ? float(sum / whole) : 0);
    }
}

/// Of a facet's intensity along its normal, what it sends in a direction.
float AreaLights::Facet::shareOf(const glm::vec3& direction) const {
  const float cosine = glm::dot(normal, direction);
  return std::max(cosine, back * cosine);
}

/// `direction` unit, away from the light.
float AreaLights::shareTowards(const Node& node, const glm::vec3& direction) const {
  if (node.table < 0) {
    float sum = 0;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      sum += facets_[i].power * facets_[i].shareOf(direction);
    return sum / node.power;
  }
  const glm::vec2 place = (octahedronPlace(direction) + 1.0f) * (0.5f * kTableCells);
  const int x = std::clamp(int(place.x), 0, kTableCells - 1),
            y = std::clamp(int(place.y), 0, kTableCells - 1);
  const float fx = place.x - float(x), fy = place.y - float(y);
  const float* row = tables_.data() + node.table + y * kTableSide + x;
  return glm::mix(glm::mix(row[0], row[1], fx), glm::mix(row[kTableSide], row[kTableSide + 1], fx), fy);
}

/// What a part sends to a surface, and how wrong that may be, in luminance.
AreaLights::Estimate AreaLights::estimate(std::uint32_t index, const Surface& surface) const {
  const Node& node = nodes_[index];
  const glm::vec3 way = node.centre - surface.rayOrigin;
  const float height = glm::dot(way, surface.normal);
  if (height <= -node.radius || glm::dot(way, surface.geometricNormal) <= -node.radius) return {};
  const float square = glm::dot(way, way), nearness = node.radius * node.radius / square;
  const bool single = node.second == 0;
  if (single && (nearness > 1 / (kFarRadii * kFarRadii) || height <= node.radius)) {
    const Emitter& e = emitters_[node.first];
    if (!e.twoSided && glm::dot(e.normal, surface.rayOrigin - e.corners[0]) <= 0) return {};
    const glm::dvec3 from(surface.rayOrigin);
    return {e.radiance *
                float(triangleIrradiance({glm::dvec3(e.corners[0]) - from, glm::dvec3(e.corners[1]) - from,
                                          glm::dvec3(e.corners[2]) - from},
                                         glm::dvec3(surface.normal))),
            0, false};
  }
  // So near that it says nothing of what is sent: to be opened in any case.
  if (nearness > 0.25f) return {node.strength * (0.25f / square), std::numeric_limits<float>::max(), true};
  const glm::vec3 direction = way / std::sqrt(square);
  const glm::vec3 facing = node.strength * (shareTowards(node, -direction) / square);
  const float cosine = std::max(0.0f, glm::dot(direction, surface.normal));
  const float most = node.power / square;  // were all of it turned this way
  return {facing * cosine, single ? 0 : 4 * nearness * most, true};
}

AreaLights::Cut AreaLights::cut(const Surface& surface) const {
  struct Seen {
    Estimate estimate;
    std::uint32_t node;
  };
  struct Open {
    float error;
    std::uint32_t part;
    bool operator<(const Open& other) const { return error < other.error; }
  };
  std::array<Seen, 2 * kMostParts> parts;  // all that there ever were
  std::array<Open, kMostParts> open;       // a heap of those that make the cut
  std::uint32_t known = 0;
  std::size_t count = 0;
  float total = 0;
  const auto add = [&](std::uint32_t node) {
    const Seen& part = parts[known] = {estimate(node, surface), node};
    total += luminance(part.estimate.irradiance);
    open[count++] = {part.estimate.error, known++};
    std::push_heap(open.begin(), open.begin() + count);
  };
  add(0);
  while (count < kMostParts) {
    // A sum that was all taken away again may be left below zero by rounding; a single emitter has no error.
    if (!(open.front().error > kMostError * std::max(total, 0.0f))) break;
    const Seen& worst = parts[open.front().part];
    std::pop_heap(open.begin(), open.begin() + count--);
    total -= luminance(worst.estimate.irradiance);
    for (const std::uint32_t child : {worst.node + 1, nodes_[worst.node].second}) add(child);
  }
  // In the order of the hierarchy, where neighbours are near each other: so samples spread over all of it.
  std::sort(open.begin(), open.begin() + count,
            [&](const Open& a, const Open& b) { return parts[a.part].node < parts[b.part].node; });
  Cut cut;
  float weights = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Seen& part = parts[open[i].part];
    const float weight = luminance(part.estimate.irradiance);
    if (!(weight > 0)) continue;
    weights += weight;
    cut.add({part.estimate.irradiance, weights, part.node, part.estimate.far});
  }
  return cut;
}

AreaLights::Sample AreaLights::sample(const Part& part, const Surface& surface, glm::vec2 u) const {
  const Node& node = nodes_[part.node];
  if (!part.far) {
    const Emitter& e = emitters_[node.first];
    const glm::dvec3 from(surface.rayOrigin);
    const glm::dvec3 a = glm::dvec3(e.corners[0]) - from;
    const SphericalTriangle seen({a, glm::dvec3(e.corners[1]) - from, glm::dvec3(e.corners[2]) - from});
    const glm::dvec3 direction = seen.directionAt(glm::dvec2(u));
    const double cosine = glm::dot(direction, glm::dvec3(surface.normal));
    const double slope = glm::dot(direction, glm::dvec3(e.normal));
    if (!(cosine > 0) || !(seen.solidAngle() > 0) || slope == 0) return {};
    const double distance = glm::dot(a, glm::dvec3(e.normal)) / slope;
    if (!(distance > 0) || !std::isfinite(distance)) return {};
    const double mean = double(luminance(part.irradiance) / luminance(e.radiance)) / seen.solidAngle();
    return {glm::vec3(from + direction * distance), float(cosine / mean)};
  }
  // A triangle by its strength, and a place on it by area; what is left of the random number is used again.
  const double whole = strengthBefore_[node.first + node.count] - strengthBefore_[node.first];
  const double wanted = strengthBefore_[node.first] + double(u.x) * whole;
  const auto begin = strengthBefore_.begin() + node.first;
  const auto found = std::upper_bound(begin + 1, begin + node.count, wanted) - 1;
  const Emitter& e = emitters_[std::size_t(found - strengthBefore_.begin())];
  const double own = *(found + 1) - *found;
  const float rest = own > 0 ? float(std::clamp((wanted - *found) / own, 0.0, 1.0)) : 0;
  const float root = std::sqrt(rest);
  Sample out;
  out.target = e.corners[0] * (1 - root) + (e.corners[1] * (1 - u.y) + e.corners[2] * u.y) * root;
  const glm::vec3 way = surface.rayOrigin - node.centre;
  const glm::vec3 direction = way / glm::length(way);
  const float share = shareTowards(node, direction);
  const Facet& facet = facets_[std::size_t(found - strengthBefore_.begin())];
  out.weight = share > 0 ? facet.shareOf(direction) / share : 0;
  return out;
}

glm::vec3 AreaLights::irradiance(const Surface& surface) const {
  glm::vec3 sum(0);
  for (const Part& part : cut(surface)) sum += part.irradiance;
  return sum;
}

glm::vec3 AreaLights::irradiance(const RayScene& scene, const Surface& surface,
                                 const PositionSamples& samples, int count, RayCounts& rays) const {
  const Cut parts = cut(surface);
  if (parts.empty()) return glm::vec3(0);
  const auto points = samples.at(surface.position, 0);
  glm::vec3 arriving(0), sent(0);
  for (std::uint32_t k = 0; k < std::uint32_t(count); ++k) {
    glm::vec2 u = points.at(k);
    const float wanted = u.x * parts.back().upTo;
    auto part = std::upper_bound(parts.begin(), parts.end() - 1, wanted,
                                 [](float value, const Part& p) { return value < p.upTo; });
    const float before = part == parts.begin() ? 0 : (part - 1)->upTo;
    const float weight = part->upTo - before;
    u.x = std::clamp((wanted - before) / weight, 0.0f, 1 - 1e-6f);
    const Sample drawn = sample(*part, surface, u);
    if (!(drawn.weight > 0)) continue;
    const glm::vec3 light = part->irradiance * (drawn.weight / weight);
    sent += light;
    const glm::vec3 way = drawn.target - surface.rayOrigin;
    const float distance = glm::length(way);
    if (!(distance > 0) || glm::dot(way, surface.geometricNormal) <= 0) continue;
    ++rays.softShadow;
    arriving += light * scene.transmittance({surface.rayOrigin, way / distance, 0, distance * kShortOfLight});
  }
  glm::vec3 all(0);
  for (const Part& part : parts) all += part.irradiance;
  for (int c = 0; c < 3; ++c) all[c] *= sent[c] > 0 ? arriving[c] / sent[c] : 0;
  return all;
}

}  // namespace acentric
