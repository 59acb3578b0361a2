#include "engine/view_gl/capture_builder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <semaphore>

#include "engine/view_gl/capture_piece.h"
#include "engine/view_gl/packed_capture.h"
#include "gl_fixture.h"
#include "tests/view/capture_fixtures.h"

namespace acentric {
namespace {

using CapturePtr = std::shared_ptr<const DisplayCapture>;

CapturePtr captureOf(unsigned seed, int columns = 60, int rows = 80) {
  const Capture made =
      test::capture(test::randomBoxes(seed, 40, 2), test::cameraAt({0, 0, 1.6}, 20, columns, rows), nullptr);
  return std::make_shared<const DisplayCapture>(prepareForDisplay(made, 1));
}

std::string nameOf(int camera) { return captureName(camera, Mirrors::none); }
CaptureTask taskOf(const CapturePtr& capture, int camera, CaptureParts parts = CaptureParts::samples) {
  constexpr std::size_t kLarge = std::size_t(1) << 27;
  return {capture, nameOf(camera), parts, kLarge, kLarge};
}

bool any(const CaptureTask& /*task*/) { return true; }

/// What is built, once there is so much.
std::vector<CaptureBuilder::Built> take(CaptureBuilder& builder, std::size_t count) {
  std::vector<CaptureBuilder::Built> all;
  for (int i = 0; i < 60'000 && all.size() < count; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    while (auto built = builder.takeBuilt(any)) all.push_back(std::move(*built));
  }
  EXPECT_EQ(all.size(), count);
  return all;
}

TEST(CaptureBuilder, BuildsWhatIsWantedInOrderAsItIsBuiltWithoutWaiting) {
  std::counting_semaphore<> wakes{0};
  CaptureBuilder builder([&] { wakes.release(); });
  const std::vector<CapturePtr> captures = {captureOf(1), captureOf(2), captureOf(3)};
  builder.want(
      {taskOf(captures[0], 4), taskOf(captures[1], 7, CaptureParts::background), taskOf(captures[2], 9)});
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(wakes.try_acquire_for(std::chrono::seconds(60)));
  const std::vector<CaptureBuilder::Built> built = take(builder, 3);
  EXPECT_FALSE(builder.anyBuilt());
  for (std::size_t i = 0; i < built.size(); ++i) {
    ASSERT_TRUE(built[i].packed);
    EXPECT_EQ(built[i].task.capture.lock(), captures[i]);
    const auto expected = packCapture(*captures[i], built[i].task);
    ASSERT_TRUE(expected);
    EXPECT_EQ(built[i].packed->bytes(), expected->bytes());
    EXPECT_EQ(built[i].packed->chunks.empty(), i == 1);
  }
}

TEST(CaptureBuilder, BuildsNothingTwiceThatIsWantedAgain) {
  CaptureBuilder builder({});
  const CapturePtr first = captureOf(1), second = captureOf(2);
  for (int i = 0; i < 50; ++i) builder.want({taskOf(first, 0), taskOf(second, 1)});
  take(builder, 2);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(builder.anyBuilt());
  builder.want({taskOf(first, 0, CaptureParts::background)});
  EXPECT_EQ(take(builder, 1).at(0).task.parts, CaptureParts::background);
}

TEST(CaptureBuilder, GivesUpWhatIsOfNoUseAndBuildsItWhenItIsAgain) {
  CaptureBuilder builder({});
  CapturePtr large = captureOf(3, 700, 700);
  const std::weak_ptr<const DisplayCapture> watched = large;
  const CapturePtr small = captureOf(4);
  for (int round = 0; round < 5; ++round) {
    builder.want({taskOf(large, 0), taskOf(small, 1)});
    std::this_thread::sleep_for(std::chrono::milliseconds(3 * round));
    builder.keepOnly([&](const CaptureTask& task) { return task.name == nameOf(1); });
    EXPECT_EQ(take(builder, 1).at(0).task.name, nameOf(1)) << round;
  }
  builder.want({taskOf(large, 0)});
  EXPECT_EQ(take(builder, 1).at(0).task.name, nameOf(0));
  builder.want({taskOf(large, 0, CaptureParts::background)});
  large.reset();
  builder.keepOnly([](const CaptureTask&) { return false; });
  EXPECT_TRUE(test::isLetGoOf(watched));
  EXPECT_FALSE(builder.anyBuilt());
}

TEST(CaptureBuilder, KeepsNoCaptureInMemoryThatOnlyWaits) {
  std::binary_semaphore goOn{0};
  std::atomic<bool> held = true;
  const auto holdTheFirst = [&] {
    if (held.exchange(false)) goOn.acquire();
  };
  CaptureBuilder builder(holdTheFirst);
  const CapturePtr first = captureOf(3), last = captureOf(5);
  CapturePtr waiting = captureOf(4);
  const std::weak_ptr<const DisplayCapture> evicted = waiting;
  builder.want({taskOf(first, 0)});
  EXPECT_EQ(take(builder, 1).at(0).task.name,
            nameOf(0));  // it is held, or about to be: it can begin nothing more
  builder.want({taskOf(waiting, 1), taskOf(last, 2)});
  waiting.reset();
  EXPECT_TRUE(evicted.expired());
  goOn.release();
  EXPECT_EQ(take(builder, 1).at(0).task.name, nameOf(2));
}

TEST(CaptureBuilder, BeginsNothingWhileMuchIsBuiltAndNotTaken) {
  std::counting_semaphore<> wakes{0};
  CaptureBuilder builder([&] { wakes.release(); }, 1);
  const CapturePtr first = captureOf(1), second = captureOf(2);
  builder.want({taskOf(first, 0), taskOf(second, 1)});
  for (const int camera : {0, 1}) {
    ASSERT_TRUE(wakes.try_acquire_for(std::chrono::seconds(60)));
    EXPECT_FALSE(wakes.try_acquire_for(std::chrono::milliseconds(50)));
    EXPECT_FALSE(builder.takeBuilt([](const CaptureTask&) { return false; }));
    const auto built = builder.takeBuilt(any);
    ASSERT_TRUE(built);
    EXPECT_EQ(built->task.name, nameOf(camera));
  }
  EXPECT_FALSE(builder.anyBuilt());
}

TEST(CaptureBuilder, IsDestroyedWhileItBuilds) {
  const CapturePtr large = captureOf(3, 700, 700), other = captureOf(4, 700, 700);
  for (int round = 0; round < 6; ++round) {
    std::atomic<int> wakes = 0;
    CaptureBuilder builder([&] { ++wakes; });
    builder.want({taskOf(large, 0), taskOf(other, 1)});
    std::this_thread::sleep_for(std::chrono::milliseconds(2 * round));
  }
  EXPECT_EQ(large.use_count(), 1);
  EXPECT_EQ(other.use_count(), 1);
}

TEST(CaptureBuilder, TellsWhatIsWrongWithACapture) {
  CaptureBuilder builder({});
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

}  // namespace
}  // namespace acentric
