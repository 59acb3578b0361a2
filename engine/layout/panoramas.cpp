#include "engine/layout/panoramas.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/layout/layout.h"

namespace acentric {
namespace {

constexpr double kSamePlace = 1e-6;  ///< share of the cell size

}  // namespace

Result<int> addPanoramas(LayoutSpec& spec, PanoramaPlaces places) {
  const Result<Layout> layout = buildLayout(spec);
  if (!layout) return tl::unexpected(layout.error());
  LayoutSpec grown = spec;
  int number = spec.freeApvs.empty() ? 0 : spec.freeApvs.rbegin()->first + 1;
  int added = 0;
  for (const Region& region : layout->regions) {
    if (region.id.slot == kFreeSlot || (places == PanoramaPlaces::rings && region.kind != RegionKind::ring))
      continue;
    const glm::dvec2 centre = region.polygon.centroid();
    const bool there = std::ranges::any_of(spec.freeApvs, [&](const auto& free) {
      return free.second.traditional() &&
             glm::distance(free.second.centre, centre) <= kSamePlace * spec.cellSize;
    });
    if (there) continue;
    if (grown.freeApvs.size() >= std::size_t(kMaxFreeApvs))
      return fail(ErrorKind::invalidArgument,
                  fmt::format("more than {} free APVs: choose larger cells, or place panoramas one by one",
                              kMaxFreeApvs),
                  "layout");
    grown.freeApvs[number++] = Apv{centre, {0, 0}};
    ++added;
  }
  spec = std::move(grown);
  return added;
}

int removePanoramas(LayoutSpec& spec) {
  return int(std::erase_if(spec.freeApvs, [](const auto& free) { return free.second.traditional(); }));
}

}  // namespace acentric
