#include "engine/pipeline/near_instances.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/scene/effect_plan.h"
#include "engine/scene/instances.h"
#include "engine/scene/material_rules.h"
#include "engine/scene/polygon_clipper.h"

namespace acentric {
namespace {

/// What a region draws in.
class RegionPolygon {
 public:
  explicit RegionPolygon(const ConvexPolygon& polygon)
      : polygon_(&polygon), low_(polygon.corners[0]), high_(polygon.corners[0]) {
    for (const glm::dvec2& corner : polygon.corners)
      low_ = glm::min(low_, corner), high_ = glm::max(high_, corner);
  }

  const ConvexPolygon& polygon() const { return *polygon_; }
  const glm::dvec2& low() const { return low_; }
  const glm::dvec2& high() const { return high_; }
  bool boxMeets(const glm::dvec2& low, const glm::dvec2& high) const {
    return high_.x >= low.x && low_.x <= high.x && high_.y >= low.y && low_.y <= high.y;
  }
  bool meets(const glm::dvec2& low, const glm::dvec2& high) const {
    return boxMeets(low, high) && overlap(*polygon_, {{low, {high.x, low.y}, high, {low.x, high.y}}});
  }
  bool holds(const glm::dvec2& low, const glm::dvec2& high) const {
    if (low.x < low_.x || low.y < low_.y || high.x > high_.x || high.y > high_.y) return false;
    for (const glm::dvec2& corner : {low, {high.x, low.y}, high, {low.x, high.y}})
      if (!polygon_->containsClosed(corner)) return false;
    return true;
  }

 private:
  const ConvexPolygon* polygon_;
  glm::dvec2 low_, high_;
};

/// Regions by where they begin, so that a box is asked of its neighbours alone.
class Regions {
 public:
  explicit Regions(std::span<const Layout> layouts) {
    for (const Layout& layout : layouts)
      for (const Region& region : layout.regions)
        if (region.grown.size() >= 3) all_.emplace_back(region.grown);
    std::ranges::sort(all_, {}, [](const RegionPolygon& p) { return p.low().x; });
    for (const RegionPolygon& p : all_) widest_ = std::max(widest_, p.high().x - p.low().x);
  }

  std::vector<const RegionPolygon*> near(const Bounds& box) const {
    const glm::dvec2 low(box.min), high(box.max);
    std::vector<const RegionPolygon*> found;
    auto p = std::ranges::lower_bound(all_, low.x - widest_, {},
                                      [](const RegionPolygon& other) { return other.low().x; });
    for (; p != all_.end() && p->low().x <= high.x; ++p)
      if (p->meets(low, high)) found.push_back(&*p);
    return found;
  }

 private:
  std::vector<RegionPolygon> all_;
  double widest_ = 0;
};

/// Triangles of an instance that some of these regions draws, as clipToPolygon does.
std::vector<std::uint32_t> drawnOf(const PlacedMesh& placed, const Bounds& box,
                                   std::span<const RegionPolygon* const> regions) {
  std::vector<std::uint32_t> drawn;
  const Mesh& mesh = placed.mesh();
  if (std::ranges::any_of(regions, [&](const RegionPolygon* region) {
        return region->holds(glm::dvec2(box.min), glm::dvec2(box.max));
      })) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) drawn.push_back(t);
    return drawn;
  }
  std::vector<glm::vec3> positions(mesh.positions.size());
  for (std::uint32_t v = 0; v < positions.size(); ++v) positions[v] = placed.position(v);
  std::vector<PolygonClipper> clippers;
  for (const RegionPolygon* region : regions) clippers.emplace_back(region->polygon());
  std::size_t last = 0;  // the next triangle lies where this one does
  const auto drawnIn = [&](std::size_t r, const std::array<glm::vec3, 3>& at, const glm::dvec2& low,
                           const glm::dvec2& high) {
    if (!regions[r]->boxMeets(low, high)) return false;
    return regions[r]->holds(low, high) || clippers[r].leavesArea(at);
  };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3& corners = mesh.triangles[t];
    const std::array at{positions[corners.x], positions[corners.y], positions[corners.z]};
    const glm::dvec2 low(glm::min(glm::vec2(at[0]), glm::min(glm::vec2(at[1]), glm::vec2(at[2]))));
    const glm::dvec2 high(glm::max(glm::vec2(at[0]), glm::max(glm::vec2(at[1]), glm::vec2(at[2]))));
    bool found = drawnIn(last, at, low, high);
    for (std::size_t r = 0; r < regions.size() && !found; ++r)
      if (r != last && drawnIn(r, at, low, high)) found = true, last = r;
    if (found) drawn.push_back(t);
  }
  return drawn;
}

/// By prototype: a plane mirror or a lamp?
std::vector<bool> placedWhole(const Scene& scene) {
  const auto rules = materialRules(scene, planEffects(scene));
  std::vector<bool> whole;
  for (const Mesh& prototype : scene.prototypes) {
    const auto m = std::size_t(prototype.material);
    whole.push_back(rules[m].mirror || (!rules[m].unlit && scene.materials[m].emissive != glm::vec3(0)));
  }
  return whole;
}

}  // namespace

NearInstances findNearInstances(const Scene& scene, std::span<const Layout> layouts, std::uint64_t most) {
  NearInstances near;
  if (scene.instances.empty()) return near;
  const Regions regions(layouts);
  const std::vector<Bounds> own = boundsOf(scene.prototypes);
  const std::vector<bool> whole = placedWhole(scene);
  InstanceExcerpts excerpts;
  Hasher key;
  key.text("near instances");
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Bounds box = boundsOf(instance, own[instance.prototype]);
    if (box.empty()) continue;
    const auto around = regions.near(box);
    if (around.empty()) continue;
    key.value(i);
    if (whole[instance.prototype]) {
      near.whole.push_back(i);
      ++near.instances;
      near.triangles += scene.prototypes[instance.prototype].triangles.size();
      continue;
    }
    const PlacedMesh placed(scene.prototypes[instance.prototype], &instance.worldFromPrototype);
    std::vector<std::uint32_t> drawn = drawnOf(placed, box, around);
    if (drawn.empty()) continue;
    key.array(std::span<const std::uint32_t>(drawn));
    ++near.instances;
    near.triangles += drawn.size();
    if (near.tooMany(most))
      excerpts = InstanceExcerpts();
    else
      excerpts.push_back({i, std::move(drawn)});
  }
  if (!near.any()) return near;
  near.key = key.finish();
  if (!excerpts.empty()) near.excerpts = std::make_shared<const InstanceExcerpts>(std::move(excerpts));
  return near;
}

Status checkNear(const NearInstances& near) {
  if (!near.tooMany()) return {};
  return fail(
      ErrorKind::tooLarge,
      fmt::format("of {} instances {} triangles lie in the walk's regions or within the near band around "
                  "them, where walks draw each triangle; at most {} can be. Draw a smaller outline, choose a "
                  "smaller near band, or give the instances fewer triangles",
                  near.instances, near.triangles, kMostNearTriangles));
}

}  // namespace acentric
