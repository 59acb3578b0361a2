#include "engine/view_gl/packed_mesh.h"

#include <algorithm>
#include <bit>

#include "engine/base/stopwatch.h"
#include "engine/view_gl/packed_capture.h"

namespace acentric {
namespace {

/// Opaque samples need no alpha: fringes lie there.
std::vector<glm::uvec2> packTexels(const DisplayCapture& capture, const CaptureMesh& mesh, std::size_t first,
                                   std::size_t last) {
  std::vector<glm::uvec2> texels;
  texels.reserve(last - first);
  for (std::size_t i = first; i < last; ++i) {
    const std::uint32_t sample = mesh.samples[i];
    Rgba8 colour = capture.colour[sample];
    colour.a = mesh.fringes[i];
    texels.emplace_back(capture.samples[sample].inverseDistanceAndRoles,
                        std::bit_cast<std::uint32_t>(colour));
  }
  return texels;
}

/// Whole words, as the shader reads them.
std::vector<std::uint8_t> packMirrors(const DisplayCapture& capture, const CaptureMesh& mesh,
                                      std::size_t first, std::size_t last) {
  std::vector<std::uint8_t> mirrors;
  for (std::size_t i = first; i < last; ++i) mirrors.push_back(capture.mirror[mesh.samples[i]]);
  mirrors.resize((mirrors.size() + 3) / 4 * 4, 0);
  return mirrors;
}

std::vector<float> packBorders(const ColumnCamera& camera) {
  std::vector<float> borders;
  for (int k = 0; k <= camera.columns; ++k) {
    const glm::vec2 direction(camera.directionAt(k));
    borders.insert(borders.end(), {direction.x, direction.y});
  }
  for (int r = 0; r <= camera.rows; ++r) borders.push_back(float(camera.tangentAt(r)));
  return borders;
}

/// Cut between patches.
std::vector<PackedChunk> packChunks(const DisplayCapture& capture, const CaptureMesh& mesh, std::size_t limit,
                                    const std::stop_token& stop) {
  std::vector<PackedChunk> chunks;
  const std::size_t mostTexels = limit / sizeof(glm::uvec2), mostPatches = limit / sizeof(MeshPatch);
  const auto samplesBefore = [&](std::size_t patch) {
    return patch < mesh.patches.size() ? std::size_t(mesh.patches[patch].firstSample) : mesh.samples.size();
  };
  for (std::size_t first = 0; first < mesh.patches.size() && !stop.stop_requested();) {
    std::size_t last = first + 1;
    while (last < mesh.patches.size() && last - first < mostPatches &&
           samplesBefore(last + 1) - samplesBefore(first) <= mostTexels)
      ++last;
    const std::size_t firstSample = samplesBefore(first), lastSample = samplesBefore(last);
    PackedChunk chunk;
    chunk.patches.assign(mesh.patches.begin() + std::ptrdiff_t(first),
                         mesh.patches.begin() + std::ptrdiff_t(last));
    for (MeshPatch& patch : chunk.patches) patch.firstSample -= std::uint32_t(firstSample);
    chunk.texels = packTexels(capture, mesh, firstSample, lastSample);
    if (!capture.mirror.empty()) chunk.mirrors = packMirrors(capture, mesh, firstSample, lastSample);
    chunks.push_back(std::move(chunk));
    first = last;
  }
  return chunks;
}

}  // namespace

bool MeshTask::sameAs(const MeshTask& other) const {
  const bool sameCapture = !capture.owner_before(other.capture) && !other.capture.owner_before(capture);
  return sameCapture && error == other.error && maxTriangles == other.maxTriangles;
}

std::size_t PackedMesh::bytes() const {
  std::size_t sum = bytesOf(borders);
  for (const PackedChunk& chunk : chunks)
    sum += bytesOf(chunk.patches) + bytesOf(chunk.texels) + bytesOf(chunk.mirrors);
  return sum;
}

Result<PackedMesh> packMesh(const DisplayCapture& capture, const MeshTask& task, TaskRunner& runner,
                            const std::stop_token& stop) {
  if (Status sound = checkArrays(capture, task.name.c_str()); !sound) return tl::unexpected(sound.error());
  const Stopwatch watch;
  const LimitedMesh built =
      buildLimitedMesh(capture, task.error, task.reach, task.maxTriangles, runner, stop);
  const CaptureMesh& mesh = built.mesh;
  PackedMesh packed;
  packed.bound = built.bound;
  packed.cost = {task.camera, mesh.samples.size(), mesh.triangleCount(),
                 0,           built.bound.error,   watch.seconds()};
  for (const MeshPatch& patch : mesh.patches)
    packed.widestPatch = std::max(packed.widestPatch, int(patch.columns));
  packed.chunks = packChunks(capture, mesh, task.largestBuffer, stop);
  packed.borders = packBorders(capture.camera);
  if (stop.stop_requested()) return fail(ErrorKind::cancelled, "stopped", task.name);
  return packed;
}

}  // namespace acentric
