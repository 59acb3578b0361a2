#include "engine/view_gl/mesh_buffers.h"

#include <algorithm>

namespace acentric {

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
  BufferUpload sending;
  list.numbers = sending.add(numbers);
  buffers.bytes += sending.send(sending.bytes());
  return chunk.lists.emplace(roles, std::move(list)).first->second;
}

MeshUpload::MeshUpload(MeshTask task, PackedMesh mesh) {
  buffers_.task = std::move(task);
  buffers_.bound = mesh.bound;
  buffers_.widestPatch = mesh.widestPatch;
  buffers_.cost = mesh.cost;
  for (PackedChunk& packed : mesh.chunks) {
    MeshChunk& chunk = buffers_.chunks.emplace_back();
    chunk.patches = std::move(packed.patches);
    chunk.patchBuffer = sending_.add(chunk.patches);
    chunk.texels = sending_.add(std::move(packed.texels));
    chunk.mirrors = sending_.add(std::move(packed.mirrors));
  }
  buffers_.borders = sending_.add(std::move(mesh.borders));
  buffers_.bytes = sending_.bytes();
}

}  // namespace acentric
