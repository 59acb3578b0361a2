/// What the window does without a window: who gets the keys, how panes share the room, preferences.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "editor/actions/action_table.h"
#include "editor/session/pane_sizes.h"
#include "editor/tools/key_focus.h"
#include "engine/base/file.h"
#include "ui/keys.h"

namespace acentric::editor {
namespace {

namespace fs = std::filesystem;
using Kind = ui::InputEvent::Kind;

ui::InputEvent event(Kind kind, int code, int modifiers = 0) { return {kind, code, modifiers, {}, {}, 0}; }

TEST(KeyFocus, ArrowsBelongToTheWalkUntilTabAndAgainAfterAClickOrEsc) {
  KeyFocus focus;
  focus.handle(event(Kind::keyPress, ui::key::w), false);
  focus.handle(event(Kind::keyPress, ui::key::up), false);
  EXPECT_FALSE(focus.onWidgets());
  focus.handle(event(Kind::keyPress, ui::key::tab), false);
  EXPECT_TRUE(focus.onWidgets());
  focus.handle(event(Kind::keyPress, ui::key::escape), true);
  EXPECT_TRUE(focus.onWidgets()) << "Esc was for the menu";
  focus.handle(event(Kind::keyPress, ui::key::escape), false);
  EXPECT_FALSE(focus.onWidgets());
  focus.handle(event(Kind::keyPress, ui::key::tab), false);
  focus.handle(event(Kind::buttonPress, ui::mouse::left), false);
  EXPECT_FALSE(focus.onWidgets());
  focus.handle(event(Kind::keyPress, ui::key::tab, ui::modifier::alt), false);
  EXPECT_FALSE(focus.onWidgets()) << "Alt+Tab is the window manager's";
}

TEST(KeyFocus, AltAloneAsksForTheMenusOnce) {
  KeyFocus focus;
  focus.handle(event(Kind::keyPress, ui::key::leftAlt), false);
  EXPECT_FALSE(focus.takeAltTap());
  focus.handle(event(Kind::keyRelease, ui::key::leftAlt), false);
  EXPECT_TRUE(focus.takeAltTap());
  EXPECT_FALSE(focus.takeAltTap());
  focus.handle(event(Kind::keyPress, ui::key::leftAlt), false);
  focus.handle(event(Kind::keyPress, ui::key::x, ui::modifier::alt), false);
  focus.handle(event(Kind::keyRelease, ui::key::x, ui::modifier::alt), false);
  focus.handle(event(Kind::keyRelease, ui::key::leftAlt), false);
  EXPECT_FALSE(focus.takeAltTap()) << "Alt was held for another key";
  focus.handle(event(Kind::keyPress, ui::key::leftAlt), false);
  focus.handle(event(Kind::buttonPress, ui::mouse::left, ui::modifier::alt), false);
  focus.handle(event(Kind::keyRelease, ui::key::leftAlt), false);
  EXPECT_FALSE(focus.takeAltTap()) << "Alt was held for a drag";
}

TEST(PaneSizes, FillTheWindowExactlyAndGoOneAfterTheOther) {
  Preferences wanted;
  const float bar = 5;
  int shownBefore = 100;
  for (float width = 1600; width >= 0; width -= 1) {
    const PaneSizes p = paneSizes(Arrangement::panels, width, 850, bar, wanted, 1);
    const float bars = bar * float(int(p.settings > 0) + int(p.walk > 0));
    EXPECT_NEAR(p.settings + p.plan + p.walk + bars, width, 1e-3) << width;
    for (const float size : {p.settings, p.plan, p.walk, p.bake, p.report, p.messages})
      EXPECT_TRUE(size == 0 || size >= 1 || width < 1) << width;
    EXPECT_TRUE(p.report == 0 || p.messages > 0) << width;
    EXPECT_TRUE(p.settings == 0 || p.walk > 0) << width;
    const int shown = int(p.settings > 0) + int(p.walk > 0);
    EXPECT_LE(shown, shownBefore) << width;
    shownBefore = shown;
  }
  EXPECT_EQ(shownBefore, 0) << "the plan is left alone in the end";
}

TEST(PaneSizes, TheBottomGoesWhenTheWindowIsLow) {
  const Preferences wanted;
  const PaneSizes high = paneSizes(Arrangement::panels, 1600, 850, 5, wanted, 1),
                  low = paneSizes(Arrangement::panels, 1600, 300, 5, wanted, 1);
  EXPECT_EQ(high.bottom, wanted.bottomHeight);
  EXPECT_NEAR(high.upper + high.bottom + 5, 850, 1e-3);
  EXPECT_EQ(low.bottom, 0);
  EXPECT_EQ(low.upper, 300);
  for (const float size : {0.0F, 1.0F, -3.0F}) {
    const PaneSizes none = paneSizes(Arrangement::panels, size, size, 5, wanted, 2);
    EXPECT_GE(none.plan, 0);
    EXPECT_GE(none.upper, 0);
  }
}

TEST(PaneSizes, ScaleTogether) {
  const Preferences wanted;
  const PaneSizes once = paneSizes(Arrangement::panels, 1600, 850, 5, wanted, 1),
                  twice = paneSizes(Arrangement::panels, 3200, 1700, 10, wanted, 2);
  EXPECT_NEAR(twice.settings, 2 * once.settings, 1);
  EXPECT_NEAR(twice.plan, 2 * once.plan, 1);
  EXPECT_NEAR(twice.bottom, 2 * once.bottom, 1);
}

TEST(PaneSizes, FourViewsShareTheWindowAndOneHasItAlone) {
  Preferences wanted;
  const float bar = 5;
  for (const float column : {Preferences::kLeastShare, 0.5F, 1 - Preferences::kLeastShare})
    for (float side = 1600; side >= 0; side -= 7) {
      wanted.fourColumn = wanted.fourRow = column;
      const PaneSizes p = paneSizes(Arrangement::four, side, side / 2, bar, wanted, 1);
      EXPECT_NEAR(p.plan + p.walk + (p.walk > 0 ? bar : 0), side, 1e-3) << side;
      EXPECT_NEAR(p.upper + p.lower + (p.lower > 0 ? bar : 0), side / 2, 1e-3) << side;
      EXPECT_EQ(p.walk > 0, side >= 405) << "two views beside each other are 200 wide at least; " << side;
      EXPECT_EQ(p.settings + p.bottom, 0);
    }
  const PaneSizes even = paneSizes(Arrangement::four, 1605, 805, bar, Preferences(), 1);
  EXPECT_EQ(even.plan, 800);
  EXPECT_EQ(even.lower, 400);
  const PaneSizes walk = paneSizes(Arrangement::walk, 1600, 850, bar, wanted, 1);
  EXPECT_EQ(walk.walk, 1600);
  EXPECT_EQ(walk.upper, 850);
  EXPECT_EQ(walk.plan + walk.settings + walk.bottom + walk.lower, 0);
  EXPECT_EQ(paneSizes(Arrangement::centre, 1600, 850, bar, wanted, 1).plan, 1600);
}

TEST(PaneSizes, PanesThatAreHiddenLeaveTheirRoom) {
  Preferences wanted;
  wanted.showSettings = wanted.showBottom = false;
  const PaneSizes p = paneSizes(Arrangement::panels, 1600, 850, 5, wanted, 1);
  EXPECT_EQ(p.settings, 0);
  EXPECT_EQ(p.bottom, 0);
  EXPECT_EQ(p.upper, 850);
  EXPECT_NEAR(p.plan + p.walk + 5, 1600, 1e-3);
}

class PreferencesTest : public testing::Test {
 protected:
  void SetUp() override {
    file_ = fs::path(testing::TempDir()) / ("acentric_preferences_" + std::to_string(::getpid()) + ".json");
  }
  void TearDown() override { fs::remove(file_); }
  Preferences after(const std::string& text) {
    std::ofstream(file_, std::ios::trunc) << text;
    return loadPreferences(file_);
  }
  fs::path file_;
};

TEST_F(PreferencesTest, KeepEverythingThatTheDialogShows) {
  Preferences p;
  p.theme = Theme::light;
  p.language = "de";
  p.scalePercent = 150;
  p.autosaveSeconds = 45;
  p.lookSensitivity = 1.75;
  p.invertLook = true;
  p.startUp = StartUp::lastProject;
  p.guideSeen = true;
  ASSERT_TRUE(savePreferences(p, file_));
  const Preferences read = loadPreferences(file_);
  EXPECT_EQ(read.theme, Theme::light);
  EXPECT_EQ(read.language, "de");
  EXPECT_EQ(read.scalePercent, 150);
  EXPECT_EQ(read.autosaveSeconds, 45);
  EXPECT_EQ(read.lookSensitivity, 1.75);
  EXPECT_TRUE(read.invertLook);
  EXPECT_EQ(read.startUp, StartUp::lastProject);
  EXPECT_TRUE(read.guideSeen);
}

TEST_F(PreferencesTest, WrongKindsAreLeftAndNumbersPutIntoRange) {
  const Preferences fresh;
  const Preferences wrong = after(
      R"({"theme":"pink","language":"xx","scalePercent":"big","startUp":7,"invertLook":1,"guideSeen":"x","autosaveSeconds":null})");
  EXPECT_EQ(wrong.theme, fresh.theme);
  EXPECT_EQ(wrong.language, "") << "as the system says";
  EXPECT_EQ(wrong.scalePercent, fresh.scalePercent);
  EXPECT_EQ(wrong.startUp, fresh.startUp);
  EXPECT_EQ(wrong.invertLook, fresh.invertLook);
  EXPECT_EQ(wrong.guideSeen, fresh.guideSeen);
  EXPECT_EQ(wrong.autosaveSeconds, fresh.autosaveSeconds);
  const Preferences far = after(
      R"({"scalePercent":5000,"autosaveSeconds":0,"lookSensitivity":-3,"bakeThreads":1e300,"walkMetresPerSecond":1e9})");
  EXPECT_EQ(far.scalePercent, Preferences::kMostScalePercent);
  EXPECT_EQ(far.autosaveSeconds, Preferences::kLeastAutosaveSeconds);
  EXPECT_EQ(far.lookSensitivity, Preferences::kLeastLookSensitivity);
  EXPECT_EQ(far.bakeThreads, 256);
  EXPECT_EQ(far.walkMetresPerSecond, 20);
  EXPECT_EQ(after(R"({"scalePercent":10})").scalePercent, Preferences::kLeastScalePercent);
}

TEST_F(PreferencesTest, SurviveAFileThatEndsAnywhere) {
  Preferences p;
  p.theme = Theme::light;
  p.addRecent("/a/b.acentric.json");
  ASSERT_TRUE(savePreferences(p, file_));
  const std::string whole = *readText(file_, 1 << 20);
  for (std::size_t length = 0; length < whole.size() - 2; length += 7) {
    const Preferences read = after(whole.substr(0, length));
    EXPECT_EQ(read.theme, Theme::dark) << length;
    EXPECT_TRUE(read.recent.empty()) << length;
  }
  EXPECT_EQ(after(whole).theme, Theme::light);
}

TEST_F(PreferencesTest, AreResetWithoutForgettingProjectsOrTheWindow) {
  Preferences p;
  p.addRecent("/a/b.acentric.json");
  p.theme = Theme::light;
  p.bakeThreads = 7;
  p.settingsWidth = 500;
  p.resetSettings();
  EXPECT_EQ(p.theme, Theme::dark);
  EXPECT_EQ(p.bakeThreads, Preferences().bakeThreads);
  EXPECT_EQ(p.recent.size(), 1u);
  EXPECT_EQ(p.settingsWidth, 500);
  p.resetLayout();
  EXPECT_EQ(p.settingsWidth, Preferences().settingsWidth);
  EXPECT_EQ(p.recent.size(), 1u);
}

TEST_F(PreferencesTest, SayWhatIsOpenedAtStart) {
  Preferences p;
  EXPECT_EQ(startUpFile(p, "/sample.json"), "/sample.json");
  EXPECT_EQ(startUpFile(p, ""), "");
  p.startUp = StartUp::lastProject;
  EXPECT_EQ(startUpFile(p, "/sample.json"), "/sample.json") << "there is no last project yet";
  p.addRecent("/mine.json");
  EXPECT_EQ(startUpFile(p, "/sample.json"), "/mine.json");
  p.startUp = StartUp::nothing;
  EXPECT_EQ(startUpFile(p, "/sample.json"), "");
}

TEST(WindowActions, StepThroughTheScalesAndStopAtTheEnds) {
  Session session({});
  EditorState state;
  ActionContext context{session, state};
  const std::vector<Action> table = makeActionTable();
  const Action& larger = *findAction(table, std::string("window.larger"));
  const Action& smaller = *findAction(table, std::string("window.smaller"));
  int before = 100;
  for (int i = 0; i < 12; ++i) {
    larger.run(context);
    EXPECT_GE(session.preferences().scalePercent, before);
    before = session.preferences().scalePercent;
  }
  EXPECT_EQ(before, Preferences::kMostScalePercent);
  for (int i = 0; i < 20; ++i) smaller.run(context);
  EXPECT_EQ(session.preferences().scalePercent, Preferences::kLeastScalePercent);
  findAction(table, std::string("window.automaticScale"))->run(context);
  EXPECT_EQ(session.preferences().scalePercent, 0);
}

}  // namespace
}  // namespace acentric::editor
