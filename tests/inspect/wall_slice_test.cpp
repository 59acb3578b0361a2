#include "engine/inspect/wall_slice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

/// A room's walls, from z = 0 to 3, each of `parts` pieces, turned about the origin.
Scene roomTurnedBy(double angle, int parts) {
  Scene scene;
  Mesh mesh;
  const std::vector<glm::dvec2> room{{0, 0}, {6, 0}, {6, 4}, {0, 4}};
  const auto add = [&](const glm::dvec2& p, float z) {
    const glm::dvec2 c = directionOf(angle);
    mesh.positions.emplace_back(float(c.x * p.x - c.y * p.y), float(c.y * p.x + c.x * p.y), z);
    return std::uint32_t(mesh.positions.size() - 1);
  };
  for (std::size_t k = 0; k < room.size(); ++k)
    for (int part = 0; part < parts; ++part) {
      const glm::dvec2 way = (room[(k + 1) % room.size()] - room[k]) / double(parts);
      const glm::dvec2 from = room[k] + double(part) * way;
      const std::uint32_t a = add(from, 0), b = add(from + way, 0), c = add(from + way, 3), d = add(from, 3);
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  const std::uint32_t a = add({0, 0}, 1.5F), b = add({6, 0}, 1.52F), c = add({6, 4}, 1.55F);
  mesh.triangles.push_back({a, b, c});  // a table top that leans: no wall
  scene.meshes.push_back(mesh);
  scene.bounds = boundsOf(scene);
  return scene;
}

TEST(WallSlice, FindsTheDirectionOfMostWallsAndTheCorners) {
  for (const double turn : {0.0, 7.0, 44.0, 63.5, 89.9}) {
    const WallSlice slice = sliceWalls(roomTurnedBy(radians(turn), 5), 1.6);
    ASSERT_TRUE(slice.directionRadians) << turn;
    double away = *slice.directionRadians - radians(turn);
    away -= std::round(away / (kPi / 2)) * kPi / 2;
    EXPECT_NEAR(degrees(away), 0, 0.05) << turn;
    EXPECT_EQ(slice.corners.size(), 4U) << "joints within a wall are none";
    double nearest = 1e9;
    for (const glm::dvec2& corner : slice.corners)
      nearest = std::min(nearest, glm::distance(corner, 6.0 * directionOf(radians(turn))));
    EXPECT_LT(nearest, 0.01);
  }
}

TEST(WallSlice, HasNothingAboveTheWallsOrOnceStopped) {
  const Scene room = roomTurnedBy(0.2, 2);
  EXPECT_FALSE(sliceWalls(room, 5).directionRadians);
  EXPECT_TRUE(sliceWalls(room, 5).corners.empty());
  std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(sliceWalls(room, 1.6, stop.get_token()).corners.empty());
}

}  // namespace
}  // namespace acentric
