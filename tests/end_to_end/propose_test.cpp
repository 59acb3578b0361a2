/// A layout and settings that keep to budgets, on real bakes of a few cameras.

#include <gtest/gtest.h>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

TEST(ProposeTest, FindsWhatKeepsToBudgetsByBakingLittleAndAppliesIt) {
  const SampleProject project("propose", "-6,-1.2;-2.2,-1.2;-2.2,1.2;-6,1.2");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  Json small = project.read();
  for (const char* effect : {"ambientOcclusion", "diffuseInterreflection", "softShadows", "mirrorReflection"})
    small["effects"][effect] = false;
  project.write(small);
  const auto propose = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"propose", project.file(), "--size", "160x90", "--frames",
                                      "2",       "--repeats",    "2",      "--json", "--truth-samples",
                                      "1"};
    words.insert(words.end(), more.begin(), more.end());
    return acentric(words);
  };
  // No time for anything but the project as it is: so much it takes.
  const auto brief = propose({"--max-mb", "1000", "--budget-minutes", "0.01"});
  ASSERT_EQ(brief.exitCode, 0) << brief.errors;
  const Json first = Json::parse(brief.output);
  ASSERT_EQ(first["points"].size(), 1u);
  EXPECT_TRUE(first["met"].get<bool>());
  const double bytes = first["points"][0]["costs"]["bytes"]["median"];
  EXPECT_FALSE(first["points"][0]["costs"].contains("loadMs")) << "of a part of the captures it says nothing";

  // Half of that: found, among resolutions and cells alone, and it is so when all is baked.
  const std::string half = std::to_string(0.5 * bytes / 1e6);
  const auto found = propose({"--max-mb", half, "--knobs", "colour-quality=80", "--budget-minutes", "3"});
  ASSERT_EQ(found.exitCode, 0) << found.errors;
  const Json report = Json::parse(found.output);
  EXPECT_TRUE(report["met"].get<bool>()) << report.dump(1);
  EXPECT_GT(report["points"].size(), 1u);
  EXPECT_EQ(report["points"][0], first["points"][0]) << "measured before";
  const Json proposal = report["presets"]["proposal"];
  EXPECT_FALSE(proposal.empty());
  EXPECT_EQ(project.read(), small) << "nothing is applied yet";

  const auto applied =
      propose({"--max-mb", half, "--knobs", "colour-quality=80", "--budget-minutes", "0.01", "--apply"});
  ASSERT_EQ(applied.exitCode, 0) << applied.errors;
  EXPECT_NE(project.read(), small);
  const auto baked = acentric({"bake", project.file(), "--json"});
  ASSERT_EQ(baked.exitCode, 0) << baked.errors;
  double promised = 0;
  for (const Json& point : report["points"])
    if (point["setting"] == proposal) promised = point["costs"]["bytes"]["median"];
  double taken = 0;
  for (const auto& entry : std::filesystem::directory_iterator(project.captures()))
    if (entry.is_regular_file() && entry.path().extension() != ".record") taken += double(entry.file_size());
  EXPECT_NEAR(taken / promised, 1, 0.25) << "extrapolated from a few cameras";
}

TEST(ProposeTest, SaysWhatItNeeds) {
  const auto none = acentric({"propose", "none.acentric.json"});
  EXPECT_EQ(none.exitCode, 1);
  EXPECT_NE(none.errors.find("give a goal"), std::string::npos) << none.errors;
  EXPECT_EQ(acentric({"propose", "none.acentric.json", "--max-mb", "-3"}).exitCode, 2);
}

}  // namespace
}  // namespace acentric::test
