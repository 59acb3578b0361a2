#include "engine/view_gl/live_captures.h"

#include <algorithm>
#include <ranges>
#include <utility>

#include "engine/view/view_cameras.h"

namespace acentric {
namespace {

/// Captures around the eye that are sent before they are seen.
constexpr std::size_t kMostAhead = 64;

/// The first cover, which is in front, comes first.
std::vector<int> camerasInView(const WalkScene& scene, const PerspectiveView& view, ViewSettings settings) {
  const std::vector<int> all = camerasOf(*scene.layout, view, settings).cameras;
  settings.secondaryCover = false;
  std::vector<int> cameras = camerasOf(*scene.layout, view, settings).cameras;
  const std::size_t first = cameras.size();
  for (const int camera : all)
    if (!std::binary_search(cameras.begin(), cameras.begin() + std::ptrdiff_t(first), camera))
      cameras.push_back(camera);
  std::erase_if(cameras, [&](int camera) {
    return std::size_t(camera) >= scene.captures.size() || !scene.captures[std::size_t(camera)];
  });
  return cameras;
}

/// May one be drawn in place of the other, with other columns, rows and samples?
bool sameView(const ColumnCamera& a, const ColumnCamera& b) {
  return a.centreOfProjection == b.centreOfProjection && a.lowAzimuth == b.lowAzimuth &&
         a.fovRadians == b.fovRadians;
}

/// With what its mirrors show.
std::size_t bytesOfAll(const DisplayCapture& capture) {
  return bufferBytes(capture) + (capture.reflections ? bufferBytes(*capture.reflections) : 0);
}

}  // namespace

bool LiveCaptures::ready(const CapturePtr& capture) {
  return captures_.ready(capture) && (!capture->reflections || captures_.ready(capture->reflections));
}

Status LiveCaptures::ask(const CapturePtr& capture, int camera, bool lacked) {
  for (const CapturePtr& part : {capture, capture->reflections})
    if (part && !captures_.ready(part))
      if (Status asked = captures_.ask(part, captureName(camera, part != capture), lacked); !asked)
        return asked;
  return {};
}

/// The nearest first, as many as there is memory for beside those in view; those that are there are used, so
/// that they stay.
void LiveCaptures::askAhead(const WalkScene& scene, const glm::dvec3& eye, const std::vector<int>& inView) {
  std::size_t bytes = 0;
  for (const int camera : inView) bytes += bytesOfAll(*scene.captures[std::size_t(camera)]);
  std::vector<std::pair<double, int>> others;
  for (std::size_t i = 0; i < scene.captures.size(); ++i)
    if (scene.captures[i] && std::ranges::find(inView, int(i)) == inView.end())
      others.emplace_back(glm::distance(scene.captures[i]->camera.centreOfProjection, eye), int(i));
  const std::size_t nearest = std::min(others.size(), kMostAhead);
  std::ranges::partial_sort(others, others.begin() + std::ptrdiff_t(nearest));
  others.resize(nearest);
  for (const auto& [distance, camera] : others) {
    const CapturePtr& now = scene.captures[std::size_t(camera)];
    bytes += bytesOfAll(*now);
    if (bytes > memoryBytes_) return;
    if (ready(now))
      drawn_[std::size_t(camera)] = now;
    else
      (void)ask(now, camera, false);  // what is wrong with it is told when it is seen
  }
}

/// Of what stands in no longer. Out of sight nothing does that keeps more memory from the walk than what it
/// stands in for.
void LiveCaptures::letGo(const WalkScene& scene, const std::vector<int>& inView) {
  drawn_.resize(scene.captures.size());
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    CapturePtr& drawn = drawn_[i];
    const CapturePtr& now = scene.captures[i];
    if (!drawn || drawn == now) continue;
    const bool useful =
        now && sameView(drawn->camera, now->camera) &&
        (drawn->samples.size() <= now->samples.size() || std::ranges::find(inView, int(i)) != inView.end());
    if (!useful) drawn.reset();
  }
}

Status LiveCaptures::sendSmall(const CapturePtr& capture, int camera, SendLimit& limit) {
  const std::size_t bytes = bytesOfAll(*capture);
  if (bytes > limit.left()) return {};
  limit.sent(bytes);
  for (const CapturePtr& part : {capture, capture->reflections})
    if (part)
      if (const auto sent = captures_.get(part, captureName(camera, part != capture)); !sent)
        return tl::unexpected(sent.error());
  return {};
}

Result<const WalkScene*> LiveCaptures::choose(const WalkScene& scene, const PerspectiveView& view,
                                              const ViewSettings& settings, SendLimit limit,
                                              FrameStats& stats) {
  if (!view.check()) return &scene;  // as planning will tell
  const std::vector<int> cameras = camerasInView(scene, view, settings);
  letGo(scene, cameras);
  for (const int camera : cameras) {
    const CapturePtr& now = scene.captures[std::size_t(camera)];
    CapturePtr& drawn = drawn_[std::size_t(camera)];
    if (drawn && !ready(drawn)) drawn.reset();  // it had to leave the graphics card
    if (!drawn && !ready(now))
      if (Status sent = sendSmall(now, camera, limit); !sent) return tl::unexpected(sent.error());
  }
  if (const auto received = receive(limit); !received) return tl::unexpected(received.error());

  std::vector<std::pair<int, CapturePtr>> instead;
  for (const int camera : cameras) {
    const CapturePtr& now = scene.captures[std::size_t(camera)];
    CapturePtr& drawn = drawn_[std::size_t(camera)];
    if (ready(now)) {
      drawn = now;
      continue;
    }
    if (Status asked = ask(now, camera, true); !asked) return tl::unexpected(asked.error());
    instead.emplace_back(camera, drawn);
    ++stats.capturesAwaited;
    stats.standIns += drawn ? 1 : 0;
  }
  askAhead(scene, view.eye, cameras);
  if (instead.empty()) return &scene;
  planned_ = scene;
  for (auto& [camera, capture] : instead) planned_.captures[std::size_t(camera)] = std::move(capture);
  return &planned_;
}

}  // namespace acentric
