#include "engine/layout/cover_template.h"

#include <cmath>

#include "engine/base/contract.h"

namespace acentric {
namespace {

constexpr int kFullTurn = 24;
constexpr int kHalfTurn = 12;

int wrapSteps(int steps) { return ((steps % kFullTurn) + kFullTurn) % kFullTurn; }

/// Directions of a region's edges (corner k to k + 1) in steps of 15 degrees.
std::vector<int> edgeDirections(const LatticeTable& table, const RegionTemplate& region) {
  const auto place = [&](const CornerRef& ref) {
    return double(ref.di) * table.stepI + double(ref.dj) * table.stepJ +
           table.cornerOffsets[std::size_t(ref.corner)];
  };
  std::vector<int> directions;
  for (std::size_t k = 0; k < region.corners.size(); ++k) {
    const glm::dvec2 edge = place(region.corners[(k + 1) % region.corners.size()]) - place(region.corners[k]);
    directions.push_back(wrapSteps(static_cast<int>(std::lround(std::atan2(edge.y, edge.x) / radians(15)))));
  }
  return directions;
}

/// The pieces of one lattice camera of v degrees: its sub-cameras, counter-clockwise.
void addSubCameras(const LatticeTable& table, int apex, int direction, const BorderTemplate& low,
                   const BorderTemplate& high, std::vector<PieceTemplate>& pieces) {
  const int parts = table.apvSteps / table.cameraSteps;
  for (int part = 0; part < parts; ++part) {
    const int from = wrapSteps(direction + part * table.cameraSteps);
    const int to = wrapSteps(from + table.cameraSteps);
    pieces.push_back({apex, from, part == 0 ? low : BorderTemplate{apex, -1, from},
                      part + 1 == parts ? high : BorderTemplate{apex, -1, to}});
  }
}

CoverTemplate ringCover(const LatticeTable& table, const RegionTemplate& region, Hand hand) {
  const std::vector<int> edges = edgeDirections(table, region);
  const int n = static_cast<int>(edges.size());
  CoverTemplate cover;
  cover.hand = hand;
  for (int k = 0; k < n; ++k) {
    const int before = (k + n - 1) % n, behind = (k + 1) % n;
    const int arriving = edges[std::size_t(before)];
    if (hand == Hand::counterClockwise)  // from e[k-1] to e[k]
      addSubCameras(table, k, arriving, {before, k, 0}, {k, behind, 0}, cover.pieces);
    else  // from -e[k-1] to -e[k]
      addSubCameras(table, k, wrapSteps(arriving + kHalfTurn), {k, before, 0}, {behind, k, 0}, cover.pieces);
  }
  return cover;
}

CoverTemplate triangleCover(const LatticeTable& table, const RegionTemplate& region) {
  require(table.apvSteps == table.cameraSteps, "a gap triangle's cameras are not split");
  const std::vector<int> edges = edgeDirections(table, region);
  CoverTemplate cover;
  cover.wedges = 3;
  for (int k = 0; k < 3; ++k) {  // exterior: between the continuations of the two edges that meet here
    const int next = (k + 1) % 3, last = (k + 2) % 3;
    cover.pieces.push_back({k, wrapSteps(edges[std::size_t(k)] + kHalfTurn), BorderTemplate{next, k, 0},
                            BorderTemplate{last, k, 0}});
  }
  for (int k = 0; k < 3; ++k)  // interior: through the triangle and beyond the opposite edge
    cover.pieces.push_back(
        {k, edges[std::size_t(k)], BorderTemplate{k, (k + 1) % 3, 0}, BorderTemplate{k, (k + 2) % 3, 0}});
  return cover;
}

}  // namespace

std::vector<CoverTemplate> coverTemplates(const LatticeTable& table, int slot) {
  const RegionTemplate& region = table.regions[std::size_t(slot)];
  switch (region.kind) {
    case RegionKind::ring:
      return {ringCover(table, region, Hand::counterClockwise), ringCover(table, region, Hand::clockwise)};
    case RegionKind::gapTriangle:
      return {triangleCover(table, region)};
    case RegionKind::gapSquare:
    case RegionKind::gapHexagon:
      break;
  }
  require(false, "no lattice table has this kind of region yet");
  return {};
}

}  // namespace acentric
