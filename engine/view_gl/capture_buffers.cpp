#include "engine/view_gl/capture_buffers.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "engine/view_gl/gl_check.h"

namespace acentric {
namespace {

struct GlSample {
  std::uint32_t inverseDistanceAndRoles;
  std::uint32_t rowAndColumn;
  std::uint32_t colour;
};
static_assert(sizeof(GlSample) == 12, "the shader reads a stride of 12 bytes");

std::vector<GlSample> pack(const DisplayCapture& capture, int firstColumn, int lastColumn) {
  std::vector<GlSample> packed;
  packed.reserve(capture.columnStart[std::size_t(lastColumn)] -
                 capture.columnStart[std::size_t(firstColumn)]);
  for (int column = firstColumn; column < lastColumn; ++column)
    for (std::size_t s = capture.columnStart[std::size_t(column)];
         s < capture.columnStart[std::size_t(column) + 1]; ++s)
      packed.push_back({capture.samples[s].inverseDistanceAndRoles,
                        capture.samples[s].row | std::uint32_t(column) << 16,
                        std::bit_cast<std::uint32_t>(capture.colour[s])});
  return packed;
}

std::vector<glm::uvec2> packBackground(const CaptureBackground& background) {
  std::vector<glm::uvec2> packed;
  packed.reserve(background.runCount());
  for (std::size_t i = 0; i < background.runCount(); ++i)
    packed.emplace_back(background.firstRow[i] | std::uint32_t(background.endRow[i]) << 16,
                        background.roles[i]);
  return packed;
}

/// Whole words, as the shader reads them.
std::vector<std::uint8_t> packMirrors(const DisplayCapture& capture, int firstColumn, int lastColumn) {
  std::vector<std::uint8_t> packed(capture.mirror.begin() + capture.columnStart[std::size_t(firstColumn)],
                                   capture.mirror.begin() + capture.columnStart[std::size_t(lastColumn)]);
  packed.resize((packed.size() + 3) / 4 * 4, 0);
  return packed;
}

/// Whole words too.
std::vector<LayerPlace> packLayers(const DisplayCapture& capture, int firstColumn, int lastColumn) {
  std::vector<LayerPlace> packed;
  for (int column = firstColumn; column < lastColumn; ++column) {
    const std::size_t end = capture.columnStart[std::size_t(column) + 1];
    for (std::size_t first = capture.columnStart[std::size_t(column)], last = first; first < end;
         first = last) {
      while (last < end && capture.samples[last].row == capture.samples[first].row) ++last;
      for (std::size_t s = first; s < last; ++s)
        packed.push_back({std::uint8_t(std::min(s - first, kManyLayers)),
                          std::uint8_t(std::min(last - 1 - s, kManyLayers))});
    }
  }
  packed.resize((packed.size() + 1) / 2 * 2);
  return packed;
}

/// Whole words too.
std::vector<Slant> packSlants(const DisplayCapture& capture, int firstColumn, int lastColumn) {
  std::vector<Slant> packed;
  for (std::size_t s = capture.columnStart[std::size_t(firstColumn)];
       s < capture.columnStart[std::size_t(lastColumn)]; ++s)
    packed.push_back(capture.samples[s].slant);
  packed.resize((packed.size() + 1) / 2 * 2);
  return packed;
}

std::vector<std::uint8_t> clearSamplesOf(const DisplayCapture& capture) {
  std::vector<std::uint8_t> most(std::size_t(capture.camera.columns), 0);
  if (!capture.blended) return most;
  for (std::size_t column = 0; column < most.size(); ++column) {
    int inPixel = 0;
    for (std::size_t s = capture.columnStart[column]; s < capture.columnStart[column + 1]; ++s) {
      if (s == capture.columnStart[column] || capture.samples[s].row != capture.samples[s - 1].row)
        inPixel = 0;
      inPixel += capture.colour[s].a < 255 ? 1 : 0;
      most[column] = std::max(most[column], std::uint8_t(std::min(inPixel, kMostClearRanks)));
    }
  }
  return most;
}

Status addSamples(CaptureBuffers& buffers, const DisplayCapture& capture, const char* name,
                  std::size_t largestBuffer) {
  // Vertex numbers are signed.
  const std::size_t mostSamples =
      std::min(storageLimit(largestBuffer) / sizeof(GlSample), std::size_t(1) << 30);
  const auto start = [&](int column) { return std::size_t(capture.columnStart[std::size_t(column)]); };
  for (int first = 0; first < capture.camera.columns;) {
    int last = first;
    while (last < capture.camera.columns && start(last + 1) - start(first) <= mostSamples) ++last;
    if (last == first)
      return fail(
          ErrorKind::tooLarge,
          fmt::format(
              "column {} has {} samples, more than this driver's storage buffers hold ({}): bake with "
              "fewer rows or use a CPU renderer",
              first, start(first + 1) - start(first), mostSamples),
          name);
    if (start(last) > start(first)) {
      CaptureChunk chunk{first, last, capture.columnStart[std::size_t(first)], {}, {}, {}, {}};
      chunk.samples = makeStorage(pack(capture, first, last), buffers.bytes);
      if (capture.layered) chunk.layers = makeStorage(packLayers(capture, first, last), buffers.bytes);
      if (!capture.mirror.empty())
        chunk.mirrors = makeStorage(packMirrors(capture, first, last), buffers.bytes);
      buffers.chunks.push_back(std::move(chunk));
    }
    first = last;
  }
  buffers.clearSamples = clearSamplesOf(capture);
  buffers.rowTangents = makeStorage(capture.rowTangent, buffers.bytes);
  return {};
}

/// What is asked for and not there yet.
Status addParts(CaptureBuffers& buffers, const DisplayCapture& capture, const char* name, CaptureParts parts,
                std::size_t largestBuffer) {
  if (parts != CaptureParts::background && !buffers.rowTangents)
    if (Status added = addSamples(buffers, capture, name, largestBuffer); !added) return added;
  if (parts == CaptureParts::samplesAndSlants)
    for (CaptureChunk& chunk : buffers.chunks)
      if (!chunk.slants)
        chunk.slants = makeStorage(packSlants(capture, chunk.firstColumn, chunk.lastColumn), buffers.bytes);
  return checkGl(fmt::format("uploading {}", name).c_str());
}

}  // namespace

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

std::size_t storageLimit(std::size_t largestBuffer) {
  GLint64 driversLargest = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &driversLargest);
  const std::size_t limit = std::size_t(std::max<GLint64>(driversLargest, 0));
  return largestBuffer > 0 ? std::min(limit, largestBuffer) : limit;
}

Result<CaptureBuffers> uploadCapture(const DisplayCapture& capture, const char* name, CaptureParts parts,
                                     std::size_t largestBuffer) {
  if (Status sound = checkArrays(capture, name); !sound) return tl::unexpected(sound.error());
  CaptureBuffers buffers;
  if (capture.background.runs.runCount() > 0)
    buffers.background = makeStorage(packBackground(capture.background.runs), buffers.bytes);
  if (Status added = addParts(buffers, capture, name, parts, largestBuffer); !added)
    return tl::unexpected(added.error());
  return buffers;
}

Result<const CaptureBuffers*> CaptureResidency::get(const std::shared_ptr<const DisplayCapture>& capture,
                                                    const char* name, CaptureParts parts) {
  if (CaptureBuffers* buffers = find(capture)) {
    if (Status added = addParts(*buffers, *capture, name, parts, largestBuffer_); !added)
      return tl::unexpected(added.error());
    return buffers;
  }
  Result<CaptureBuffers> uploaded = uploadCapture(*capture, name, parts, largestBuffer_);
  if (!uploaded) return tl::unexpected(uploaded.error());
  return &put(capture, std::move(*uploaded));
}

}  // namespace acentric
