/// From a model file to a walk, as a user types it.

#include <gtest/gtest.h>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

class WalkTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    project = new SampleProject("walk");
    baked = new ProcessResult(acentric({"bake", project->file(), "--json"}));
  }
  static void TearDownTestSuite() {
    delete project;
    delete baked;
  }
  void SetUp() override {
    ASSERT_EQ(project->made().exitCode, 0) << project->made().errors;
    ASSERT_EQ(baked->exitCode, 0) << baked->errors;
  }
  std::string path(const char* name) const { return (project->folder() / name).string(); }

  static inline SampleProject* project = nullptr;
  static inline ProcessResult* baked = nullptr;
};

TEST_F(WalkTest, BakesEveryCameraOnce) {
  const Json first = Json::parse(baked->output);
  EXPECT_GT(first["baked"].get<int>(), 10);
  EXPECT_EQ(first["reused"].get<int>(), 0);
  const auto again = acentric({"bake", project->file(), "--json"});
  ASSERT_EQ(again.exitCode, 0) << again.errors;
  EXPECT_EQ(Json::parse(again.output)["baked"].get<int>(), 0);
  EXPECT_EQ(Json::parse(again.output)["reused"], first["baked"]);
}

TEST_F(WalkTest, RendersWithEveryRendererAndTheyAgree) {
  ASSERT_EQ(acentric({"tour", project->file(), "-o", path("tour.json"), "--frames", "6"}).exitCode, 0);
  std::map<std::string, double> psnr;
  for (const std::string renderer : {"list", "scalar", "zbuffer", "gl"}) {
    const auto picture = path((renderer + ".png").c_str());
    const auto rendered = acentric(
        {"render", project->file(), "--size", "320x180", "--renderer", renderer, "-o", picture, "--json"});
    ASSERT_EQ(rendered.exitCode, 0) << renderer << ": " << rendered.errors;
    EXPECT_TRUE(std::filesystem::exists(picture));
    const auto measured = acentric({"measure", project->file(), "--path", path("tour.json"), "--size",
                                    "320x180", "--renderer", renderer, "--json"});
    ASSERT_EQ(measured.exitCode, 0) << renderer << ": " << measured.errors;
    const Json report = Json::parse(measured.output);
    psnr[renderer] = report["psnr"]["median"].get<double>();
    EXPECT_GT(psnr[renderer], 15)
        << renderer;  // one sample per degree is coarse; a wrong picture has far less
    // Large cells among columns, one sample per degree: some holes stay.
    EXPECT_LT(report["holeShare"]["median"].get<double>(), 0.12) << renderer;
  }
  EXPECT_EQ(psnr["list"], psnr["scalar"]);
  // Splats of what is kept behind an edge lap over it by a pixel where no depth is compared.
  EXPECT_NEAR(psnr["list"], psnr["zbuffer"], 0.8);
  EXPECT_NEAR(psnr["list"], psnr["gl"], 0.7);
}

TEST_F(WalkTest, TruthIsRenderedWithoutCaptures) {
  const auto truth = acentric({"render", project->file(), "--size", "160x90", "--renderer", "truth",
                               "--truth-samples", "1", "-o", path("truth.png")});
  EXPECT_EQ(truth.exitCode, 0) << truth.errors;
}

TEST_F(WalkTest, WritesFramesAndAContactSheet) {
  ASSERT_EQ(acentric({"tour", project->file(), "-o", path("short.json"), "--frames", "3"}).exitCode, 0);
  const auto walked = acentric(
      {"walk", project->file(), "--path", path("short.json"), "-o", path("frames"), "--size", "160x90"});
  ASSERT_EQ(walked.exitCode, 0) << walked.errors;
  for (const char* name : {"frames/frame_00000.png", "frames/frame_00002.png", "frames/contact_sheet.png"})
    EXPECT_TRUE(std::filesystem::exists(project->folder() / name)) << name;
}

