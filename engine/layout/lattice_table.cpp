#include "engine/layout/lattice_table.h"

#include <cmath>

namespace acentric {
namespace {

const double kHigh = std::sqrt(3.0) / 2;  // of a regular triangle

/// a: octagons (4.8.8), squares standing on a corner between them.
LatticeTable octagons() {
  const double half = 0.5 + std::sqrt(0.5);  // of an octagon's width
  LatticeTable table;
  table.stepI = {2 * half, 0};
  table.stepJ = {0, 2 * half};
  table.cornerOffsets = {{half, 0.5}, {0.5, half}, {-0.5, half}, {half, -0.5}};
  table.regions = {
      {RegionKind::ring,
       {{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {-1, 0, 0}, {-1, 0, 3}, {0, -1, 2}, {0, -1, 1}, {0, 0, 3}}},
      {RegionKind::gapSquare, {{0, 0, 0}, {1, 0, 2}, {0, 1, 3}, {0, 0, 1}}},
  };
  table.apvSteps = 3;
  table.cameraSteps = 3;
  table.cellArea = 4 * half * half;
  return table;
}

/// b: 3.6.3.6, hexagons two edges apart in six directions, sharing corners; two triangles to a hexagon.
LatticeTable kagomeHexagons() {
  LatticeTable table;
  table.stepI = {2, 0};
  table.stepJ = {1, 2 * kHigh};
  table.cornerOffsets = {{1, 0}, {0.5, kHigh}, {-0.5, kHigh}};
  table.regions = {
      {RegionKind::ring, {{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {-1, 0, 0}, {0, -1, 1}, {1, -1, 2}}},
      {RegionKind::gapTriangle, {{0, 0, 0}, {1, 0, 2}, {0, 0, 1}}},
      {RegionKind::gapTriangle, {{1, 0, 2}, {1, 0, 1}, {0, 1, 0}}},
  };
  table.apvSteps = 4;
  table.cameraSteps = 4;
  table.cellArea = 4 * kHigh;
  return table;
}

/// c: 6.6.6, hexagons without gaps.
LatticeTable hexagons() {
  LatticeTable table;
  table.stepI = {1.5, kHigh};
  table.stepJ = {0, 2 * kHigh};
  table.cornerOffsets = {{1, 0}, {0.5, kHigh}};
  table.regions = {
      {RegionKind::ring, {{0, 0, 0}, {0, 0, 1}, {-1, 1, 0}, {-1, 0, 1}, {-1, 0, 0}, {0, -1, 1}}}};
  table.apvSteps = 4;
  table.cameraSteps = 4;
  table.cellArea = 3 * kHigh;
  return table;
}

/// d: squares in a checkerboard.
LatticeTable checkerboard() {
  LatticeTable table;
  table.stepI = {1, 1};
  table.stepJ = {-1, 1};
  table.cornerOffsets = {{-0.5, -0.5}, {0.5, -0.5}};
  table.regions = {
      {RegionKind::ring, {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 1}}},
      {RegionKind::gapSquare, {{0, 0, 1}, {1, -1, 0}, {1, 0, 1}, {1, 0, 0}}},
  };
  table.apvSteps = 6;
  table.cameraSteps = 3;
  table.cellArea = 2;
  return table;
}

/// e: squares without gaps. A camera of 90 degrees is two of 45.
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

/// f: 3.6.3.6 again, with rings around the triangles; the hexagons are gaps. A camera of 120 degrees is two
/// of 60.
LatticeTable kagomeTriangles() {
  LatticeTable table = kagomeHexagons();
  const std::vector<RegionTemplate> regions = table.regions;
  const glm::dvec2 centre(1, kHigh * 2 / 3);  // of the first triangle
  for (glm::dvec2& offset : table.cornerOffsets) offset -= centre;
  table.regions = {{RegionKind::ring, regions[1].corners},
                   {RegionKind::ring, regions[2].corners},
                   {RegionKind::gapHexagon, regions[0].corners}};
  table.apvSteps = 8;
  table.cameraSteps = 4;
  return table;
}

/// g: triangles without gaps between; every other one has a ring.
LatticeTable triangles() {
  LatticeTable table;
  table.stepI = {1, 0};
  table.stepJ = {0.5, kHigh};
  table.cornerOffsets = {{-0.5, -kHigh / 3}};
  table.regions = {{RegionKind::ring, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                   {RegionKind::gapTriangle, {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}};
  table.apvSteps = 8;
  table.cameraSteps = 4;
  table.cellArea = kHigh;
  return table;
}

}  // namespace

const LatticeTable* latticeTable(Configuration configuration) {
  static const LatticeTable tables[] = {octagons(), kagomeHexagons(),  hexagons(), checkerboard(),
                                        squares(),  kagomeTriangles(), triangles()};
  const auto index = static_cast<std::size_t>(configuration);
  return index < std::size(tables) ? &tables[index] : nullptr;
}

}  // namespace acentric
