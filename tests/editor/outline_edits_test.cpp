#include "editor/commands/outline_edits.h"

#include <gtest/gtest.h>

namespace acentric::editor {
namespace {

TEST(OutlineFaults, ASoundOutlineWithAHoleHasNone) {
  const Outline sound{{{{0, 0}, {4, 0}, {4, 3}, {0, 3}}, {{1, 1}, {2, 1}, {2, 2}}}};
  EXPECT_TRUE(outlineFaults(sound).empty());
}

TEST(OutlineFaults, CrossingSidesAreNamedWhereTheyCross) {
  const auto faults = outlineFaults({{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].place, glm::dvec2(1, 1));
  EXPECT_NE(faults[0].text.find("crosses"), std::string::npos);
}

TEST(OutlineFaults, LoopsThatCrossOrTouchAndLoopsWithoutAreaAreFound) {
  const std::vector<glm::dvec2> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_EQ(outlineFaults({{square, {{1, 1}, {3, 1}, {3, 3}, {1, 3}}}}).size(), 2U);
  const auto touching = outlineFaults({{square, {{2, 1}, {3, 0}, {3, 2}}}});
  ASSERT_FALSE(touching.empty());
  EXPECT_EQ(touching[0].place, glm::dvec2(2, 1));
  const auto flat = outlineFaults({{{{0, 0}, {1, 0}, {2, 0}}}});
  ASSERT_FALSE(flat.empty());
  EXPECT_EQ(flat[0].text, "loop 1 has no area");
}

TEST(OutlineFaults, NoMoreThanAskedFor) {
  Outline tangled;
  for (int k = 0; k < 20; ++k)
    tangled.loops.push_back({{k * 1.0, 0}, {k + 1.5, 0}, {k + 1.5, 5}, {k * 1.0, 5}});
  EXPECT_EQ(outlineFaults(tangled, 7).size(), 7U);
}

TEST(LoopAreas, HolesAreTakenOff) {
  const auto areas = loopAreas({{{{0, 0}, {4, 0}, {4, 3}, {0, 3}}, {{1, 1}, {1, 2}, {2, 2}, {2, 1}}}});
  ASSERT_EQ(areas.size(), 2U);
  EXPECT_NEAR(areas[0].squareMetres, 12, 1e-12);
  EXPECT_FALSE(areas[0].hole);
  EXPECT_NEAR(areas[1].squareMetres, 1, 1e-12);
  EXPECT_TRUE(areas[1].hole);
}

TEST(SimplifyOutline, DropsCornersWithinTheDistanceAsOneStep) {
  Project project;
  project.layout().outline.loops = {{{0, 0}, {2, 0.01}, {4, 0}, {4, 3}, {0, 3}}};
  const Edit edit = simplifyOutline(project, 0.05);
  EXPECT_EQ(cornersOf(edit.project.layout().outline), 4U);
  EXPECT_EQ(edit.label, "Simplify outline");
  EXPECT_EQ(simplifyOutline(project, 0.001).project, project);
}

}  // namespace
}  // namespace acentric::editor
