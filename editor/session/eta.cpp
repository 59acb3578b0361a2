#include "editor/session/eta.h"

#include <algorithm>

namespace acentric::editor {

void Eta::report(double now, double done, double total) {
  if (total != total_ || (!samples_.empty() && done < samples_.back().done)) samples_.clear();
  total_ = total;
  if (samples_.empty() || done > samples_.back().done) samples_.push_back({now, done});
  while (samples_.size() > 2 && samples_.front().time < now - kWindow) samples_.pop_front();
}

std::optional<double> Eta::perSecond() const {
  if (samples_.size() < 2) return std::nullopt;
  const double seconds = samples_.back().time - samples_.front().time;
  const double gained = samples_.back().done - samples_.front().done;
  if (seconds < 0.5 || gained <= 0) return std::nullopt;
  return gained / seconds;
}

std::optional<double> Eta::secondsLeft(double now) const {
  const auto rate = perSecond();
  if (!rate) return std::nullopt;
  const double left = (total_ - samples_.back().done) / *rate;
  return std::max(0.0, left - (now - samples_.back().time));
}

}  // namespace acentric::editor
