/// A bake of heavy captures, an estimate and a bake of light, each stopped at moments spread over all that
/// they do.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <thread>

#include "engine/base/file.h"
#include "engine/base/stopwatch.h"
#include "engine/pipeline/estimate_bake.h"
#include "tests/pipeline/small_project.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

/// On a machine that does nothing else it is well below one.
constexpr double kPromptSeconds = 5;

bool hasTemporaries(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(folder, error))
    if (entry.path().filename().string().starts_with(kTemporaryPrefix)) return true;
  return false;
}

class StopTest : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    test::SceneBuilder builder;
    const int paint = builder.material(test::matte({0.8f, 0.7f, 0.6f}));
    builder.box(paint, {-4, -4, 0}, {4, 4, 3}, true).point({0, 0, 2.5f}, 50);
    for (const glm::vec2 at : {glm::vec2(2, 2), glm::vec2(-2, 2), glm::vec2(2, -2), glm::vec2(-2, -2.5f)})
      builder.box(paint, {at.x - 0.3f, at.y - 0.3f, 0.1f}, {at.x + 0.3f, at.y + 0.3f, 2});
    Project project = test::smallProject(0.3, 10);
    project.bake.surfaceTexel = 1;
    project.bake.ambientRays = 4;
    project.bake.testEyes = 1;
    open_ = test::openWith(builder.rays(), project);
  }

  /// Of a project of its own, without anything baked.
  OpenProject fresh(int number) const {
    OpenProject open = open_;
    open.file = folder_ / std::to_string(number) / "room.acentric.json";
    fs::create_directories(open.file.parent_path());
    return open;
  }

  struct Ended {
    bool finished = false;
    double secondsAfterStop = 0;
  };
  /// `work(stop)` with a stop after `seconds`.
  template <class Work>
  static Ended stopAfter(double seconds, const Work& work) {
    std::stop_source stop;
    Stopwatch sinceStop;
    std::jthread timer([&] {
      std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
      sinceStop = {};
      stop.request_stop();
    });
    const auto result = work(stop.get_token());
    timer.join();
    if (result) return {true, 0};
    EXPECT_EQ(result.error().kind, ErrorKind::cancelled) << result.error().describe();
    return {false, sinceStop.seconds()};
  }

  OpenProject open_;
};

TEST_F(StopTest, ABakeEndsSoonAtAnyMomentAndWhatItLeavesIsSound) {
  BakeRequest request;
  request.coarseFirst = true;
  request.cameras = std::vector{0, 1, 2};
  TaskRunner runner(1);
  const Stopwatch whole;
  const auto finished = bakeProject(fresh(0), request, runner);
  ASSERT_TRUE(finished) << finished.error().describe();
  const double seconds = whole.seconds();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> moment(0, seconds);
  double worst = 0;
  int stopped = 0;
  for (int n = 1; n <= 4; ++n) {
    const OpenProject open = fresh(n);
    const Ended ended = stopAfter(moment(random), [&](const std::stop_token& stop) {
      return bakeProject(open, request, runner, {}, stop);
    });
    worst = std::max(worst, ended.secondsAfterStop);
    stopped += ended.finished ? 0 : 1;
    EXPECT_FALSE(hasTemporaries(open.file.parent_path()));
    const auto store = CaptureStore::open(captureFolderFor(open.file));
    ASSERT_TRUE(store);
    for (const auto& entry : fs::directory_iterator(store->folder())) {
      if (entry.path().extension() != ".pack") continue;
      const auto key = ContentKey::fromHex(entry.path().stem().string());
      ASSERT_TRUE(key);
      EXPECT_EQ(store->inspect(*key, true)->condition, CaptureStore::Condition::sound);
    }
    if (n > 1) continue;
    const auto again = bakeProject(open, request, runner);
    ASSERT_TRUE(again) << again.error().describe();
    EXPECT_EQ(again->captures.baked + again->captures.reused, int(request.cameras->size()));
    EXPECT_TRUE(again->damaged.empty());
    for (const int camera : *request.cameras) EXPECT_TRUE(store->has(open.keys[std::size_t(camera)]));
    EXPECT_TRUE(surfaceLightBaked(open));
  }
  EXPECT_GT(stopped, 0);
  EXPECT_LT(worst, kPromptSeconds);
  RecordProperty("worstSeconds", std::to_string(worst));
}

/// Where nothing is gathered yet, each ray of light may lead to a place that has to be lit first.
TEST_F(StopTest, ABakeEndsSoonWhileItFollowsManyBounces) {
  OpenProject bouncing = open_;
  bouncing.project.bake.bounces = 8;
  bouncing.project.bake.ambientRays = 1024;
  bouncing.project.bake.surfaceTexel = 0.005;
  ASSERT_TRUE(bouncing.plan.on(Effect::diffuseInterreflection));
  TaskRunner runner(1);
  double worst = 0;
  for (int n = 1; n <= 4; ++n) {
    OpenProject open = bouncing;
    open.file = fresh(n).file;
    BakeRequest request;
    request.cameras.emplace();
    if (n % 2 == 0) request.cameras->push_back(0);  // else the light on surfaces
    const Ended ended = stopAfter(
        0.3 * n, [&](const std::stop_token& stop) { return bakeProject(open, request, runner, {}, stop); });
    EXPECT_FALSE(ended.finished);
    worst = std::max(worst, ended.secondsAfterStop);
    EXPECT_FALSE(hasTemporaries(open.file.parent_path()));
  }
  EXPECT_LT(worst, kPromptSeconds);
  RecordProperty("worstSeconds", std::to_string(worst));
}

TEST_F(StopTest, AnEstimateEndsSoonAtAnyMomentAndLeavesNothing) {
  TaskRunner runner(1);
  EstimateOptions options;
  options.effort = 0.1;
  options.surfaceLight = true;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> moment(0, 2);
  for (int n = 0; n < 4; ++n) {
    const OpenProject open = fresh(n);
    const Ended ended = stopAfter(moment(random), [&](const std::stop_token& stop) {
      return estimateProjectBake(open, {}, options, runner, {}, stop);
    });
    EXPECT_LT(ended.secondsAfterStop, kPromptSeconds);
    EXPECT_TRUE(fs::is_empty(open.file.parent_path()));
  }
}

}  // namespace
}  // namespace acentric
