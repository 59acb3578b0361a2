#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "baked_camera.h"
#include "engine/bake/eye_views.h"

namespace acentric {
namespace {

using test::Baked;
using test::bakeFrom;
using test::cameraAt;
using test::firstOnly;
using test::kEyeZ;
using test::matte;
using test::room;
using test::SceneBuilder;
using test::square;

/// A room with a screen of some half width before its far wall, and what the pixel straight ahead holds.
std::vector<int> behindScreen(float halfWidth, BakeSettings settings, SampleCounts* counts = nullptr) {
  SceneBuilder builder = room();
  const int white = builder.material(matte());
  builder.quad(white, {3, halfWidth, 0}, {3, -halfWidth, 0}, {3, -halfWidth, 3}, {3, halfWidth, 3});
  settings.samplesPerDegree = 2;
  const Baked baked = bakeFrom(builder.rays(), cameraAt({0, 0}, {square(1)}), settings);
  if (counts != nullptr) *counts = baked.counts;
  std::vector<int> decimetres;
  for (const auto& s : baked.pixel(0.01, 0.01))
    if (s.w > 0) decimetres.push_back(int(std::lround(10 / s.w)));
  return decimetres;
}

TEST(BakeHiddenSurfaces, KeepsWhatSomeEyeOfTheRegionSeesBehindTheFirstSurface) {
  // The wall at (6, 0.06) is seen past a screen at x = 3 from the corner (1, 1) where the screen reaches less
  // far than y = 1 - 0.94 * 2 / 5 = 0.624.
  EXPECT_EQ(behindScreen(0.6f, {}), (std::vector{30, 60}));
  EXPECT_EQ(behindScreen(0.65f, {}), (std::vector{30}));
  EXPECT_EQ(behindScreen(0.6f, firstOnly()), (std::vector{30}));
  BakeSettings all;
  all.pruning = false;
  SampleCounts counts;
  EXPECT_EQ(behindScreen(0.65f, all, &counts), (std::vector{30, 60}));
  EXPECT_EQ(counts.hidden, 0u);
  behindScreen(0.65f, {}, &counts);
  EXPECT_GT(counts.hidden, 0u);
  EXPECT_GT(counts.kept[0], 5 * counts.kept[1]);
  EXPECT_GT(counts.kept[1], 0u);
}

/// The back of a panel passes for its front before the test eyes' maps, and would show in its cracks.
TEST(BakeHiddenSurfaces, DropsWhatLiesRightBehindAnOpaqueSurface) {
  SceneBuilder builder = room();
  builder.box(builder.material(matte()), {4, -1, 0.5f}, {4.004f, 1, 2});
  const LayoutCamera camera = cameraAt({0.5, 0.2}, {square(1), square(2)});
  const Baked baked = bakeFrom(builder.rays(), camera);
  std::size_t thin = 0, deep = 0;
  for (int k = 0; k < baked.columns.columns; ++k)
    for (int r = 0; r < baked.columns.rows; ++r) {
      const auto samples = baked.pixelAt(k, r);
      for (std::size_t i = 1; i < samples.size(); ++i)
        if (samples[i].roles & samples[i - 1].roles) {
          EXPECT_GT(1 - samples[i].w / samples[i - 1].w, 2e-3) << k << " " << r;
          ++deep;
        }
      const double x = samples.empty() ? 0 : 0.5 + baked.columns.directionAt(k + 0.5).x / samples[0].w;
      thin += std::abs(x - 4) < 0.01;
    }
  EXPECT_GT(thin, 50u) << "the panel's front";
  EXPECT_GT(deep, 50u) << "the wall behind it, seen from beside the camera";
}

/// Two sheets that face the same way, nearer together than eyes tell surfaces apart: who sees one seems to
/// see the other, which would shine through in the cracks of the first.
TEST(BakeHiddenSurfaces, DropsASheetRightBehindAnotherThatFacesTheSameWay) {
  SceneBuilder builder = room();
  const int white = builder.material(matte());
  for (const float x : {4.0f, 4.001f})
    builder.quad(white, {x, 1, 0.5f}, {x, -1, 0.5f}, {x, -1, 2}, {x, 1, 2});
  const Baked baked = bakeFrom(builder.rays(), cameraAt({0, 0}, {square(1)}));
  std::size_t sheets = 0;
  for (int k = 0; k < baked.columns.columns; ++k)
    for (int r = 0; r < baked.columns.rows; ++r) {
      int here = 0;
      for (const auto& sample : baked.pixelAt(k, r))
        here += sample.w > 0 && std::abs(baked.columns.directionAt(k + 0.5).x / sample.w - 4) < 0.01;
      EXPECT_LE(here, 1) << k << " " << r;
      sheets += here > 0;
    }
  EXPECT_GT(sheets, 500u);
}

/// Strips right behind mouldings on a wall, hidden from everywhere: where four rays of a test eye's map meet
/// moulding and wall, the strips seem to be seen between them.
TEST(BakeHiddenSurfaces, DropsWhatIsHiddenSoonBehindMouldings) {
  SceneBuilder builder = room();
  const int white = builder.material(matte());
  const auto strip = [&](float x, float y, float half) {
    builder.quad(white, {x, y + half, 0}, {x, y - half, 0}, {x, y - half, 3}, {x, y + half, 3});
  };
  for (int n = -20; n <= 20; ++n) strip(4, 0.1f * float(n), 0.025f), strip(4.018f, 0.1f * float(n), 0.015f);
  strip(4.05f, 0, 4);
  BakeSettings settings;
  settings.samplesPerDegree = 8;
  const Baked baked = bakeFrom(builder.rays(), cameraAt({0, 0}, {square(1)}), settings);
  std::size_t mouldings = 0, hidden = 0;
  for (int k = 0; k < baked.columns.columns; ++k) {
    const glm::dvec2 direction = baked.columns.directionAt(k + 0.5);
    if (std::abs(direction.y / direction.x) > 0.1) continue;
    for (int r = 0; r < baked.columns.rows; ++r) {
      if (std::abs(baked.columns.tangentAt(r + 0.5)) > 0.2) continue;
      for (const auto& sample : baked.pixelAt(k, r)) {
        const double x = sample.w > 0 ? direction.x / sample.w : 0;
        mouldings += std::abs(x - 4) < 0.004;
        hidden += std::abs(x - 4.018) < 0.004;
      }
    }
  }
  EXPECT_GT(mouldings, 2000u);
  EXPECT_EQ(hidden, 0u);
}

/// A fence of slats 5 cm before a wall: the test eyes' maps are too coarse for it, so rays decide, with as
/// much tolerance as a sample's size gives. Five centimetres are more than that.
TEST(BakeHiddenSurfaces, DropsAWallThatIsHiddenBehindSlatsNotFarBeforeIt) {
  SceneBuilder builder = room();
  const int white = builder.material(matte());
  constexpr double kSpacing = 0.4, kHalf = 0.15;
  for (int n = -4; n <= 4; ++n) {
    const float low = float(n * kSpacing - kHalf), high = float(n * kSpacing + kHalf);
    builder.quad(white, {4, high, 0}, {4, low, 0}, {4, low, 3}, {4, high, 3});
  }
  builder.quad(white, {4.05f, 4, 0}, {4.05f, -4, 0}, {4.05f, -4, 3}, {4.05f, 4, 3});
  const Baked baked = bakeFrom(builder.rays(), cameraAt({0, 0}, {square(1)}));
  std::size_t hidden = 0, seen = 0;
  for (int k = 0; k < baked.columns.columns; ++k) {
    const glm::dvec2 direction = baked.columns.directionAt(k + 0.5);
    const double y = 4.05 * direction.y / direction.x;
    if (!(direction.x > 0) || std::abs(y) > 1.2) continue;
    // From the eyes of the region, a square of 2 m, the slats' shadows on the wall are off by 4 cm at most.
    const bool covered = std::abs(std::remainder(y, kSpacing)) < kHalf - 0.04;
    for (int r = 0; r < baked.columns.rows; ++r) {
      if (std::abs(baked.columns.tangentAt(r + 0.5)) > 0.2) continue;
      bool kept = false;
      for (const auto& sample : baked.pixelAt(k, r))
        kept = kept || (sample.w > 0 && std::abs(direction.x / sample.w - 4.05) < 0.02);
      if (covered) {
        EXPECT_FALSE(kept) << k << " " << r;
        ++hidden;
      }
      seen += kept;
    }
  }
  EXPECT_GT(hidden, 100u);
  EXPECT_GT(seen, 100u) << "between the slats";
}

/// The camera's ray leaves a box through a side that it only sees from within, and the region from without.
TEST(BakeHiddenSurfaces, ShadesTheSideThatIsSeenAndNotTheOneTheCameraLooksAt) {
  SceneBuilder builder;
  const glm::vec3 falling = glm::normalize(glm::vec3(0, -1, -0.3f));  // on the side that faces +y alone
  builder.box(builder.material(matte()), {4, -1, 0}, {5, 1, 3}).sun(falling, 10).sky(glm::vec3(1e-6f));
  const auto scene = builder.rays();
  const auto sideAhead = [&](const BakeSettings& settings) {
    for (const auto& sample : bakeFrom(scene, cameraAt({0, 0}, {square(2)}), settings).pixel(1 / 4.5, 0.01))
      if (std::abs(1 / sample.w - std::hypot(4.5, 1.0)) < 0.2) return sample.colour.r;
    return -1.0f;
  };
  EXPECT_NEAR(sideAhead({}), 10 * -falling.y / kPi, 0.02);
  BakeSettings unpruned;
  unpruned.pruning = false;
  EXPECT_LT(sideAhead(unpruned), 1e-3) << "nobody is asked who sees it";
}

/// A sheet of metal, 5 mm thick, that the camera's rays cross at a slant. Its far side, met from within, lies
/// so near behind the other that eyes on this side take both for one place; what those on the far side see is
/// not its dark inside.
TEST(BakeHiddenSurfaces, KeepsNoInnerSideOfAThinBody) {
  SceneBuilder builder;
  builder.box(builder.material(matte()), {3, 0.5, 0}, {7, 0.505f, 3}).sky(glm::vec3(1));
  const auto scene = builder.rays();
  const Baked baked = bakeFrom(scene, cameraAt({0, 0}, {square(2)}));
  int far = 0;
  for (const double x : {4.0, 4.5, 5.0, 5.5, 6.0})
    for (const auto& sample : baked.pixel(0.5025 / x, 0.01)) {
      if (sample.w == 0) continue;
      EXPECT_GT(sample.colour.r, 0.1f) << "at " << 1 / sample.w << " m, by " << x;
      ++far;
    }
  EXPECT_GE(far, 8) << "both sides are seen";
}

/// Half a millimetre thick: both sides lie nearer together than eyes tell surfaces apart, and the region has
/// eyes on either side of it.
TEST(BakeHiddenSurfaces, KeepsBothSidesOfASheetThatEyesSeeFromEither) {
  SceneBuilder builder;
  const glm::vec3 falling = glm::normalize(glm::vec3(0, -1, -0.3f));  // on the far side alone
  builder.box(builder.material(matte()), {3, 0.5f, 0}, {7, 0.5005f, 3}).sun(falling, 10).sky(glm::vec3(0.1f));
  const auto scene = builder.rays();
  const Baked baked = bakeFrom(scene, cameraAt({0, 0}, {square(2)}));
  for (const double x : {4.0, 4.5, 5.0, 5.5, 6.0}) {
    int near = 0, far = 0;
    for (const auto& sample : baked.pixel(0.50025 / x, 0.01))
      if (sample.w != 0) ++(sample.colour.r > 1 ? far : near);
    EXPECT_EQ(near, 1) << "by " << x;
    EXPECT_EQ(far, 1) << "by " << x;
  }
}

TEST(BakeHiddenSurfaces, DropsAFirstSurfaceThatNoRegionSees) {
  // The camera stands outside its region, in the next room.
  SceneBuilder builder;
  const int white = builder.material(matte());
  builder.box(white, {-6, -5, 0}, {2, 5, 3}, true).box(white, {2.1f, -5, 0}, {8, 5, 3}, true);
  const auto samples = [&](double x) {
    return bakeFrom(builder.rays(), cameraAt({x, 0}, {square(0.5)})).pixel(0.01, 0.01);
  };
  ASSERT_EQ(samples(0).size(), 1u);
  EXPECT_NEAR(1 / samples(0)[0].w, 2, 0.01) << "only the wall of the eye's own room";
  EXPECT_TRUE(samples(3).empty()) << "the wall at x = 8 is in a room that no eye of the region sees";
}

TEST(BakeHiddenSurfaces, PrunesAsIfEverySurfaceWereTracedFromEveryTestEye) {
  SceneBuilder builder = room();
  const int white = builder.material(matte());
  std::mt19937 random(11);
  std::uniform_real_distribution<float> place(-4.5f, 4.5f), size(0.05f, 0.6f), height(0.2f, 2.6f);
  for (int n = 0; n < 40; ++n) {
    const glm::vec3 at(place(random) + 1, place(random), 0), half(size(random), size(random), height(random));
    builder.box(white, at - glm::vec3(half.x, half.y, 0), at + half);
  }
  const auto scene = builder.rays();
  LayoutCamera camera = cameraAt({-1, -0.5}, {square(1), square(0.7, {-1.7, 0})});
  camera.fovRadians = radians(20);
  BakeSettings settings;
  settings.maxLayers = 64;
  const Baked pruned = bakeFrom(scene, camera, settings);
  settings.pruning = false;
  const Baked all = bakeFrom(scene, camera, settings);
  settings.pruning = true;
  std::size_t deep = 0, missing = 0, superfluous = 0, compared = 0;
  for (int k = 0; k < all.columns.columns; k += 2)
    for (int r = 0; r < all.columns.rows; r += 2) {
      const glm::dvec3 direction(all.columns.directionAt(k + 0.5), all.columns.tangentAt(r + 0.5));
      const auto kept = pruned.pixelAt(k, r);
      for (const auto& surface : all.pixelAt(k, r)) {
        if (surface.w == 0) continue;
        const glm::dvec3 point = all.columns.centreOfProjection + direction / surface.w;
        int roles = 0, perhaps = 0;  // surely, and with what is behind another surface by a hair
        for (std::size_t role = 0; role < camera.roles.size(); ++role)
          for (const glm::dvec3& eye : placedEyes(camera.roles[role].polygon, kEyeZ, settings)) {
            const glm::dvec3 way = point - eye;
            const double distance = glm::length(way);
            const double open =
                double(scene->occluderDistance({glm::vec3(eye), glm::vec3(way / distance)})) / distance;
            if (open > 1 - 1e-4) roles |= 1 << role;
            if (open > 1 - 2e-2) perhaps |= 1 << role;
          }
        roles &= surface.roles, perhaps &= surface.roles;
        const auto same = std::ranges::find(kept, surface.w, &Baked::Sample::w);
        const int found = same == kept.end() ? 0 : same->roles;
        missing += (roles & ~found) != 0 ? 1 : 0;
        superfluous += (found & ~perhaps) != 0 ? 1 : 0;
        deep += same != kept.end() && same != kept.begin() ? 1 : 0;
        ++compared;
      }
    }
  EXPECT_GT(compared, 10000u);
  EXPECT_GT(deep, 300u);
  EXPECT_LE(missing, compared / 200) << "of " << compared << ", through gaps finer than the map";
  EXPECT_LE(superfluous, compared / 100) << "behind things finer than the map";
}

TEST(BakeHiddenSurfaces, GlassInFrontGivesABlendedSampleAndWhatIsBehind) {
  SceneBuilder builder = room();
  Material glass = matte();
  glass.transmission = 1;
  builder.quad(builder.material(glass), {3, 2, 0}, {3, -2, 0}, {3, -2, 3}, {3, 2, 3});
  const auto pixel = bakeFrom(builder.rays(), cameraAt({0, 0}, {square(1)})).pixel(0.01, 0.01);
  ASSERT_EQ(pixel.size(), 2u);
  EXPECT_NEAR(pixel[0].w, 1.0 / 3, 5e-4);
  EXPECT_NEAR(pixel[0].colour.a, 0.12, 0.01);
  EXPECT_NEAR(pixel[1].w, 1.0 / 6, 5e-4);
  EXPECT_EQ(pixel[1].colour.a, 1);
  // Glass within the region is local geometry.
  EXPECT_EQ(bakeFrom(builder.rays(), cameraAt({0, 0}, {square(4)})).pixel(0.01, 0.01).size(), 1u);
  // With transmission off it is a wall.
  const auto wall =
      bakeFrom(builder.rays({Effect::transmission}), cameraAt({0, 0}, {square(1)})).pixel(0.01, 0.01);
  ASSERT_EQ(wall.size(), 1u);
  EXPECT_NEAR(wall[0].w, 1.0 / 3, 5e-4);
}

TEST(BakeHiddenSurfaces, MoreLayersThanAllowedKeepTheNearestAndEndOnAnOpaqueOne) {
  SceneBuilder builder = room();
  Material film = matte();
  film.alphaMode = AlphaMode::blend;
  film.baseColour.a = 0.5f;
  const int m = builder.material(film);
  for (const float x : {1.5f, 2.0f, 2.5f, 3.0f, 3.5f})
    builder.quad(m, {x, 2, 0}, {x, -2, 0}, {x, -2, 3}, {x, 2, 3});
  BakeSettings settings;
  settings.samplesPerDegree = 1;
  settings.maxLayers = 3;
  const Baked baked = bakeFrom(builder.rays(), cameraAt({0, 0}, {square(1)}), settings);
  EXPECT_EQ(baked.capture.maxLayers(), 3);
  const auto pixel = baked.pixel(0.01, 0.01);
  ASSERT_EQ(pixel.size(), 3u);
  EXPECT_NEAR(1 / pixel[0].w, 1.5, 0.01);
  EXPECT_NEAR(1 / pixel[1].w, 2.0, 0.01);
  EXPECT_NEAR(1 / pixel[2].w, 6.0, 0.02);
  EXPECT_EQ(pixel[2].colour.a, 1);
}

/// A pixel may have all the samples that it can, and the sky be seen past them.
TEST(BakeHiddenSurfaces, KeepsTheBackgroundThatIsSeenBehindTheLastLayer) {
  const auto showsSky = [](float halfWidth) {
    SceneBuilder builder;
    const int white = builder.material(matte());
    builder.sky(glm::vec3(1)).floor(white, 10);
    for (const float x : {3.0f, 3.5f})
      builder.quad(white, {x, halfWidth, 0}, {x, -halfWidth, 0}, {x, -halfWidth, 9}, {x, halfWidth, 9});
    const auto pixel = bakeFrom(builder.rays(), cameraAt({0, 0}, {square(1)}), firstOnly()).pixel(0.01, 0.3);
    return std::ranges::any_of(pixel, [](const Baked::Sample& s) { return s.w == 0; });
  };
  EXPECT_TRUE(showsSky(0.6f)) << "from the corner (1, 1)";
  EXPECT_FALSE(showsSky(4)) << "nobody sees past the screens";
}

/// Seen through a window the sky fills other directions from each place. The reference traces rays from eyes
/// that no bake asks.
TEST(BakeHiddenSurfaces, KeepsTheSkyThatAnyEyeOfTheRegionSeesThroughAHighWindow) {
  SceneBuilder builder;
  const int white = builder.material(matte());
  builder.sky(glm::vec3(1)).floor(white, 6);
  builder.quad(white, {-6, -6, 4}, {-6, 6, 4}, {6, 6, 4}, {6, -6, 4});
  for (const float y : {-6.0f, 6.0f}) builder.quad(white, {-6, y, 0}, {6, y, 0}, {6, y, 4}, {-6, y, 4});
  const auto wall = [&](float y0, float y1, float z0, float z1) {
    builder.quad(white, {6, y0, z0}, {6, y1, z0}, {6, y1, z1}, {6, y0, z1});
  };
  wall(-6, 6, 0, 3), wall(-6, 6, 3.5f, 4), wall(-6, -0.5f, 3, 3.5f), wall(0.5f, 6, 3, 3.5f);
  for (const float y : {-0.25f, 0.0f, 0.25f}) wall(y - 0.02f, y + 0.02f, 3, 3.5f);  // its bars
  const auto scene = builder.rays();
  const Baked baked = bakeFrom(scene, cameraAt({2, 0}, {square(2)}));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-2, 2), height(-0.15, 0.15), window(-0.5, 0.5);
  const auto seesSky = [&](const glm::dvec3& eye, const glm::dvec3& direction) {
    return std::isinf(scene->occluderDistance({glm::vec3(eye), glm::vec3(direction)}));
  };
  int seen = 0, missing = 0;
  while (seen < 3000) {
    const glm::dvec3 eye(place(random), place(random), kEyeZ + height(random));
    const glm::dvec3 direction =
        glm::normalize(glm::dvec3(6, window(random), 3.25 + 0.5 * window(random)) - eye);
    const double azimuth = std::atan2(direction.y, direction.x);
    if (std::abs(azimuth) > radians(29) || !seesSky(eye, direction)) continue;
    ++seen;
    const auto pixel = baked.pixel(azimuth, std::asin(direction.z));
    missing += std::ranges::any_of(pixel, [](const Baked::Sample& s) { return s.w == 0; }) ? 0 : 1;
  }
  EXPECT_LE(missing, seen / 25) << "of " << seen << "; half of them with the test eyes alone";
  // Nothing but what an eye sees, there or less than two texels of the eyes' maps beside.
  const double texel = radians(1);
  for (int k = 0; k < baked.columns.columns; k += 3)
    for (int r = 0; r < baked.columns.rows; r += 3) {
      const auto pixel = baked.pixelAt(k, r);
      if (std::ranges::none_of(pixel, [](const Baked::Sample& s) { return s.w == 0; })) continue;
      const double elevation = baked.columns.elevationAt(r + 0.5), azimuth = baked.columns.azimuthAt(k + 0.5);
      bool found = false;
      for (double x = -2; x <= 2; x += 0.1)
        for (double y = -2; y <= 2; y += 0.1) {
          // Where the direction from there meets the wall.
          const double along = (6 - x) / std::cos(azimuth), slack = 2 * texel * along;
          const double atY = y + along * std::sin(azimuth), atZ = kEyeZ + along * std::tan(elevation);
          found = found || (std::abs(atY) < 0.5 + slack && std::abs(atZ - 3.25) < 0.25 + 0.15 + slack);
        }
      ASSERT_TRUE(found) << "column " << k << " row " << r;
    }
}

}  // namespace
}  // namespace acentric
