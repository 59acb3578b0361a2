#include "editor/session/bake_queue.h"

#include <gtest/gtest.h>

namespace acentric::editor {
namespace {

constexpr CameraStage kTracing = CameraStage::tracing, kWriting = CameraStage::writing;

/// Cameras 0.. of one storey, of 100 pixels each.
BakeQueue queueOf(int cameras) {
  std::vector<QueuedCamera> rows;
  for (int camera = 0; camera < cameras; ++camera) rows.push_back({0, camera, 100});
  BakeQueue queue;
  queue.begin(std::move(rows));
  return queue;
}

CameraNews news(int camera, CameraStage stage, int columnsDone = 0, std::uint64_t rays = 0) {
  return {camera, stage, false, 10, columnsDone, rays};
}

TEST(BakeQueue, FollowsACameraFromWaitingToDone) {
  BakeQueue queue = queueOf(2);
  EXPECT_EQ(queue.count(CameraStage::waiting), 2);
  queue.tell(0, 0, news(1, kTracing));
  EXPECT_EQ(queue.current(), 1u);
  queue.tell(1, 0, news(1, kTracing, 5));
  EXPECT_EQ(queue.cameras()[1].traced, 0.5);
  EXPECT_EQ(queue.share(), 0.25);
  queue.tell(2, 0, news(1, kWriting, 10));
  EXPECT_EQ(queue.count(kWriting), 1);
  EXPECT_EQ(queue.finished(), 0);
  queue.tell(3, 0, news(1, CameraStage::done, 10));
  EXPECT_EQ(queue.finished(), 1);
  EXPECT_EQ(queue.share(), 0.5);
  CameraNews failed = news(0, CameraStage::failed);
  failed.error = "the disk is full";
  queue.tell(4, 0, failed);
  EXPECT_EQ(queue.cameras()[0].error, "the disk is full");
  queue.tell(5, 0, news(77, kTracing));
  queue.tell(5, 9, news(0, kTracing));
  EXPECT_EQ(queue.finished(), 2) << "news of cameras that are not in the list";
}

TEST(BakeQueue, CapturesThatAreThereAlreadyAreNoPartOfTheWork) {
  BakeQueue queue;
  queue.begin({{0, 0, 100, CameraStage::reused}, {0, 1, 100}, {0, 2, 300}});
  EXPECT_EQ(queue.toBake(), 2);
  EXPECT_EQ(queue.finished(), 0);
  queue.tell(0, 0, news(0, CameraStage::reused));
  EXPECT_EQ(queue.finished(), 0);
  EXPECT_EQ(queue.share(), 0);
  queue.tell(0, 0, news(1, kTracing));
  queue.tell(1, 0, news(1, kWriting, 10));
  queue.tell(2, 0, news(1, CameraStage::done, 10));
  EXPECT_EQ(queue.finished(), 1);
  EXPECT_EQ(queue.share(), 0.25);
}

TEST(BakeQueue, APreviewLeavesItsCameraWaiting) {
  BakeQueue queue = queueOf(3);
  CameraNews preview = news(2, kTracing, 5);
  preview.preview = true;
  queue.tell(0, 0, preview);
  EXPECT_TRUE(queue.cameras()[2].previewing);
  EXPECT_EQ(queue.share(), 0);
  for (const CameraStage stage : {kWriting, CameraStage::done, CameraStage::done}) {
    preview.stage = stage;
    queue.tell(1, 0, preview);
  }
  EXPECT_EQ(queue.cameras()[2].stage, CameraStage::waiting);
  EXPECT_EQ(queue.previewed(), 1);
  EXPECT_EQ(queue.secondsLeft(1), std::nullopt) << "its rate is not the captures'";
}

TEST(BakeQueue, TellsRatesAndTheTimeThatIsLeftFromThem) {
  BakeQueue queue = queueOf(11);
  queue.tell(0, 0, news(0, CameraStage::reused));
  for (int camera = 1; camera <= 5; ++camera) {
    const double began = 2.0 * (camera - 1);
    queue.tell(began, 0, news(camera, kTracing));
    queue.tell(began + 1, 0, news(camera, kTracing, 5, 3000));
    queue.tell(began + 2, 0, news(camera, kWriting, 10, 6000));
    queue.tell(began + 2, 0, news(camera, CameraStage::done, 10, 6000));
  }
  // 50 pixels a second, and 500 are left.
  ASSERT_TRUE(queue.secondsLeft(10));
  EXPECT_NEAR(*queue.secondsLeft(10), 10, 1e-9);
  EXPECT_NEAR(*queue.secondsLeft(13), 7, 1e-9);
  EXPECT_NEAR(*queue.raysPerSecond(), 3000, 1e-9);
  queue.pause();
  EXPECT_EQ(queue.secondsLeft(100), std::nullopt);
  queue.tell(100, 0, news(6, kTracing));
  queue.tell(101, 0, news(6, kTracing, 5));
  EXPECT_NEAR(*queue.secondsLeft(101), 9, 1e-9) << "the pause counts for nothing";
  queue.end();
  EXPECT_EQ(queue.count(kTracing), 0);
  EXPECT_EQ(queue.finished(), 6);
}

}  // namespace
}  // namespace acentric::editor
