#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "editor/actions/action_table.h"
#include "editor/commands/layout_edits.h"
#include "editor/commands/setting_edits.h"

#include "tests/editor/session_fixture.h"

namespace acentric::editor {
namespace {

/// The room, driven by actions, without a window.
class PlanSessionTest : public OpenSessionTest {
 protected:
  void settle() {
    waitFor([&] { return !session_->working() && session_->built()->project == session_->project(); });
  }
  void run(const std::string& id) {
    const Action* action = findAction(table_, id);
    ASSERT_NE(action, nullptr) << id;
    ActionContext context{*session_, state_};
    ASSERT_TRUE(action->enabled(context)) << id;
    action->run(context);
  }
  bool enabled(const std::string& id) {
    return findAction(table_, id)->enabled(ActionContext{*session_, state_});
  }

  EditorState state_;
  const std::vector<Action> table_ = makeActionTable();
};

TEST_F(PlanSessionTest, WhatCannotBeDoneNamesWhatItNeeds) {
  for (const Action& action : table_) EXPECT_TRUE(enabled(action.id) || !action.needs.empty()) << action.id;
}

TEST_F(PlanSessionTest, TheOutlineFromTheSceneIsWhatANewProjectHas) {
  const Project fresh = session_->project();
  session_->apply(setOutline(session_->project(), {{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}}}));
  settle();
  run("outline.fromScene");
  waitFor([&] { return !session_->searching().running(); });
  EXPECT_NEAR(session_->project().layout().outline.area(), fresh.layout().outline.area(), 1e-6);
  EXPECT_EQ(session_->history().cursor(), 2U);
  session_->undo();
  EXPECT_NEAR(session_->project().layout().outline.area(), 4, 1e-9);
}

TEST_F(PlanSessionTest, FittingToTheFloorLaysCellsAsANewProjectDoes) {
  const LayoutSpec fresh = session_->project().layout();
  run("layout.fit");
  waitFor([&] { return !session_->searching().running(); });
  EXPECT_EQ(session_->project().layout(), fresh);
  EXPECT_EQ(session_->messages().all().back().text,
            "The cells fit the floor already; smaller ones may fit it better");
  session_->apply(setLattice(session_->project(), {{0.7, 0.3}, radians(17.0), fresh.cellSize}, "turn"));
  settle();
  const std::size_t cameras = session_->built()->layout->cameras.size();
  run("layout.fit");
  waitFor([&] { return !session_->searching().running(); });
  EXPECT_EQ(session_->history().cursor(), 2U);
  EXPECT_LT(buildLayout(session_->project().layout())->cameras.size(), cameras);
  session_->undo();
  EXPECT_NEAR(degrees(session_->project().layout().rotationRadians), 17, 1e-9);
}

TEST_F(PlanSessionTest, SelectingCopyingAndNudgingAreOneStepEach) {
  EXPECT_FALSE(enabled("edit.duplicate")) << "nothing is selected";
  run("edit.selectRings");
  const std::size_t rings = state_.selection.size();
  run("edit.invertSelection");
  const std::size_t gaps = state_.selection.size();
  EXPECT_EQ(rings + gaps, session_->built()->layout->regions.size());
  const std::set<CellId> inverse = state_.selection;
  run("edit.selectGaps");
  EXPECT_EQ(state_.selection, inverse);
  run("edit.selectNotBaked");
  EXPECT_EQ(state_.selection.size(), rings + gaps);
  const std::set<CellId> before = state_.selection;
  run("edit.duplicate");
  EXPECT_EQ(session_->history().cursor(), 1U);
  EXPECT_EQ(state_.selection.size(), before.size());
  EXPECT_FALSE(state_.selection.contains(*before.begin()));
  settle();
  EXPECT_EQ(session_->built()->layout->regions.size(), 2 * (rings + gaps));
  state_.selection = before;
  run("edit.nudgeRight");
  run("edit.nudgeLeft");
  EXPECT_LE(session_->history().cursor(), 3U);
}

TEST_F(PlanSessionTest, AnArrayIsLaidFromWhatIsShown) {
  state_.selection = {session_->built()->layout->regions.front().id};
  EXPECT_FALSE(enabled("edit.placeArray"));
  run("edit.array");
  ASSERT_TRUE(state_.array);
  state_.array->countI = 40;
  run("edit.placeArray");
  EXPECT_FALSE(state_.array);
  EXPECT_EQ(session_->history().cursor(), 1U);
  EXPECT_GT(state_.selection.size(), 10U);
}

TEST_F(PlanSessionTest, OneOverlayAtATimeAndAgainIsTheBakeState) {
  run("view.triangles");
  EXPECT_EQ(state_.overlay, PlanOverlay::triangles);
  run("view.checks");
  EXPECT_EQ(state_.overlay, PlanOverlay::checks);
  run("view.checks");
  EXPECT_EQ(state_.overlay, PlanOverlay::bake);
}

TEST_F(PlanSessionTest, WallsAreFoundWhenAToolAsksForThem) {
  EXPECT_EQ(session_->walls(), nullptr);
  session_->askForWalls(true);
  waitFor([&] { return session_->walls() != nullptr; });
  EXPECT_EQ(session_->walls()->corners.size(), 4U);
  EXPECT_NEAR(*session_->walls()->directionRadians, 0, 1e-6);
}

}  // namespace
}  // namespace acentric::editor
