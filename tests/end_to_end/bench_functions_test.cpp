/// Figures of single functions, as `acentric bench functions` tells them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

using testing::HasSubstr;

Json benchOf(std::vector<std::string> words) {
  std::vector<std::string> arguments = {"bench", "functions", "--threads", "2", "--json"};
  arguments.insert(arguments.end(), words.begin(), words.end());
  const auto ran = acentric(arguments);
  EXPECT_EQ(ran.exitCode, 0) << ran.errors;
  return Json::parse(ran.output, nullptr, false);
}

TEST(BenchFunctions, TellMachineCommitAndFiguresBesideWhatTheyReplace) {
  const Json report = benchOf({"hard-cases"});
  EXPECT_EQ(report["threads"], 2);
  for (const char* key : {"version", "commit", "processor"})
    EXPECT_FALSE(report[key].get<std::string>().empty());
  ASSERT_EQ(report["benches"].size(), 1U);
  std::set<std::string> names;
  int beside = 0;
  for (const Json& figure : report["benches"][0]["figures"]) {
    EXPECT_TRUE(names.insert(figure["what"].get<std::string>()).second) << "a name means one thing";
    EXPECT_GT(figure["min"].get<double>(), 0) << figure["what"];
    EXPECT_LE(figure["min"], figure["median"]);
    EXPECT_LE(figure["median"], figure["max"]);
    if (!figure.contains("beside")) continue;
    ++beside;
    EXPECT_EQ(figure["beside"]["count"], figure["count"]) << "measured by turns";
    EXPECT_GT(figure["ratio"].get<double>(), 0);
  }
  EXPECT_GE(beside, 6);
}

TEST(BenchFunctions, OneRunComparesTwoBuilds) {
  const std::string programs = std::filesystem::path(ACENTRIC_PROGRAM).parent_path().string();
  const Json report = benchOf({"hard-cases", "--beside", programs, "--rounds", "2"});
  EXPECT_EQ(report["rounds"], 2);
  EXPECT_EQ(report["beside"]["commit"], report["commit"]) << "here it is the same build";
  for (const Json& figure : report["benches"][0]["figures"]) {
    EXPECT_EQ(figure["count"], 2);
    EXPECT_EQ(figure["beside"]["name"], report["commit"]);
    EXPECT_EQ(figure["beside"]["count"], 2);
  }
}

TEST(BenchFunctions, ThoseThatNeedAModelWorkOnIt) {
  const std::string model = ACENTRIC_SAMPLE_SCENE;
  const Json report = benchOf({"budgets", "simplify", "--model", model, "--regions", "60"});
  ASSERT_EQ(report["benches"].size(), 2U);
  EXPECT_EQ(report["benches"][0]["facts"]["triangles"], 148734);
  EXPECT_GE(report["benches"][0]["facts"]["regions"], 60);
  EXPECT_LE(report["benches"][1]["facts"]["triangles after"],
            report["benches"][1]["facts"]["triangles before"]);
}

TEST(BenchFunctions, WhatIsMissingIsToldWithTheWayOut) {
  const auto refused = [](std::vector<std::string> words) {
    words.insert(words.begin(), {"bench", "functions"});
    const auto ran = acentric(words);
    EXPECT_EQ(ran.exitCode, 1);
    return ran.errors;
  };
  EXPECT_THAT(refused({"nothing"}), HasSubstr("there is no bench 'nothing'"));
  EXPECT_THAT(refused({"budgets"}), HasSubstr("--model"));
  EXPECT_THAT(refused({"budgets", "--model", "/none.glb"}), HasSubstr("none.glb"));
  EXPECT_THAT(refused({"plan", "--beside", "/nowhere"}), HasSubstr("--target acentric-bench-functions"));
}

}  // namespace
}  // namespace acentric::test
