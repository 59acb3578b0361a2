#include "engine/measure/source_colours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "engine/image/colour.h"
#include "engine/layout/drawing_order.h"

namespace acentric {
namespace {

/// Linear light as seen by normal eyes and by the three kinds of dichromats (Machado, Oliveira and Fernandes
/// 2009, severity 1).
const std::array<glm::dmat3, 4> kEyes{
    glm::dmat3(1),
    glm::transpose(glm::dmat3(0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882,
                              -0.048116, 1.051998)),
    glm::transpose(glm::dmat3(0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820,
                              0.042940, 0.968881)),
    glm::transpose(glm::dmat3(1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733,
                              0.691367, 0.303900))};

/// CIE L*a*b* of linear Rec.709 light.
glm::dvec3 lab(const glm::dvec3& light) {
  const glm::dvec3 l = glm::clamp(light, 0.0, 1.0);
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
  const double x = f((0.4124 * l.r + 0.3576 * l.g + 0.1805 * l.b) / 0.95047);
  const double y = f(0.2126 * l.r + 0.7152 * l.g + 0.0722 * l.b);
  const double z = f((0.0193 * l.r + 0.1192 * l.g + 0.9505 * l.b) / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// The smallest difference that any of the eyes sees.
double difference(const Rgba8& a, const Rgba8& b) {
  const auto linear = [](const Rgba8& c) {
    return glm::dvec3(linearFromSrgbTable()[c.r], linearFromSrgbTable()[c.g], linearFromSrgbTable()[c.b]);
  };
  double least = 1e9;
  for (const glm::dmat3& eye : kEyes)
    least = std::min(least, glm::distance(lab(eye * linear(a)), lab(eye * linear(b))));
  return least;
}

TEST(SourceColours, StayApartForColourBlindEyes) {
  std::vector<Rgba8> all{kLocalColour, kBackgroundColour, kInventedColour, kOpenHoleColour};
  for (int n = 0; n < kCameraColours; ++n) all.push_back(cameraColour(n));
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_GT(difference(all[a], all[b]), 20) << a << " and " << b;
}

TEST(SourceColours, OfNeighboursInTheDrawingOrderDiffer) {
  for (const Configuration configuration :
       {Configuration::a, Configuration::b, Configuration::c, Configuration::d, Configuration::e,
        Configuration::f, Configuration::g}) {
    SCOPED_TRACE(nameOf(configuration));
    LayoutSpec spec;
    spec.configuration = configuration;
    spec.cellSize = 1;
    spec.outline = *parseOutline("-4,-4;4,-4;4,4;-4,4");
    const Result<Layout> layout = buildLayout(spec);
    ASSERT_TRUE(layout);
    const SourceColours colours(*layout);
    std::set<std::array<int, 3>> used;
    for (const Region& region : layout->regions)
      for (const Cover& cover : region.covers)
        for (std::size_t p = 0; p < cover.pieces.size(); ++p) {
          const int here = cover.pieces[p].camera, next = cover.pieces[(p + 1) % cover.pieces.size()].camera;
          const Rgba8 colour = colours.of(sourceOfCamera(here));
          used.insert({colour.r, colour.g, colour.b});
          EXPECT_TRUE(here == next || difference(colour, colours.of(sourceOfCamera(next))) > 20) << here;
        }
    EXPECT_EQ(used.size(), std::size_t(kCameraColours)) << "all of the palette is used";
  }
}

/// A ring around the origin with a panorama in its centre.
Layout ringWithPanorama() {
  LayoutSpec spec;
  spec.cellSize = 1;
  spec.outline = *parseOutline("-0.1,-0.1;0.1,-0.1;0.1,0.1;-0.1,0.1");
  spec.freeApvs[3] = Apv{{0, 0}, {0, 0}, 60, Hand::counterClockwise};
  return *buildLayout(spec);
}

TEST(SourceRoles, TellOwnCoverOtherHandAndPanorama) {
  const Layout layout = ringWithPanorama();
  PerspectiveView view;
  view.eye = {0.2, 0.1, layout.eyeZ()};
  const SourceRoles roles(layout, view);
  const Region& region = layout.regions[std::size_t(*layout.regionAt({0.2, 0.1}))];
  const Cover& chosen = chooseCover(region, sectorOf(view));
  for (const Cover& cover : region.covers)
    for (const Piece& piece : cover.pieces)
      EXPECT_EQ(roles.of(sourceOfCamera(piece.camera)),
                &cover == &chosen ? SourceRole::ownCover : SourceRole::otherHand);
  const int panorama = *layout.findCamera({3, 0, kFreeCorner, 0});
  EXPECT_EQ(roles.of(sourceOfCamera(panorama)), SourceRole::panorama);
  EXPECT_EQ(roles.of(kSourceLocal), SourceRole::notACamera);
  EXPECT_EQ(sourceName(layout, sourceOfCamera(panorama)), "panorama 3, looks to 90°");
  EXPECT_EQ(sourceName(layout, kSourceInvented), "filled hole");
}

TEST(SourcePicture, ShowsEachSourceInItsColourWithItsSign) {
  const Layout layout = ringWithPanorama();
  PerspectiveView view;
  view.eye = {0, 0, layout.eyeZ()};
  const SourceRoles roles(layout, view);
  const SourceColours colours(layout);
  const PixelSource own = sourceOfCamera(
      chooseCover(layout.regions[std::size_t(*layout.regionAt({0, 0}))], sectorOf(view)).pieces[0].camera);
  const PixelSource panorama = sourceOfCamera(*layout.findCamera({3, 0, kFreeCorner, 0}));
  Frame frame;
  frame.colour = ColourImage(24, 24, Rgba8(128, 128, 128, 255));
  for (const PixelSource source :
       {own, panorama, kSourceLocal, kSourceBackground, kSourceInvented, kSourceHole}) {
    frame.source = Image<PixelSource>(24, 24, source);
    const ColourImage picture = sourcePicture(frame, colours, roles);
    const auto plain = std::ranges::count_if(picture.pixels, [&](const Rgba8& pixel) {
      return glm::distance(glm::vec3(pixel), glm::vec3(colours.of(source))) < 3;
    });
    if (source == panorama) {
      EXPECT_GT(plain, 24 * 24 / 2);
      EXPECT_LT(plain, 24 * 24) << "striped";
    } else {
      EXPECT_EQ(plain, 24 * 24) << source;
    }
  }
}

TEST(SourceShares, AddUpAndComeLargestFirst) {
  const Layout layout = ringWithPanorama();
  const SourceRoles roles(layout, PerspectiveView{});
  Frame frame;
  frame.source = Image<PixelSource>(10, 10, kSourceLocal);
  for (int x = 0; x < 10; ++x) frame.source.at(x, 0) = sourceOfCamera(2), frame.source.at(x, 1) = kSourceHole;
  frame.source.at(0, 0) = kSourceInvented;
  const auto shares = sourceShares(frame, roles);
  ASSERT_EQ(shares.size(), 4u);
  EXPECT_EQ(shares[0].source, kSourceLocal);
  EXPECT_DOUBLE_EQ(shares[0].share, 0.8);
  double sum = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    sum += shares[i].share;
    EXPECT_TRUE(i == 0 || shares[i].share <= shares[i - 1].share) << i;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(HolePicture, MarksOpenAndFilledHolesOverGrey) {
  Frame frame;
  frame.colour = ColourImage(3, 1, Rgba8(255, 255, 255, 255));
  frame.source = Image<PixelSource>(3, 1, kSourceLocal);
  frame.source.at(1, 0) = kSourceHole, frame.source.at(2, 0) = kSourceInvented;
  const ColourImage picture = holePicture(frame);
  EXPECT_EQ(picture.at(0, 0), Rgba8(110, 110, 110, 255));
  EXPECT_EQ(picture.at(1, 0), Rgba8(255));
  EXPECT_EQ(picture.at(2, 0), kInventedColour);
}

}  // namespace
}  // namespace acentric
