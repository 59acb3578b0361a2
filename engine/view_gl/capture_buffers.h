#pragma once
/// Captures as OpenGL buffers. A capture larger than the driver's storage buffer limit is cut between
/// columns.

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/base/result.h"
#include "engine/view/walk_scene.h"
#include "engine/view_gl/gl_object.h"
#include "engine/view_gl/residency.h"

namespace acentric {

/// Clear samples behind one another in a pixel are drawn one rank at a time; those beyond this many share the
/// last.
inline constexpr int kMostClearRanks = 8;

/// How many samples of the same pixel are stored before and behind a sample; kManyLayers: so many or more.
struct LayerPlace {
  std::uint8_t before = 0, behind = 0;
};
inline constexpr std::size_t kManyLayers = 255;

struct CaptureChunk {
  int firstColumn = 0;
  int lastColumn = 0;             ///< one behind
  std::uint32_t firstSample = 0;  ///< in the capture
  GlBuffer samples;               ///< 12 bytes each: inverse distance | roles, row | column << 16, colour
  GlBuffer mirrors;               ///< a byte each; none without mirrors
  GlBuffer layers;                ///< a LayerPlace each; none where no pixel has more than one sample
  GlBuffer slants;                ///< two bytes each (Slant); none until asked for
};

struct CaptureBuffers {
  std::weak_ptr<const DisplayCapture> owner;
  std::vector<CaptureChunk> chunks;
  GlBuffer rowTangents;  ///< float per row; none, and no chunks, until samples are asked for
  GlBuffer background;   ///< 8 bytes a run: first row | end row << 16, roles; none without background
  std::vector<std::uint8_t>
      clearSamples;  ///< per column: most clear samples in one pixel, at most kMostClearRanks
  std::size_t bytes = 0;
  std::uint64_t lastUse = 0;
};

/// What is asked for of a capture.
enum class CaptureParts { background, samples, samplesAndSlants };

/// Uploads a capture. Fails on one whose arrays contradict each other, or whose single column is beyond the
/// limit: `largestBuffer` bytes, 0 = what the driver allows.
Result<CaptureBuffers> uploadCapture(const DisplayCapture& capture, const char* name,
                                     CaptureParts parts = CaptureParts::samples,
                                     std::size_t largestBuffer = 0);

/// Fails on a capture whose arrays contradict each other: nothing that reads them checks again.
Status checkArrays(const DisplayCapture& capture, const char* name);
/// What shader storage buffers may hold, bytes; at most `largestBuffer` unless that is 0.
std::size_t storageLimit(std::size_t largestBuffer);
/// A storage buffer of these values; counts its bytes.
template <class Values>
GlBuffer makeStorage(const Values& values, std::size_t& bytes) {
  GlBuffer buffer = GlBuffer::make();
  const std::size_t size = values.size() * sizeof values[0];
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer.name());
  glBufferData(GL_SHADER_STORAGE_BUFFER, GLsizeiptr(size), values.data(), GL_STATIC_DRAW);
  bytes += size;
  return buffer;
}

class CaptureResidency : public Residency<CaptureBuffers> {
 public:
  explicit CaptureResidency(std::size_t largestBuffer = 0) : largestBuffer_(largestBuffer) {}

  /// The buffers of `capture`, uploaded now as far as need be. Valid until the next call of dropGone or trim.
  Result<const CaptureBuffers*> get(const std::shared_ptr<const DisplayCapture>& capture, const char* name,
                                    CaptureParts parts = CaptureParts::samples);

 private:
  std::size_t largestBuffer_ = 0;
};

}  // namespace acentric
