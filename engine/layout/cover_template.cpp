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

/// The border of a sub-camera at a corner.
BorderTemplate along(int corner, int direction) {
  return {corner, wrapSteps(direction), BorderTemplate::Through::direction};
}

/// The pieces of one lattice camera, `steps` wide: its sub-cameras, counter-clockwise.
void addSubCameras(const LatticeTable& table, int apex, int direction, int steps, const BorderTemplate& low,
                   const BorderTemplate& high, std::vector<PieceTemplate>& pieces) {
  require(steps % table.cameraSteps == 0, "sub-cameras fill their camera");
  const int parts = steps / table.cameraSteps;
  for (int part = 0; part < parts; ++part) {
    const int from = wrapSteps(direction + part * table.cameraSteps);
    const int to = from + table.cameraSteps;
    pieces.push_back(
        {apex, from, part == 0 ? low : along(apex, from), part + 1 == parts ? high : along(apex, to)});
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
      addSubCameras(table, k, arriving, table.apvSteps, {before, k}, {k, behind}, cover.pieces);
    else  // from -e[k-1] to -e[k]
      addSubCameras(table, k, wrapSteps(arriving + kHalfTurn), table.apvSteps, {k, before}, {behind, k},
                    cover.pieces);
  }
  return cover;
}

/// Corner wedges seen by the exterior cameras, between the continuations of the two edges that meet there,
/// and edge strips seen by interior cameras, between the continuations of the two edges beside. A strip's
/// camera stands behind one end of its edge or the other: on the right (counter-clockwise) or the left; in a
/// triangle both are the opposite corner.
CoverTemplate gapCover(const LatticeTable& table, const RegionTemplate& region, Hand hand) {
  const std::vector<int> edges = edgeDirections(table, region);
  const int n = static_cast<int>(edges.size());
  const auto corner = [&](int k) { return ((k % n) + n) % n; };
  CoverTemplate cover;
  cover.hand = hand;
  const int wedgeSteps = kHalfTurn - kFullTurn / n;
  for (int k = 0; k < n; ++k) {
    const std::size_t first = cover.pieces.size();
    addSubCameras(table, k, edges[std::size_t(k)] + kHalfTurn, wedgeSteps, {corner(k + 1), k},
                  {corner(k - 1), k}, cover.pieces);
    if (n < 6) continue;
    // Neighbouring wedges overlap beyond the tip of the strip between them: they are parted there by the line
    // from the middle of the gap through the tip.
    require(cover.pieces.size() - first == 2, "a hexagon's exterior cameras are two sub-cameras");
    const auto tip = [&](int edge) {
      return BorderTemplate{corner(edge + n / 2), corner(edge), BorderTemplate::Through::middles};
    };
    cover.pieces[first].clip = ClipTemplate{tip(k - 1), true, BorderTemplate{corner(k - 2), corner(k - 1)}};
    cover.pieces[first + 1].clip = ClipTemplate{tip(k), false, BorderTemplate{corner(k + 2), corner(k + 1)}};
  }
  cover.wedges = static_cast<int>(cover.pieces.size());

  const int span = table.cameraSteps * n / kHalfTurn;  // corners further that a sub-camera's far border meets
  for (int m = 0; m < n; ++m) {
    const BorderTemplate right{corner(m - 1), m}, left{corner(m + 2), corner(m + 1)};
    const int leftDirection = edges[std::size_t(corner(m + 1))] + kHalfTurn;
    if (hand == Hand::counterClockwise)
      cover.pieces.push_back(
          {corner(m - 1), edges[std::size_t(corner(m - 1))], right, {corner(m - 1), corner(m + span)}});
    else
      cover.pieces.push_back({corner(m + 2),
                              wrapSteps(leftDirection - table.cameraSteps),
                              {corner(m + 2), corner(m + 1 - span)},
                              left});
    if (n > 3)
      cover.pieces.back().clip =
          hand == Hand::counterClockwise ? ClipTemplate{left, false, {}} : ClipTemplate{right, true, {}};
  }
  return cover;
}

}  // namespace

std::vector<CoverTemplate> coverTemplates(const LatticeTable& table, int slot) {
  const RegionTemplate& region = table.regions[std::size_t(slot)];
  switch (region.kind) {
    case RegionKind::ring:
      return {ringCover(table, region, Hand::counterClockwise), ringCover(table, region, Hand::clockwise)};
    case RegionKind::gapTriangle:
      return {gapCover(table, region, Hand::counterClockwise)};
    case RegionKind::gapSquare:
    case RegionKind::gapHexagon:
      return {gapCover(table, region, Hand::counterClockwise), gapCover(table, region, Hand::clockwise)};
  }
  require(false, "a region has a kind");
  return {};
}

}  // namespace acentric
