#include "ui/frame_pacer.h"

#include <algorithm>

namespace acentric::ui {

void FramePacer::request(int count) { wanted_ = std::max(wanted_, count); }

void FramePacer::requestAt(double seconds) {
  timed_ = timed_ < 0 ? std::max(0.0, seconds) : std::min(timed_, std::max(0.0, seconds));
}

bool FramePacer::shouldDraw(double now) const {
  return (wanted_ > 0 || timedDue(now)) && now - last_ >= interval_;
}

double FramePacer::sleepSeconds(double now) const {
  const double earliest = last_ + interval_ - now;
  if (wanted_ > 0) return std::max(0.0, earliest);
  if (timed_ >= 0) return std::clamp(timed_ - now, std::max(0.0, earliest), kIdleSleep);
  return kIdleSleep;
}

void FramePacer::drawn(double now) {
  wanted_ = std::max(0, wanted_ - 1);
  if (timedDue(now)) timed_ = -1;
  last_ = now;
}

}  // namespace acentric::ui
