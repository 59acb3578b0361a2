#pragma once
/// The samples of a capture as the graphics card takes them. Making them needs no context: any thread may.

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/task_runner.h"
#include "engine/view/walk_scene.h"

namespace acentric {

/// Clear samples behind one another in a pixel are drawn one rank at a time; those beyond this many share the
/// last.
inline constexpr int kMostClearRanks = 8;

/// How many samples of the same pixel are stored before and behind a sample; kManyLayers: so many or more.
struct LayerPlace {
  std::uint8_t before = 0, behind = 0;
};
inline constexpr std::size_t kManyLayers = 255;

struct GlSample {
  std::uint32_t inverseDistanceAndRoles;
  std::uint32_t rowAndColumn;  ///< row | column << 16
  std::uint32_t colour;
};
static_assert(sizeof(GlSample) == 12, "the shader reads a stride of 12 bytes");

/// What is asked for of a capture: its background alone, or its samples or patches with it.
enum class CaptureParts { background, samples, patches };

struct CaptureTask {
  std::weak_ptr<const DisplayCapture> capture;
  std::string name;  ///< of the capture, for messages
  CaptureParts parts = CaptureParts::samples;
  std::size_t usualBuffer = 0;    ///< bytes; larger ones are of one column
  std::size_t largestBuffer = 0;  ///< bytes

  /// Do both ask for the same of the same capture?
  bool sameAs(const CaptureTask& other) const;
};

/// Columns and their samples, as much as one buffer holds. All in whole words, as the shader reads them.
struct PackedColumns {
  int firstColumn = 0;
  int lastColumn = 0;             ///< one behind
  std::uint32_t firstSample = 0;  ///< in the capture
  std::vector<GlSample> samples;
  std::vector<std::uint8_t> mirrors;  ///< a byte each; none without mirrors
  std::vector<LayerPlace> layers;     ///< of each; none where no pixel has more than one sample
};

struct PackedCapture {
  std::vector<PackedColumns> chunks;
  std::vector<float> rowTangents;      ///< of each row; none of a background alone
  std::vector<glm::uvec2> background;  ///< of each run: first row | end row << 16, roles
  std::vector<std::uint8_t>
      clearRanks;  ///< per column: most clear samples in one pixel, at most kMostClearRanks
  std::shared_ptr<const DisplayPatches> patches;

  std::size_t bytes() const;
};

template <class Value>
std::size_t bytesOf(const std::vector<Value>& values) {
  return values.size() * sizeof(Value);
}

/// Fails on a capture whose arrays contradict each other: nothing that reads them checks again.
Status checkArrays(const DisplayCapture& capture, const char* name);
/// That these parts of a capture become, in one chunk.
std::size_t packedBytes(const DisplayCapture& capture, CaptureParts parts);
/// `capture` is the task's. Fails on one whose arrays contradict each other, or whose single column is beyond
/// the largest buffer; and when stopped.
Result<PackedCapture> packCapture(const DisplayCapture& capture, const CaptureTask& task,
                                  const std::stop_token& stop = {});

}  // namespace acentric
