/// Which views the window shows, and which alone.

#include "editor/actions/action_table.h"
#include "editor/actions/menu_actions.h"
#include "tests/editor/session_fixture.h"

namespace acentric::editor {
namespace {

class ArrangementTest : public OpenSessionTest {
 protected:
  ActionContext here() { return {*session_, state_}; }
  void run(const char* id) {
    const Action& action = *findAction(table_, std::string(id));
    ActionContext context = here();
    ASSERT_TRUE(action.enabled(context)) << id;
    action.run(context);
  }
  bool checked(const char* id) { return findAction(table_, std::string(id))->checked(here()); }

  EditorState state_;
  const std::vector<Action> table_ = makeActionTable();
};

TEST_F(ArrangementTest, AViewIsShownThenFillsTheWindowThenGoesBack) {
  EXPECT_EQ(arrangementOf(here()), Arrangement::panels);
  EXPECT_TRUE(checked("view.plan"));
  EXPECT_TRUE(checked("view.walk"));
  EXPECT_FALSE(checked("view.scene3d"));
  run("view.scene3d");
  EXPECT_EQ(arrangementOf(here()), Arrangement::panels);
  EXPECT_TRUE(checked("view.scene3d"));
  run("view.scene3d");
  EXPECT_EQ(arrangementOf(here()), Arrangement::centre);
  EXPECT_FALSE(checked("view.walk"));
  run("view.walk");
  EXPECT_EQ(arrangementOf(here()), Arrangement::walk) << "from one whole view to another";
  EXPECT_FALSE(checked("view.scene3d"));
  run("view.walk");
  EXPECT_EQ(arrangementOf(here()), Arrangement::panels);
  EXPECT_EQ(state_.centreView, View::scene3d) << "as it was before";
}

TEST_F(ArrangementTest, FourViewsAreKeptBehindOneThatFillsTheWindow) {
  run("view.four");
  EXPECT_EQ(arrangementOf(here()), Arrangement::four);
  for (const char* id : {"view.plan", "view.walk", "view.scene3d", "view.accuracy"})
    EXPECT_TRUE(checked(id)) << id;
  run("view.accuracy");
  EXPECT_EQ(arrangementOf(here()), Arrangement::centre);
  EXPECT_EQ(state_.centreView, View::accuracy);
  run("view.four");
  EXPECT_EQ(arrangementOf(here()), Arrangement::four) << "back, not off";
  run("view.four");
  EXPECT_EQ(arrangementOf(here()), Arrangement::panels);
}

TEST_F(ArrangementTest, AFullScreenComesOverAllAndLeavesItAsItWas) {
  run("view.four");
  run("window.fullScreen");
  EXPECT_EQ(arrangementOf(here()), Arrangement::walk);
  run("window.fullScreen");
  EXPECT_EQ(arrangementOf(here()), Arrangement::four);
  run("window.fullScreen");
  ActionContext context = here();
  beginAfresh(context);
  EXPECT_FALSE(state_.fullScreen) << "another project begins in a window";
}

}  // namespace
}  // namespace acentric::editor
