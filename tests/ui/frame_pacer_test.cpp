#include "ui/frame_pacer.h"

#include <gtest/gtest.h>

namespace acentric::ui {
namespace {

/// Draws until the pacer is content; returns the time after.
double settle(FramePacer& pacer, double now, int& drawn) {
  for (drawn = 0; pacer.sleepSeconds(now) < FramePacer::kIdleSleep && drawn < 1000;) {
    now += pacer.sleepSeconds(now);
    if (pacer.shouldDraw(now)) {
      pacer.drawn(now);
      ++drawn;
    }
  }
  return now;
}

TEST(FramePacer, DrawsNothingWhileNothingChanges) {
  FramePacer pacer;
  int drawn = 0;
  double now = settle(pacer, 0, drawn);
  EXPECT_EQ(drawn, FramePacer::kSettleFrames);
  now += 100;
  EXPECT_FALSE(pacer.shouldDraw(now));
  EXPECT_DOUBLE_EQ(pacer.sleepSeconds(now), FramePacer::kIdleSleep);
}

TEST(FramePacer, CapsTheRate) {
  FramePacer pacer(60);
  int frames = 0;
  for (double now = 0; now < 1; now += 0.001) {
    pacer.request();
    if (pacer.shouldDraw(now)) {
      pacer.drawn(now);
      ++frames;
    }
  }
  EXPECT_LE(frames, 60);
  EXPECT_GE(frames, 55);
}

TEST(FramePacer, TheEarliestTimedRequestWins) {
  FramePacer pacer;
  int drawn = 0;
  const double now = settle(pacer, 0, drawn);
  pacer.requestAt(now + 0.8);
  pacer.requestAt(now + 0.3);
  pacer.requestAt(now + 0.5);
  EXPECT_NEAR(pacer.sleepSeconds(now), 0.3, 1e-9);
  EXPECT_FALSE(pacer.shouldDraw(now + 0.29));
  ASSERT_TRUE(pacer.shouldDraw(now + 0.31));
  pacer.drawn(now + 0.31);
  EXPECT_DOUBLE_EQ(pacer.sleepSeconds(now + 0.31), FramePacer::kIdleSleep);
}

TEST(FramePacer, NeverSleepsPastItsHousekeeping) {
  FramePacer pacer;
  int drawn = 0;
  const double now = settle(pacer, 0, drawn);
  pacer.requestAt(now + 50);
  EXPECT_DOUBLE_EQ(pacer.sleepSeconds(now), FramePacer::kIdleSleep);
}

}  // namespace
}  // namespace acentric::ui
