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

Status checkSent(const std::string& name) { return checkGl(fmt::format("uploading {}", name).c_str()); }

}  // namespace

void CaptureResidency::begin(const CaptureSet& inScene) {
  const auto useless = [&](const Asked& asked) {
    const auto capture = asked.capture.lock();
    return !capture || !inScene.contains(capture.get()) || ready(capture);
  };
  wanted_.clear();
  std::erase_if(waiting_, useless);
  std::erase_if(failed_, [&](const Failed& failed) { return useless(failed.asked); });
  if (upload_ && useless(uploading_)) upload_.reset();
}

Result<const CaptureBuffers*> CaptureResidency::get(const std::shared_ptr<const DisplayCapture>& capture,
                                                    const std::string& name) {
  if (const CaptureBuffers* there = find(capture)) return there;
  const Stopwatch watch;
  Result<CaptureUpload> upload = CaptureUpload::begin(capture, name, storageLimit(largestBuffer_));
  if (!upload) return tl::unexpected(upload.error());
  sent_.bytes += upload->send(std::numeric_limits<std::size_t>::max());
  sent_.seconds += watch.seconds();
  if (Status sent = checkSent(name); !sent) return tl::unexpected(sent.error());
  return &put(capture, upload->take());
}

Status CaptureResidency::ask(const std::shared_ptr<const DisplayCapture>& capture, const std::string& name,
                             bool lacked) {
  for (const Failed& failed : failed_)
    if (failed.asked.isOf(capture)) return tl::unexpected(failed.error);
  if (upload_ && uploading_.isOf(capture))
    uploading_.lacked = lacked;
  else if (std::ranges::none_of(wanted_, [&](const Asked& asked) { return asked.isOf(capture); }))
    wanted_.push_back({capture, name, lacked});
  return {};
}

void CaptureResidency::beginNext(bool& news) {
  while (!upload_ && !waiting_.empty()) {
    uploading_ = std::move(waiting_.front());
    waiting_.erase(waiting_.begin());
    const auto capture = uploading_.capture.lock();
    if (!capture) continue;  // evicted
    Result<CaptureUpload> upload =
        CaptureUpload::begin(capture, uploading_.name, storageLimit(largestBuffer_));
    if (upload) {
      upload_ = std::move(*upload);
      return;
    }
    news = news || uploading_.lacked;
    failed_.push_back({uploading_, upload.error()});
  }
}

Result<bool> CaptureResidency::receive(SendLimit& limit) {
  const Stopwatch watch;
  bool news = false;
  while (limit.left() > 0) {
    beginNext(news);
    if (!upload_) break;
    const std::size_t sentNow = upload_->send(std::min(limit.left(), kBytesAtOnce));
    limit.sent(sentNow);
    sent_.bytes += sentNow;
    if (Status sent = checkSent(uploading_.name); !sent) {
      upload_.reset();
      return tl::unexpected(sent.error());
    }
    if (!upload_->done()) continue;
    if (const auto capture = uploading_.capture.lock()) {
      put(capture, upload_->take());
      news = news || uploading_.lacked;
    }
    upload_.reset();
  }
  sent_.seconds += watch.seconds();
  return news;
}

void CaptureResidency::stop() {
  wanted_.clear(), waiting_.clear(), failed_.clear();
  upload_.reset();
}

void CaptureResidency::trim(std::size_t bytes) {
  const std::size_t coming = upload_ ? upload_->bytes() : 0;
  Residency::trim(bytes - std::min(bytes, coming));
}

}  // namespace acentric
