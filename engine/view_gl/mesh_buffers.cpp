#include "engine/view_gl/mesh_buffers.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "engine/base/stopwatch.h"
#include "engine/view_gl/capture_buffers.h"
#include "engine/view_gl/gl_check.h"

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

MeshBuffers upload(const DisplayCapture& capture, const CaptureMesh& mesh, std::size_t limit) {
  MeshBuffers buffers;
  const std::size_t mostTexels = limit / sizeof(glm::uvec2), mostPatches = limit / sizeof(MeshPatch);
  const auto samplesBefore = [&](std::size_t patch) {
    return patch < mesh.patches.size() ? std::size_t(mesh.patches[patch].firstSample) : mesh.samples.size();
  };
  for (std::size_t first = 0; first < mesh.patches.size();) {
    std::size_t last = first + 1;
    while (last < mesh.patches.size() && last - first < mostPatches &&
           samplesBefore(last + 1) - samplesBefore(first) <= mostTexels)
      ++last;
    const std::size_t firstSample = samplesBefore(first), lastSample = samplesBefore(last);
    MeshChunk chunk;
    chunk.patches.assign(mesh.patches.begin() + std::ptrdiff_t(first),
                         mesh.patches.begin() + std::ptrdiff_t(last));
    for (MeshPatch& patch : chunk.patches) {
      patch.firstSample -= std::uint32_t(firstSample);
      buffers.widestPatch = std::max(buffers.widestPatch, int(patch.columns));
    }
    chunk.patchBuffer = makeStorage(chunk.patches, buffers.bytes);
    chunk.texels = makeStorage(packTexels(capture, mesh, firstSample, lastSample), buffers.bytes);
    if (!capture.mirror.empty())
      chunk.mirrors = makeStorage(packMirrors(capture, mesh, firstSample, lastSample), buffers.bytes);
    buffers.chunks.push_back(std::move(chunk));
    first = last;
  }
  buffers.borders = makeStorage(packBorders(capture.camera), buffers.bytes);
  return buffers;
}

}  // namespace

const PatchList& patchesFor(std::uint8_t roles, int columns, MeshChunk& chunk, MeshBuffers& buffers) {
  const auto known = chunk.lists.find(roles);
  if (known != chunk.lists.end()) return known->second;
  std::vector<std::uint32_t> numbers;
  PatchList list;
  for (std::uint32_t i = 0; i < chunk.patches.size(); ++i) {
    const MeshPatch& patch = chunk.patches[i];
    if ((patch.roles & roles) == 0) continue;
    list.columnStart.resize(std::max<std::size_t>(list.columnStart.size(), patch.column + 1u),
                            std::uint32_t(numbers.size()));
    numbers.push_back(i);
  }
  list.columnStart.resize(std::size_t(columns) + 1, std::uint32_t(numbers.size()));
  list.numbers = makeStorage(numbers, buffers.bytes);
  return chunk.lists.emplace(roles, std::move(list)).first->second;
}

Result<MeshBuffers*> MeshResidency::get(const std::shared_ptr<const DisplayCapture>& capture,
                                        const char* name, const Layout& layout, int camera,
                                        const ViewSettings& settings) {
  MeshBuffers* resident = find(capture);
  if (resident != nullptr && resident->errorSet == settings.meshError &&
      resident->trianglesSet == settings.maxMeshTriangles)
    return resident;
  if (Status sound = checkArrays(*capture, name); !sound) return tl::unexpected(sound.error());
  const Stopwatch watch;
  const double reach = eyeReach(layout, camera);
  MeshBound bound = meshBound(capture->camera, settings.meshError, reach);
  CaptureMesh mesh = buildCaptureMesh(*capture, bound, runner_);
  while (settings.maxMeshTriangles > 0 && mesh.triangleCount() > std::size_t(settings.maxMeshTriangles) &&
         bound.error < kLargestMeshError) {
    bound = meshBound(capture->camera, std::min(2 * bound.error, kLargestMeshError), reach);
    mesh = buildCaptureMesh(*capture, bound, runner_);
  }
  const double buildSeconds = watch.seconds();
  MeshBuffers buffers = upload(*capture, mesh, storageLimit(largestBuffer_));
  if (Status uploaded = checkGl(fmt::format("uploading the mesh of {}", name).c_str()); !uploaded)
    return tl::unexpected(uploaded.error());
  buffers.bound = bound;
  buffers.errorSet = settings.meshError;
  buffers.trianglesSet = settings.maxMeshTriangles;
  buffers.cost = {camera, mesh.samples.size(), mesh.triangleCount(), 0, bound.error, buildSeconds};
  return &put(capture, std::move(buffers));
}

}  // namespace acentric
