#include "engine/view_gl/capture_builder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <semaphore>

#include "engine/view_gl/packed_capture.h"
#include "engine/view_gl/packed_mesh.h"
#include "gl_fixture.h"
#include "tests/view/capture_fixtures.h"

namespace acentric {
namespace {

using MeshBuilder = CaptureBuilder<MeshTask, PackedMesh>;
using CapturePtr = std::shared_ptr<const DisplayCapture>;

CapturePtr captureOf(unsigned seed, int columns = 60, int rows = 80) {
  const Capture made =
      test::capture(test::randomBoxes(seed, 40, 2), test::cameraAt({0, 0, 1.6}, 20, columns, rows), nullptr);
  return std::make_shared<const DisplayCapture>(prepareForDisplay(made, 1));
}

MeshTask taskOf(const CapturePtr& capture, int camera, double error = 0.25) {
  return {capture, camera, "capture of camera " + std::to_string(camera), 2, error, 0, std::size_t(1) << 27};
}

bool any(const MeshTask& /*task*/) { return true; }

/// What is built, once there is so much.
std::vector<MeshBuilder::Built> take(MeshBuilder& builder, std::size_t count) {
  std::vector<MeshBuilder::Built> all;
  for (int i = 0; i < 60'000 && all.size() < count; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    while (auto built = builder.takeBuilt(any)) all.push_back(std::move(*built));
  }
  EXPECT_EQ(all.size(), count);
  return all;
}

TEST(CaptureBuilder, BuildsWhatIsWantedInOrderAsItIsBuiltWithoutWaiting) {
  std::counting_semaphore<> wakes{0};
  MeshBuilder builder(packMesh, 1, [&] { wakes.release(); });
  const std::vector<CapturePtr> captures = {captureOf(1), captureOf(2), captureOf(3)};
  builder.want({taskOf(captures[0], 4), taskOf(captures[1], 7, 2), taskOf(captures[2], 9)});
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(wakes.try_acquire_for(std::chrono::seconds(60)));
  const std::vector<MeshBuilder::Built> built = take(builder, 3);
  EXPECT_FALSE(builder.anyBuilt());
  TaskRunner runner(0);
  for (std::size_t i = 0; i < built.size(); ++i) {
    ASSERT_TRUE(built[i].packed);
    EXPECT_EQ(built[i].task.capture.lock(), captures[i]);
    const auto expected = packMesh(*captures[i], built[i].task, runner);
    ASSERT_TRUE(expected);
    const PackedMesh& mesh = *built[i].packed;
    EXPECT_EQ(mesh.cost.camera, built[i].task.camera);
    EXPECT_EQ(mesh.cost.error, i == 1 ? 2 : 0.25);
    EXPECT_GT(mesh.cost.triangles, 10u);
    EXPECT_EQ(mesh.cost.triangles, expected->cost.triangles);
    ASSERT_EQ(mesh.chunks.size(), expected->chunks.size());
    EXPECT_EQ(mesh.chunks[0].texels, expected->chunks[0].texels);
  }
}

TEST(CaptureBuilder, BuildsNothingTwiceThatIsWantedAgain) {
  MeshBuilder builder(packMesh, 1, {});
  const CapturePtr first = captureOf(1), second = captureOf(2);
  for (int i = 0; i < 50; ++i) builder.want({taskOf(first, 0), taskOf(second, 1)});
  take(builder, 2);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(builder.anyBuilt());
  builder.want({taskOf(first, 0, 1)});  // another mesh
  EXPECT_EQ(take(builder, 1).at(0).packed->cost.error, 1);
}

TEST(CaptureBuilder, GivesUpWhatIsOfNoUseAndBuildsItWhenItIsAgain) {
  MeshBuilder builder(packMesh, 1, {});
  CapturePtr large = captureOf(3, 700, 700);
  const std::weak_ptr<const DisplayCapture> watched = large;
  const CapturePtr small = captureOf(4);
  for (int round = 0; round < 5; ++round) {
    builder.want({taskOf(large, 0), taskOf(small, 1)});
    std::this_thread::sleep_for(std::chrono::milliseconds(3 * round));
    builder.keepOnly([&](const MeshTask& task) { return task.camera == 1; });
    EXPECT_EQ(take(builder, 1).at(0).task.camera, 1) << round;
  }
  builder.want({taskOf(large, 0)});
  EXPECT_EQ(take(builder, 1).at(0).task.camera, 0);
  builder.want({taskOf(large, 0, 3)});
  large.reset();
  builder.keepOnly([](const MeshTask&) { return false; });
  EXPECT_TRUE(test::isLetGoOf(watched));
  EXPECT_FALSE(builder.anyBuilt());
}

TEST(CaptureBuilder, KeepsNoCaptureInMemoryThatOnlyWaits) {
  std::binary_semaphore goOn{0};
  std::atomic<bool> held = true;
  const auto holdTheFirst = [&] {
    if (held.exchange(false)) goOn.acquire();
  };
  MeshBuilder builder(packMesh, 1, holdTheFirst);
  const CapturePtr first = captureOf(3), last = captureOf(5);
  CapturePtr waiting = captureOf(4);
  const std::weak_ptr<const DisplayCapture> evicted = waiting;
  builder.want({taskOf(first, 0)});
  EXPECT_EQ(take(builder, 1).at(0).task.camera, 0);  // it is held, or about to be: it can begin nothing more
  builder.want({taskOf(waiting, 1), taskOf(last, 2)});
  waiting.reset();
  EXPECT_TRUE(evicted.expired());
  goOn.release();
  EXPECT_EQ(take(builder, 1).at(0).task.camera, 2);
}

TEST(CaptureBuilder, BeginsNothingWhileMuchIsBuiltAndNotTaken) {
  struct Large {
    static std::size_t bytes() { return CaptureBuilder<MeshTask, Large>::kMostBytesBuilt + 1; }
  };
  using LargeBuilder = CaptureBuilder<MeshTask, Large>;
  std::counting_semaphore<> wakes{0};
  LargeBuilder builder([](const DisplayCapture&, const MeshTask&, TaskRunner&,
                          const std::stop_token&) { return Result<Large>(Large{}); },
                       1, [&] { wakes.release(); });
  const CapturePtr first = captureOf(1), second = captureOf(2);
  builder.want({taskOf(first, 0), taskOf(second, 1)});
  for (const int camera : {0, 1}) {
    ASSERT_TRUE(wakes.try_acquire_for(std::chrono::seconds(60)));
    EXPECT_FALSE(wakes.try_acquire_for(std::chrono::milliseconds(50)));
    EXPECT_FALSE(builder.takeBuilt([](const MeshTask&) { return false; }));
    const auto built = builder.takeBuilt(any);
    ASSERT_TRUE(built);
    EXPECT_EQ(built->task.camera, camera);
  }
  EXPECT_FALSE(builder.anyBuilt());
}

TEST(CaptureBuilder, IsDestroyedWhileItBuilds) {
  const CapturePtr large = captureOf(3, 700, 700), other = captureOf(4, 700, 700);
  for (int round = 0; round < 6; ++round) {
    std::atomic<int> wakes = 0;
    MeshBuilder builder(packMesh, 1 + round % 2, [&] { ++wakes; });
    builder.want({taskOf(large, 0), taskOf(other, 1)});
    std::this_thread::sleep_for(std::chrono::milliseconds(2 * round));
  }
  EXPECT_EQ(large.use_count(), 1);
  EXPECT_EQ(other.use_count(), 1);
}

TEST(CaptureBuilder, TellsWhatIsWrongWithACapture) {
  MeshBuilder builder(packMesh, 1, {});
  auto spoilt = std::make_shared<DisplayCapture>(*captureOf(1));
  spoilt->colour.pop_back();
  builder.want({taskOf(spoilt, 3)});
  const auto built = take(builder, 1);
  ASSERT_FALSE(built.at(0).packed);
  EXPECT_EQ(built[0].packed.error().kind, ErrorKind::malformed);
  EXPECT_EQ(built[0].packed.error().where, "capture of camera 3");
}

TEST(PackedCapture, IsCutBetweenColumnsIntoBuffersOfTheUsualSize) {
  const CapturePtr capture = captureOf(1);
  const std::size_t columns = std::size_t(capture->camera.columns);
  std::size_t longest = 0;
  for (std::size_t k = 0; k < columns; ++k)
    longest = std::max<std::size_t>(longest, capture->columnStart[k + 1] - capture->columnStart[k]);
  const std::size_t column = longest * sizeof(GlSample);
  const auto packed = [&](std::size_t usual, std::size_t largest) {
    return packCapture(*capture, {capture, "capture of camera 5", CaptureParts::samples, usual, largest});
  };
  const auto whole = packed(std::size_t(1) << 20, std::size_t(1) << 20);
  ASSERT_TRUE(whole);
  ASSERT_EQ(whole->chunks.size(), 1u);
  EXPECT_EQ(whole->bytes(), packedBytes(*capture, CaptureParts::samples));
  for (const std::size_t usual : {5 * column, std::size_t(12)}) {
    const auto cut = packed(usual, column * 6);
    ASSERT_TRUE(cut);
    EXPECT_GE(cut->chunks.size(), usual > column ? columns / 10 : columns / 2);
    std::size_t samples = 0;
    for (const PackedColumns& chunk : cut->chunks) {
      EXPECT_TRUE(bytesOf(chunk.samples) <= usual || chunk.lastColumn == chunk.firstColumn + 1);
      EXPECT_EQ(chunk.firstSample, samples);
      for (const GlSample& sample : chunk.samples) {
        const GlSample& same = whole->chunks[0].samples[samples++];
        EXPECT_EQ(sample.rowAndColumn, same.rowAndColumn);
        EXPECT_EQ(sample.inverseDistanceAndRoles, same.inverseDistanceAndRoles);
      }
    }
    EXPECT_EQ(samples, capture->samples.size());
  }
  const auto tooLong = packed(column, column - 1);
  ASSERT_FALSE(tooLong);
  EXPECT_EQ(tooLong.error().kind, ErrorKind::tooLarge);
  EXPECT_EQ(tooLong.error().where, "capture of camera 5");
  std::stop_source stop;
  stop.request_stop();
  const auto stopped = packCapture(*capture, {capture, "stopped"}, stop.get_token());
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, ErrorKind::cancelled);
}

TEST(PackedMesh, IsNotMadeOnceStopped) {
  const CapturePtr capture = captureOf(1);
  std::stop_source stop;
  stop.request_stop();
  TaskRunner runner(0);
  const auto packed = packMesh(*capture, taskOf(capture, 0), runner, stop.get_token());
  ASSERT_FALSE(packed);
  EXPECT_EQ(packed.error().kind, ErrorKind::cancelled);
  EXPECT_TRUE(buildLimitedMesh(*capture, 0.25, 2, 1, runner, stop.get_token()).mesh.patches.empty());
}

}  // namespace
}  // namespace acentric
