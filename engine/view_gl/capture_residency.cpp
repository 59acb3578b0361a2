#include "engine/view_gl/capture_residency.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/base/stopwatch.h"
#include "engine/view_gl/gl_check.h"

namespace acentric {
namespace {

/// So much is sent before a frame looks at the clock.
constexpr std::size_t kBytesAtOnce = std::size_t(1) << 20;

Status checkSent(const CaptureTask& task) { return checkGl(fmt::format("uploading {}", task.name).c_str()); }

}  // namespace

void CaptureResidency::begin(const CaptureSet& inScene) {
  keepOnly([&](const CaptureTask& task) {
    const auto capture = task.capture.lock();
    return capture && inScene.contains(capture.get()) && !ready(capture, task.parts);
  });
}

bool CaptureResidency::ready(const std::shared_ptr<const DisplayCapture>& capture, CaptureParts parts) {
  const CaptureBuffers* const buffers = find(capture);
  return buffers != nullptr && (parts == CaptureParts::background || buffers->parts == parts);
}

Result<const CaptureBuffers*> CaptureResidency::get(const std::shared_ptr<const DisplayCapture>& capture,
                                                    const std::string& name, CaptureParts parts) {
  if (ready(capture, parts)) return find(capture);
  const Stopwatch watch;
  const CaptureTask task = taskOf(capture, name, parts);
  Result<PackedCapture> packed = packCapture(*capture, task);
  if (!packed) return tl::unexpected(packed.error());
  CaptureUpload upload(task, std::move(*packed));
  sent_.bytes += upload.send(std::numeric_limits<std::size_t>::max());
  sent_.seconds += watch.seconds();
  if (Status sent = checkSent(task); !sent) return tl::unexpected(sent.error());
  return &put(capture, upload.take());
}

Status CaptureResidency::ask(const std::shared_ptr<const DisplayCapture>& capture, const std::string& name,
                             CaptureParts parts, bool lacked) {
  const CaptureTask task = taskOf(capture, name, parts);
  const auto same = [&](const CaptureTask& other) { return task.sameAs(other); };
  if (lacked) lacked_.push_back(task);
  for (const auto& [failed, error] : failed_)
    if (same(failed)) return tl::unexpected(error);
  if (std::ranges::none_of(wanted_, same) && !(upload_ && same(upload_->task()))) wanted_.push_back(task);
  return {};
}

void CaptureResidency::end() {
  awaited_ = std::exchange(lacked_, {});
  if (builder_) builder_->want(std::exchange(wanted_, {}));
}

Result<bool> CaptureResidency::receive(SendLimit& limit, Which which) {
  if (!builder_) return false;
  const Stopwatch watch;
  bool news = false;
  while (limit.left() > 0 && (upload_ || takeBuilt(Which::lacked, news) || takeBuilt(which, news))) {
    if (which == Which::lacked && !isAwaited(upload_->task())) break;
    const std::size_t sentNow = upload_->send(std::min(limit.left(), kBytesAtOnce));
    limit.sent(sentNow);
    sent_.bytes += sentNow;
    const CaptureTask task = upload_->task();
    if (Status sent = checkSent(task); !sent) {
      upload_.reset();
      return tl::unexpected(sent.error());
    }
    if (!upload_->done()) continue;
    if (const auto capture = task.capture.lock()) {
      put(capture, upload_->take());
      news = news || isAwaited(task);
    }
    upload_.reset();
  }
  sent_.seconds += watch.seconds();
  return news;
}

void CaptureResidency::trim(std::size_t bytes) {
  const std::size_t coming = upload_ ? upload_->bytes() : 0;
  Residency::trim(bytes - std::min(bytes, coming));
}

CaptureTask CaptureResidency::taskOf(const std::shared_ptr<const DisplayCapture>& capture,
                                     const std::string& name, CaptureParts parts) const {
  return {capture, name, parts, kUsualBuffer, storageLimit(largestBuffer_)};
}

void CaptureResidency::keepOnly(const std::function<bool(const CaptureTask&)>& useful) {
  wanted_.clear();
  lacked_.clear();
  if (!builder_) return;
  builder_->keepOnly(useful);
  if (upload_ && !useful(upload_->task())) upload_.reset();
  std::erase_if(failed_, [&](const auto& failed) { return !useful(failed.first); });
}

bool CaptureResidency::isAwaited(const CaptureTask& task) const {
  return std::ranges::any_of(awaited_, [&](const CaptureTask& other) { return task.sameAs(other); });
}

bool CaptureResidency::takeBuilt(Which which, bool& news) {
  const auto wanted = [&](const CaptureTask& task) { return which == Which::all || isAwaited(task); };
  while (std::optional<CaptureBuilder::Built> built = builder_->takeBuilt(wanted)) {
    if (built->packed) {
      upload_.emplace(std::move(built->task), std::move(*built->packed));
      return true;
    }
    news = news || isAwaited(built->task);
    failed_.emplace_back(std::move(built->task), built->packed.error());
  }
  return false;
}

}  // namespace acentric
