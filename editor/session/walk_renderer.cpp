#include "editor/session/walk_renderer.h"

#include <algorithm>
#include <utility>

#include "editor/session/engine_texts.h"
#include "engine/view/view_cameras.h"

namespace acentric::editor {

bool rendersTheSame(const WalkScene& a, const WalkScene& b, const PerspectiveView& view,
                    const ViewSettings& settings) {
  const auto on = [](const EffectState& effect) { return effect.on; };
  if (a.scene != b.scene || a.layout != b.layout || a.exposure != b.exposure ||
      a.surfaceLight != b.surfaceLight || a.mirrors != b.mirrors ||
      !std::ranges::equal(a.plan.effects, b.plan.effects, {}, on, on))
    return false;
  const ViewCameras used = camerasOf(*a.layout, view, settings);
  const auto sameCapture = [&](int camera) {
    return a.captures[std::size_t(camera)] == b.captures[std::size_t(camera)];
  };
  return std::ranges::all_of(used.cameras, sameCapture) &&
         (used.region < 0 || a.local[std::size_t(used.region)] == b.local[std::size_t(used.region)]);
}

WalkRenderer::WalkRenderer(int threads, std::function<void()> wake)
    : threads_(threads),
      wake_(std::move(wake)),
      thread_([this](const std::stop_token& stop) { loop(stop); }) {}

WalkRenderer::~WalkRenderer() {
  thread_.request_stop();
  thread_.join();
}

void WalkRenderer::request(WalkRequest request) {
  {
    const std::lock_guard lock(mutex_);
    waiting_ = std::move(request);
  }
  changed_.notify_one();
}

std::optional<WalkPicture> WalkRenderer::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(finished_, std::nullopt);
}

bool WalkRenderer::busy() const {
  const std::lock_guard lock(mutex_);
  return rendering_ || waiting_.has_value();
}

void WalkRenderer::recycle(Frame frame) {
  const std::lock_guard lock(mutex_);
  spare_ = std::move(frame);
}

void WalkRenderer::loop(const std::stop_token& stop) {
  TaskRunner runner(threads_ - 1);
  FrameMemory memory;
  while (!stop.stop_requested()) {
    WalkPicture picture;
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, stop, [this] { return waiting_.has_value(); })) return;
      picture.request = std::move(*waiting_);
      waiting_.reset();
      if (!spare_.colour.empty()) memory.frame = std::move(spare_);
      spare_ = {};
      rendering_ = true;
    }
    auto frame = renderFrame(picture.request.loaded->walk, picture.request.view, picture.request.settings,
                             runner, memory);
    if (frame)
      picture.frame = std::move(*frame);
    else
      picture.problem = engineText(frame.error());
    {
      const std::lock_guard lock(mutex_);
      finished_ = std::move(picture);
      rendering_ = false;
    }
    if (wake_) wake_();
  }
}

}  // namespace acentric::editor
