#include "ui/space_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/ui/offscreen.h"

namespace acentric::ui {
namespace {

using test::kBlack, test::kGreen, test::kPureGreen, test::kPureRed, test::kRed, test::kSize;
constexpr float kFar = std::numeric_limits<float>::infinity();

/// From the origin of `at` along y, 45 degrees to each side; a metre at distance d is 64 / d pixels.
SpaceView viewFrom(const glm::dvec3& at) {
  SpaceView view;
  view.eye = at;
  view.viewFromWorld = glm::transpose(glm::dmat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0}));
  view.areaSize = {kSize, kSize};
  return view;
}

class SpaceMeshTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!screen_.works()) GTEST_SKIP() << "no OpenGL here";
  }
  void show(SpaceMesh& mesh, const SpaceView& view, float hidden = 0.25F) {
    screen_.clear();
    mesh.render(view, screen_.target(), hidden);
    ASSERT_TRUE(mesh.problem().empty()) << mesh.problem();
    screen_.read();
  }
  test::Offscreen screen_{kSize, kSize};
};

TEST_F(SpaceMeshTest, DrawsLinesDotsAndFacesWhereTheyAreAlsoFarFromTheOrigin) {
  for (const glm::dvec3& at : {glm::dvec3(0), glm::dvec3(5e6, -3e6, 20)}) {
    SpaceMesh mesh;
    SpaceShapes shapes;
    shapes.lines.push_back({at + glm::dvec3(-1, 4, 1), at + glm::dvec3(1, 4, 1), kRed, 4});  // 16 px up
    shapes.lines.push_back({at + glm::dvec3(2, 4, 2), at + glm::dvec3(2, 4, 2), kGreen, 10});
    shapes.faces.push_back(
        {{at + glm::dvec3(-3, 4, -1), at + glm::dvec3(3, 4, -1), at + glm::dvec3(0, 4, -3)}, kGreen});
    mesh.setLasting(shapes, at);
    show(mesh, viewFrom(at));
    EXPECT_EQ(screen_.at(64, 48), kPureRed);
    EXPECT_EQ(screen_.at(52, 48), kPureRed);
    EXPECT_EQ(screen_.at(64, 43), kBlack);
    EXPECT_EQ(screen_.at(44, 48), kBlack);
    EXPECT_EQ(screen_.at(96, 32), kPureGreen);
    EXPECT_EQ(screen_.at(96 + 3, 32), kPureGreen);
    EXPECT_EQ(screen_.at(96 + 7, 32), kBlack);
    EXPECT_EQ(screen_.at(64, 90), kPureGreen);
    EXPECT_EQ(screen_.at(64, 76), kBlack);
  }
}

TEST_F(SpaceMeshTest, FadesWhatLiesBehindTheSurfacesOfThePicture) {
  SpaceMesh mesh;
  SpaceShapes shapes;
  shapes.lines.push_back({{-3, 4, 1}, {3, 4, 1}, kRed, 4});
  shapes.faces.push_back({{{{-4, 4, -1}, {4, 4, -1}, {0, 4, -3}}}, kGreen});
  mesh.setLasting(shapes, {});
  // A wall 2 m away at the left; 4.2 m and nothing at the right.
  const std::vector<float> metres{2, 2, 9, kFar};
  mesh.setDistances(4, 1, metres);
  show(mesh, viewFrom({}));
  EXPECT_NEAR(screen_.at(40, 48).r, 64, 2);
  EXPECT_EQ(screen_.at(90, 48), kPureRed);
  EXPECT_EQ(screen_.at(110, 48), kPureRed);
  EXPECT_NEAR(screen_.at(50, 88).g, 64, 2);
  EXPECT_EQ(screen_.at(75, 88), kPureGreen);
  mesh.clearDistances();
  show(mesh, viewFrom({}));
  EXPECT_EQ(screen_.at(40, 48), kPureRed);
}

TEST_F(SpaceMeshTest, DrawsThePartOfALineThatIsBeforeTheEye) {
  SpaceMesh mesh;
  SpaceShapes shapes;
  shapes.lines.push_back({{0.5, -50, -1}, {0.5, 50, -1}, kGreen, 4});  // passes below, to the horizon
  shapes.lines.push_back({{0, -5, 0}, {0, -5, 0}, kRed, 40});          // behind
  mesh.setLasting(shapes, {});
  show(mesh, viewFrom({}));
  EXPECT_EQ(screen_.at(64 + 16, 64 + 32), kPureGreen);  // 2 m away
  EXPECT_EQ(screen_.at(64 + 8, 64 + 16), kPureGreen);   // 4 m
  EXPECT_EQ(screen_.at(64, 60), kBlack);
}

TEST_F(SpaceMeshTest, PassingShapesGoOverLastingOnesAndAway) {
  SpaceMesh mesh;
  SpaceShapes lasting, passing;
  lasting.lines.push_back({{-2, 4, 0}, {2, 4, 0}, kRed, 6});
  passing.lines.push_back({{-2, 4, 0}, {2, 4, 0}, kGreen, 6});
  mesh.setLasting(lasting, {});
  mesh.setPassing(passing);
  EXPECT_EQ(mesh.lineCount(), 2U);
  show(mesh, viewFrom({}));
  EXPECT_EQ(screen_.at(64, 64), kPureGreen);
  mesh.setPassing({});
  show(mesh, viewFrom({}));
  EXPECT_EQ(screen_.at(64, 64), kPureRed);
}

TEST_F(SpaceMeshTest, KeepsToItsAreaOfTheWindow) {
  SpaceMesh mesh;
  SpaceShapes shapes;
  shapes.lines.push_back({{0, 4, 0}, {0, 4, 0}, kRed, 8});
  mesh.setLasting(shapes, {});
  SpaceView view = viewFrom({});
  view.areaMin = {64, 0}, view.areaSize = {64, 32};
  show(mesh, view);
  EXPECT_EQ(screen_.at(96, 16), kPureRed);
  EXPECT_EQ(screen_.at(64, 64), kBlack);
}

}  // namespace
}  // namespace acentric::ui
