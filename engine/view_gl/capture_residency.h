#pragma once
/// Which captures have their samples on the graphics card.

#include <functional>
#include <memory>
#include <string>

#include "engine/view_gl/built_residency.h"
#include "engine/view_gl/capture_buffers.h"

namespace acentric {

class CaptureResidency : public BuiltResidency<CaptureTask, PackedCapture, CaptureUpload, CaptureBuffers> {
 public:
  /// Without a builder frames wait. `largestBuffer`: bytes, 0 = what the driver allows.
  explicit CaptureResidency(TaskRunner& runner, std::unique_ptr<Builder> builder = nullptr,
                            std::size_t largestBuffer = 0);
  static std::unique_ptr<Builder> makeBuilder(std::function<void()> wake);

  /// Before a frame: gives up what is on its way for captures that are not among these, or are ready.
  void begin(const CaptureSet& inScene);
  /// Are these parts of it on the graphics card? They are used in this frame.
  bool ready(const std::shared_ptr<const DisplayCapture>& capture,
             CaptureParts parts = CaptureParts::samples);
  /// The buffers of `capture`, packed and sent now if it is not ready. Valid until the next call of begin,
  /// receive, dropGone or trim.
  Result<const CaptureBuffers*> get(const std::shared_ptr<const DisplayCapture>& capture,
                                    const std::string& name, CaptureParts parts = CaptureParts::samples);
  /// Is to be packed in the background, after what this frame asked for before it. `lacked`: by this frame;
  /// otherwise it is for those to come. Fails if it could not be.
  Status ask(const std::shared_ptr<const DisplayCapture>& capture, const std::string& name,
             CaptureParts parts = CaptureParts::samples, bool lacked = true);
  /// After a frame: what it asked for is packed next.
  void end() { beginWanted(); }

 private:
  CaptureTask taskOf(const std::shared_ptr<const DisplayCapture>& capture, const std::string& name,
                     CaptureParts parts) const;

  std::size_t largestBuffer_ = 0;
};

}  // namespace acentric
