#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "editor/actions/action_table.h"
#include "editor/commands/layout_edits.h"
#include "editor/commands/setting_edits.h"

namespace acentric::editor {
namespace {

namespace fs = std::filesystem;

/// A room of 6 x 5 x 3 m, opened and driven by actions, without a window.
class PlanSessionTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("acentric_plan_session_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "room.obj")
        << "v -3 0 -2.5\nv 3 0 -2.5\nv 3 0 2.5\nv -3 0 2.5\nv -3 3 -2.5\nv 3 3 -2.5\nv 3 3 2.5\nv -3 3 2.5\n"
           "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    SessionOptions options;
    options.importHost.importer = ACENTRIC_IMPORTER;
    options.importHost.cacheFolder = folder_ / "cache";
    options.processors = 2;
    options.autosaveSeconds = 0;
    session_ = std::make_unique<Session>(options);
    session_->open(folder_ / "room.obj");
    waitFor([&] { return session_->walk() && !session_->working(); });
  }
  void TearDown() override {
    session_.reset();
    fs::remove_all(folder_);
  }
  void waitFor(const std::function<bool()>& done) {
    for (int i = 0; i < 12000 && !done(); ++i) {
      session_->poll(now_);
      now_ += 0.05;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_TRUE(done());
  }
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

  fs::path folder_;
  double now_ = 0;
  std::unique_ptr<Session> session_;
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
