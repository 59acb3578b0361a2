#include "engine/cli/stream_frames.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "engine/cli/path_frames.h"

namespace acentric::cli {
namespace {

constexpr double kTurnRadiansPerSecond = 1.6;

}  // namespace

TimedPath::TimedPath(std::vector<PerspectiveView> views, double metresPerSecond) : views_(std::move(views)) {
  at_.push_back(0);
  for (std::size_t i = 1; i < views_.size(); ++i) {
    const double metres = glm::distance(views_[i - 1].eye, views_[i].eye);
    const double turned = std::abs(std::remainder(views_[i].yawRadians - views_[i - 1].yawRadians, kTwoPi));
    at_.push_back(at_.back() + std::max(metres / metresPerSecond, turned / kTurnRadiansPerSecond));
  }
}

TimedPath::Pose TimedPath::at(double seconds) const {
  const auto after = std::upper_bound(at_.begin(), at_.end(), seconds);
  const auto i =
      std::size_t(std::clamp<std::ptrdiff_t>(after - at_.begin(), 1, std::ptrdiff_t(at_.size()) - 1));
  if (views_.size() < 2) return {views_.front()};
  const PerspectiveView &from = views_[i - 1], &to = views_[i];
  const double length = at_[i] - at_[i - 1];
  const double share = length > 0 ? std::clamp((seconds - at_[i - 1]) / length, 0.0, 1.0) : 1;
  Pose pose{between(from, to, share)};
  if (length > 0) pose.velocity = glm::dvec2(to.eye - from.eye) / length;
  return pose;
}

Result<StreamRenderer> StreamRenderer::open(const ViewSettings& settings, bool waitForCaptures,
                                            TaskRunner& runner) {
  StreamRenderer made(settings, runner);
  if (!onOpenGl(settings.renderer)) return made;
  auto context = HeadlessContext::create();
  if (!context) return tl::unexpected(context.error());
  auto gl = GlRenderer::create({.waitForCaptures = waitForCaptures, .runner = &runner});
  if (!gl) return tl::unexpected(gl.error());
  made.context_ = std::move(*context), made.gl_ = std::move(*gl);
  return made;
}

Result<FrameStats> StreamRenderer::draw(const WalkScene& walk, const PerspectiveView& view) {
  if (gl_) return gl_->draw(walk, view, settings_);
  auto frame = renderFrame(walk, view, settings_, *runner_, memory_);
  if (!frame) return tl::unexpected(frame.error());
  memory_.frame = std::move(*frame);
  return memory_.frame.stats;
}

ViewCaptures capturesOf(const LoadedWalk& walk, const ViewCameras& needed) {
  ViewCaptures captures;
  for (const int camera : needed.cameras) {
    captures.missing = captures.missing || !walk.walk.captures[std::size_t(camera)];
    captures.standIn = captures.standIn || walk.standsIn[std::size_t(camera)];
  }
  return captures;
}

void WalkTally::count(const FrameStats& stats) {
  sendMs.push_back(stats.sendSeconds * 1e3);
  awaiting += stats.capturesAwaited > 0;
  unsent += stats.capturesAwaited > stats.standIns;
  mostSent = std::max(mostSent, stats.bytesSent);
}

void WalkTally::count(const LoadedWalk& walk, const ViewCameras& needed, double seconds) {
  const auto [missing, standIn] = capturesOf(walk, needed);
  incomplete += missing;
  coarse += standIn && !missing;
  if (!missing && !standIn && firstFullSeconds < 0) firstFullSeconds = seconds;
}

std::uint64_t peakResidentBytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stoull(line.substr(6)) * 1024;
  return 0;
}

void forgetPeakResident() {
  ::malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;  // as proc(5) says
}

}  // namespace acentric::cli
