/// Stairs and ramps between storeys, as a user has them baked and walked: a hall with a flight of steps and a
/// ramp.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "editor/actions/path_walk.h"
#include "tests/end_to_end/sample_project.h"
#include "tests/support/stair_hall.h"

namespace acentric::test {
namespace {
using testing::HasSubstr;

class StairsTest : public testing::Test {
 protected:
  void SetUp() override { StairHall::write(folder.path() / "hall.obj"); }

  /// Floors at 0, 0.9 and 2.7 m, and what lies between.
  Json make(std::vector<std::string> more = {"--stairs"}) {
    std::vector<std::string> arguments = {"new",
                                          (folder.path() / "hall.obj").string(),
                                          "-o",
                                          file,
                                          "--up",
                                          "z",
                                          "--storey",
                                          "all",
                                          "--cell",
                                          "3",
                                          "--samples-per-degree",
                                          "2",
                                          "--no-estimate",
                                          "--force"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return jsonOf(arguments);
  }
  Json read() const { return Json::parse(std::ifstream(file), nullptr, false); }
  std::string refusal(std::vector<std::string> arguments) const {
    const auto result = acentric(arguments);
    EXPECT_EQ(result.exitCode, 1);
    return result.errors;
  }

  TemporaryFolder folder{"stairs"};
  std::string file = (folder.path() / "hall.acentric.json").string();
};

TEST_F(StairsTest, AreLaidOutBakedAndDrawnAlongThePathThatLeadsUpThem) {
  make();
  Json project = read();
  int pieces = 0;
  for (const Json& storey : project["storeys"]) pieces += storey["layout"].contains("slope") ? 1 : 0;
  EXPECT_GE(pieces, 8 + 3) << "2.7 m of steps and 0.9 m of ramp in pieces of up to 0.3 m";
  EXPECT_LE(pieces, 20);
  ASSERT_EQ(project["paths"].size(), 2u);

  // Only the flight is baked: as many floors as that one path needs.
  project["bake"]["ambientRays"] = 4;
  project["bake"]["surfaceTexel"] = 0.2;
  std::ofstream(file) << project.dump(2);
  for (const Json& path : project["paths"]) {
    const Json& poses = path["poses"];
    EXPECT_LT(poses.front()[3].get<double>(), 1.6 + 0.32);
    EXPECT_GT(poses.back()[3].get<double>(), 1.6 + 0.6);
    const std::string stairs = path["name"];
    for (const Json& storey : project["storeys"])
      if (storey["name"].get<std::string>().starts_with(stairs + "."))
        jsonOf({"bake", file, "--storey", storey["name"].get<std::string>()});
    const Json measured = jsonOf(
        {"measure", file, "--path", stairs, "--size", "320x180", "--frames", "6", "--truth-samples", "4"});
    EXPECT_EQ(measured["warnings"].size(), 0u) << measured["warnings"];
    for (const Json& frame : measured["frames"]) {
      EXPECT_GT(frame["psnr"].get<double>(), 22) << frame;
      EXPECT_LT(frame["holeShare"].get<double>(), 0.01) << frame;
    }
    EXPECT_GT(measured["frames"].back()["eye"][2].get<double>(),
              measured["frames"].front()["eye"][2].get<double>() + 0.4);
  }
}

TEST_F(StairsTest, AreWalkedUpAndDownByKeysInTheEditorAndRecorded) {
  make();
  editor::SessionOptions options;
  options.importHost.importer = ACENTRIC_IMPORTER;
  options.importHost.cacheFolder = folder.path() / "cache";
  editor::Session session(options);
  double now = 0;
  constexpr double kFrame = 1.0 / 60;
  session.open(file);
  for (int i = 0; i < 12000 && !(session.built() && !session.opening().running()); ++i) {
    session.poll(now += 0.01);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_TRUE(session.built());
  const int lower = session.project().storey;
  EXPECT_NEAR(session.project().layout().floorHeight, 0, 1e-3);
  editor::EditorState state;
  editor::ActionContext c{session, state};
  const auto eye = [&] { return state.walker.pose().eye; };
  const auto walk = [&](double seconds, const editor::WalkKeys& keys) {
    double most = 0;
    for (int i = 0; i < int(seconds / kFrame); ++i) {
      const double z = eye().z;
      session.poll(now += kFrame);
      editor::walkByKeys(c, kFrame, keys);
      editor::recordEye(c, now);
      // As the panel does in each frame: what is baked bounds the eye.
      const editor::WalkPose stands = editor::standing(*session.built(), state.walker.pose());
      EXPECT_LT(glm::distance(stands.eye, eye()), 0.02) << eye().x << ", storey " << session.project().storey;
      state.walker.setPose(stands);
      most = std::max(most, std::abs(eye().z - z));
    }
    EXPECT_LT(most, 0.05) << "a jump";
  };
  state.walker.standAt(editor::standing(*session.built(), {{2, StairHall::kFlightY, 1.6}, 0, 0}));
  editor::startOrStopRecording(c);
  walk(6.5, {.forward = true});
  EXPECT_GT(eye().x, StairHall::kFlightEnd + 1);
  EXPECT_NEAR(eye().z, StairHall::kUpper + 1.6, 1e-2);
  EXPECT_NEAR(session.project().layout().floorHeight, StairHall::kUpper, 1e-3);
  EXPECT_EQ(session.built()->project.storey, session.project().storey);
  EXPECT_FALSE(session.dirty()) << "walking is no edit";
  EXPECT_FALSE(session.history().canUndo());
  walk(0.5, {});
  walk(6.5, {.back = true});
  EXPECT_EQ(session.project().storey, lower);
  EXPECT_NEAR(eye().z, 1.6, 1e-2);
  walk(0.5, {});
  editor::startOrStopRecording(c);

  ASSERT_EQ(session.project().paths.size(), 3U) << "two that lead up the stairs, and this one";
  const WalkPath& recorded = session.project().paths.back();
  EXPECT_EQ(recorded.storey, lower);
  EXPECT_EQ(editor::posesOutside(recorded, *session.built()), 0);
  editor::selectWalk(c, {editor::WalkSelection::Kind::path, 2, {}});
  editor::playOrPause(c);
  double highest = 0;
  for (int i = 0; i < 2000 && editor::followPath(c, now += kFrame, false); ++i) {
    session.poll(now);
    ++state.picturesShown;
    highest = std::max(highest, eye().z);
  }
  EXPECT_NEAR(highest, StairHall::kUpper + 1.6, 0.02);
  EXPECT_NEAR(eye().z, 1.6, 0.02);
}

TEST_F(StairsTest, AreAddedToAProjectAndTakenOutAgain) {
  make({});
  const Json before = read();
  ASSERT_EQ(before["storeys"].size(), 3u);
  const Json added = jsonOf({"storeys", file, "--add-stairs", "0:2"});
  EXPECT_EQ(added["stairs"]["ways"], 1);
  EXPECT_GE(added["stairs"]["pieces"], 8);
  EXPECT_TRUE(added["storeys"].back()["stairs"].get<bool>());
  const Json all = jsonOf({"storeys", file, "--add-stairs", "all"});
  EXPECT_EQ(all["stairs"]["ways"], 1) << "the ramp; the flight has cells";
  ASSERT_EQ(all["stairs"]["leftOut"].size(), 1u);
  EXPECT_THAT(all["stairs"]["leftOut"][0].get<std::string>(), HasSubstr("has cells"));
  for (const Json& storey : jsonOf({"check", file, "--storey", "stairs 1.3", "--all"})) (void)storey;
  jsonOf({"storeys", file, "--remove-stairs"});
  EXPECT_EQ(read(), before) << "without a trace";
}

TEST_F(StairsTest, RefusalsSayTheWayOut) {
  const std::string model = (folder.path() / "hall.obj").string();
  EXPECT_THAT(refusal({"new", model, "-o", file, "--up", "z", "--stairs"}), HasSubstr("--storey all"));
  make({});
  EXPECT_THAT(refusal({"storeys", file, "--add-stairs", "some"}), HasSubstr("LOWER:UPPER"));
  EXPECT_THAT(refusal({"storeys", file, "--add-stairs", "0:attic"}), HasSubstr("attic"));
  EXPECT_THAT(refusal({"storeys", file, "--add-stairs", "1:2"}),
              testing::AllOf(HasSubstr("no stairs"), HasSubstr("storey 1"), HasSubstr("storey 2")));
  Json project = read();
  project["storeys"][0]["layout"]["slope"] = {{"at", {0, 0}}, {"rise", {1.9, 1.9}}};
  std::ofstream(file) << project.dump(2);
  EXPECT_THAT(refusal({"info", file}),
              testing::AllOf(HasSubstr("/storeys/0/layout"), HasSubstr("rise"), HasSubstr("0..2")));
  project["storeys"][0]["layout"]["slope"] = {{"at", {0, 0}}};
  std::ofstream(file) << project.dump(2);
  EXPECT_THAT(refusal({"info", file}), HasSubstr("/storeys/0/layout/slope"));
}

}  // namespace
}  // namespace acentric::test
