#pragma once
/// Which region of a layout holds a point, in well under a microsecond whatever the number of regions: the
/// lattice gives the address, a hash table its place in the layout. Immutable; any thread.

#include <unordered_map>

#include "engine/layout/lattice.h"

namespace acentric {

class RegionIndex {
 public:
  /// `regions` in the order of Layout::regions.
  RegionIndex(const LayoutSpec& spec, const Lattice& lattice, const std::vector<Region>& regions);

  const Lattice& lattice() const { return lattice_; }
  std::optional<int> find(const CellId& id) const;
  std::optional<int> regionAt(const glm::dvec2& point) const;

 private:
  struct HashCell {
    std::size_t operator()(const CellId& id) const;
  };
  struct FreeRegion {
    int region;
    glm::dvec2 centre;
    double radius;
    ConvexPolygon polygon;
  };

  Lattice lattice_;
  std::set<CellId> split_;
  std::unordered_map<CellId, int, HashCell> places_;
  std::vector<FreeRegion> free_;  ///< in order of their numbers
};

}  // namespace acentric
