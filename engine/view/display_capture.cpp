#include <algorithm>
#include <cmath>
#include <span>

#include "engine/base/contract.h"
#include "engine/image/shown_colour.h"
#include "engine/view/walk_scene.h"

namespace acentric {
namespace {

/// Smallest and largest inverse distance of these samples; smallest above largest if there are none.
glm::vec2 rangeOf(std::span<const PackedSample> samples) {
  glm::vec2 range(samples.empty() ? 1 : HUGE_VALF, 0);
  for (const PackedSample& sample : samples) {
    const float inverseDistance = inverseDistanceOf(sample);
    range = {std::min(range.x, inverseDistance), std::max(range.y, inverseDistance)};
  }
  return range;
}

/// `whole` says how the colours of its samples or reflections are to be taken.
DisplayCapture prepare(const Capture& whole, const CaptureSamples& capture, float exposure) {
  const ColumnCamera& camera = whole.camera;
  const std::size_t columns = static_cast<std::size_t>(camera.columns);
  const std::size_t rows = static_cast<std::size_t>(camera.rows);
  require(capture.columnStart.size() == columns + 1, "a capture needs one offset per column and one more");

  DisplayCapture display;
  display.camera = camera;
  display.columnStart = capture.columnStart;
  display.mirror.assign(capture.mirror.begin(), capture.mirror.end());
  display.samples.resize(capture.sampleCount());
  for (std::size_t i = 0; i < display.samples.size(); ++i)
    display.samples[i] = packSample(capture.inverseDistance[i], capture.roles[i], capture.row[i]);

  display.colour.resize(capture.sampleCount());
  for (std::size_t i = 0; i < capture.sampleCount(); ++i) {
    display.colour[i] = shownColour(capture.colour[i], whole.shown, exposure);
    display.blended = display.blended || display.colour[i].a < 255;
  }

  if (capture.hasSilhouettes())
    display.patches = std::make_shared<const DisplayPatches>(
        displayPatches(camera, capture, whole.planeTolerance, display.colour));

  display.rowTangent.resize(rows);
  for (std::size_t r = 0; r < rows; ++r)
    display.rowTangent[r] = static_cast<float>(camera.tangentAt(static_cast<double>(r) + 0.5));

  display.columnDirection.resize(columns);
  display.columnRange.resize(columns);
  for (std::size_t k = 0; k < columns; ++k) {
    display.columnDirection[k] = glm::vec2(camera.directionAt(static_cast<double>(k) + 0.5));
    const std::uint32_t begin = capture.columnStart[k], end = capture.columnStart[k + 1];
    display.columnRange[k] = rangeOf(std::span(display.samples).subspan(begin, end - begin));
    for (std::uint32_t i = begin + 1; i < end && !display.layered; ++i)
      display.layered = capture.row[i] == capture.row[i - 1];
  }
  return display;
}

template <class T, class Allocator>
std::size_t bytesOf(const std::vector<T, Allocator>& values) {
  return values.size() * sizeof(T);
}

}  // namespace

DisplayCapture prepareForDisplay(const Capture& capture, float exposure) {
  const ColumnCamera& camera = capture.camera;
  DisplayCapture display = prepare(capture, capture, exposure);
  if (capture.background.runCount() > 0) {
    DisplayBackground& background = display.background;
    background.runs = capture.background;
    for (int x = 0; x <= camera.columns; ++x) background.columnBorder.push_back(camera.directionAt(x));
    for (int y = 0; y <= camera.rows; ++y) background.rowBorder.push_back(camera.tangentAt(y));
  }
  if (capture.hasReflections())
    display.reflections =
        std::make_shared<const DisplayCapture>(prepare(capture, capture.reflections, exposure));
  return display;
}

std::size_t bytesOf(const DisplayCapture& c) {
  return sizeof c + bytesOf(c.columnStart) + bytesOf(c.samples) + bytesOf(c.colour) +
         bytesOf(c.columnDirection) + bytesOf(c.rowTangent) + bytesOf(c.columnRange) + bytesOf(c.mirror) +
         (c.patches ? c.patches->bytes() : 0) + c.background.runs.bytes() +
         bytesOf(c.background.columnBorder) + bytesOf(c.background.rowBorder) +
         (c.reflections ? bytesOf(*c.reflections) : 0);
}

}  // namespace acentric
