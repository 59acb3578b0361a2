#include "editor/session/bake_queue.h"

#include <algorithm>

namespace acentric::editor {

void BakeQueue::begin(std::vector<QueuedCamera> cameras) {
  *this = {};
  cameras_ = std::move(cameras);
  for (std::size_t row = 0; row < cameras_.size(); ++row) {
    rows_[{cameras_[row].storey, cameras_[row].camera}] = row;
    ++counts_[std::size_t(cameras_[row].stage)];
    if (cameras_[row].stage != CameraStage::reused) pixels_ += cameras_[row].pixels;
  }
  reusedFirst_ = count(CameraStage::reused);
}

void BakeQueue::setStage(QueuedCamera& row, CameraStage stage) {
  --counts_[std::size_t(row.stage)];
  ++counts_[std::size_t(stage)];
  row.stage = stage;
}

void BakeQueue::tell(double now, int storey, const CameraNews& news) {
  const auto found = rows_.find({storey, news.camera});
  if (found == rows_.end()) return;
  QueuedCamera& row = cameras_[found->second];
  if (row.stage == CameraStage::reused) return;
  lastTold_ = now;
  const bool traced = news.stage == CameraStage::writing;
  if (news.stage == CameraStage::tracing) current_ = found->second;
  if (news.stage == CameraStage::tracing || traced) rays_.report(now, tracedRays_ + double(news.rays), 0);
  if (traced) tracedRays_ += double(news.rays);
  row.traced = news.columns > 0 ? double(news.columnsDone) / news.columns : 0;
  row.seconds = news.seconds;
  row.error = news.error;
  if (news.preview) {
    // The camera itself goes on waiting.
    row.previewing = news.stage == CameraStage::tracing || news.stage == CameraStage::writing;
    const bool there = news.stage == CameraStage::done || news.stage == CameraStage::reused;
    if (there && !row.previewed) row.previewed = true, ++previewed_;
    setStage(row, there ? CameraStage::waiting : news.stage);
    return;
  }
  row.previewing = false;
  if (news.stage == CameraStage::tracing || traced)
    pace_.report(now, tracedPixels_ + row.pixels * row.traced, 0);
  if (traced) tracedPixels_ += row.pixels;
  if (traced || news.stage == CameraStage::reused) donePixels_ += row.pixels;
  setStage(row, news.stage);
}

void BakeQueue::pause() {
  pace_.reset();
  rays_.reset();
}

void BakeQueue::end() {
  for (QueuedCamera& row : cameras_)
    if (row.stage == CameraStage::tracing || row.stage == CameraStage::writing) {
      setStage(row, CameraStage::waiting);
      row.previewing = false;
      row.traced = row.seconds = 0;
    }
  pause();
}

int BakeQueue::finished() const {
  return count(CameraStage::done) + count(CameraStage::reused) - reusedFirst_ + count(CameraStage::failed);
}

double BakeQueue::share() const {
  if (!(pixels_ > 0)) return 0;
  const QueuedCamera& now = cameras_[current_];
  const bool tracing = now.stage == CameraStage::tracing && !now.previewing;
  return (donePixels_ + (tracing ? now.traced * now.pixels : 0)) / pixels_;
}

std::optional<double> BakeQueue::secondsLeft(double now) const {
  const auto rate = pace_.perSecond();
  if (!rate) return std::nullopt;
  return std::max(0.0, (1 - share()) * pixels_ / *rate - (now - lastTold_));
}

}  // namespace acentric::editor
