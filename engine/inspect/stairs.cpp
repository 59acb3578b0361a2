#include "engine/inspect/stairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/inspect/cell_mask.h"

namespace acentric {
namespace {

constexpr double kStairGrid = 0.1;           // metres: a tread has two points and more
constexpr double kMostStairCells = 160'000;  // 40 x 40 m
constexpr double kPlanesAround = 1.0;        // metres of the planes that are looked at too
constexpr double kSmoothing = 0.5;      // metres: the ground at a place is a plane through what is so near
constexpr double kLevelWithin = 0.04;   // metres from a plane's height: that plane
constexpr int kPieceOverlap = 2;        // grid steps that a piece reaches over its neighbours
constexpr std::size_t kLeastSpots = 4;  // of a piece

/// A plane through spots; the least squares, with slopes damped where they lie in a line.
struct GroundFit {
  glm::dvec2 middle{0}, rise{0};
  double height = 0;
  double at(const glm::dvec2& place) const { return height + glm::dot(rise, place - middle); }
};

/// `place` and `height` of each of `count` spots.
template <class PlaceOf, class HeightOf>
GroundFit fitGround(std::span<const int> spots, const PlaceOf& placeOf, const HeightOf& heightOf) {
  GroundFit fit;
  const double count = double(spots.size());
  for (const int spot : spots) fit.middle += placeOf(spot) / count, fit.height += heightOf(spot) / count;
  double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;
  for (const int spot : spots) {
    const glm::dvec2 d = placeOf(spot) - fit.middle;
    const double z = heightOf(spot) - fit.height;
    xx += d.x * d.x, xy += d.x * d.y, yy += d.y * d.y, xz += d.x * z, yz += d.y * z;
  }
  const double damping = count * 1e-4;  // of spots a centimetre apart
  xx += damping, yy += damping;
  const double determinant = xx * yy - xy * xy;
  fit.rise = glm::dvec2(yy * xz - xy * yz, xx * yz - xy * xz) / determinant;
  return fit;
}

class StairSurvey {
 public:
  StairSurvey(const Storeys& storeys, const StoreyWay& way, const StairOptions& options, Standing standing)
      : standing_(std::move(standing)), options_(options) {
    findPlanes(storeys, way);
    findBody(way.planes.size());
    smoothGround();
  }

  std::vector<StairPiece> pieces() const {
    std::vector<StairPiece> pieces;
    const std::vector<double> cuts = cutHeights();
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
      std::vector<std::uint8_t> within(body_.size(), 0);
      for (std::size_t s = 0; s < body_.size(); ++s)
        within[s] = body_[s] != 0 && ground_[s] >= cuts[c] && ground_[s] < cuts[c + 1] ? 1 : 0;
      for (const std::vector<int>& spots : partsOf(within))
        if (spots.size() >= kLeastSpots) pieces.push_back(pieceOf(spots));
    }
    std::erase_if(pieces, [](const StairPiece& piece) { return piece.outline.empty(); });
    return pieces;
  }

 private:
  glm::dvec2 placeOf(int spot) const {
    const StandingSpot& at = standing_.spots[std::size_t(spot)];
    return standing_.grid.centreOf(at.x, at.y);
  }

  std::vector<std::vector<int>> partsOf(const std::vector<std::uint8_t>& included) const {
    const std::vector<int> part = numberParts(standing_, included);
    std::vector<std::vector<int>> parts;
    for (std::size_t s = 0; s < part.size(); ++s) {
      if (part[s] < 0) continue;
      if (std::size_t(part[s]) >= parts.size()) parts.resize(std::size_t(part[s]) + 1);
      parts[std::size_t(part[s])].push_back(int(s));
    }
    return parts;
  }

  /// The way's planes go by height alone, so that the outline of a coarser grid parts nothing from them.
  void findPlanes(const Storeys& storeys, const StoreyWay& way) {
    const double tolerance = options_.walkable.floorTolerance;
    planeOf_.assign(standing_.spots.size(), -1);
    planeHeight_.assign(standing_.spots.size(), 0);
    for (std::size_t p = 0; p < storeys.planes.size(); ++p) {
      const WalkPlane& plane = storeys.planes[p];
      const bool ends = std::ranges::find(way.planes, int(p)) != way.planes.end();
      for (std::size_t s = 0; s < planeOf_.size(); ++s) {
        if (std::abs(double(standing_.spots[s].height) - plane.height) > tolerance) continue;
        if (!ends && !plane.outline.contains(placeOf(int(s)))) continue;
        if (planeOf_[s] >= 0 && !ends) continue;
        planeOf_[s] = int(p);
        planeHeight_[s] = plane.height;
      }
    }
  }

