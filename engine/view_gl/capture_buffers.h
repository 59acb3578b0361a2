#pragma once
/// Captures as OpenGL buffers. A capture larger than the driver's storage buffer limit is cut between
/// columns.

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/view_gl/buffer_upload.h"
#include "engine/view_gl/packed_capture.h"

namespace acentric {

struct CaptureChunk {  ///< as PackedColumns
  int firstColumn = 0;
  int lastColumn = 0;
  std::uint32_t firstSample = 0;
  GlBuffer samples;
  GlBuffer mirrors;
  GlBuffer layers;
};

struct CaptureBuffers {  ///< as PackedCapture
  std::weak_ptr<const DisplayCapture> owner;
  CaptureParts parts = CaptureParts::background;
  std::vector<CaptureChunk> chunks;
  GlBuffer rowTangents;
  GlBuffer background;
  GlBuffer patchColours, patchCovers;
  std::vector<std::uint8_t> clearRanks;
  std::size_t bytes = 0;
  std::uint64_t lastUse = 0;
};

/// A capture on its way to the graphics card, piece by piece.
class CaptureUpload {
 public:
  CaptureUpload(CaptureTask task, PackedCapture capture);
  const CaptureTask& task() const { return task_; }
  /// Sends at most so many bytes more, or all that are left; returns how many.
  std::size_t send(std::size_t most) { return sending_.send(most); }
  bool done() const { return sending_.done(); }
  std::size_t bytes() const { return sending_.bytes(); }
  /// Once it is done.
  CaptureBuffers take() { return std::move(buffers_); }

 private:
  CaptureTask task_;
  CaptureBuffers buffers_;
  BufferUpload sending_;
};

}  // namespace acentric
