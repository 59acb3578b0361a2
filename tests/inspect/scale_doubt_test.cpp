#include "engine/inspect/scale_doubt.h"

#include <gtest/gtest.h>

#include "tests/inspect/box_world.h"

namespace acentric {
namespace {
using test::BoxWorld;

/// All lengths times `scale`.
BoxWorld scaled(BoxWorld world, double scale) {
  for (auto& box : world.boxes) box.min *= scale, box.max *= scale;
  return world;
}

/// Towers on a ground of `across` metres, of storeys of `storey` metres up to `top`; nothing but slabs.
BoxWorld towers(double across, double top, double storey) {
  BoxWorld world{{{{0, 0, -1}, {across, across, 0}}}, {}};
  for (const double x : {0.1, 0.55})
    for (const double y : {0.1, 0.55})
      for (double floor = storey; floor <= top; floor += storey)
        world.boxes.push_back({{x * across, y * across, floor - 0.05 * storey},
                               {(x + 0.35) * across, (y + 0.35) * across, floor}});
  return world;
}

std::optional<ScaleEvidence> weigh(const BoxWorld& world, double texelMetres = 0) {
  return weighScale({measureHeadways(world.bounds(), world.probe()),
                     {},
                     glm::length(glm::dvec3(world.bounds().size())),
                     texelMetres});
}

TEST(ScaleDoubt, IsRaisedByACityWhoseStoreysAreTwentyMetresHigh) {
  const auto evidence = weigh(towers(2192, 740, 20));
  ASSERT_TRUE(evidence.has_value());
  EXPECT_NEAR(evidence->factor, 0.15, 1e-6);
  ASSERT_EQ(evidence->findings.size(), 1U);
  EXPECT_NEAR(evidence->findings[0].metres, 20, 1e-4);
  EXPECT_EQ(evidence->findings[0].subject, "its storeys are");
  EXPECT_FALSE(weigh(scaled(towers(2192, 740, 20), evidence->factor)).has_value());
}

TEST(ScaleDoubt, IsNotRaisedByRoomsHallsAndStoreysAsPeopleBuildThem) {
  EXPECT_FALSE(weigh(BoxWorld::room(5, 4, 2.4)).has_value());
  EXPECT_FALSE(weigh(BoxWorld::room(30, 60, 14)).has_value()) << "a hall";
  EXPECT_FALSE(weigh(BoxWorld::room(30, 90, 45)).has_value()) << "a cathedral";
  EXPECT_FALSE(weigh(towers(300, 60, 3.2)).has_value());
  EXPECT_FALSE(weigh(towers(300, 60, 5.5)).has_value());
}

TEST(ScaleDoubt, IsRaisedByRoomsWhoseCentimetresInchesOrKilometresAreTakenForMetres) {
  for (const double scale : {100.0, 39.37, 0.001, 0.1}) {
    const auto evidence = weigh(scaled(BoxWorld::room(5, 4, 2.7), scale));
    ASSERT_TRUE(evidence.has_value()) << scale;
    EXPECT_NEAR(evidence->factor * scale, 1, 0.01);
  }
  const auto feet = weigh(scaled(towers(300, 60, 3), 1 / 0.3048));
  ASSERT_TRUE(feet.has_value());
  EXPECT_NEAR(feet->factor, 0.3048, 0.01);
}

TEST(ScaleDoubt, OfWhatIsOpenComesFromItsExtentAndTheTexels) {
  const auto ground = [](double across) { return BoxWorld{{{{0, 0, 0}, {across, across, 0.1}}}, {}}; };
  EXPECT_FALSE(weigh(ground(15)).has_value());
  EXPECT_FALSE(weigh(ground(9000)).has_value()) << "a landscape";
  const auto huge = weigh(ground(60000));
  ASSERT_TRUE(huge.has_value());
  EXPECT_DOUBLE_EQ(huge->factor, 0.01);
  const auto fine = weigh(ground(60000), 4);
  ASSERT_TRUE(fine.has_value());
  EXPECT_DOUBLE_EQ(fine->factor, 0.001) << "texels of 4 mm rather than of 4 cm";
  const auto tiny = weigh(ground(0.02));
  ASSERT_TRUE(tiny.has_value());
  EXPECT_DOUBLE_EQ(tiny->factor, 100) << "0.1 m from corner to corner";
}

}  // namespace
}  // namespace acentric
