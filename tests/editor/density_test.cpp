/// How densely cells are sampled: the edits, and the tool that paints it.

#include <gtest/gtest.h>

#include "editor/commands/density_edits.h"
#include "editor/commands/group_edits.h"
#include "editor/commands/layout_edits.h"
#include "editor/tools/plan_tool.h"
#include "ui/keys.h"

namespace acentric::editor {
namespace {

Project roomOf(Configuration configuration) {
  Project project;
  project.scene = "room.obj";
  project.layout().configuration = configuration;
  project.layout().cellSize = 1;
  project.layout().outline.loops = {{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}};
  return project;
}

TEST(DensityEdits, EachStepDoublesTheSamplesWithinLimits) {
  EXPECT_NEAR(densityAfter(1, 1), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(densityAfter(std::sqrt(2.0), 1), 2, 1e-12);
  EXPECT_NEAR(densityAfter(2, -2), 1, 1e-12);
  EXPECT_EQ(densityAfter(4, 1), 4);
  EXPECT_EQ(densityAfter(0.25, -1), 0.25);
  EXPECT_NEAR(densityAfter(1.2, 1), std::sqrt(2.0), 1e-12) << "onto the next rung";
  EXPECT_NEAR(densityAfter(1.2, -1), 1, 1e-12);
  double up = kLeastRegionDensity;
  for (int n = 0; n < 8; ++n) up = densityAfter(up, 1);
  EXPECT_EQ(up, kMostRegionDensity) << "rounding does not pile up";
}

TEST(DensityEdits, UpAndDownAgainIsTheProjectAsItWas) {
  const Project project = roomOf(Configuration::b);
  const std::set<CellId> cells{cellAt(project.layout(), {0, 0}).id, cellAt(project.layout(), {2, 0}).id};
  const Edit more = stepDensity(project, cells, 1);
  EXPECT_EQ(more.project.layout().density.size(), cells.size());
  EXPECT_EQ(stepDensity(more.project, cells, -1).project, project);
  EXPECT_EQ(setDensity(more.project, cells, 1).project, project);
}

TEST(DensityEdits, APartMayHaveTheProjectsWithinAWholeOfAnother) {
  Project project = roomOf(Configuration::e);
  LayoutSpec& spec = project.layout();
  const CellId whole = cellAt(spec, {0.3, 0.2}).id, part = partsOf(spec, whole)[2];
  spec.split = {whole};
  project = setDensity(project, {whole}, 2).project;
  const Project usual = setDensity(project, {part}, 1).project;
  EXPECT_EQ(densityOf(usual.layout(), part), 1);
  EXPECT_EQ(densityOf(usual.layout(), partsOf(usual.layout(), whole)[1]), 2);
  EXPECT_EQ(joinCells(usual, {part}).project.layout().density, (std::map<CellId, double>{{whole, 2}}));
}

TEST(DensityEdits, GoWithAFreeApvThatIsTakenAway) {
  Project project =
      addFreeApv(roomOf(Configuration::b), {{0, 0}, {0.4, 0}, 60, Hand::counterClockwise}).project;
  const CellId apv{project.layout().freeApvs.begin()->first, 0, kFreeSlot};
  project = setDensity(project, {apv}, 2).project;
  EXPECT_TRUE(project.layout().check());
  EXPECT_TRUE(removeCells(project, {apv}).project.layout().density.empty());
}

TEST(DensityEdits, GoWithCellsThatAreMovedAndCopied) {
  Project project = roomOf(Configuration::e);
  project.layout().outline = {};
  project.layout().added = {{0, 0, 0}, {1, 0, 0}};
  project = setDensity(project, {{0, 0, 0}}, 2).project;
  const LatticeStep step{3, 0};
  const Project moved = moveCells(project, {{0, 0, 0}, {1, 0, 0}}, step).edit.project;
  EXPECT_EQ(moved.layout().density, (std::map<CellId, double>{{{3, 0, 0}, 2}}));
  const Project copied = copyCells(project, {{0, 0, 0}, {1, 0, 0}}, {step}).edit.project;
  EXPECT_EQ(copied.layout().density, (std::map<CellId, double>{{{0, 0, 0}, 2}, {{3, 0, 0}, 2}}));
}

class DensityToolTest : public testing::Test {
 protected:
  DensityToolTest() {
    spec_ = roomOf(Configuration::e).layout();
    tool_.setMode(PlanMode::density);
  }
  PlanIntent send(PointerEvent::Kind kind, const glm::dvec2& world, int modifiers = 0) {
    constexpr double kScale = 50;
    const PlanSituation situation{&spec_, &selection_, {100, 100}, kScale};
    return tool_.handle({kind, ui::mouse::left, modifiers, {world.x * kScale, -world.y * kScale}, world},
                        situation);
  }

  LayoutSpec spec_;
  std::set<CellId> selection_;
  PlanTool tool_;
};

TEST_F(DensityToolTest, AFastDragPaintsEveryCellOnItsWay) {
  std::set<CellId> expected;
  for (double x = -2.4; x <= 2.4; x += 0.01) expected.insert(cellAt(spec_, {x, 0.2}).id);
  ASSERT_GE(expected.size(), 5u);
  send(PointerEvent::Kind::press, {-2.4, 0.2});
  send(PointerEvent::Kind::move, {2.4, 0.2});
  EXPECT_EQ(tool_.densityTool().painted(), expected);
  const auto intent = send(PointerEvent::Kind::release, {2.4, 0.2});
  const auto* paint = std::get_if<PaintDensityIntent>(&intent);
  ASSERT_NE(paint, nullptr);
  EXPECT_EQ(paint->cells, expected);
  EXPECT_FALSE(paint->erase);
  EXPECT_TRUE(tool_.densityTool().painted().empty());
}

TEST_F(DensityToolTest, ControlErasesFreeGroundIsLeftAndEscapeDropsAll) {
  send(PointerEvent::Kind::press, {9, 9}, ui::modifier::control);
  const auto nothing = send(PointerEvent::Kind::release, {9, 9}, ui::modifier::control);
  EXPECT_TRUE(std::get<PaintDensityIntent>(nothing).cells.empty());
  send(PointerEvent::Kind::press, {0.2, 0.2}, ui::modifier::control);
  const auto erased = send(PointerEvent::Kind::release, {0.2, 0.2}, ui::modifier::control);
  EXPECT_TRUE(std::get<PaintDensityIntent>(erased).erase);
  EXPECT_EQ(std::get<PaintDensityIntent>(erased).cells.size(), 1u);
  send(PointerEvent::Kind::press, {0.2, 0.2});
  EXPECT_TRUE(tool_.cancel());
  EXPECT_TRUE(tool_.densityTool().painted().empty());
  EXPECT_TRUE(std::holds_alternative<std::monostate>(send(PointerEvent::Kind::release, {0.2, 0.2})));
}

TEST_F(DensityToolTest, AFreeApvLiesOverTheCells) {
  spec_.freeApvs = {{3, {{0, 0}, {0.5, 0}, 60, Hand::counterClockwise}}};
  send(PointerEvent::Kind::press, {0.05, 0.05});
  EXPECT_EQ(tool_.densityTool().painted(), (std::set<CellId>{{3, 0, kFreeSlot}}));
}

}  // namespace
}  // namespace acentric::editor
