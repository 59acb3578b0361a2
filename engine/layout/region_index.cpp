#include "engine/layout/region_index.h"

#include <cmath>

namespace acentric {

std::size_t RegionIndex::HashCell::operator()(const CellId& id) const {
  // Two rounds of a 64-bit finaliser: neighbouring integers must not share buckets.
  std::uint64_t h = (std::uint64_t(std::uint32_t(id.i)) << 32) | std::uint32_t(id.j);
  h ^= (std::uint64_t(std::uint32_t(id.slot)) << 8 | std::uint64_t(std::uint32_t(id.level))) *
       0x9e3779b97f4a7c15ULL;
  h = (h ^ (h >> 32)) * 0xd6e8feb86659fd93ULL;
  h = (h ^ (h >> 32)) * 0xd6e8feb86659fd93ULL;
  return std::size_t(h ^ (h >> 32));
}

RegionIndex::RegionIndex(const LayoutSpec& spec, const Lattice& lattice, const std::vector<Region>& regions)
    : lattice_(lattice), split_(spec.split) {
  places_.reserve(regions.size());
  for (std::size_t r = 0; r < regions.size(); ++r) {
    places_.emplace(regions[r].id, static_cast<int>(r));
    if (regions[r].id.slot != kFreeSlot) continue;
    const Apv& apv = spec.freeApvs.at(regions[r].id.i);
    free_.push_back(
        {static_cast<int>(r), apv.centre, glm::length(apv.offset) * (1 + 1e-9), regions[r].polygon});
  }
}

std::optional<int> RegionIndex::find(const CellId& id) const {
  const auto found = places_.find(id);
  if (found == places_.end()) return std::nullopt;
  return found->second;
}

std::optional<int> RegionIndex::regionAt(const glm::dvec2& point) const {
  if (!std::isfinite(point.x) || !std::isfinite(point.y)) return std::nullopt;
  for (const FreeRegion& region : free_)
    if (glm::distance(point, region.centre) <= region.radius && region.polygon.contains(point))
      return region.region;
  const CellId cell = lattice_.leafAt(point, split_);
  // Far out, the lattice answers with the nearest region where rounding leaves a point in none. Parts of a
  // split region share a border with it only up to rounding: there the whole's border decides.
  if (cell.level == 0 && !lattice_.holds(cell, point)) return std::nullopt;
  return find(cell);
}

}  // namespace acentric
