#include "engine/bake/region_sky.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "engine/bake/flush_denormals.h"
#include "engine/bake/test_eyes.h"

namespace acentric {
namespace {

/// Directions that one task asks about.
constexpr std::size_t kDirectionsAtOnce = 64;
/// Regions that are remembered: those of cameras near by.
constexpr std::size_t kKept = 64;

struct Asked {
  std::size_t corner = 0;
  std::uint32_t eye = 0;  ///< the first to be asked: the one that saw it in the direction beside
};

}  // namespace

std::shared_ptr<const RegionSky> RegionSky::trace(const RayScene& scene,
                                                  std::span<const std::shared_ptr<const EyeView>> views,
                                                  const std::vector<glm::dvec3>& eyes, TaskRunner& runner,
                                                  RayCounts& rays, const std::stop_token& stop) {
  const std::shared_ptr<RegionSky> sky(new RegionSky(views.front()->lattice()));
  const CubeLattice& lattice = sky->lattice_;
  std::vector<bool> asked(lattice.size());
  std::vector<Asked> border;
  for (std::size_t corner = 0; corner < lattice.size(); ++corner)
    for (const auto& view : views) {
      const EyeView::Sees seen = view->backgroundAt(corner);
      if (seen == EyeView::Sees::no) continue;
      sky->seen_[corner] = seen;
      asked[corner] = true;
      break;
    }
  const auto askAround = [&](std::size_t corner, std::uint32_t eye) {
    for (const std::size_t next : lattice.neighbours(corner))
      if (!asked[next]) {
        asked[next] = true;
        border.push_back({next, eye});
      }
  };
  for (std::size_t corner = 0; corner < lattice.size(); ++corner)
    if (sky->seen_[corner] == EyeView::Sees::yes) askAround(corner, 0);
  std::atomic<std::uint64_t> traced = 0;
  while (!border.empty() && !stop.stop_requested()) {
    std::vector<Asked> now;
    now.swap(border);
    runner.parallelFor((now.size() + kDirectionsAtOnce - 1) / kDirectionsAtOnce, [&](std::size_t batch) {
      const FlushDenormals flush;
      std::uint64_t count = 0;
      for (std::size_t i = batch * kDirectionsAtOnce;
           i < std::min(now.size(), (batch + 1) * kDirectionsAtOnce); ++i) {
        if (stop.stop_requested()) return;
        const glm::vec3 direction(glm::normalize(lattice.direction(now[i].corner)));
        const auto sees = [&](std::size_t eye) {
          ++count;
          return !scene.isOccluded({glm::vec3(eyes[eye]), direction});
        };
        std::uint32_t eye = now[i].eye;
        if (!sees(eye))
          for (eye = 0; eye < eyes.size() && (eye == now[i].eye || !sees(eye));) ++eye;
        if (eye == eyes.size()) continue;
        sky->seen_[now[i].corner] = EyeView::Sees::yes;
        now[i].eye = eye;
      }
      traced += count;
    });
    for (const Asked& direction : now)
      if (sky->seen_[direction.corner] == EyeView::Sees::yes) askAround(direction.corner, direction.eye);
  }
  rays.visibility += traced;
  if (stop.stop_requested()) return nullptr;
  return sky;
}

EyeView::Sees RegionSky::looksAlong(const glm::dvec3& direction) const {
  bool any = false;
  for (const std::size_t corner : lattice_.cornersOf(lattice_.placeOf(direction))) {
    if (seen_[corner] == EyeView::Sees::unsure) return EyeView::Sees::unsure;
    any = any || seen_[corner] == EyeView::Sees::yes;
  }
  return any ? EyeView::Sees::yes : EyeView::Sees::no;
}

std::shared_ptr<const RegionSky> RegionSkies::at(const ConvexPolygon& region, double eyeZ,
                                                 std::span<const std::shared_ptr<const EyeView>> views,
                                                 TaskRunner& runner, RayCounts& rays,
                                                 const std::stop_token& stop) {
  BakeSettings search = settings_;
  search.testEyes = kSkyEyes;
  std::vector<glm::dvec3> eyes = placedEyes(region, eyeZ, search);
  if (const auto known = std::ranges::find(kept_, eyes, &Kept::eyes); known != kept_.end()) {
    std::rotate(known, known + 1, kept_.end());
    return kept_.back().sky;
  }
  auto sky = RegionSky::trace(scene_, views, eyes, runner, rays, stop);
  if (!sky) return nullptr;
  if (kept_.size() == kKept) kept_.erase(kept_.begin());
  kept_.push_back({std::move(eyes), sky, MemoryBudget::Share(budget_)});
  kept_.back().share.set(sky->bytes());
  return sky;
}

}  // namespace acentric
