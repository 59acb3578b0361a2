#include "editor/session/frame_times.h"

#include <numeric>

#include "ui/translate.h"

namespace acentric::editor {

const char* nameOf(FramePart part) {
  switch (part) {
    case FramePart::plan:
      return tr("plan");
    case FramePart::send:
      return tr("send");
    case FramePart::captures:
      return tr("captures");
    case FramePart::local:
      return tr("near polygons");
    case FramePart::fill:
      return tr("fill");
    case FramePart::present:
      return tr("window");
  }
  return "";
}

const char* helpFor(FramePart part) {
  switch (part) {
    case FramePart::plan:
      return tr("Choosing pieces and culling columns.");
    case FramePart::send:
      return tr("Packing captures and sending them to the graphics card.");
    case FramePart::captures:
      return tr("From samples to pixels, the background too.");
    case FramePart::local:
      return tr("Local polygons within the near band.");
    case FramePart::fill:
      return tr("Filling what is still open.");
    case FramePart::present:
      return tr("Handing the window to the graphics card and showing it, once for each picture of the walk.");
  }
  return "";
}

double FrameCost::total() const { return std::accumulate(seconds.begin(), seconds.end(), 0.0); }

void FrameTimes::add(const FrameStats& stats) {
  frames_.push_back(
      {{stats.planSeconds, stats.sendSeconds, stats.warpSeconds, stats.localSeconds, stats.fillSeconds, 0}});
  if (frames_.size() > kMost) frames_.pop_front();
  awaitsPresent_ = true;
}

void FrameTimes::presented(double seconds) {
  if (!awaitsPresent_) return;
  awaitsPresent_ = false;
  frames_.back().seconds[std::size_t(FramePart::present)] = seconds;
}

Spread FrameTimes::spread() const {
  std::vector<double> totals;
  totals.reserve(frames_.size());
  for (const FrameCost& frame : frames_) totals.push_back(frame.total());
  return spreadOf(std::move(totals));
}

}  // namespace acentric::editor
