/// From a model file to a walk, as a user types it.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

std::string bytesOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

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

TEST_F(WalkTest, APixelTellsWhatPaintedItAndWhatWouldImproveIt) {
  const Json answer = jsonOf({"ask", project->file(), "--size", "160x90", "--pixel", "80,40"});
  EXPECT_EQ(answer["pixel"], Json({80, 40}));
  ASSERT_TRUE(answer.contains("painter")) << answer.dump();
  EXPECT_GT(answer["painter"]["metres"].get<double>(), 0);
  EXPECT_LT(answer["painter"]["samplesPerPixel"].get<double>(), 1) << "1 sample per degree";
  const double now = answer["around"]["psnr"].get<double>();
  ASSERT_FALSE(answer["improvements"].empty());
  EXPECT_LE(answer["improvements"].size(), 3u);
  double last = 1e9;
  for (const Json& each : answer["improvements"]) {
    const double promised = each["psnr"].get<double>();
    EXPECT_GT(promised, now + 0.09) << each;
    EXPECT_LE(promised, last) << "the best first";
    EXPECT_GT(each["bake"]["cameras"].get<int>(), 0) << each;
    last = promised;
  }
  const auto brief = acentric({"ask", project->file(), "--size", "160x90", "--no-improvements"});
  EXPECT_EQ(brief.exitCode, 0) << brief.errors;
  EXPECT_EQ(brief.output.rfind("pixel (80, 45): ", 0), 0u) << brief.output;
  for (const char* pixel : {"160,0", "0,90", "-1,3", "5", "5,", "a,b", "1,2,3"}) {
    const auto refused = acentric({"ask", project->file(), "--size", "160x90", "--pixel", pixel});
    EXPECT_NE(refused.exitCode, 0) << pixel;
    EXPECT_NE(refused.errors.find("give column,row within 160x90"), std::string::npos) << refused.errors;
  }
}

TEST_F(WalkTest, ALimitOfMemoryChangesNoPicture) {
  std::vector<std::string> pictures;
  for (const char* megabytes : {"1", "1000"}) {
    const auto folder = path((std::string("memory") + megabytes).c_str());
    const auto walked =
        acentric({"walk", project->file(), "--size", "160x90", "-o", folder, "--memory", megabytes});
    ASSERT_EQ(walked.exitCode, 0) << walked.errors;
    pictures.push_back(folder);
  }
  for (const char* frame : {"frame_00000.png", "frame_00031.png", "frame_00059.png"})
    EXPECT_EQ(bytesOf(std::filesystem::path(pictures[0]) / frame),
              bytesOf(std::filesystem::path(pictures[1]) / frame))
        << frame;
}

TEST_F(WalkTest, AWalkInRealTimeTellsWhatCameAndWent) {
  const auto ran = acentric({"bench", "view", project->file(), "--stream", "--renderers", "list", "--size",
                             "160x90", "--frames", "4", "--speed", "20", "--memory", "1", "--json"});
  ASSERT_EQ(ran.exitCode, 0) << ran.errors;
  const Json report = Json::parse(ran.output);
  EXPECT_GT(report["frames"].get<int>(), 0);
  EXPECT_LE(report["incompleteFrames"].get<int>() + report["coarseFrames"].get<int>(),
            report["frames"].get<int>());
  EXPECT_GT(report["loads"].get<int>(), 0);
  EXPECT_EQ(report["limitBytes"].get<std::uint64_t>(), 1'000'000U);
  EXPECT_GE(report["frameMsMax"].get<double>(), report["frameMsMedian"].get<double>());
  EXPECT_TRUE(report["warnings"].empty());
}

TEST_F(WalkTest, AWalkInRealTimeOnOpenGlWaitsForCapturesIfItIsToldTo) {
  const auto walked = acentric({"bench", "view", project->file(), "--stream", "--renderers", "gl", "--size",
                                "160x90", "--frames", "4", "--speed", "20", "--wait-for-captures", "--json"});
  ASSERT_EQ(walked.exitCode, 0) << walked.errors;
  const Json waiting = Json::parse(walked.output);
  EXPECT_EQ(waiting["gl"]["awaitingFrames"].get<int>(), 0);
  EXPECT_GT(waiting["gl"]["mostBytesSent"].get<std::uint64_t>(), 0U);
}

