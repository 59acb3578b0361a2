#include <algorithm>
#include <functional>
#include <numeric>

#include "engine/base/contract.h"
#include "engine/view/slant.h"
#include "engine/view/walk_scene.h"

namespace acentric {
namespace {

/// Smallest and largest inverse distance of samples [begin, end); smallest above largest if there are none.
glm::vec2 rangeOf(const CaptureSamples& capture, std::uint32_t begin, std::uint32_t end) {
  if (begin >= end) return {1, 0};
  const auto [low, high] =
      std::minmax_element(capture.inverseDistance.begin() + begin, capture.inverseDistance.begin() + end);
  return {*low, *high};
}

DisplayCapture prepare(const ColumnCamera& camera, const CaptureSamples& capture, float exposure) {
  const std::size_t columns = static_cast<std::size_t>(camera.columns);
  const std::size_t rows = static_cast<std::size_t>(camera.rows);
  require(capture.columnStart.size() == columns + 1, "a capture needs one offset per column and one more");

  DisplayCapture display;
  display.camera = camera;
  display.columnStart = capture.columnStart;
  display.row.assign(capture.row.begin(), capture.row.end());
  display.inverseDistance.assign(capture.inverseDistance.begin(), capture.inverseDistance.end());
  display.roles.assign(capture.roles.begin(), capture.roles.end());
  display.mirror.assign(capture.mirror.begin(), capture.mirror.end());
  display.slant = slantsOf(camera, capture.columnStart, capture.row, capture.inverseDistance);

  display.colour.resize(capture.sampleCount());
  for (std::size_t i = 0; i < capture.sampleCount(); ++i) {
    const glm::vec4 linear = unpackColour(capture.colour[i]);
    display.colour[i] = encodeForDisplay(glm::vec3(linear), exposure, linear.a);
    display.blended = display.blended || display.colour[i].a < 255;
  }

  display.rowTangent.resize(rows);
  for (std::size_t r = 0; r < rows; ++r)
    display.rowTangent[r] = static_cast<float>(camera.tangentAt(static_cast<double>(r) + 0.5));

  SampleBlocks& blocks = display.blocks;
  display.columnDirection.resize(columns);
  display.columnRange.resize(columns);
  display.columnBlock.resize(columns + 1);
  for (std::size_t k = 0; k < columns; ++k) {
    display.columnDirection[k] = glm::vec2(camera.directionAt(static_cast<double>(k) + 0.5));
    const std::uint32_t begin = capture.columnStart[k], end = capture.columnStart[k + 1];
    display.columnRange[k] = rangeOf(capture, begin, end);
    display.columnBlock[k] = static_cast<std::uint32_t>(blocks.roles.size());
    for (std::uint32_t i = begin; i < end; i += kSamplesPerBlock) {
      const std::uint32_t last = std::min(i + kSamplesPerBlock, end);
      const glm::vec2 range = rangeOf(capture, i, last);
      blocks.leastInverse.push_back(range.x), blocks.mostInverse.push_back(range.y);
      blocks.lowTangent.push_back(display.rowTangent[capture.row[last - 1]]);
      blocks.highTangent.push_back(display.rowTangent[capture.row[i]]);
      blocks.roles.push_back(std::accumulate(capture.roles.begin() + i, capture.roles.begin() + last,
                                             std::uint8_t(0), std::bit_or<std::uint8_t>()));
    }
    for (std::uint32_t i = begin + 1; i < end && !display.layered; ++i)
      display.layered = capture.row[i] == capture.row[i - 1];
  }
  display.columnBlock[columns] = static_cast<std::uint32_t>(blocks.roles.size());
  for (auto* values : {&blocks.leastInverse, &blocks.mostInverse, &blocks.lowTangent, &blocks.highTangent})
    values->resize(values->size() + kSampleRoom);
  blocks.roles.resize(blocks.roles.size() + kSampleRoom);
  return display;
}

}  // namespace

DisplayCapture prepareForDisplay(const Capture& capture, float exposure) {
  const ColumnCamera& camera = capture.camera;
  DisplayCapture display = prepare(camera, capture, exposure);
  if (capture.background.runCount() > 0) {
    DisplayBackground& background = display.background;
    background.runs = capture.background;
    for (int x = 0; x <= camera.columns; ++x) background.columnBorder.push_back(camera.directionAt(x));
    for (int y = 0; y <= camera.rows; ++y) background.rowBorder.push_back(camera.tangentAt(y));
  }
  if (capture.hasReflections())
    display.reflections =
        std::make_shared<const DisplayCapture>(prepare(capture.camera, capture.reflections, exposure));
  return display;
}

}  // namespace acentric