TEST_F(WalkTest, ValidatesAndFindsADamagedCapture) {
  EXPECT_EQ(acentric({"validate", project->file()}).exitCode, 0);
  const TemporaryFolder damaged("damaged");
  const auto& copy = damaged.path();
  std::filesystem::copy(project->folder(), copy, std::filesystem::copy_options::recursive);
  for (const auto& entry : std::filesystem::directory_iterator(copy / "gallery.captures"))
    if (entry.path().extension() == ".pack") {
      std::filesystem::resize_file(entry.path(), std::filesystem::file_size(entry.path()) / 2);
      const auto validated = acentric({"validate", (copy / "gallery.acentric.json").string()});
      EXPECT_EQ(validated.exitCode, 1);
      EXPECT_NE(validated.output.find(entry.path().filename().string()), std::string::npos)
          << validated.output;
      return;
    }
  FAIL() << "no capture to damage";
}

TEST_F(WalkTest, AnotherCellBakesOnlyWhatItAdds) {
  Json edited = project->read();
  const Json info = Json::parse(acentric({"info", project->file(), "--regions", "--json"}).output);
  const Json cell = info["regions"][0]["cell"];
  edited["storeys"][0]["layout"]["removed"] = Json::array({cell});
  const auto shrunk = project->folder() / "shrunk.acentric.json";
  std::ofstream(shrunk) << edited.dump(2);
  std::filesystem::copy(project->captures(), project->folder() / "shrunk.captures");
  const auto dry = acentric({"bake", shrunk.string(), "--dry-run", "--json"});
  ASSERT_EQ(dry.exitCode, 0) << dry.errors;
  EXPECT_EQ(Json::parse(dry.output)["missing"].size(), 0u) << "taking a cell away makes no camera stale";

  // Put back a cell whose captures were pruned with it: only its own cameras are baked again.
  ASSERT_EQ(acentric({"bake", shrunk.string(), "--prune"}).exitCode, 0);
  edited["storeys"][0]["layout"]["removed"] = Json::array();
  std::ofstream(shrunk) << edited.dump(2);
  const auto back = acentric({"bake", shrunk.string(), "--json"});
  ASSERT_EQ(back.exitCode, 0) << back.errors;
  EXPECT_LE(Json::parse(back.output)["baked"].get<int>(), 12);
  EXPECT_GT(Json::parse(back.output)["reused"].get<int>(), 10);
}

TEST_F(WalkTest, SaysWhatIsWrongAndExitsNonZero) {
  struct Case {
    std::vector<std::string> arguments;
    int exitCode;
    const char* said;
  };
  const std::vector<Case> cases = {
      {{"info", path("none.acentric.json")}, 1, "none.acentric.json"},
      {{"render", project->file(), "--eye", "1000,1000", "-o", path("x.png")}, 1, "outside"},
      {{"render", project->file(), "--eye", "a,b", "-o", path("x.png")}, 1, "--eye"},
      {{"render", project->file(), "--size", "0x10", "-o", path("x.png")}, 1, "--size"},
      {{"render", project->file(), "--fov", "200", "-o", path("x.png")}, 1, "field of view"},
      {{"render", project->file(), "-o", "/proc/none/x.png"}, 1, "/proc/none"},
      {{"bake", project->file(), "--only", "100000"}, 1, "100000"},
      {{"new", path("gallery.glb"), "-o", project->file()}, 1, "--force"},
      {{"new", path("none.glb"), "-o", path("n.acentric.json")}, 1, "none.glb"},
      {{"new", path("gallery.glb"), "-o", path("n.acentric.json"), "--config", "h"}, 1, "choose one of"},
      {{"render", project->file()}, 2, "--output"},
      {{"frobnicate"}, 2, "subcommand"},
  };
  for (const Case& c : cases) {
    const auto result = acentric(c.arguments);
    EXPECT_EQ(result.exitCode, c.exitCode) << c.arguments[0] << " " << result.errors;
    EXPECT_NE((result.errors + result.output).find(c.said), std::string::npos)
        << c.said << " not in: " << result.errors;
  }
  EXPECT_FALSE(std::filesystem::exists(path("x.png")));
  EXPECT_FALSE(std::filesystem::exists(path("n.acentric.json")));
}

}  // namespace
}  // namespace acentric::test
