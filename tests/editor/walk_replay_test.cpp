#include "editor/tools/walk_replay.h"

#include <gtest/gtest.h>

#include "editor/tools/walk_recorder.h"

namespace acentric::editor {
namespace {

constexpr double kFrame = 1.0 / 60;

WalkPose at(double x, double yaw = 0) { return {{x, 0, 1.6}, yaw, 0}; }

TEST(WalkRecorder, KeepsRealTimesAndLeavesOutStandingBeforeAndAfter) {
  WalkRecorder recorder;
  recorder.take(0, at(0));
  EXPECT_FALSE(recorder.recording());
  recorder.start(0);
  double now = 10;
  for (int i = 0; i < 60; ++i) recorder.take(now += kFrame, at(0));
  EXPECT_EQ(recorder.seconds(now), 0);
  for (int i = 1; i <= 120; ++i) recorder.take(now += kFrame, at(0.02 * i));
  EXPECT_NEAR(recorder.seconds(now), 2, 1e-9);
  now += 3;  // no frames are drawn while the eye rests
  for (int i = 1; i <= 60; ++i) recorder.take(now += kFrame, at(2.4 - 0.02 * i));
  for (int i = 0; i < 60; ++i) recorder.take(now += kFrame, at(1.2));
  const CameraPath path = recorder.stop();
  EXPECT_FALSE(recorder.recording());
  ASSERT_TRUE(path.check()) << path.check().error().message;
  ASSERT_EQ(path.poses.size(), 4u) << "two steady walks and a rest between them";
  EXPECT_NEAR(path.poses[1].seconds, 2, 1e-9);
  EXPECT_NEAR(path.poses[1].eye.x, 2.4, 1e-9);
  EXPECT_NEAR(path.poses[2].seconds, 5, 1e-9);
  EXPECT_NEAR(path.poses[2].eye.x, 2.4, 1e-9);
  EXPECT_NEAR(path.poses[3].seconds, 6, 1e-9);
}

TEST(WalkRecorder, SlowFramesAreOneMovement) {
  WalkRecorder recorder;
  recorder.start(0);
  for (int i = 0; i <= 20; ++i) recorder.take(0.2 * i, at(0.1 * i));
  EXPECT_LE(recorder.stop().poses.size(), 3u);
}

TEST(WalkRecorder, NothingMovedIsNoPath) {
  WalkRecorder recorder;
  recorder.start(0);
  for (int i = 0; i < 100; ++i) recorder.take(kFrame * i, at(1));
  EXPECT_TRUE(recorder.stop().poses.empty());
}

TEST(WalkRecorder, IsFullInTheEnd) {
  WalkRecorder recorder;
  recorder.start(0);
  recorder.take(0, at(0));
  recorder.take(1, at(1));
  EXPECT_FALSE(recorder.full());
  recorder.take(2 + WalkRecorder::kMostSeconds, at(2));
  EXPECT_TRUE(recorder.full());
}

TEST(WalkReplay, FollowsTheClockAtItsSpeed) {
  for (const double speed : {0.25, 1.0, 4.0}) {
    WalkReplay replay;
    replay.setSpeed(speed);
    replay.play();
    replay.advance(100, 60);
    EXPECT_EQ(replay.at(), 0);
    for (int i = 1; i <= 60; ++i) replay.advance(100 + i * kFrame, 60);
    EXPECT_NEAR(replay.at(), speed, 1e-9);
  }
  WalkReplay replay;
  replay.setSpeed(100);
  EXPECT_EQ(replay.speed(), WalkReplay::kMostSpeed);
}

TEST(WalkReplay, APauseTakesNoTime) {
  WalkReplay replay;
  replay.play();
  replay.advance(0, 10);
  replay.advance(2, 10);
  replay.pause();
  replay.advance(5, 10);
  EXPECT_EQ(replay.at(), 2);
  replay.play();
  replay.advance(7, 10);
  replay.advance(8, 10);
  EXPECT_EQ(replay.at(), 3);
  replay.seek(6);
  replay.advance(8.5, 10);
  EXPECT_EQ(replay.at(), 6.5);
}

TEST(WalkReplay, EndsAtTheEndAndThenBeginsAgain) {
  WalkReplay replay;
  replay.play();
  replay.advance(0, 3);
  replay.advance(5, 3);
  EXPECT_EQ(replay.at(), 3);
  EXPECT_FALSE(replay.playing());
  replay.play();
  replay.advance(9, 3);
  EXPECT_EQ(replay.at(), 0);
}

TEST(WalkReplay, ALoopGoesOn) {
  WalkReplay replay;
  replay.loop = true;
  replay.play();
  replay.advance(0, 3);
  replay.advance(7, 3);
  EXPECT_NEAR(replay.at(), 1, 1e-12);
  EXPECT_TRUE(replay.playing());
}

TEST(WalkReplay, TellsHowEvenlyPicturesCame) {
  WalkReplay replay;
  replay.play();
  double now = 0;
  unsigned long pictures = 7;
  replay.advance(now, 100);
  replay.picturesShown(now, pictures);
  for (int i = 0; i < 99; ++i) {
    now += i == 50 ? 0.1 : 0.02;
    replay.picturesShown(now, pictures);  // none in between
    replay.picturesShown(now, ++pictures);
    replay.advance(now, 100);
  }
  EXPECT_FALSE(replay.takeReport());
  replay.stop();
  const auto report = replay.takeReport();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->frames, 99);
  EXPECT_EQ(report->late, 1);
  EXPECT_NEAR(report->median, 0.02, 1e-9);
  EXPECT_NEAR(report->p99, 0.1, 1e-9);
  EXPECT_NEAR(report->seconds, now, 1e-9);
  EXPECT_EQ(replay.at(), 0);
  EXPECT_FALSE(replay.takeReport()) << "told once";
}

TEST(WalkReplay, WhileTheEyeRestsNoPictureIsLate) {
  WalkReplay replay;
  replay.play();
  replay.advance(0, 100);
  for (int i = 1; i <= 3; ++i) replay.picturesShown(0.02 * i, static_cast<unsigned long>(i));
  replay.resting();
  for (int i = 4; i <= 6; ++i) replay.picturesShown(5 + 0.02 * i, static_cast<unsigned long>(i));
  replay.stop();
  const auto report = replay.takeReport();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->late, 0);
  EXPECT_EQ(report->frames, 4);
}

}  // namespace
}  // namespace acentric::editor
