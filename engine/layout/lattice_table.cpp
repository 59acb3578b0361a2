#include "engine/layout/lattice_table.h"

#include <cmath>

namespace acentric {
namespace {

/// 3.6.3.6: hexagons two edges apart in six directions, sharing corners; two triangles to a hexagon.
LatticeTable kagome() {
  const double high = std::sqrt(3.0) / 2;
  LatticeTable table;
  table.stepI = {2, 0};
  table.stepJ = {1, 2 * high};
  table.cornerOffsets = {{1, 0}, {0.5, high}, {-0.5, high}};
  table.regions = {
      {RegionKind::ring, {{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {-1, 0, 0}, {0, -1, 1}, {1, -1, 2}}},
      {RegionKind::gapTriangle, {{0, 0, 0}, {1, 0, 2}, {0, 0, 1}}},
      {RegionKind::gapTriangle, {{1, 0, 2}, {1, 0, 1}, {0, 1, 0}}},
  };
  table.apvSteps = 4;
  table.cameraSteps = 4;
  table.cellArea = 4 * high;
  return table;
}

/// Squares without gaps. A camera of 90 degrees is two of 45.
LatticeTable squares() {
  LatticeTable table;
  table.stepI = {1, 0};
  table.stepJ = {0, 1};
  table.cornerOffsets = {{-0.5, -0.5}};
  table.regions = {{RegionKind::ring, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}};
  table.apvSteps = 6;
  table.cameraSteps = 3;
  table.cellArea = 1;
  return table;
}

}  // namespace

const LatticeTable* latticeTable(Configuration configuration) {
  static const LatticeTable b = kagome();
  static const LatticeTable e = squares();
  switch (configuration) {
    case Configuration::b:
      return &b;
    case Configuration::e:
      return &e;
    case Configuration::a:
    case Configuration::c:
    case Configuration::d:
    case Configuration::f:
    case Configuration::g:
      break;
  }
  return nullptr;
}

}  // namespace acentric