  /// Of the body alone: what lies beside it, a step lower, would draw it down at its sides.
  void smoothGround() {
    ground_.resize(standing_.spots.size());
    std::vector<int> seen(standing_.spots.size(), -1), near;
    for (std::size_t s = 0; s < ground_.size(); ++s) {
      if (body_[s] == 0) continue;
      const glm::dvec2 middle = placeOf(int(s));
      near.assign(1, int(s));
      seen[s] = int(s);
      for (std::size_t n = 0; n < near.size(); ++n)
        for (const int next : standing_.spots[std::size_t(near[n])].next)
          if (next >= 0 && body_[std::size_t(next)] != 0 && seen[std::size_t(next)] != int(s) &&
              glm::distance(placeOf(next), middle) <= kSmoothing)
            seen[std::size_t(next)] = int(s), near.push_back(next);
      ground_[s] = fitGround(
                       near, [&](int spot) { return placeOf(spot); },
                       [&](int spot) { return double(standing_.spots[std::size_t(spot)].height); })
                       .at(middle);
    }
  }

  /// Spots of no plane that lead to several, and what of these planes is not level yet or no longer.
  void findBody(std::size_t leastPlanes) {
    std::vector<std::uint8_t> between(planeOf_.size());
    for (std::size_t s = 0; s < between.size(); ++s) between[s] = planeOf_[s] < 0 ? 1 : 0;
    body_.assign(planeOf_.size(), 0);
    std::vector<int> open;
    for (const std::vector<int>& part : partsOf(between)) {
      std::vector<int> planes;
      for (const int spot : part)
        for (const int next : standing_.spots[std::size_t(spot)].next)
          if (next >= 0 && planeOf_[std::size_t(next)] >= 0) planes.push_back(planeOf_[std::size_t(next)]);
      std::ranges::sort(planes);
      const auto repeated = std::ranges::unique(planes);
      planes.erase(repeated.begin(), repeated.end());
      if (planes.size() < std::min<std::size_t>(2, leastPlanes)) continue;
      for (const int spot : part) body_[std::size_t(spot)] = 1;
      open.insert(open.end(), part.begin(), part.end());
    }
    while (!open.empty()) {
      const int spot = open.back();
      open.pop_back();
      for (const int next : standing_.spots[std::size_t(spot)].next) {
        if (next < 0 || body_[std::size_t(next)] != 0 || planeOf_[std::size_t(next)] < 0) continue;
        if (std::abs(double(standing_.spots[std::size_t(next)].height) - planeHeight_[std::size_t(next)]) <=
            kLevelWithin)
          continue;
        body_[std::size_t(next)] = 1;
        open.push_back(next);
      }
    }
  }

  /// Where pieces begin and end: no farther apart than a piece may rise, and where little ground is, so that
  /// no landing is cut.
  std::vector<double> cutHeights() const {
    std::vector<double> heights;
    for (std::size_t s = 0; s < body_.size(); ++s)
      if (body_[s] != 0) heights.push_back(ground_[s]);
    if (heights.empty()) return {};
    std::ranges::sort(heights);
    constexpr double kNear = 0.03;  // metres
    const auto groundAt = [&](double height) {
      return std::ranges::upper_bound(heights, height + kNear) -
             std::ranges::lower_bound(heights, height - kNear);
    };
    const double top = heights.back() + 1e-6, most = options_.pieceRise;
    // Where there is so much, it is a landing.
    const double landing = 2.5 * double(heights.size()) * 2 * kNear / (top - heights.front());
    std::vector<double> cuts{heights.front()};
    while (top - cuts.back() > most) {
      const double left = top - cuts.back();
      double best = left / std::ceil(left / most);  // the last piece is no sliver then
      constexpr int kTries = 8;
      const double even = best;
      for (int t = 1; t <= kTries && double(groundAt(cuts.back() + even)) > landing; ++t) {
        const double lower = (1 - 0.7 * t / kTries) * even;
        if (groundAt(cuts.back() + lower) < groundAt(cuts.back() + best)) best = lower;
      }
      cuts.push_back(cuts.back() + best);
    }
    cuts.push_back(top);
    return cuts;
  }

