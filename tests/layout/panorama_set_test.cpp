#include "engine/layout/panorama_set.h"

#include <gtest/gtest.h>

namespace acentric {
namespace {

TEST(PanoramaSet, LooksAllRoundFromEachPlaceAndDrawsTheNearestGroups) {
  LayoutSpec like;
  like.floorHeight = 3, like.eyeHeight = 1.5;
  const std::vector<std::vector<glm::dvec2>> groups = {{{0, 0}}, {{4, 0}, {6, 0}}, {{0, 9}}};
  const PanoramaSet set = panoramaSet(like, groups, 2, 5);
  ASSERT_EQ(set.groups.size(), 3u);
  ASSERT_EQ(set.layout.cameras.size(), 24u);
  EXPECT_EQ(set.layout.eyeZ(), 4.5);
  EXPECT_FALSE(set.layout.regionAt({0, 0}));
  EXPECT_EQ(set.groups[1].centre, glm::dvec2(5, 0));
  for (const PanoramaGroup& group : set.groups)
    for (int k = 0; k < group.cameras; ++k) {
      const LayoutCamera& camera = set.layout.cameras[std::size_t(group.firstCamera + k)];
      EXPECT_EQ(camera.position, group.places[std::size_t(k / kPanoramaCameras)]);
      EXPECT_NEAR(camera.lowAzimuth, k % kPanoramaCameras * camera.fovRadians, 1e-12);
      // Everything but the nearest is captured.
      EXPECT_NEAR(exitDistance(camera, camera.roles.front(), {1, 0}), 0.015, 1e-9);
    }
  const std::vector<int> cameras = set.camerasFor({5, 1});  // the pair first, then the origin
  ASSERT_EQ(cameras.size(), 18u);
  EXPECT_EQ(cameras.front(), 6);
  EXPECT_EQ(cameras[12], 0);
}

}  // namespace
}  // namespace acentric
