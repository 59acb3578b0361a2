/// A walk is recorded in the editor's session, saved, opened again and replayed there, and played by the
/// command line.

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "editor/actions/path_walk.h"
#include "engine/pipeline/walk_ground.h"
#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

constexpr double kFrame = 1.0 / 60;

class RecordedWalk : public testing::Test {
 protected:
  RecordedWalk() : project_("recorded") {}
  editor::SessionOptions options() const {
    editor::SessionOptions options;
    options.importHost.importer = ACENTRIC_IMPORTER;
    options.importHost.cacheFolder = project_.folder() / "cache";
    return options;
  }
  void open(editor::Session& session) {
    session.open(project_.file());
    for (int i = 0; i < 12000 && !(session.built() && !session.opening().running()); ++i) {
      session.poll(now_ += 0.01);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_TRUE(session.built());
  }
  /// 60 frames a second for so long, with these keys held.
  void walk(editor::ActionContext& c, double seconds, const editor::WalkKeys& keys) {
    const Layout& layout = *c.session.built()->layout;
    for (int i = 0; i < int(seconds / kFrame); ++i) {
      now_ += kFrame;
      c.state.walker.step(
          kFrame, keys, {layout.eyeZ(), layout.eyeZ()},
          [&](const glm::dvec2& from, const glm::dvec2& to) { return walkTo(layout, from, to); });
      editor::recordEye(c, now_);
    }
  }
  int framesOf(const std::string& path, const char* folder) {
    const auto walked = acentric({"walk", project_.file(), "--path", path, "--renderer", "truth", "--size",
                                  "32x18", "-o", (project_.folder() / folder).string(), "--json"});
    EXPECT_EQ(walked.exitCode, 0) << walked.errors;
    return Json::parse(walked.output, nullptr, false).value("frames", 0);
  }

  SampleProject project_;
  double now_ = 0;
};

TEST_F(RecordedWalk, IsSavedWithItsProjectAndPlaysEverywhere) {
  ASSERT_EQ(project_.made().exitCode, 0) << project_.made().errors;
  const auto file = project_.folder() / "walk 1.json";
  WalkPath recorded;
  {
    editor::Session session(options());
    open(session);
    editor::EditorState state;
    editor::ActionContext c{session, state};
    const OpenProject& built = *session.built();
    state.walker.standAt(
        editor::standing(built, {{session.project().spawn().position, built.layout->eyeZ()}, 0.3, 0}));
    editor::startOrStopRecording(c);
    walk(c, 1.5, {.forward = true});
    walk(c, 0.5, {.turnLeft = true});
    walk(c, 0.5, {});
    editor::startOrStopRecording(c);
    ASSERT_EQ(session.project().paths.size(), 1u);
    recorded = session.project().paths[0];
    EXPECT_NEAR(recorded.path.seconds(), 2.0, 0.6);
    EXPECT_LE(recorded.path.poses.size(), 25u);
    EXPECT_EQ(editor::posesOutside(recorded, built), 0);
    ASSERT_TRUE(session.save());
    session.exportPath(0, file);
  }
  editor::Session session(options());
  open(session);
  editor::EditorState state;
  editor::ActionContext c{session, state};
  ASSERT_EQ(session.project().paths.size(), 1u);
  EXPECT_EQ(session.project().paths[0].name, "walk 1");
  EXPECT_EQ(session.project().paths[0].path.seconds(), recorded.path.seconds());
  editor::selectWalk(c, {editor::WalkSelection::Kind::path, 0, {}});
  editor::playOrPause(c);
  int frames = 0;
  while (editor::followPath(c, now_ += kFrame, false) && frames < 10000) {
    ++frames;
    ++state.picturesShown;
  }
  EXPECT_NEAR(frames * kFrame, recorded.path.seconds(), 0.05);
  EXPECT_LT(glm::distance(state.walker.pose().eye, recorded.path.poses.back().eye), 1e-6);
  EXPECT_NE(state.replayReport.find("frames in"), std::string::npos) << state.replayReport;

  const int expected = int(std::ceil(recorded.path.seconds() * kPathRate - 1e-6)) + 1;
  EXPECT_EQ(framesOf("walk 1", "by_name"), expected);
  EXPECT_EQ(framesOf(file.string(), "by_file"), expected);
}

TEST_F(RecordedWalk, WalkingTakesAReplayOver) {
  editor::Session session(options());
  open(session);
  editor::EditorState state;
  editor::ActionContext c{session, state};
  const glm::dvec2 start = session.project().spawn().position;
  const double z = session.built()->layout->eyeZ();
  editor::Session& s = session;
  Project changed = s.project();
  changed.paths = {{"walk 1", 0, {{{{start, z}, 0, 0, 0}, {{start, z}, 1, 0, 10}}}}};
  changed.bookmarks = {{"here", 0, {start, z}, 2, 0, 75}};
  ASSERT_TRUE(s.apply({changed, "test"}));
  editor::selectWalk(c, {editor::WalkSelection::Kind::path, 0, {}});
  editor::playOrPause(c);
  EXPECT_TRUE(editor::followPath(c, 1, false));
  EXPECT_TRUE(editor::followPath(c, 1.1, false));
  EXPECT_FALSE(editor::followPath(c, 1.2, true)) << "a key is held";
  EXPECT_FALSE(state.replay.playing());
  editor::playOrPause(c);
  EXPECT_TRUE(editor::followPath(c, 1.3, false));
  state.walker.look({40, 0}, 0.01);
  EXPECT_FALSE(editor::followPath(c, 1.4, false)) << "the head was turned";
  editor::playOrPause(c);
  EXPECT_TRUE(editor::followPath(c, 1.5, false));
  editor::goToBookmark(c, 0);
  editor::followPath(c, 1.6, false);
  EXPECT_EQ(state.walker.pose().yawRadians, 2);
  EXPECT_FALSE(state.replay.playing());
  EXPECT_EQ(s.project().fovDegrees, 75) << "as the bookmark was taken";
}

}  // namespace
}  // namespace acentric::test
