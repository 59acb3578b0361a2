/// Qualities of a bake to choose from, what each takes, and the resolution that fits a size.

#include "editor/session/bake_costs.h"

#include "editor/actions/action_table.h"
#include "engine/pipeline/bake_plan.h"
#include "engine/pipeline/knobs.h"
#include "tests/editor/session_fixture.h"

namespace acentric::editor {
namespace {

TEST(BakePresets, AreSoundAndInForceOnceChosen) {
  BakeSettings own;
  own.eyeRange = 0.4;
  own.ambientRadius = 5;
  for (const BakePreset preset : kBakePresets) {
    const BakeSettings chosen = withPreset(own, preset);
    EXPECT_TRUE(chosen.check()) << nameOf(preset);
    EXPECT_EQ(presetInForce(chosen), preset);
    EXPECT_EQ(chosen.eyeRange, 0.4) << "where one walks is no quality";
    EXPECT_EQ(chosen.ambientRadius, 5);
  }
  EXPECT_EQ(presetInForce(Project{}.bake), BakePreset::balanced) << "what new projects have";
}

TEST(BakePresets, OneChangedSettingIsNamedAgainstTheNearest) {
  BakeSettings own = withPreset({}, BakePreset::draft);
  own.distanceShift = 1;
  EXPECT_EQ(presetInForce(own), std::nullopt);
  EXPECT_EQ(nearestPreset(own), BakePreset::draft);
  EXPECT_EQ(differencesFrom(own, BakePreset::draft), std::vector<std::string>{"distance shift"});
  EXPECT_GT(differencesFrom(own, BakePreset::fine).size(), 5U);
}

TEST(BakePresets, EverySettingThatTheyDifferInIsNamed) {
  const BakeSettings balanced, fine = withPreset({}, BakePreset::fine);
  Project project;
  project.scene = "room.obj";
  EXPECT_EQ(differencesFrom(fine, BakePreset::balanced).size(), settingOf(project, BakePreset::fine).size());
  EXPECT_TRUE(settingOf(project, BakePreset::balanced).empty());
  for (const BakePreset preset : kBakePresets) {
    const auto set = acentric::applySetting(project, settingOf(project, preset));
    ASSERT_TRUE(set) << set.error().describe();
    EXPECT_EQ(set->bake, withPreset(project.bake, preset)) << "as a sweep calls it: " << nameOf(preset);
  }
}

class BakeCostsTest : public OpenSessionTest {
 protected:
  void SetUp() override {
    OpenSessionTest::SetUp();
    makeCoarse(*session_);
    settle();
    began_ = session_->history().cursor();
  }
  void settle() {
    waitFor([&] { return !session_->working() && session_->built()->project == session_->project(); });
  }
  void run(const std::string& id) {
    ActionContext context{*session_, state_};
    const Action* action = findAction(table_, id);
    ASSERT_TRUE(action != nullptr && action->enabled(context)) << id;
    action->run(context);
    settle();
  }
  const BakeCost* costOf(BakePreset preset) {
    return session_->bakeCosts().of(withPreset(session_->project().bake, preset));
  }
  const BakeCost* ownCost() { return session_->bakeCosts().of(session_->project().bake); }
  /// As a panel does that is shown; waits until what the project takes as it is set is predicted, which
  /// comes first.
  void look() {
    session_->showBakeCosts(true);
    waitFor([&] { return ownCost() != nullptr; });
    EXPECT_EQ(session_->bakeCosts().trouble(), "");
  }

