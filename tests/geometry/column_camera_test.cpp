#include "engine/geometry/column_camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

ColumnCamera camera() {
  return {{1, 2, 1.6}, radians(350), radians(60), radians(30), radians(-50), 600, 400};
}

TEST(ColumnCamera, ColumnsRunCounterClockwiseAndRowsDownwards) {
  const ColumnCamera c = camera();
  EXPECT_LT(glm::distance(c.directionAt(0), directionOf(radians(350))), 1e-12);
  EXPECT_LT(glm::distance(c.directionAt(600), directionOf(radians(50))), 1e-12);
  EXPECT_GT(cross(c.directionAt(10), c.directionAt(11)), 0);
  EXPECT_NEAR(c.tangentAt(0), std::tan(radians(30)), 1e-12);
  EXPECT_NEAR(c.tangentAt(400), std::tan(radians(-50)), 1e-12);
  EXPECT_NEAR(c.columnPitch() * 600, radians(60), 1e-12);
  EXPECT_NEAR(c.rowPitch() * 400, radians(80), 1e-12);
}

TEST(ColumnCamera, ASampleLiesWhereTheHeaderSays) {
  const ColumnCamera c = camera();
  // P + (c + t z) / w: horizontal distance 1 / w, elevation that of the row.
  const double w = 0.25, x = 123.5, y = 77.5;
  const glm::dvec3 point = c.centreOfProjection + (glm::dvec3(c.directionAt(x), c.tangentAt(y))) / w;
  const glm::dvec3 offset = point - c.centreOfProjection;
  EXPECT_NEAR(glm::length(glm::dvec2(offset)), 4, 1e-12);
  EXPECT_NEAR(std::atan2(offset.z, glm::length(glm::dvec2(offset))), c.elevationAt(y), 1e-12);
  EXPECT_NEAR(std::remainder(std::atan2(offset.y, offset.x) - c.azimuthAt(x), kTwoPi), 0, 1e-12);
}

TEST(ColumnCamera, RefusesHostileNumbers) {
  EXPECT_TRUE(camera().check());
  const auto refuses = [](auto change) {
    ColumnCamera c = camera();
    change(c);
    return !c.check();
  };
  EXPECT_TRUE(refuses([](auto& c) { c.centreOfProjection.z = NAN; }));
  EXPECT_TRUE(refuses([](auto& c) { c.lowAzimuth = INFINITY; }));
  EXPECT_TRUE(refuses([](auto& c) { c.fovRadians = 0; }));
  EXPECT_TRUE(refuses([](auto& c) { c.fovRadians = 4; }));
  EXPECT_TRUE(refuses([](auto& c) { c.columns = 0; }));
  EXPECT_TRUE(refuses([](auto& c) { c.rows = 70000; }));
  EXPECT_TRUE(refuses([](auto& c) { c.topElevation = radians(90); }));
  EXPECT_TRUE(refuses([](auto& c) { c.bottomElevation = c.topElevation; }));
}

TEST(ColumnCamera, EveryFieldChangesItsKey) {
  const auto keyOf = [](const ColumnCamera& c) {
    Hasher hasher;
    c.addTo(hasher);
    return hasher.finish();
  };
  const ContentKey key = keyOf(camera());
  EXPECT_EQ(key, keyOf(camera()));
  for (int field = 0; field < 9; ++field) {
    ColumnCamera c = camera();
    double* reals[] = {&c.centreOfProjection.x, &c.centreOfProjection.y, &c.centreOfProjection.z,
                       &c.lowAzimuth,           &c.fovRadians,           &c.topElevation,
                       &c.bottomElevation};
    if (field < 7) *reals[field] += 1e-9;
    if (field == 7) ++c.columns;
    if (field == 8) ++c.rows;
    EXPECT_NE(keyOf(c), key) << field;
  }
}

}  // namespace
}  // namespace acentric
