#include "engine/pipeline/near_instances.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/scene/instances.h"

namespace acentric {
namespace {

/// Regions by where they begin, so that a box is asked of its neighbours alone.
class RegionBoxes {
 public:
  explicit RegionBoxes(std::span<const Layout> layouts) {
    for (const Layout& layout : layouts)
      for (const Region& region : layout.regions) {
        if (region.grown.size() < 3) continue;
        Entry entry{&region.grown, region.grown.corners[0], region.grown.corners[0]};
        for (const glm::dvec2& corner : region.grown.corners)
          entry.low = glm::min(entry.low, corner), entry.high = glm::max(entry.high, corner);
        widest_ = std::max(widest_, entry.high.x - entry.low.x);
        entries_.push_back(entry);
      }
    std::ranges::sort(entries_, {}, [](const Entry& e) { return e.low.x; });
  }

  bool meets(const Bounds& box) const {
    const glm::dvec2 low(box.min), high(box.max);
    const ConvexPolygon plan{{low, {high.x, low.y}, high, {low.x, high.y}}};
    auto entry =
        std::ranges::lower_bound(entries_, low.x - widest_, {}, [](const Entry& e) { return e.low.x; });
    for (; entry != entries_.end() && entry->low.x <= high.x; ++entry)
      if (entry->high.x >= low.x && entry->low.y <= high.y && entry->high.y >= low.y &&
          overlap(*entry->polygon, plan))
        return true;
    return false;
  }

 private:
  struct Entry {
    const ConvexPolygon* polygon;
    glm::dvec2 low, high;
  };
  std::vector<Entry> entries_;
  double widest_ = 0;
};

}  // namespace

ContentKey NearInstances::key() const {
  if (instances.empty()) return {};
  return Hasher().text("near instances").array(std::span<const std::uint32_t>(instances)).finish();
}

NearInstances findNearInstances(const Scene& scene, std::span<const Layout> layouts) {
  NearInstances near;
  if (scene.instances.empty()) return near;
  const RegionBoxes regions(layouts);
  const std::vector<Bounds> own = boundsOf(scene.prototypes);
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Bounds box = boundsOf(instance, own[instance.prototype]);
    if (box.empty() || !regions.meets(box)) continue;
    near.instances.push_back(i);
    near.triangles += scene.prototypes[instance.prototype].triangles.size();
  }
  return near;
}

Status checkNear(const NearInstances& near) {
  if (!near.tooMany()) return {};
  return fail(
      ErrorKind::tooLarge,
      fmt::format("{} instances with {} triangles in all stand in the walk's regions or within the near "
                  "band around them, where walks draw each triangle; at most {} can be. Draw a smaller "
                  "outline, choose a smaller near band, or give the instances fewer triangles",
                  near.instances.size(), near.triangles, kMostNearTriangles));
}

}  // namespace acentric
