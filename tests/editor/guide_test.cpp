#include "editor/session/guide.h"

#include <gtest/gtest.h>

#include <string>

namespace acentric::editor {
namespace {

int stepNamed(const std::string& title) {
  for (std::size_t i = 0; i < guideSteps().size(); ++i)
    if (title == guideSteps()[i].title) return int(i);
  return -1;
}

/// A guide that stands at a step.
Guide guideAt(const std::string& title, const GuideFacts& facts) {
  Guide guide;
  guide.start(facts);
  while (guide.running() && guide.index() < stepNamed(title)) guide.next(facts);
  EXPECT_TRUE(guide.running()) << "no step is called " << title;
  return guide;
}

TEST(Guide, HasAFewStepsThatPointAtWidgets) {
  EXPECT_GE(guideSteps().size(), 5u);
  EXPECT_LE(guideSteps().size(), 6u);
  for (const GuideStep& step : guideSteps()) {
    EXPECT_FALSE(std::string(step.title).empty() || std::string(step.text).empty() ||
                 std::string(step.widget).empty());
    EXPECT_FALSE(step.done({}, {})) << step.title << " is done before anything is";
  }
}

TEST(Guide, GoesOnWhenACellIsPlacedAndNotWhenOnlyTheLayoutArrives) {
  GuideFacts facts;
  facts.cells = 20;
  Guide guide = guideAt("Place cells", facts);
  facts.cells = 25;  // the layout was built anew without an edit
  EXPECT_FALSE(guide.observe(facts));
  facts.changes = 1;
  EXPECT_TRUE(guide.observe(facts));
  EXPECT_EQ(guide.index(), stepNamed("Place cells") + 1);
}

TEST(Guide, GoesOnByWhatEachStepAsksFor) {
  struct Case {
    const char* title;
    void (*act)(GuideFacts&);
  };
  for (const Case& one : {Case{"See what will be sampled", [](GuideFacts& f) { f.coverage = true; }},
                          Case{"Bake", [](GuideFacts& f) { f.baking = true; }},
                          Case{"Bake", [](GuideFacts& f) { f.baked = 3; }},
                          Case{"Walk", [](GuideFacts& f) { f.walkedMetres = 8; }},
                          Case{"Find anything", [](GuideFacts& f) { ++f.commands; }}}) {
    GuideFacts facts;
    facts.walkedMetres = 5;
    Guide guide = guideAt(one.title, facts);
    const int before = guide.index();
    EXPECT_FALSE(guide.observe(facts)) << one.title;
    one.act(facts);
    EXPECT_TRUE(guide.observe(facts)) << one.title;
    EXPECT_TRUE(!guide.running() || guide.index() == before + 1) << one.title;
  }
}

TEST(Guide, SavingCountsOnlyWhenThereWasSomethingToSave) {
  GuideFacts facts;
  Guide guide = guideAt("Save", facts);
  EXPECT_FALSE(guide.observe(facts));
  facts.dirty = true;
  EXPECT_FALSE(guide.observe(facts));
  facts.dirty = false;
  EXPECT_TRUE(guide.observe(facts));
}

TEST(Guide, GoesBackWithoutLeapingForwardAgainAndEndsAfterTheLastStep) {
  GuideFacts facts;
  facts.baked = 7;
  Guide guide = guideAt("Walk", facts);
  guide.back(facts);
  EXPECT_EQ(guide.index(), stepNamed("Bake"));
  EXPECT_FALSE(guide.observe(facts)) << "captures of before are no new ones";
  guide.back(facts);
  guide.back(facts);
  guide.back(facts);
  EXPECT_TRUE(guide.first());
  while (!guide.last()) guide.next(facts);
  EXPECT_TRUE(guide.running());
  guide.next(facts);
  EXPECT_FALSE(guide.running());
  EXPECT_FALSE(guide.observe(facts));
  guide.start(facts);
  EXPECT_TRUE(guide.running() && guide.first());
}

}  // namespace
}  // namespace acentric::editor
