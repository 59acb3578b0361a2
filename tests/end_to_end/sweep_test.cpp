/// What accuracy costs, on a real bake: measured, gone on with, and applied.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

std::string textOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> sweep(const SampleProject& project, std::vector<std::string> more) {
  std::vector<std::string> words = {
      "sweep", project.file(),    "--size", "160x90",      "--frames", "3",     "--repeats",
      "2",     "--truth-samples", "1",      "--crossings", "2",        "--json"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

const Json* pointOf(const Json& report, const Json& setting) {
  for (const Json& point : report["points"])
    if (point["setting"] == setting) return &point;
  return nullptr;
}

/// Its captures are baked beside the project's own, which has none.
void presetForOneCommand(const SampleProject& project) {
  const auto dry = acentric({"bake", project.file(), "--preset", "accurate", "--dry-run", "--json"});
  ASSERT_EQ(dry.exitCode, 0) << dry.errors;
  const auto baked = acentric({"bake", project.file(), "--preset", "accurate", "--json"});
  ASSERT_EQ(baked.exitCode, 0) << baked.errors;
  EXPECT_EQ(Json::parse(baked.output)["baked"].get<std::size_t>(), Json::parse(dry.output)["missing"].size());
  const auto measured =
      acentric({"measure", project.file(), "--preset", "accurate", "--preset-from",
                (project.folder() / "gallery.sweep").string(), "--frames", "1", "--size", "96x54", "--json"});
  ASSERT_EQ(measured.exitCode, 0) << measured.errors;
  const auto plain = acentric({"measure", project.file(), "--frames", "1", "--size", "96x54"});
  EXPECT_NE(plain.exitCode, 0) << "the project as it is has no captures yet";
  EXPECT_NE(acentric({"bake", project.file(), "--preset", "accurate", "--prune"}).exitCode, 0);
  const auto unknown = acentric({"render", project.file(), "--preset", "swift", "-o", "x.png"});
  EXPECT_NE(unknown.errors.find("balanced"), std::string::npos) << unknown.errors;
}

TEST(SweepTest, MeasuresWhatAccuracyCostsGoesOnWhereItStoppedAndAppliesWhatItFound) {
  // The end of the nave alone, and few rays: what is measured is not the scene.
  const SampleProject project("sweep", "-6,-1.2;-2.2,-1.2;-2.2,1.2;-6,1.2");
  ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  Json small = project.read();
  for (const char* effect : {"ambientOcclusion", "diffuseInterreflection", "softShadows", "mirrorReflection"})
    small["effects"][effect] = false;
  small["bake"]["colourQuality"] = 100;  // bytes grow with samples: pictures of so few take little each
  project.write(small);
  const std::vector<std::string> knobs = {"--knobs", "reconstruction=point/splat,samples-per-degree=2",
                                          "--budget-minutes", "30"};
  const std::filesystem::path folder = project.folder() / "gallery.sweep";

  // No time for anything but the project as it is.
  const auto brief = acentric(sweep(
      project, {"--knobs", "reconstruction=point/splat,samples-per-degree=2", "--budget-minutes", "0.01"}));
  ASSERT_EQ(brief.exitCode, 0) << brief.errors;
  EXPECT_NE(brief.errors.find("bakeForecast"), std::string::npos) << brief.errors;
  const Json first = Json::parse(brief.output);
  ASSERT_EQ(first["points"].size(), 4u);
  EXPECT_FALSE(first["points"][0].contains("skipped"));
  EXPECT_NE(
      pointOf(first, {{"samples-per-degree", "2"}})->at("skipped").get<std::string>().find("would take"),
      std::string::npos);

  const auto whole = acentric(sweep(project, knobs));
  ASSERT_EQ(whole.exitCode, 0) << whole.errors;
  const Json report = Json::parse(whole.output);
  for (const Json& point : report["points"]) EXPECT_FALSE(point.contains("skipped")) << point.dump();
  EXPECT_EQ(report["points"][0], first["points"][0]) << "measured before";
  const Json& base = report["points"][0];
  const Json* points = pointOf(report, {{"reconstruction", "point"}});
  const Json* finer = pointOf(report, {{"samples-per-degree", "2"}});
  ASSERT_TRUE(points && finer);
  const auto median = [](const Json& point, const char* group, const char* name) {
    return point[group][name]["median"].get<double>();
  };
  EXPECT_GT(median(base, "errors", "psnr"), median(*points, "errors", "psnr"));
  EXPECT_GT(median(*points, "errors", "holeShare"), median(base, "errors", "holeShare"));
  EXPECT_GT(median(*finer, "errors", "msSsim"), median(base, "errors", "msSsim"));
  EXPECT_LT(median(*finer, "errors", "depthError"), median(base, "errors", "depthError"));
  EXPECT_GT(median(*finer, "costs", "bytes"), 2 * median(base, "costs", "bytes"));
  EXPECT_EQ((*points)["bakeKey"], base["bakeKey"]) << "the same captures, baked once";
  EXPECT_NE((*finer)["bakeKey"], base["bakeKey"]);
  EXPECT_EQ(median(*points, "costs", "bakeSeconds"), median(base, "costs", "bakeSeconds"));
  for (const Json& point : report["points"]) EXPECT_EQ(point["changedFrames"].get<int>(), 0);
  EXPECT_FALSE(report["front"].empty());
  EXPECT_FALSE(std::filesystem::exists(project.captures())) << "the project's own folder is left alone";
  EXPECT_EQ(Json::parse(textOf(folder / "sweep.json")), report);
  const std::string html = textOf(folder / "sweep.html");
  EXPECT_NE(html.find("data:image/jpeg;base64,"), std::string::npos);
  const std::string csv = textOf(folder / "sweep.csv");
  EXPECT_EQ(std::size_t(std::count(csv.begin(), csv.end(), '\n')), report["points"].size() + 1);
  EXPECT_FALSE(report["commit"].get<std::string>().empty());
  EXPECT_EQ(base["commit"], report["commit"]);
  ASSERT_EQ(report["numerics"].size(), 3u);
  EXPECT_NE(html.find("Numerical accuracy"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "numerics.csv"));

  const std::string before = textOf(project.file());
  const auto shown = acentric({"preset", project.file(), "accurate", "--json"});
  ASSERT_EQ(shown.exitCode, 0) << shown.errors;
  EXPECT_EQ(textOf(project.file()), before) << "without --apply nothing is written";
  presetForOneCommand(project);
  EXPECT_EQ(textOf(project.file()), before) << "nor with --preset";
  const auto applied = acentric({"preset", project.file(), "accurate", "--apply", "--json"});
  ASSERT_EQ(applied.exitCode, 0) << applied.errors;
  for (const Json& change : Json::parse(applied.output)["changes"])
    EXPECT_EQ(report["presets"]["accurate"][change["knob"].get<std::string>()], change["to"]);
  EXPECT_EQ(project.read()["bake"]["samplesPerDegree"].get<double>(), 2);

  const auto other = acentric(sweep(project, knobs));
  EXPECT_NE(other.exitCode, 0) << "the project is another now";
  EXPECT_NE(other.errors.find("--again"), std::string::npos) << other.errors;
}

}  // namespace
}  // namespace acentric::test
