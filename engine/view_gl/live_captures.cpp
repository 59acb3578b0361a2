#include "engine/view_gl/live_captures.h"

#include <algorithm>
#include <ranges>
#include <utility>

#include "engine/view/view_cameras.h"
#include "engine/view_gl/capture_piece.h"

namespace acentric {
namespace {

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

}  // namespace

/// That must be there before the camera is drawn. Of a mesh only what blends is points; the runs of its
/// background are few enough to be sent when they are drawn.
std::vector<LiveCaptures::Part> LiveCaptures::partsOf(const CapturePtr& capture, int camera,
                                                      const ViewSettings& settings) {
  std::vector<Part> parts;
  if (settings.renderer != Renderer::glMesh || capture->blended || meshes_.find(capture) == nullptr)
    parts.push_back({capture, captureName(camera, Mirrors::none)});
  if (capture->reflections) parts.push_back({capture->reflections, captureName(camera, Mirrors::reflect)});
  return parts;
}

bool LiveCaptures::ready(const CapturePtr& capture, int camera, const ViewSettings& settings) {
  return std::ranges::all_of(partsOf(capture, camera, settings),
                             [&](const Part& part) { return captures_.ready(part.capture); });
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

Status LiveCaptures::sendSmall(const CapturePtr& capture, int camera, const ViewSettings& settings,
                               SendLimit& limit) {
  const std::vector<Part> parts = partsOf(capture, camera, settings);
  std::size_t bytes = 0;
  for (const Part& part : parts) bytes += packedBytes(*part.capture);
  if (bytes > limit.left()) return {};
  limit.sent(bytes);
  for (const Part& part : parts)
    if (const auto sent = captures_.get(part.capture, part.name); !sent) return tl::unexpected(sent.error());
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
    if (drawn && !ready(drawn, camera, settings)) drawn.reset();  // it had to leave the graphics card
    if (!drawn && !ready(now, camera, settings))
      if (Status sent = sendSmall(now, camera, settings, limit); !sent) return tl::unexpected(sent.error());
  }
  if (const auto received = captures_.receive(limit); !received) return tl::unexpected(received.error());
  if (const auto received = meshes_.receive(limit); !received) return tl::unexpected(received.error());

  std::vector<std::pair<int, CapturePtr>> instead;
  for (const int camera : cameras) {
    const CapturePtr& now = scene.captures[std::size_t(camera)];
    CapturePtr& drawn = drawn_[std::size_t(camera)];
    if (ready(now, camera, settings)) {
      drawn = now;
      continue;
    }
    for (const Part& part : partsOf(now, camera, settings))
      if (!captures_.ready(part.capture))
        if (Status asked = captures_.ask(part.capture, part.name); !asked)
          return tl::unexpected(asked.error());
    instead.emplace_back(camera, drawn);
    ++stats.capturesAwaited;
    stats.standIns += drawn ? 1 : 0;
  }
  if (instead.empty()) return &scene;
  planned_ = scene;
  for (auto& [camera, capture] : instead) planned_.captures[std::size_t(camera)] = std::move(capture);
  return &planned_;
}

}  // namespace acentric
