#include "engine/view_gl/capture_residency.h"

namespace acentric {
namespace {

Result<PackedCapture> pack(const DisplayCapture& capture, const CaptureTask& task, TaskRunner& /*runner*/,
                           const std::stop_token& stop) {
  return packCapture(capture, task, stop);
}

}  // namespace

CaptureResidency::CaptureResidency(TaskRunner& runner, std::unique_ptr<Builder> builder,
                                   std::size_t largestBuffer)
    : BuiltResidency(pack, runner, std::move(builder)), largestBuffer_(largestBuffer) {}

std::unique_ptr<CaptureResidency::Builder> CaptureResidency::makeBuilder(std::function<void()> wake) {
  return std::make_unique<Builder>(pack, 1, std::move(wake));
}

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
  return build(capture, taskOf(capture, name, parts));
}

Status CaptureResidency::ask(const std::shared_ptr<const DisplayCapture>& capture, const std::string& name,
                             CaptureParts parts, bool lacked) {
  return want(taskOf(capture, name, parts), lacked);
}

CaptureTask CaptureResidency::taskOf(const std::shared_ptr<const DisplayCapture>& capture,
                                     const std::string& name, CaptureParts parts) const {
  return {capture, name, parts, kUsualBuffer, storageLimit(largestBuffer_)};
}

}  // namespace acentric
