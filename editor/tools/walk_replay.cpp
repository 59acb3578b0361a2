#include "editor/tools/walk_replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/measure/statistics.h"
#include "ui/translate.h"

namespace acentric::editor {

std::string describe(const ReplayReport& report) {
  return trf(
      "{} frames in {:.1f} s, {} of them took longer than 33 ms; {:.1f} ms a frame (median), {:.1f} ms (99th "
      "percentile)",
      report.frames, report.seconds, report.late, 1e3 * report.median, 1e3 * report.p99);
}

void WalkReplay::play() {
  playing_ = true;
  lastAdvance_.reset();
  lastPicture_.reset();
}

void WalkReplay::pause() {
  playing_ = false;
  lastPicture_.reset();
}

void WalkReplay::stop() {
  finish();
  at_ = 0;
}

void WalkReplay::finish() {
  pause();
  if (!frames_.empty()) {
    const Spread spread = spreadOf(frames_);
    const auto late = std::ranges::count_if(frames_, [](double seconds) { return seconds > kLateSeconds; });
    report_ = ReplayReport{played_, int(frames_.size()), int(late), spread.median, spread.p99};
  }
  frames_.clear();
  played_ = 0;
}

void WalkReplay::setSpeed(double factor) { speed_ = std::clamp(factor, kLeastSpeed, kMostSpeed); }

void WalkReplay::advance(double now, double pathSeconds) {
  if (!playing_) return;
  const double passed = lastAdvance_ ? now - *lastAdvance_ : 0;
  if (!lastAdvance_ && at_ >= pathSeconds) at_ = 0;  // played to its end before
  lastAdvance_ = now;
  played_ += passed;
  at_ += speed_ * passed;
  if (at_ < pathSeconds) return;
  if (loop && pathSeconds > 0) {
    at_ = std::fmod(at_, pathSeconds);
  } else {
    at_ = pathSeconds;
    finish();
  }
}

void WalkReplay::picturesShown(double now, unsigned long pictures) {
  if (std::exchange(pictures_, pictures) == pictures || !playing_) return;
  if (lastPicture_) frames_.push_back(now - *lastPicture_);
  lastPicture_ = now;
}

std::optional<ReplayReport> WalkReplay::takeReport() { return std::exchange(report_, std::nullopt); }

}  // namespace acentric::editor
