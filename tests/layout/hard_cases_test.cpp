/// Where numbers go wrong: each case is checked on the real thing, and on a deliberately naive variant that
/// must fail, so that the test is seen to bite.

#include <gtest/gtest.h>

#include <cmath>

#include "engine/layout/lattice.h"
#include "tests/layout/layout_fixtures.h"

namespace acentric {
namespace {
using test::kAllConfigurations;
using test::makeLayout;
using test::Placing;
using test::Random;

// ---- Naive variants --------------------------------------------------------------------------------------

/// The sign by one cross product, in the precision of Real.
template <class Real>
int naiveSide(const BorderLine& line, const glm::dvec2& p) {
  const Real ax = Real(line.from.x), ay = Real(line.from.y);
  const Real area = (Real(line.to.x) - ax) * (Real(p.y) - ay) - (Real(line.to.y) - ay) * (Real(p.x) - ax);
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

/// Sectors that own both of their borders.
bool closedHolds(const Piece& piece, const glm::dvec2& p) {
  return naiveSide<double>(piece.low, p) >= 0 && naiveSide<double>(piece.high, p) <= 0;
}

/// Corners as computed from each polygon's own centre, matched by comparing coordinates.
std::size_t cornersMatchedByCoordinates(const Layout& layout) {
  std::set<std::pair<double, double>> corners;
  for (const Region& region : layout.regions) {
    const glm::dvec2 centre = region.polygon.centroid();
    const glm::dvec2 first = region.polygon.corners[0] - centre;
    const double n = double(region.polygon.size()), radius = glm::length(first),
                 begin = std::atan2(first.y, first.x);
    for (double k = 0; k < n; ++k) {
      const glm::dvec2 corner = centre + radius * directionOf(begin + kTwoPi * k / n);
      corners.emplace(corner.x, corner.y);
    }
  }
  return corners.size();
}

// ---- Points on and beside borders ------------------------------------------------------------------------

/// Places where a sector's border is hard to tell: along its line, and one step of the last digit beside it.
std::vector<glm::dvec2> pointsAlongBorders(const Cover& cover, Random& random) {
  std::vector<glm::dvec2> points;
  for (const Piece& piece : cover.pieces)
    for (const BorderLine& line : {piece.low, piece.high})
      for (int n = 0; n < 6; ++n) {
        glm::dvec2 p = line.to + random(0.1, 20) * line.direction();
        points.push_back(p);
        p.x = std::nextafter(p.x, random(-1, 1) > 0 ? INFINITY : -INFINITY);
        points.push_back(p);
      }
  return points;
}

/// The sign in whole numbers: 5e6 m out, doubles are multiples of 2^-30 m.
int wholeNumberSide(const BorderLine& line, const glm::dvec2& p) {
  __extension__ using Wide = __int128;
  const auto whole = [](double value) { return Wide(std::int64_t(std::ldexp(value, 30))); };
  const Wide ax = whole(line.from.x), ay = whole(line.from.y);
  const Wide area = (whole(line.to.x) - ax) * (whole(p.y) - ay) - (whole(line.to.y) - ay) * (whole(p.x) - ax);
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

TEST(HardCases, TheSideOfABorderIsRightBesideItByExactSignsAndNotByFloatCrossProducts) {
  int points = 0, wrongInFloat = 0;
  for (const Configuration configuration : kAllConfigurations) {
    const Layout layout = makeLayout(configuration, {2, {5e6, -5e6}, 0.4});
    Random random(41);
    for (const Region& region : layout.regions)
      for (const Cover& cover : region.covers)
        for (const glm::dvec2& p : pointsAlongBorders(cover, random)) {
          if (region.polygon.containsClosed(p)) continue;
          ASSERT_EQ(std::ranges::count_if(cover.pieces, [&](const Piece& piece) { return piece.holds(p); }),
                    1);
          const Piece& piece = cover.pieces[std::size_t(random.index(cover.pieces.size()))];
          const bool held = wholeNumberSide(piece.low, p) >= 0 && wholeNumberSide(piece.high, p) < 0;
          ASSERT_EQ(piece.holds(p), held && (!piece.clip || piece.clip->holds(p))) << nameOf(configuration);
          ++points;
          wrongInFloat += naiveSide<float>(piece.low, p) != wholeNumberSide(piece.low, p);
        }
  }
  EXPECT_GT(points, 10000);
  EXPECT_GT(wrongInFloat, points / 10);
}

TEST(HardCases, AViewBorderAlongASectorsBorderShowsAllThatItsRaysCrossAndFloatCrossProductsMissSides) {
  int views = 0, naiveWrong = 0;
  for (const Configuration configuration : kAllConfigurations) {
    const Layout layout = makeLayout(configuration, {2, {0.3, -0.7}, 0.4});
    Random random(43);
    for (std::size_t r = 0; r < layout.regions.size(); ++r) {
      const Region& region = layout.regions[r];
      for (const Cover& cover : region.covers)
        for (const Piece& piece : cover.pieces) {
          // The view begins or ends along the border, or a few last digits beside it.
          const glm::dvec2 along = piece.low.direction();
          double azimuth = std::atan2(along.y, along.x);
          for (int digits = random.index(4); digits > 0; --digits)
            azimuth = std::nextafter(azimuth, random(-9, 9));
          const double width = random(0.3, 3.1);
          const ViewSector sector{random.within(region.polygon),
                                  {random.index(2) == 0 ? azimuth : azimuth - width, width}};
          std::vector<int> painted;
          for (const OrderedPiece& shown : visiblePieces(layout, static_cast<int>(r), cover, sector))
            painted.push_back(shown.camera);
          for (const double share : {1e-7, 0.5, 1 - 1e-7}) {
            const glm::dvec2 ray = directionOf(sector.azimuths.low + share * width);
            auto expected = test::crossedAlongRay(region, cover, sector.eye, ray, 1e-6);
            std::ranges::reverse(expected);
            auto crossed = painted;
            std::erase_if(crossed, [&](int c) { return std::ranges::find(expected, c) == expected.end(); });
            ASSERT_EQ(crossed, expected) << nameOf(configuration);
          }
          // Naively, the paper's r_eye x r_A in floats.
          const glm::dvec2 view = directionOf(azimuth);
          const glm::vec2 a(view), b(along);
          const float rounded = a.x * b.y - a.y * b.x;
          const long double exact =
              static_cast<long double>(view.x) * along.y - static_cast<long double>(view.y) * along.x;
          naiveWrong += (rounded > 0) != (exact > 0) || (rounded < 0) != (exact < 0);
          ++views;
        }
    }
  }
  EXPECT_GT(views, 500);
  EXPECT_GT(naiveWrong, views / 4);
}

TEST(HardCases, APointOnABorderIsHeldOnceByHalfOpenSectorsAndTwiceByClosedOnes) {
  // Unrotated squares with corners at whole numbers: borders pass exactly through lattice points.
  const Layout layout = makeLayout(Configuration::e, {2, {1, 1}, 0});
  int points = 0, twice = 0;
  for (const Region& region : layout.regions)
    for (const Cover& cover : region.covers)
      for (int x = -6; x <= 6; ++x)
        for (int y = -6; y <= 6; ++y) {
          const glm::dvec2 p(2 * x, 2 * y);
          if (region.polygon.containsClosed(p)) continue;
          const auto held = [&](const auto& holds) {
            return std::ranges::count_if(cover.pieces, [&](const Piece& piece) { return holds(piece, p); });
          };
          ASSERT_EQ(held([](const Piece& piece, const glm::dvec2& q) { return piece.holds(q); }), 1);
          ++points;
          twice += held(closedHolds) > 1;
        }
  EXPECT_GT(points, 1000);
  EXPECT_GT(twice, points / 10);
}

TEST(HardCases, CornersOfDifferentPolygonsAreTheSameCameraByIntegersAndNotByCoordinates) {
  for (const Configuration configuration : kAllConfigurations) {
    const Layout layout = makeLayout(configuration, {1.7, {123.4, -77.7}, 0.3}, 4);
    std::set<std::pair<double, double>> bits;  // of the corners as the lattice places them
    std::set<std::tuple<int, int, int, int>> addresses;
    for (const Region& region : layout.regions)
      for (const glm::dvec2& corner : region.polygon.corners) bits.emplace(corner.x, corner.y);
    for (const LayoutCamera& camera : layout.cameras)
      addresses.emplace(camera.id.i, camera.id.j, camera.id.corner, camera.id.level);
    EXPECT_EQ(bits.size(), addresses.size()) << nameOf(configuration);
    EXPECT_GT(cornersMatchedByCoordinates(layout), addresses.size() * 5 / 4) << nameOf(configuration);
  }
}

TEST(HardCases, TheAnglesOfARingCloseBySharedBordersAndNotByAddingFieldsOfView) {
  // v * n is 360 degrees for each ring, and cameras at a corner that look all round leave no seam: the end of
  // each sector is the beginning of the next one, bit for bit.
  int added = 0, open = 0;
  for (const Configuration configuration : kAllConfigurations) {
    const Layout layout = makeLayout(configuration, {2, {0, 0}, 0.123});
    for (const Region& region : layout.regions) {
      if (region.kind != RegionKind::ring) continue;
      const auto& pieces = region.covers[0].pieces;
      double sum = 0;
      float azimuth = float(layout.cameras[std::size_t(pieces[0].camera)].lowAzimuth);
      const float first = azimuth;
      for (std::size_t k = 0; k < pieces.size(); ++k) {
        const Piece &piece = pieces[k], &next = pieces[(k + 1) % pieces.size()];
        const LayoutCamera& camera = layout.cameras[std::size_t(piece.camera)];
        const LayoutCamera& after = layout.cameras[std::size_t(next.camera)];
        sum += camera.fovRadians;
        azimuth += float(camera.fovRadians);
        EXPECT_NEAR(std::remainder(camera.lowAzimuth + camera.fovRadians - after.lowAzimuth, kTwoPi), 0,
                    1e-12);
        EXPECT_EQ(piece.high.from, next.low.from);
        EXPECT_EQ(piece.high.to, next.low.to);
      }
      EXPECT_NEAR(sum, kTwoPi, 1e-12);
      ++added;
      open += directionOf(double(azimuth)) != directionOf(double(first));
    }
  }
  EXPECT_GT(open, added / 2) << "added up in floats, the last sector does not end where the first begins";
}

// ---- Scale and place -------------------------------------------------------------------------------------

/// The ids of the cameras that a view shows, back to front.
std::vector<CameraId> shown(const Layout& layout, const glm::dvec2& eye, double azimuth, double width) {
  std::vector<CameraId> ids;
  const auto region = layout.regionAt(eye);
  if (!region) return ids;
  const ViewSector sector{eye, {azimuth - 0.5 * width, width}};
  const Cover& cover = chooseCover(layout.regions[std::size_t(*region)], sector);
  for (const OrderedPiece& piece : visiblePieces(layout, *region, cover, sector))
    ids.push_back(layout.cameras[std::size_t(piece.camera)].id);
  return ids;
}

TEST(HardCases, TheSameProjectAtAnyScaleAndPlaceHasTheSameLayoutAndCovers) {
  const double cell = 2;
  for (const Configuration configuration : kAllConfigurations) {
    const Layout reference = makeLayout(configuration, {cell, {0, 0}, 0.3}, 2.5);
    for (const double scale : {1e-3, 1.0, 1e4})
      for (const glm::dvec2& move : {glm::dvec2(0), glm::dvec2(5e6, -5e6)}) {
        const Layout other = makeLayout(configuration, {scale * cell, move, 0.3}, 2.5);
        ASSERT_EQ(other.regions.size(), reference.regions.size());
        ASSERT_EQ(other.cameras.size(), reference.cameras.size());
        for (std::size_t r = 0; r < reference.regions.size(); ++r)
          ASSERT_EQ(other.regions[r].id, reference.regions[r].id);
        for (std::size_t c = 0; c < reference.cameras.size(); ++c)
          ASSERT_EQ(other.cameras[c].id, reference.cameras[c].id);
        Random random(42);
        const double fovs[] = {radians(1), radians(59.999), radians(60), radians(120), radians(179)};
        for (int n = 0; n < 400; ++n) {
          const glm::dvec2 eye(random(-4, 4), random(-4, 4));
          const double azimuth = random(0, kTwoPi), width = fovs[n % 5];
          ASSERT_EQ(shown(other, move + scale * eye, azimuth, width), shown(reference, eye, azimuth, width))
              << nameOf(configuration) << " at scale " << scale;
        }
      }
  }
}

}  // namespace
}  // namespace acentric
