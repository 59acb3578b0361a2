#include "editor/session/preview_stream.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "engine/base/stopwatch.h"

namespace acentric::editor {
namespace {

int scaledSide(int side, double scale) { return std::max(1, int(std::lround(side * scale))); }

bool sameCamera(const PerspectiveView& a, const PerspectiveView& b) {
  return a.eye == b.eye && a.yawRadians == b.yawRadians && a.pitchRadians == b.pitchRadians &&
         a.fovRadians == b.fovRadians && a.width == b.width && a.height == b.height;
}

bool sameCamera(const PreviewCapture& a, const PreviewCapture& b) {
  return a.camera.id == b.camera.id && a.columns == b.columns;
}

PreviewPicture traced(const PreviewWanted& wanted, TaskRunner& runner, const std::stop_token& stop) {
  if (const auto* view = std::get_if<PerspectiveView>(&wanted.camera))
    return previewView(*wanted.tracer, *view, wanted.cutHeight, runner, stop);
  const auto& capture = std::get<PreviewCapture>(wanted.camera);
  return previewCapture(*wanted.tracer, capture.camera, capture.columns, runner, stop);
}

}  // namespace

bool same(const PreviewWanted& a, const PreviewWanted& b) {
  if (a.tracer != b.tracer || a.cutHeight != b.cutHeight || a.camera.index() != b.camera.index())
    return false;
  if (const auto* view = std::get_if<PerspectiveView>(&a.camera))
    return sameCamera(*view, std::get<PerspectiveView>(b.camera));
  return sameCamera(std::get<PreviewCapture>(a.camera), std::get<PreviewCapture>(b.camera));
}

PreviewWanted scaled(const PreviewWanted& wanted, double scale) {
  PreviewWanted out = wanted;
  if (auto* view = std::get_if<PerspectiveView>(&out.camera)) {
    view->width = scaledSide(view->width, scale);
    view->height = scaledSide(view->height, scale);
  } else {
    ColumnCamera& columns = std::get<PreviewCapture>(out.camera).columns;
    columns.columns = scaledSide(columns.columns, scale);
    columns.rows = scaledSide(columns.rows, scale);
  }
  return out;
}

PreviewStream::PreviewStream(int threads, std::function<void()> wake)
    : threads_(threads),
      wake_(std::move(wake)),
      thread_([this](const std::stop_token& stop) { loop(stop); }) {}

PreviewStream::~PreviewStream() {
  if (asked_) asked_->stop.request_stop();
  thread_.request_stop();
  thread_.join();
}

void PreviewStream::clear() {
  if (asked_) asked_->stop.request_stop();
  shown_.reset();
}

std::optional<double> PreviewStream::nextScale(const PreviewWanted& wanted) const {
  const bool there = shown_ && same(shown_->whole, wanted);
  if (there && shown_->scale >= 1) return std::nullopt;
  if (asked_ && (asked_->scale < 1 || same(asked_->whole, wanted))) return std::nullopt;
  if (there) return 1.0;
  return shown_ ? resolution_.movingScale() : kFirstScale;
}

void PreviewStream::want(const PreviewWanted& wanted) {
  if (const auto scale = nextScale(wanted)) ask(wanted, *scale);
}

void PreviewStream::ask(const PreviewWanted& wanted, double scale) {
  if (asked_) asked_->stop.request_stop();
  asked_ = Asked{wanted, scale, {}};
  {
    const std::lock_guard lock(mutex_);
    waiting_ = asked_;
  }
  changed_.notify_one();
}

bool PreviewStream::take() {
  std::optional<PreviewShown> finished;
  {
    const std::lock_guard lock(mutex_);
    finished = std::exchange(finished_, std::nullopt);
  }
  if (!finished) return false;
  if (asked_ && asked_->scale == finished->scale && same(asked_->whole, finished->whole)) asked_.reset();
  if (finished->picture.empty()) return false;
  if (finished->scale < 1) resolution_.measured(finished->scale, finished->seconds);
  shown_ = std::move(finished);
  return true;
}

bool PreviewStream::takeWithin(double seconds) {
  if (asked_) {
    std::unique_lock lock(mutex_);
    ready_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return finished_.has_value(); });
  }
  return take();
}

void PreviewStream::loop(const std::stop_token& stop) {
  TaskRunner runner(threads_ - 1);
  while (!stop.stop_requested()) {
    Asked now;
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, stop, [this] { return waiting_.has_value(); })) return;
      now = std::move(*waiting_);
      waiting_.reset();
    }
    PreviewShown shown{now.whole, scaled(now.whole, now.scale), now.scale, 0, {}};
    const Stopwatch watch;
    shown.picture = traced(shown.traced, runner, now.stop.get_token());
    shown.seconds = watch.seconds();
    {
      const std::lock_guard lock(mutex_);
      finished_ = std::move(shown);
    }
    ready_.notify_one();
    if (wake_) wake_();
  }
}

}  // namespace acentric::editor
