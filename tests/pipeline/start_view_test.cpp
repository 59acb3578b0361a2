#include "engine/pipeline/start_view.h"

#include <gtest/gtest.h>

#include "engine/base/file.h"
#include "engine/geometry/conventions.h"
#include "tests/pipeline/small_project.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

Layout layoutOver(const std::string& outline, double cell) {
  LayoutSpec spec;
  spec.configuration = Configuration::e;
  spec.cellSize = cell;
  spec.outline = parseOutline(outline).value();
  return buildLayout(spec).value();
}

TEST(StartView, LooksDownTheLongRoomAndNotAtAWallAStepAway) {
  // A garage: a long room, and a partition close to its middle.
  test::SceneBuilder builder;
  const int white = builder.material(test::matte());
  builder.box(white, {-12, -3, 0}, {12, 3, 3}, true);
  builder.box(white, {0.2f, -3, 0}, {0.4f, 2, 3});
  const RayScenePtr rays = builder.rays();
  const Layout layout = layoutOver("-11.5,-2.5;11.5,-2.5;11.5,2.5;-11.5,2.5", 1.5);
  const Spawn start = chooseStart(layout, *rays);
  const ViewWorth worth = worthOf(*rays, {start.position, layout.eyeZ()}, start.yawRadians);
  EXPECT_EQ(worth.near, 0);
  EXPECT_GT(worth.depth, 5);
  EXPECT_TRUE(layout.regionAt(start.position).has_value());
  EXPECT_GT(std::abs(std::cos(start.yawRadians)), 0.9) << "along the room";
  // The middle of the outline, looking at the partition, is worth less.
  EXPECT_LT(worthOf(*rays, {-0.5, 0, layout.eyeZ()}, 0).score(), worth.score() - 1);
}

TEST(StartView, PrefersWhatIsThereToAnEmptySky) {
  // A courtyard open to one side, with things on the other.
  test::SceneBuilder builder;
  const int white = builder.material(test::matte()), red = builder.material(test::matte({0.6f, 0.1f, 0.1f}));
  builder.quad(white, {-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0});
  for (int i = 0; i < 6; ++i)
    builder.box(i % 2 == 0 ? white : red, {float(8 + i), float(-6 + 2 * i), 0},
                {float(9 + i), float(-5 + 2 * i), float(4 + i)});
  const RayScenePtr rays = builder.rays();
  const Layout layout = layoutOver("-4,-4;4,-4;4,4;-4,4", 2);
  const Spawn start = chooseStart(layout, *rays);
  EXPECT_GT(std::cos(start.yawRadians), 0.5) << "towards the things";
  const auto towards = [&](double yaw) { return worthOf(*rays, {start.position, layout.eyeZ()}, yaw); };
  EXPECT_LT(towards(start.yawRadians).sky, towards(kPi).sky);
  EXPECT_GT(towards(start.yawRadians).variety, towards(kPi).variety);
}

TEST(StartView, IsAmongTheRoomiestPlacesWhereNoneHasRoom) {
  // A corridor 0.7 m wide that widens to 1.3 m for its last fifth: nowhere are 0.8 m free around a person.
  // The narrow part has the longer view.
  test::SceneBuilder builder;
  const int white = builder.material(test::matte());
  builder.box(white, {-10, -0.65f, 0}, {10, 0.65f, 3}, true);
  builder.box(white, {-10, -0.65f, 0}, {6, -0.35f, 3});
  builder.box(white, {-10, 0.35f, 0}, {6, 0.65f, 3});
  const RayScenePtr rays = builder.rays();
  const Layout layout = layoutOver("-9.5,-0.3;9.4,-0.3;9.4,0.3;-9.5,0.3", 0.5);
  const Spawn start = chooseStart(layout, *rays);
  EXPECT_GT(start.position.x, 6);
  const double room = 0.35;  // half the narrow part's width
  for (const glm::dvec2 way : {glm::dvec2(0, 1), glm::dvec2(0, -1)})
    EXPECT_GT(rays->trace({glm::vec3(start.position, layout.eyeZ()), glm::vec3(way, 0)}).distance, room);
}

using StartViewOfAFile = FolderTest;

TEST_F(StartViewOfAFile, ThatKeepsNoneIsWhereANewProjectWouldBegin) {
  const std::filesystem::path file = folder_ / "garage.acentric.json";
  ASSERT_TRUE(writeTextAtomically(folder_ / "garage.obj",
                                  "# File units = meters\nv -12 0 3\nv 12 0 3\nv 12 0 -3\nv -12 0 -3\n"
                                  "v -12 3 3\nv 12 3 3\nv 12 3 -3\nv -12 3 -3\nf 1 2 3 4\nf 8 7 6 5\n"
                                  "f 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n"));
  ASSERT_TRUE(writeTextAtomically(file, R"({"format": "acentric-project", "version": 1, "scene": "garage.obj",
    "import": {"up": "y"},
    "layout": {"configuration": "e", "cellSize": 1.5, "outline":
               [[[-11.5, -2.5], [11.5, -2.5], [11.5, 2.5], [-11.5, 2.5]]]}})"));
  const auto kept = loadProject(file);
  ASSERT_TRUE(kept) << kept.error().describe();
  EXPECT_FALSE(kept->spawn().stored);
  const auto open = openProject(file, {});
  ASSERT_TRUE(open) << open.error().describe();
  const Spawn found = chooseStart(*open->layout, *open->rays);
  EXPECT_NE(found.position, glm::dvec2(0));
  EXPECT_EQ(open->project.spawn().position, found.position);
  EXPECT_EQ(open->project.spawn().yawRadians, found.yawRadians);
  EXPECT_EQ(formatProject(open->project), formatProject(*kept)) << "it is not kept until it is chosen";
}

TEST(StartView, IsTheSameEachTime) {
  const RayScenePtr rays = [] {
    test::SceneBuilder builder;
    builder.box(builder.material(test::matte()), {-5, -4, 0}, {5, 4, 3}, true);
    return builder.rays();
  }();
  const Layout layout = layoutOver("-4,-3;4,-3;4,3;-4,3", 1);
  EXPECT_EQ(chooseStart(layout, *rays), chooseStart(layout, *rays));
}

}  // namespace
}  // namespace acentric
