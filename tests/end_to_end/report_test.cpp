/// What bakes tell about themselves: camera by camera, and timed.

#include <gtest/gtest.h>

#include <map>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

TEST(ReportTest, TellsOfEachCameraWhatWasKeptAlsoOfThoseBakedBefore) {
  const SampleProject project("report");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  const auto bake = [&] {
    const auto ran = acentric({"bake", project.file(), "--only", "0,3", "--json"});
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    return Json::parse(ran.output, nullptr, false);
  };
  const Json first = bake(), again = bake();
  ASSERT_EQ(first["cameras"].size(), 2u);
  std::uint64_t kept = 0, bytes = 0;
  for (const Json& camera : first["cameras"]) {
    EXPECT_FALSE(camera["reused"].get<bool>());
    kept += camera["samples"]["kept"].get<std::uint64_t>();
    bytes += camera["bytes"].get<std::uint64_t>();
  }
  EXPECT_GT(kept, 0u);
  EXPECT_EQ(kept, first["samples"]["kept"].get<std::uint64_t>());
  EXPECT_EQ(bytes, first["bytes"].get<std::uint64_t>());
  ASSERT_EQ(again["cameras"].size(), 2u);
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_TRUE(again["cameras"][c]["reused"].get<bool>());
    EXPECT_EQ(again["cameras"][c]["samples"], first["cameras"][c]["samples"]);
    EXPECT_EQ(again["cameras"][c]["bytes"], first["cameras"][c]["bytes"]);
  }
  const auto listed = acentric({"bake", project.file(), "--only", "0,3", "--list"});
  EXPECT_NE(listed.output.find("   0: "), std::string::npos) << listed.output;
  EXPECT_NE(listed.output.find("   3: "), std::string::npos) << listed.output;
  EXPECT_NE(listed.output.find("dropped"), std::string::npos) << listed.output;
}

TEST(ReportTest, BakesWhatAPathNeedsAndNoMore) {
  const SampleProject project("along");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  const std::string path = (project.folder() / "tour.json").string();
  ASSERT_EQ(acentric({"tour", project.file(), "-o", path, "--frames", "8"}).exitCode, 0);
  const auto bake = [&](const std::string& frames) {
    const auto ran = acentric({"bake", project.file(), "--along", path, "--frames", frames, "--json"});
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    return Json::parse(ran.output, nullptr, false)["cameras"].size();
  };
  const std::size_t two = bake("2"), all = bake("0");
  EXPECT_GT(two, 0u);
  EXPECT_LT(two, all);
  const auto walked = acentric({"measure", project.file(), "--path", path, "--size", "160x90", "--json"});
  ASSERT_EQ(walked.exitCode, 0) << walked.errors;
  EXPECT_TRUE(Json::parse(walked.output)["warnings"].empty()) << "nothing that the path needs is missing";
  EXPECT_NE(acentric({"bake", project.file(), "--along", path, "--only", "0"}).exitCode, 0);
}

TEST(ReportTest, RefusesToMixQualitiesWithWhatIsAboutFinalCaptures) {
  const SampleProject project("mixed");
  for (const char* option : {"--prune", "--dry-run"}) {
    const auto ran = acentric({"bake", project.file(), "--quality", "draft", option});
    EXPECT_NE(ran.exitCode, 0);
    EXPECT_NE(ran.errors.find("--quality"), std::string::npos) << ran.errors;
  }
  EXPECT_FALSE(std::filesystem::exists(project.captures()));
}

TEST(ReportTest, BenchTellsRaysAndBytesOfEachSetAndLeavesNothing) {
  const SampleProject project("bench");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  const auto ran = acentric(
      {"bench", "bake", project.file(), "--side", "48", "--cameras", "6", "--repeats", "1", "--json"});
  ASSERT_EQ(ran.exitCode, 0) << ran.errors;
  const Json bench = Json::parse(ran.output);
  std::map<std::string, Json> sets;
  for (const Json& set : bench["sets"]) sets[set["name"].get<std::string>()] = set;
  constexpr std::uint64_t kPixels = 6 * 48 * 48;
  for (const char* name : {"geometry", "one shadow ray", "all effects"}) {
    EXPECT_EQ(sets[name]["rays"]["visibility"], 0) << name << ": nothing is pruned";
    EXPECT_LE(sets[name]["samples"]["kept"].get<std::uint64_t>(), kPixels) << name << ": one layer";
  }
  EXPECT_EQ(sets["geometry"]["rays"]["shadow"], 0);
  EXPECT_GT(sets["one shadow ray"]["rays"]["shadow"].get<double>(), 0);
  EXPECT_EQ(sets["one shadow ray"]["rays"]["ambient"], 0);
  EXPECT_EQ(sets["preview"]["rays"]["visibility"], 0);
  EXPECT_GT(sets["final"]["rays"]["visibility"].get<double>(), 0);
  EXPECT_GE(sets["final"]["rays"]["primary"].get<double>(), sets["preview"]["rays"]["primary"].get<double>());
  for (const auto& [name, set] : sets) {
    EXPECT_GT(set["tracerShare"].get<double>(), 0) << name;
    EXPECT_GT(set["parts"]["march"].get<double>(), 0) << name;
  }
  EXPECT_EQ(sets["all effects"]["parts"]["silhouettes"], 0);
  EXPECT_GT(sets["final"]["parts"]["silhouettes"].get<double>(), 0);
  EXPECT_GT(sets["final"]["parts"]["testEyes"].get<double>(), 0);
  EXPECT_GT(sets["final"]["parts"]["eyeViews"].get<double>(), 0);
  const Json& bytes = bench["bytesPerCamera"];
  EXPECT_GE(bytes["everySurface"].get<double>(), bytes["pruned"].get<double>());
  EXPECT_GT(bytes["pruned"].get<double>(), bytes["quantised"].get<double>());
  EXPECT_GT(bytes["quantised"].get<double>(), bytes["pack"].get<double>());
  for (const auto& entry : std::filesystem::directory_iterator(project.folder()))
    EXPECT_TRUE(entry.is_regular_file()) << entry.path();
}

}  // namespace
}  // namespace acentric::test
