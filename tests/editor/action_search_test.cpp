#include "editor/actions/action_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "editor/actions/action_table.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

Action named(const char* id, const char* label, const char* menu = "Plan", const char* help = "") {
  Action action;
  action.id = id;
  action.label = label;
  action.menu = menu;
  action.help = help;
  return action;
}

std::vector<std::string> ids(const std::vector<const Action*>& found) {
  std::vector<std::string> result;
  for (const Action* action : found) result.push_back(action->id);
  return result;
}

using Ids = std::vector<std::string>;

TEST(ActionSearch, TellsHowAWordIsFound) {
  EXPECT_EQ(matchWord("spl", "Split selected cells"), MatchKind::wordBegin);
  EXPECT_EQ(matchWord("CELL", "Split selected cells"), MatchKind::wordBegin);
  EXPECT_EQ(matchWord("ssc", "Split selected cells"), MatchKind::initials);
  EXPECT_EQ(matchWord("sc", "Split selected cells"), MatchKind::initials);
  EXPECT_EQ(matchWord("lect", "Split selected cells"), MatchKind::inside);
  EXPECT_EQ(matchWord("sltd", "Split selected cells"), MatchKind::scattered);
  EXPECT_EQ(matchWord("xyz", "Split selected cells"), std::nullopt);
  // Scattered letters must begin with a word: "plit" begins none.
  EXPECT_EQ(matchWord("lsc", "Split selected cells"), std::nullopt);
  EXPECT_EQ(matchWord("", "anything"), MatchKind::wordBegin);
}

TEST(ActionSearch, FindsWordsInAnyOrderAndNeedsAllOfThem) {
  const std::vector<Action> table = {named("a", "Show sampling coverage"), named("b", "Show cameras"),
                                     named("c", "Coverage of a cell")};
  EXPECT_EQ(ids(searchActions(table, "coverage show", {})), (Ids{"a"}));
  EXPECT_EQ(ids(searchActions(table, "show", {})), (Ids{"a", "b"}));
  EXPECT_EQ(ids(searchActions(table, "  cov   ce ", {})), (Ids{"c"}));
  EXPECT_EQ(ids(searchActions(table, "", {})), (Ids{"a", "b", "c"}));
  EXPECT_TRUE(searchActions(table, "show nothing", {}).empty());
}

TEST(ActionSearch, RanksBeginningsBeforeInsidesBeforeScatteredLettersAndHelpLast) {
  const std::vector<Action> table = {named("scattered", "Find a room to walk in"),
                                     named("help", "Other", "Plan", "Makes the firm plan"),
                                     named("inside", "Confirm"), named("begin", "Firm floor")};
  EXPECT_EQ(ids(searchActions(table, "firm", {})), (Ids{"begin", "inside", "scattered", "help"}));
}

TEST(ActionSearch, PutsWhatIsCalledLikeTheQueryFirstThenWhatBeginsWithIt) {
  const std::vector<Action> table = {named("inside", "Select what is not baked"), named("end", "Cancel bake"),
                                     named("begin", "Bake again"), named("whole", "Bake")};
  EXPECT_EQ(ids(searchActions(table, "bake", {})), (Ids{"whole", "begin", "inside", "end"}));
  EXPECT_EQ(ids(searchActions(table, " BAKE  ag", {})), (Ids{"begin"}));
  EXPECT_EQ(ids(searchActions(table, "bake", {"end", "begin"})), (Ids{"whole", "begin", "end", "inside"}));
}

TEST(ActionSearch, PutsWhatWasUsedLastFirstAmongEquals) {
  const std::vector<Action> table = {named("a", "Show scene"), named("b", "Show cameras"),
                                     named("c", "Unshown things")};
  EXPECT_EQ(ids(searchActions(table, "show", {"c", "b"})), (Ids{"b", "a", "c"}));
  EXPECT_EQ(ids(searchActions(table, "", {"c", "b"})), (Ids{"c", "b", "a"}));
}

TEST(ActionSearch, FindsEveryActionOfTheTableByItsLabelAndItsKey) {
  const std::vector<Action> table = makeActionTable();
  for (const Action& action : table) {
    const auto byLabel = searchActions(table, action.label, {});
    EXPECT_NE(std::ranges::find(byLabel, &action), byLabel.end()) << action.id;
    if (action.shortcut.key == 0) continue;
    const auto byKey = searchActions(table, describe(action.shortcut), {});
    EXPECT_NE(std::ranges::find(byKey, &action), byKey.end()) << action.id;
  }
  EXPECT_EQ(searchActions(table, "bake", {}).front()->id, "bake.start");
  EXPECT_EQ(searchActions(table, "undo", {}).front()->id, "edit.undo");
  EXPECT_EQ(searchActions(table, "pref", {}).front()->id, "file.preferences");
  EXPECT_EQ(searchActions(table, "cfit", {}), searchActions(table, "CFIT", {}));
}

