#include "engine/view_gl/capture_buffers.h"

namespace acentric {

CaptureUpload::CaptureUpload(CaptureTask task, PackedCapture capture) : task_(std::move(task)) {
  buffers_.parts = task_.parts;
  for (PackedColumns& packed : capture.chunks) {
    CaptureChunk& chunk = buffers_.chunks.emplace_back();
    chunk.firstColumn = packed.firstColumn;
    chunk.lastColumn = packed.lastColumn;
    chunk.firstSample = packed.firstSample;
    chunk.samples = sending_.add(std::move(packed.samples));
    chunk.mirrors = sending_.add(std::move(packed.mirrors));
    chunk.layers = sending_.add(std::move(packed.layers));
  }
  buffers_.rowTangents = sending_.add(std::move(capture.rowTangents));
  buffers_.background = sending_.add(std::move(capture.background));
  if (capture.patches) {
    buffers_.patchColours = sending_.add(std::span(capture.patches->colour), capture.patches);
    buffers_.patchCovers = sending_.add(std::span(capture.patches->cover), capture.patches);
  }
  buffers_.clearRanks = std::move(capture.clearRanks);
  buffers_.bytes = sending_.bytes();
}

}  // namespace acentric