TEST_F(WalkTest, RendersWithEveryRendererAndTheyAgree) {
  ASSERT_EQ(acentric({"tour", project->file(), "-o", path("tour.json"), "--frames", "6"}).exitCode, 0);
  std::map<std::string, double> psnr;
  for (const std::string renderer : {"list", "scalar", "zbuffer", "patches by list", "patches by gl"}) {
    const bool patches =
        renderer.starts_with("patches");  // which a depth buffer does not draw, nor OpenGL splats
    const std::string by = patches ? renderer.substr(11) : renderer;
    const std::string reconstruction = patches ? "patches" : "splat";
    const auto picture = path((renderer + ".png").c_str());
    const auto rendered = acentric({"render", project->file(), "--size", "320x180", "--renderer", by,
                                    "--reconstruction", reconstruction, "-o", picture, "--json"});
    ASSERT_EQ(rendered.exitCode, 0) << renderer << ": " << rendered.errors;
    EXPECT_TRUE(std::filesystem::exists(picture));
    const auto measured =
        acentric({"measure", project->file(), "--path", path("tour.json"), "--size", "320x180", "--renderer",
                  by, "--reconstruction", reconstruction, "--json"});
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
  EXPECT_NEAR(psnr["patches by list"], psnr["patches by gl"], 0.1);
  const auto splats = acentric(
      {"render", project->file(), "--renderer", "gl", "--reconstruction", "splat", "-o", path("splats.png")});
  EXPECT_EQ(splats.exitCode, 1);
  EXPECT_NE(splats.errors.find("OpenGL draws patches"), std::string::npos) << splats.errors;
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

TEST_F(WalkTest, WritesEveryModeOfFramesWithATableOfHowTrueTheyAre) {
  ASSERT_EQ(acentric({"tour", project->file(), "-o", path("short.json"), "--frames", "3"}).exitCode, 0);
  const auto walked = acentric(
      {"walk", project->file(), "--path", path("short.json"), "-o", path("modes"), "--size", "160x90",
       "--modes", "picture,truth,difference,beside,sources,holes", "--truth-samples", "1", "--json"});
  ASSERT_EQ(walked.exitCode, 0) << walked.errors;
  for (const char* mode : {"frame", "truth", "difference", "beside", "sources", "holes"})
    for (const char* number : {"00000", "00001", "00002"})
      EXPECT_TRUE(
          std::filesystem::exists(project->folder() / "modes" / (mode + std::string("_") + number + ".png")));
  const Json report = Json::parse(walked.output);
  EXPECT_EQ(report["videoCommands"].size(), 6u);
  EXPECT_NE(report["videoCommands"][1].get<std::string>().find("truth_%05d.png"), std::string::npos);

  // What the walk says of its frames is what measure says of them.
  const auto measured =
      acentric({"measure", project->file(), "--path", path("short.json"), "--size", "160x90", "--json"});
  ASSERT_EQ(measured.exitCode, 0) << measured.errors;
  const Json truth = Json::parse(measured.output)["frames"];
  ASSERT_EQ(report["measured"].size(), truth.size());
  std::ifstream table(project->folder() / "modes" / "frames.csv");
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "frame,x,y,z,yaw,pitch,ms,open_share,psnr,ssim,hole_share");
  for (std::size_t i = 0; i < truth.size(); ++i) {
    for (const char* value : {"psnr", "ssim", "holeShare"})
      EXPECT_EQ(report["measured"][i][value], truth[i][value]);
    ASSERT_TRUE(std::getline(table, line));
    EXPECT_EQ(line.substr(0, 2), std::to_string(i) + ",");
    EXPECT_EQ(std::ranges::count(line, ','), 10);
  }
}

TEST_F(WalkTest, MeasuresSeamsAndPoppingAlongAPath) {
  ASSERT_EQ(acentric({"tour", project->file(), "-o", path("long.json"), "--frames", "12"}).exitCode, 0);
  const auto measured = acentric({"measure", project->file(), "--path", path("long.json"), "--size", "160x90",
                                  "--frames", "4", "--seams", "--crossings", "3", "--json"});
  ASSERT_EQ(measured.exitCode, 0) << measured.errors;
  const Json report = Json::parse(measured.output);
  EXPECT_GT(report["seams"]["pairs"].get<int>(), 0);
  EXPECT_GT(report["seams"]["within"]["pairs"].get<int>(), 1000);
  ASSERT_EQ(report["popping"]["list"].size(), 3u);
  for (const Json& crossing : report["popping"]["list"]) {
    EXPECT_NE(crossing["fromRegion"], crossing["toRegion"]);
    EXPECT_GT(crossing["pop"]["psnr"].get<double>(), 12);
    EXPECT_GT(crossing["step"]["psnr"].get<double>(), 12);
  }
}

TEST_F(WalkTest, ComparesWaysOfTakingPanoramas) {
  const auto benched = acentric({"bench", "holes", project->file(), "--size", "160x90", "--frames", "2", "-o",
                                 path("holes"), "--json"});
  ASSERT_EQ(benched.exitCode, 0) << benched.errors;
  const Json report = Json::parse(benched.output);
  ASSERT_EQ(report["methods"].size(), 6u);
  EXPECT_EQ(report["methods"][0]["frames"].size(), 2u);
  for (const char* name : {"holes/holes.png", "holes/holes.json", "holes/holes.txt"})
    EXPECT_TRUE(std::filesystem::exists(project->folder() / name)) << name;

  // A panorama in the middle of each ring is placed, and the bake knows of it.
  const auto dry = acentric({"layout", project->file(), "--panoramas", "rings", "--json"});
  ASSERT_EQ(dry.exitCode, 0) << dry.errors;
  EXPECT_GT(Json::parse(dry.output)["freeApvs"].get<int>(), 0);
  EXPECT_FALSE(Json::parse(dry.output)["applied"].get<bool>());
}

TEST_F(WalkTest, TellsWhichCameraPaintedWhat) {
  const auto rendered = acentric({"render", project->file(), "--size", "320x180", "--mode", "sources", "-o",
                                  path("sources.png"), "--json"});
  ASSERT_EQ(rendered.exitCode, 0) << rendered.errors;
  const Json report = Json::parse(rendered.output);
  double sum = 0, cameras = 0;
  for (const Json& source : report["sources"]) {
    sum += source["share"].get<double>();
    if (source.contains("camera")) cameras += source["share"].get<double>();
    EXPECT_EQ(source["colour"].get<std::string>().size(), 7u);
  }
  EXPECT_NEAR(sum, 1, 1e-9);
  EXPECT_GT(cameras, 0.2);
  const auto truth =
      acentric({"render", project->file(), "--renderer", "truth", "--mode", "holes", "-o", path("none.png")});
  EXPECT_EQ(truth.exitCode, 1);
  EXPECT_NE(truth.errors.find("--mode"), std::string::npos);
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