TEST(ActionSearch, FindsByTheNameThatIsShownAndByTheEnglishOne) {
  const std::vector<Action> table = makeActionTable();
  ASSERT_TRUE(setLanguage("de", ACENTRIC_CATALOGUES).has_value());
  const auto first = [&](const char* query) {
    const auto found = searchActions(table, query, {});
    return found.empty() ? std::string() : found.front()->id;
  };
  EXPECT_EQ(first("rückgängig"), "edit.undo");
  EXPECT_EQ(first("Undo"), "edit.undo");
  EXPECT_EQ(first("über acentric"), "help.about") << "a small letter for Ü";
  EXPECT_EQ(first("strg+s"), "file.save");
  EXPECT_FALSE(searchKeys(table, "mausrad").empty());
  EXPECT_EQ(searchKeys(table, "wheel").front().keys, "Mausrad");
  ASSERT_TRUE(setLanguage("ja", ACENTRIC_CATALOGUES).has_value());
  EXPECT_EQ(first("元に戻す"), "edit.undo");
  EXPECT_EQ(first("undo"), "edit.undo");
  ASSERT_TRUE(setLanguage("en").has_value());
}

TEST(ActionSearch, RunsEveryActionOfAMenuByItsLabelAndEnter) {
  const std::vector<Action> table = makeActionTable();
  int inMenus = 0;
  for (const Action& action : table) {
    if (action.menu.empty()) continue;
    ++inMenus;
    // Whatever was used before: the one that is called so is lit at once, and Enter runs it.
    std::vector<std::string> all;
    for (const Action& other : table) all.push_back(other.id);
    for (const std::vector<std::string>& recent : {std::vector<std::string>{}, all})
      EXPECT_EQ(searchActions(table, action.label, recent).front()->id, action.id) << action.label;
  }
  EXPECT_GT(inMenus, 80);
}

TEST(KeyList, HoldsEveryKeyOfTheTableAndThoseOfTheWalkAndTheMouse) {
  const std::vector<Action> table = makeActionTable();
  const auto all = searchKeys(table, "");
  const auto has = [&all](const std::string& keys) {
    return std::ranges::any_of(all, [&keys](const KeyHelp& line) { return line.keys == keys; });
  };
  for (const Action& action : table)
    for (const Shortcut& key : {action.shortcut, action.alternative})
      EXPECT_TRUE(key.key == 0 || has(describe(key))) << action.id;
  EXPECT_TRUE(has("W A S D, arrows"));
  EXPECT_TRUE(has("Wheel"));
  for (const KeyHelp& line : all) {
    EXPECT_FALSE(line.keys.empty() || line.what.empty() || line.where.empty()) << line.what;
    EXPECT_EQ(line.keys.find('?'), std::string::npos) << line.what << " has a key without a name";
  }
}

TEST(KeyList, IsSearchedByKeyAndByWhatItDoes) {
  const std::vector<Action> table = makeActionTable();
  const auto zoom = searchKeys(table, "zoom");
  ASSERT_EQ(zoom.size(), 1u);
  EXPECT_EQ(zoom.front().keys, "Wheel");
  const auto saveAs = searchKeys(table, "ctrl+shift+s");
  ASSERT_EQ(saveAs.size(), 1u);
  EXPECT_EQ(saveAs.front().what, "Save as…");
}

TEST(Actions, SayWhyTheyCannotBeDone) {
  Session session({});
  EditorState state;
  const ActionContext context{session, state};
  const std::vector<Action> table = makeActionTable();
  for (const Action& action : table)
    EXPECT_EQ(whyDisabled(action, context).empty(), action.enabled(context)) << action.id;
  EXPECT_EQ(whyDisabled(*findAction(table, std::string("bake.start")), context), "needs an open project");
}

TEST(Actions, RememberTheLastUsedOnceEach) {
  EditorState state;
  for (const char* id : {"a", "b", "a"}) noteUse(state, id);
  EXPECT_EQ(state.recentActions, (Ids{"a", "b"}));
  for (int i = 0; i < 40; ++i) noteUse(state, std::to_string(i));
  EXPECT_LE(state.recentActions.size(), 20u);
  EXPECT_EQ(state.recentActions.front(), "39");
}

}  // namespace
}  // namespace acentric::editor