  StairPiece pieceOf(const std::vector<int>& spots) const {
    const GroundFit fit = fitGround(
        spots, [&](int spot) { return placeOf(spot); }, [&](int spot) { return ground_[std::size_t(spot)]; });
    return {fit.height, {fit.middle, fit.rise}, outlineOf(spots)};
  }

  Outline outlineOf(std::vector<int> spots) const {
    const ProbeGrid& grid = standing_.grid;
    CellMask mask(grid.columns, grid.rows);
    std::vector<int> spotOf(mask.cells.size(), -1);
    const auto take = [&](int spot) {
      const StandingSpot& at = standing_.spots[std::size_t(spot)];
      const std::size_t cell = grid.index(at.x, at.y);
      if (spotOf[cell] >= 0) return false;
      spotOf[cell] = spot;
      mask.cells[cell] = 1;
      return true;
    };
    for (const int spot : spots) take(spot);
    for (int step = 0; step < kPieceOverlap; ++step) {
      std::vector<int> wider = spots;
      for (const int spot : spots)
        for (const int next : standing_.spots[std::size_t(spot)].next)
          if (next >= 0 && take(next)) wider.push_back(next);
      spots = std::move(wider);
    }
    CellLinks links{std::vector<std::uint8_t>(mask.cells.size(), 0),
                    std::vector<std::uint8_t>(mask.cells.size(), 0)};
    for (std::size_t cell = 0; cell < spotOf.size(); ++cell) {
      if (spotOf[cell] < 0) continue;
      const StandingSpot& spot = standing_.spots[std::size_t(spotOf[cell])];
      const auto joined = [&](std::size_t side, std::size_t other) {
        return spot.next[side] >= 0 && spot.next[side] == spotOf[other] ? 1 : 0;
      };
      if (spot.x + 1 < grid.columns) links.right[cell] = std::uint8_t(joined(0, cell + 1));
      if (spot.y + 1 < grid.rows) links.up[cell] = std::uint8_t(joined(1, cell + std::size_t(grid.columns)));
    }
    const CellMask part = largestClearPart(mask, links);
    return part.count() == 0 ? Outline{} : outlineAround(part, grid);
  }

  Standing standing_;
  const StairOptions& options_;
  std::vector<int> planeOf_;         ///< per spot, into Storeys::planes; -1 = none
  std::vector<double> planeHeight_;  ///< of that
  std::vector<double> ground_;       ///< per spot of the body: z of the smoothed ground, metres
  std::vector<std::uint8_t> body_;   ///< per spot: is it of the stairs?
};

}  // namespace

Status StairOptions::check() const {
  if (Status sound = walkable.check(); !sound) return sound;
  if (!(pieceRise >= 0.02 && pieceRise <= 10))
    return fail(ErrorKind::invalidArgument,
                fmt::format("a piece of stairs rises {:g} m; it must lie in 0.02..10 m", pieceRise),
                "stairs");
  return {};
}

Result<std::vector<StairPiece>> findStairs(const Bounds& bounds, const Storeys& storeys, const StoreyWay& way,
                                           const StairOptions& options, const SurfaceProbe& probe) {
  if (Status sound = options.check(); !sound) return tl::unexpected(sound.error());
  const glm::dvec2 size = way.high - way.low + 2 * kPlanesAround;
  ProbeGrid grid;
  grid.corner = way.low - kPlanesAround;
  grid.step = kStairGrid;
  if (!(size.x > 0 && size.y > 0 && size.x * size.y <= kMostStairCells * kStairGrid * kStairGrid))
    return fail(ErrorKind::tooLarge,
                fmt::format("the way from {:.2f} to {:.2f} m is {:.0f} x {:.0f} m large; stairs take up to "
                            "{:.0f} m2 of the plan",
                            storeys.planes[std::size_t(way.planes.front())].height,
                            storeys.planes[std::size_t(way.planes.back())].height, size.x, size.y,
                            kMostStairCells * kStairGrid * kStairGrid),
                "stairs");
  grid.columns = int(std::ceil(size.x / grid.step));
  grid.rows = int(std::ceil(size.y / grid.step));
  WalkableOptions walkable = options.walkable;
  walkable.ignoreSides = storeys.ignoredSides;
  const FloorLevels levels = findFloorLevels(bounds, grid, walkable.headRoom(), probe);
  return StairSurvey(storeys, way, options,
                     surveyStanding(grid, levels, walkable.standingRules(), probe, walkable.runner))
      .pieces();
}

}  // namespace acentric
