#pragma once
/// Captures as OpenGL buffers: their patches' texels, and where they show the background.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/view/walk_scene.h"
#include "engine/view_gl/buffer_upload.h"

namespace acentric {

struct CaptureBuffers {
  std::weak_ptr<const DisplayCapture> owner;
  GlBuffer background;  ///< of each run: first row | end row << 16, roles
  GlBuffer patchColours, patchCovers;
  std::size_t bytes = 0;
  std::uint64_t lastUse = 0;
};

/// For messages: of a camera's capture, or of what its mirrors show.
std::string captureName(int camera, bool reflections);

/// That a capture takes as buffers.
std::size_t bufferBytes(const DisplayCapture& capture);

/// A capture on its way to the graphics card, piece by piece.
class CaptureUpload {
 public:
  /// Fails on one whose arrays contradict each other (nothing that reads them
  /// checks again), and on one of more texels than a storage buffer of so many bytes holds. `name`: of the
  /// capture, for messages.
  static Result<CaptureUpload> begin(const std::shared_ptr<const DisplayCapture>& capture,
                                     const std::string& name, std::size_t largestBuffer);
  /// Sends at most so many bytes more, or all that are left; returns how many.
  std::size_t send(std::size_t most) { return sending_.send(most); }
  bool done() const { return sending_.done(); }
  std::size_t bytes() const { return sending_.bytes(); }
  /// Once it is done.
  CaptureBuffers take() { return std::move(buffers_); }

 private:
  CaptureBuffers buffers_;
  BufferUpload sending_;
};

}  // namespace acentric