  EditorState state_;
  const std::vector<Action> table_ = makeActionTable();
  std::size_t began_ = 0;
};

TEST_F(BakeCostsTest, APresetIsOneEditThatIsShownAsInForce) {
  const Project before = session_->project();
  const Action& fine = *findAction(table_, std::string("quality.fine"));
  const ActionContext context{*session_, state_};
  EXPECT_FALSE(fine.checked(context));
  run("quality.fine");
  EXPECT_TRUE(fine.checked(context));
  EXPECT_EQ(presetInForce(session_->project().bake), BakePreset::fine);
  EXPECT_EQ(session_->history().cursor(), began_ + 1);
  run("quality.fine");
  EXPECT_EQ(session_->history().cursor(), began_ + 1) << "it is so already";
  session_->undo();
  EXPECT_EQ(session_->project(), before);
}

TEST_F(BakeCostsTest, EveryPresetIsPredictedOfTheWholeProject) {
  look();
  waitFor(
      [&] { return costOf(BakePreset::draft) && costOf(BakePreset::balanced) && costOf(BakePreset::fine); });
  const auto cameras = int(session_->built()->layout->cameras.size());
  for (const BakePreset preset : kBakePresets) EXPECT_EQ(costOf(preset)->forecast.cameras, cameras);
  const auto bytes = [&](BakePreset preset) { return costOf(preset)->forecast.bytes(); };
  EXPECT_GT(bytes(BakePreset::draft), ownCost()->forecast.bytes()) << "8 samples per degree, not 0.5";
  EXPECT_GT(bytes(BakePreset::balanced), 1.5 * bytes(BakePreset::draft));
  EXPECT_GT(bytes(BakePreset::fine), 1.5 * bytes(BakePreset::balanced));
  EXPECT_GT(costOf(BakePreset::fine)->forecast.seconds(), costOf(BakePreset::draft)->forecast.seconds());
}

TEST_F(BakeCostsTest, WhatIsPredictedHoldsUntilTheLayoutChanges) {
  look();
  waitFor([&] { return costOf(BakePreset::draft) != nullptr; });
  const double draft = costOf(BakePreset::draft)->forecast.seconds();
  run("quality.draft");
  session_->apply(setFieldOfView(session_->project(), 80));
  settle();
  ASSERT_NE(costOf(BakePreset::draft), nullptr) << "neither a preset nor the view changes what others take";
  EXPECT_EQ(costOf(BakePreset::draft)->forecast.seconds(), draft);
  session_->showBakeCosts(false);
  session_->apply(setCellSize(session_->project(), 1.7));
  settle();
  session_->showBakeCosts(true);
  session_->poll(now_ += 0.05);
  EXPECT_EQ(costOf(BakePreset::draft), nullptr);
  EXPECT_FALSE(session_->bakeCosts().predicting()) << "it waits until the project keeps still";
  look();
  EXPECT_EQ(ownCost()->forecast.cameras, int(session_->built()->layout->cameras.size()));
}

TEST_F(BakeCostsTest, AfterChangesItIsPredictedAnewOnceTheProjectKeepsStill) {
  look();
  session_->apply(setCellSize(session_->project(), 1.7));
  settle();
  for (int i = 0; i < 20; ++i) session_->poll(now_ += 0.1);
  EXPECT_FALSE(session_->bakeCosts().predicting());
  EXPECT_EQ(ownCost(), nullptr) << "not while somebody may go on";
  look();
}

using ShownCostsTest = SessionTest;

TEST_F(ShownCostsTest, WhatAProjectTakesAsItIsOpenedIsPredictedByItselfWhereItIsShown) {
  Session session(options());
  openAndSettle(session, folder_ / "room.obj");
  for (int i = 0; i < 60; ++i) session.poll(now_ += 0.1);
  EXPECT_FALSE(session.bakeCosts().predicting()) << "it is shown nowhere";
  session.showBakeCosts(true);
  waitFor(session, [&] { return session.bakeCosts().of(session.project().bake) != nullptr; });
}

TEST_F(BakeCostsTest, ASizeBecomesAResolutionThatFitsIt) {
  look();
  const double wanted = 6 * ownCost()->forecast.bytes();
  session_->proposeSize(wanted);
  waitFor([&] { return session_->bakeCosts().proposal() != nullptr; });
  const SizeProposal proposal = *session_->bakeCosts().proposal();
  EXPECT_FALSE(proposal.far());
  EXPECT_NEAR(proposal.cost.forecast.bytes() / wanted, 1, 0.1);
  EXPECT_GT(proposal.bake.samplesPerDegree, 2 * session_->project().bake.samplesPerDegree);
  BakeSettings same = proposal.bake;
  same.samplesPerDegree = session_->project().bake.samplesPerDegree;
  EXPECT_EQ(same, session_->project().bake) << "all else stays";
  session_->apply(setBakeSettings(session_->project(), proposal.bake, "size"));
  settle();
  EXPECT_EQ(session_->history().cursor(), began_ + 1);
  ASSERT_NE(ownCost(), nullptr) << "what was found of it is remembered";
  EXPECT_EQ(ownCost()->forecast.bytes(), proposal.cost.forecast.bytes());
  BakeSettings other = proposal.bake;
  other.colourQuality = 50;
  session_->apply(setBakeSettings(session_->project(), other, "colour quality"));
  settle();
  session_->poll(now_ += 0.05);
  EXPECT_EQ(session_->bakeCosts().proposal(), nullptr) << "it was of other settings";
}

TEST_F(BakeCostsTest, ASizeThatLightAloneExceedsIsRefused) {
  look();
  session_->proposeSize(ownCost()->forecast.lightBytes / 2);
  waitFor([&] { return !session_->bakeCosts().sizeTrouble().empty(); });
  EXPECT_NE(session_->bakeCosts().sizeTrouble().find("surface texel"), std::string::npos)
      << session_->bakeCosts().sizeTrouble();
  EXPECT_EQ(session_->bakeCosts().proposal(), nullptr);
}

TEST_F(BakeCostsTest, AccuracyIsThatOfTheSameCapturesDrawnAsTheProjectIs) {
  look();
  const BakeCost& cost = *ownCost();
  EXPECT_EQ(cost.bakeKeys, std::vector{bakeKeyOf(*session_->built())});
  Sweep sweep;
  sweep.points.resize(3);
  sweep.points[0].bakeKey = "another";
  sweep.points[1].bakeKey = cost.bakeKeys[0];
  sweep.points[1].setting = {{"renderer", "zbuffer"}, {"samples-per-degree", "0.5"}};
  EXPECT_EQ(measuredWith(sweep, cost), nullptr) << "drawn otherwise";
  sweep.points[2].bakeKey = cost.bakeKeys[0];
  sweep.points[2].setting = {{"samples-per-degree", "0.5"}};
  EXPECT_EQ(measuredWith(sweep, cost), &sweep.points[2]);
  sweep.points[2].skipped = "would take about 3 h, of 10 min that were left";
  EXPECT_EQ(measuredWith(sweep, cost), nullptr);
}

}  // namespace
}  // namespace acentric::editor
