#include "engine/pipeline/knobs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "engine/base/file.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

TEST(Knobs, EveryValueThatIsTriedGivesASoundProjectAndNothingElseChanges) {
  Project project;
  project.scene = "room.glb";
  project.layout().outline.loops = {{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}};
  std::set<std::string> names;
  for (const Knob& knob : knobs()) {
    EXPECT_TRUE(names.insert(knob.name).second) << knob.name;
    const auto range = parseKnobRange(knob.name, project);
    ASSERT_TRUE(range) << range.error().describe();
    EXPECT_FALSE(range->values.empty()) << knob.name;
    for (const std::string& value : range->values) {
      const auto set = applySetting(project, {{knob.name, value}});
      ASSERT_TRUE(set) << knob.name << " " << value << ": " << set.error().describe();
      EXPECT_FALSE(*set == project) << knob.name << " " << value;
      EXPECT_EQ(knob.value(*set), value) << knob.name;
      for (const Knob& other : knobs())
        if (other.name != knob.name) {
          EXPECT_EQ(other.value(*set), other.value(project)) << other.name << " by " << knob.name;
        }
      const bool viewOnly = set->bake == project.bake && set->storeys == project.storeys;
      EXPECT_EQ(viewOnly, !knob.bakes) << knob.name;
    }
  }
}

TEST(Knobs, AreAppliedInTheirOrderHoweverTheyAreGiven) {
  Project project;
  project.scene = "room.glb";
  project.layout().outline.loops = {{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}};
  const SweepSetting one{{"panoramas", "on"}, {"configuration", "e"}, {"layers", "2.0"}},
      other{{"configuration", "e"}, {"panoramas", "on"}};
  EXPECT_FALSE(inOrder(one, project)) << "2.0 is no whole number";
  const auto a = applySetting(project, other);
  const auto b = applySetting(project, {other[1], other[0]});
  ASSERT_TRUE(a && b);
  EXPECT_TRUE(*a == *b);
  EXPECT_EQ(*inOrder({other[1], other[0]}, project), other);
  EXPECT_TRUE(inOrder({{"layers", "8"}}, project)->empty()) << "as it is";
  EXPECT_FALSE(inOrder({{"layers", "2"}, {"layers", "4"}}, project));
}

TEST(Knobs, RefuseWhatTheyDoNotKnowAndNameWhatThereIs) {
  Project project;
  project.scene = "room.glb";
  EXPECT_NE(parseKnobRange("layer", project).error().message.find("layers"), std::string::npos);
  EXPECT_FALSE(parseKnobRange("layers=many", project));
  EXPECT_FALSE(parseKnobRange("fill-holes=yes", project));
  EXPECT_FALSE(applySetting(project, {{"layers", "1000"}})) << "beyond what a project may have";
  EXPECT_EQ(parseKnobRange("layers=1/8/1/2", project)->values, (std::vector<std::string>{"1", "2"}));
}

using Presets = FolderTest;

TEST_F(Presets, AreReadFromASweepsFile) {
  const auto file = folder_ / kSweepFile;
  EXPECT_EQ(presetOf(file, "fast").error().kind, ErrorKind::notFound);
  Sweep sweep;
  SweepPoint point;
  point.setting = {{"layers", "2"}};
  point[Measure::msSsim] = point[Measure::frameMs] = point[Measure::bytes] = spreadOf({0.5});
  sweep.points = {point};
  ASSERT_TRUE(writeTextAtomically(file, toJson(sweep)));
  EXPECT_EQ(*presetOf(file, "fast"), point.setting);
  EXPECT_NE(presetOf(file, "swift").error().message.find("balanced"), std::string::npos);
  EXPECT_EQ(sweepFileOf("a/room.acentric.json", folder_), file);
  EXPECT_EQ(sweepFileOf("a/room.acentric.json", {}), "a/room.sweep/sweep.json");
}

}  // namespace
}  // namespace acentric
