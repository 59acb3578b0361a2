#include "engine/view_gl/packed_capture.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "engine/base/contract.h"

namespace acentric {
namespace {

std::vector<glm::uvec2> packBackground(const CaptureBackground& background) {
  std::vector<glm::uvec2> packed;
  packed.reserve(background.runCount());
  for (std::size_t i = 0; i < background.runCount(); ++i)
    packed.emplace_back(background.firstRow[i] | std::uint32_t(background.endRow[i]) << 16,
                        background.roles[i]);
  return packed;
}

/// Values of four bytes or less, and as many more as fill the last word.
template <class Value>
std::size_t inWords(std::size_t count) {
  constexpr std::size_t inWord = 4 / sizeof(Value);
  return (count + inWord - 1) / inWord * inWord;
}

void addLayers(const DisplayCapture& capture, std::size_t begin, std::size_t end,
               std::vector<LayerPlace>& layers) {
  for (std::size_t first = begin, last = begin; first < end; first = last) {
    while (last < end && capture.samples[last].row == capture.samples[first].row) ++last;
    for (std::size_t s = first; s < last; ++s)
      layers.push_back({std::uint8_t(std::min(s - first, kManyLayers)),
                        std::uint8_t(std::min(last - 1 - s, kManyLayers))});
  }
}

/// Returns the most clear samples in one pixel.
std::uint8_t clearRanks(const DisplayCapture& capture, std::size_t begin, std::size_t end) {
  int most = 0, inPixel = 0;
  for (std::size_t s = begin; s < end; ++s) {
    if (s == begin || capture.samples[s].row != capture.samples[s - 1].row) inPixel = 0;
    inPixel += capture.colour[s].a < 255 ? 1 : 0;
    most = std::max(most, inPixel);
  }
  return std::uint8_t(std::min(most, kMostClearRanks));
}

PackedColumns packColumns(const DisplayCapture& capture, int first, int last, const std::stop_token& stop) {
  PackedColumns packed;
  packed.firstColumn = first;
  packed.lastColumn = last;
  packed.firstSample = capture.columnStart[std::size_t(first)];
  const std::size_t count = capture.columnStart[std::size_t(last)] - packed.firstSample;
  packed.samples.reserve(count);
  if (capture.layered) packed.layers.reserve(inWords<LayerPlace>(count));
  for (int column = first; column < last && !stop.stop_requested(); ++column) {
    const std::size_t begin = capture.columnStart[std::size_t(column)];
    const std::size_t end = capture.columnStart[std::size_t(column) + 1];
    for (std::size_t s = begin; s < end; ++s) {
      const PackedSample& sample = capture.samples[s];
      packed.samples.push_back({sample.inverseDistanceAndRoles, sample.row | std::uint32_t(column) << 16,
                                std::bit_cast<std::uint32_t>(capture.colour[s])});
    }
    if (capture.layered) addLayers(capture, begin, end, packed.layers);
  }
  if (!capture.mirror.empty()) {
    const auto mirrors = capture.mirror.begin() + std::ptrdiff_t(packed.firstSample);
    packed.mirrors.reserve(inWords<std::uint8_t>(count));
    packed.mirrors.assign(mirrors, mirrors + std::ptrdiff_t(count));
  }
  packed.layers.resize(inWords<LayerPlace>(packed.layers.size()));
  packed.mirrors.resize(inWords<std::uint8_t>(packed.mirrors.size()));
  return packed;
}

Status packChunks(const DisplayCapture& capture, const CaptureTask& task, const std::stop_token& stop,
                  PackedCapture& packed) {
  // Vertex numbers are signed.
  const std::size_t mostSamples = std::min(task.largestBuffer / sizeof(GlSample), std::size_t(1) << 30);
  const std::size_t usual = std::min(mostSamples, task.usualBuffer / sizeof(GlSample));
  const auto start = [&](int column) { return std::size_t(capture.columnStart[std::size_t(column)]); };
  for (int first = 0; first < capture.camera.columns && !stop.stop_requested();) {
    int last = first + 1;
    while (last < capture.camera.columns && start(last + 1) - start(first) <= usual) ++last;
    if (start(last) - start(first) > mostSamples)
      return fail(
          ErrorKind::tooLarge,
          fmt::format(
              "column {} has {} samples, more than this driver's storage buffers hold ({}): bake with "
              "fewer rows or use a CPU renderer",
              first, start(first + 1) - start(first), mostSamples),
          task.name);
    if (start(last) > start(first)) packed.chunks.push_back(packColumns(capture, first, last, stop));
    first = last;
  }
  return {};
}

std::size_t bytesOfTexels(const DisplayPatches& patches) {
  return patches.colour.size() * sizeof(patches.colour[0]) + patches.cover.size() * sizeof(patches.cover[0]);
}

/// Of the patches that a capture has.
Status checkPatches(const DisplayPatches& patches, const CaptureTask& task) {
  const std::size_t texels = patches.colour.size();
  bool sound = patches.cover.size() == texels;
  for (const DisplayPatch& patch : patches.patches)
    sound = sound &&
            patch.firstTexel + (patch.columns + std::size_t(2)) * (patch.rows + std::size_t(2)) <= texels;
  if (!sound)
    return fail(ErrorKind::malformed, "the capture's patches have other texels than they say", task.name);
  if (texels * sizeof(std::uint32_t) > task.largestBuffer)
    return fail(
        ErrorKind::tooLarge,
        fmt::format("its patches have {} texels, more than this driver's storage buffers hold ({}): bake "
                    "with fewer samples per degree or use a CPU renderer",
                    texels, task.largestBuffer / sizeof(std::uint32_t)),
        task.name);
  return {};
}

}  // namespace

bool CaptureTask::sameAs(const CaptureTask& other) const {
  return !capture.owner_before(other.capture) && !other.capture.owner_before(capture) && parts == other.parts;
}

std::size_t PackedCapture::bytes() const {
  std::size_t sum = bytesOf(rowTangents) + bytesOf(background);
  for (const PackedColumns& chunk : chunks)
    sum += bytesOf(chunk.samples) + bytesOf(chunk.mirrors) + bytesOf(chunk.layers);
  return sum + (patches ? bytesOfTexels(*patches) : 0);
}

std::size_t packedBytes(const DisplayCapture& capture, CaptureParts parts) {
  const std::size_t background = capture.background.runs.runCount() * sizeof(glm::uvec2);
  if (parts == CaptureParts::patches) return background + bytesOfTexels(*capture.patches);
  if (parts == CaptureParts::background) return background;
  const std::size_t samples = capture.samples.size();
  std::size_t bytes = samples * sizeof(GlSample);
  if (capture.layered) bytes += inWords<LayerPlace>(samples) * sizeof(LayerPlace);
  if (!capture.mirror.empty()) bytes += inWords<std::uint8_t>(samples);
  return background + bytes + bytesOf(capture.rowTangent);
}

Status checkArrays(const DisplayCapture& capture, const char* name) {
  const auto bad = [&](const char* what) { return fail(ErrorKind::malformed, what, name); };
  if (Status camera = capture.camera.check(); !camera) return camera;
  const std::size_t columns = std::size_t(capture.camera.columns), rows = std::size_t(capture.camera.rows);
  const std::size_t samples = capture.samples.size();
  if (capture.columnStart.size() != columns + 1 || capture.columnDirection.size() != columns ||
      capture.columnRange.size() != columns || capture.rowTangent.size() != rows)
    return bad("the capture's column and row tables do not fit its camera");
  if (capture.colour.size() != samples) return bad("the capture's sample arrays differ in length");
  if (!capture.mirror.empty() && capture.mirror.size() != samples)
    return bad("the capture does not name the mirror of each sample");
  if (capture.columnStart.front() != 0 || capture.columnStart.back() != samples ||
      !std::is_sorted(capture.columnStart.begin(), capture.columnStart.end()))
    return bad("the capture's columns do not partition its samples");
  const CaptureBackground& background = capture.background.runs;
  if (background.runCount() > 0 &&
      (background.columnStart.size() != columns + 1 || background.columnStart.front() != 0 ||
       background.columnStart.back() != background.runCount() ||
       !std::is_sorted(background.columnStart.begin(), background.columnStart.end()) ||
       background.endRow.size() != background.runCount() || background.roles.size() != background.runCount()))
    return bad("the capture's columns do not partition its background");
  if (std::ranges::any_of(capture.samples, [&](const PackedSample& sample) { return sample.row >= rows; }))
    return bad("a sample's row is outside the picture");
  return {};
}

Result<PackedCapture> packCapture(const DisplayCapture& capture, const CaptureTask& task,
                                  const std::stop_token& stop) {
  if (Status sound = checkArrays(capture, task.name.c_str()); !sound) return tl::unexpected(sound.error());
  PackedCapture packed;
  packed.background = packBackground(capture.background.runs);
  if (task.parts == CaptureParts::samples) {
    if (Status done = packChunks(capture, task, stop, packed); !done) return tl::unexpected(done.error());
    packed.rowTangents = capture.rowTangent;
    packed.clearRanks.resize(std::size_t(capture.camera.columns));
    for (std::size_t k = 0; capture.blended && k < packed.clearRanks.size() && !stop.stop_requested(); ++k)
      packed.clearRanks[k] = clearRanks(capture, capture.columnStart[k], capture.columnStart[k + 1]);
  }
  if (task.parts == CaptureParts::patches) {
    require(capture.patches != nullptr, "patches are asked for of a capture that has them");
    if (Status whole = checkPatches(*capture.patches, task); !whole) return tl::unexpected(whole.error());
    packed.patches = capture.patches;
  }
  if (stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped", task.name);
  return packed;
}

}  // namespace acentric
