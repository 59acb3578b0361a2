/// The sample project as it ships: nothing is wrong with it, for the command line and in the editor's list,
/// and its walk stays where one can stand.

#include <gtest/gtest.h>

#include <thread>

#include "editor/session/session.h"
#include "engine/pipeline/camera_path.h"
#include "engine/pipeline/walk_ground.h"
#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

namespace fs = std::filesystem;

class ShippedSample : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder("shipped_sample");
    fs::copy_file(ACENTRIC_SAMPLE_SCENE, folder_->path() / "gallery.glb");
    fs::copy_file(fs::path(ACENTRIC_SAMPLE_PROJECT) / "gallery.acentric.json", file());
  }
  static void TearDownTestSuite() { delete folder_; }
  static fs::path file() { return folder_->path() / "gallery.acentric.json"; }

  /// Opened, with every check of the layout done.
  static void openAndCheck(editor::Session& session) {
    session.open(file());
    double now = 0;
    const auto settled = [&] {
      if (!session.built()) return false;
      session.askForInspection(true);
      return session.inspection() != nullptr && session.inspection()->layout == session.built()->layout &&
             session.captures() != nullptr && !session.working();
    };
    for (int i = 0; i < 36000 && !settled(); ++i) {
      session.poll(now += 0.01);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_TRUE(settled());
    session.poll(now += 1);
  }
  static editor::SessionOptions options() {
    editor::SessionOptions options;
    options.importHost.importer = ACENTRIC_IMPORTER;
    options.importHost.cacheFolder = folder_->path() / "cache";
    return options;
  }

  static inline TemporaryFolder* folder_ = nullptr;
};

TEST_F(ShippedSample, HasNothingForTheChecksToTell) {
  const auto ran = acentric({"check", file().string(), "--json"});
  ASSERT_EQ(ran.exitCode, 0) << ran.errors;
  const Json report = Json::parse(ran.output, nullptr, false);
  EXPECT_GT(report.value("centres", 0), 0);
  EXPECT_EQ(report["findings"], Json::array());
  EXPECT_FALSE(report.value("ignoredSides", true));
}

TEST_F(ShippedSample, OpensInTheEditorWithAnEmptyListButForTheBake) {
  editor::Session session(options());
  openAndCheck(session);
  ASSERT_FALSE(HasFatalFailure());
  ASSERT_EQ(session.problems().size(), 1U);
  const editor::Problem& only = session.problems().front();
  EXPECT_EQ(only.severity, Severity::note);
  EXPECT_EQ(only.text, "Nothing is baked yet");
}

TEST_F(ShippedSample, HasAPlaceToStandAllOverItsOutlineAndAlongItsWalk) {
  editor::Session session(options());
  openAndCheck(session);
  ASSERT_FALSE(HasFatalFailure());
  const Layout& layout = *session.built()->layout;
  const auto walk = loadPath(fs::path(ACENTRIC_SAMPLE_PROJECT) / "paths" / "walk.json");
  ASSERT_TRUE(walk.has_value()) << walk.error().describe();
  for (const PathPose& pose : walk->poses)
    EXPECT_TRUE(mayStand(layout, glm::dvec2(pose.eye))) << pose.eye.x << ", " << pose.eye.y;
  EXPECT_TRUE(mayStand(layout, session.project().spawn().position));
  int stood = 0;
  for (double x = -7; x <= 7; x += 0.1)
    for (double y = -5; y <= 5; y += 0.1) {
      if (!layout.spec.outline.contains({x, y})) continue;
      ++stood;
      EXPECT_TRUE(layout.regionAt({x, y})) << x << ", " << y;
    }
  // Of a hall of 140 square metres, with benches, plants and a glass case: most can be walked.
  EXPECT_GT(0.01 * stood, 90);
}

}  // namespace
}  // namespace acentric::test
