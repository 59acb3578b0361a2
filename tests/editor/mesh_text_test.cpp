#include "editor/session/mesh_text.h"

#include <gtest/gtest.h>

namespace acentric::editor {
namespace {

TEST(MeshText, SumsWhatTheMeshesOfAFrameTake) {
  FrameStats stats;
  EXPECT_EQ(meshSumText(stats), "");
  stats.meshes = {{3, 1000, 1200, 2'000'000, 0.25, 0.1}, {8, 5000, 30'000, 500'000, 1.5, 0.2}};
  stats.meshTriangles = 7050;
  EXPECT_EQ(meshSumText(stats), "2 meshes: 7,050 of 31,200 triangles drawn, within 1.5 samples, 2.5 MB");
  EXPECT_EQ(meshText(stats.meshes[0]), "mesh: 1,200 triangles within 0.25 samples, 2.0 MB");
}

TEST(MeshText, TellsPointsFromMeshesOfOtherSettings) {
  FrameStats stats;
  EXPECT_EQ(meshesAwaitedText(stats), "");
  EXPECT_EQ(capturesAwaitedText(stats), "");
  stats.capturesAwaited = stats.standIns = 3;
  EXPECT_EQ(capturesAwaitedText(stats), "3 captures on their way to the graphics card");
  stats.standIns = 1;
  EXPECT_EQ(capturesAwaitedText(stats),
            "3 captures on their way to the graphics card, 2 with nothing in their place");
  stats.meshesAwaited = stats.pointsForMeshes = 4;
  EXPECT_EQ(meshesAwaitedText(stats), "4 captures as points until their meshes are built");
  stats.pointsForMeshes = 0;
  EXPECT_EQ(meshesAwaitedText(stats), "4 meshes are being built anew");
  stats.pointsForMeshes = 1;
  EXPECT_EQ(meshesAwaitedText(stats),
            "1 captures as points until their meshes are built, 3 meshes are being built anew");
}

}  // namespace
}  // namespace acentric::editor
