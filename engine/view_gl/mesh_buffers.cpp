#include "engine/view_gl/mesh_buffers.h"

#include <algorithm>

#include "engine/view_gl/capture_buffers.h"

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
  list.numbers = makeStorage(numbers, buffers.bytes);
  return chunk.lists.emplace(roles, std::move(list)).first->second;
}

MeshUpload::MeshUpload(MeshTask task, PackedMesh mesh) : mesh_(std::move(mesh)) {
  buffers_.task = std::move(task);
  buffers_.bound = mesh_.bound;
  buffers_.widestPatch = mesh_.widestPatch;
  buffers_.cost = mesh_.cost;
  for (PackedChunk& packed : mesh_.chunks) {
    MeshChunk& chunk = buffers_.chunks.emplace_back();
    chunk.patches = std::move(packed.patches);
    chunk.patchBuffer = make(chunk.patches);
    chunk.texels = make(packed.texels);
    if (!packed.mirrors.empty()) chunk.mirrors = make(packed.mirrors);
  }
  buffers_.borders = make(mesh_.borders);
}

/// Room for the values, which are to be sent.
template <class Value>
GlBuffer MeshUpload::make(const std::vector<Value>& values) {
  GlBuffer buffer = GlBuffer::make();
  const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer.name());
  glBufferData(GL_SHADER_STORAGE_BUFFER, GLsizeiptr(bytes.size()), nullptr, GL_STATIC_DRAW);
  buffers_.bytes += bytes.size();
  parts_.push_back({buffer.name(), bytes});
  return buffer;
}

std::size_t MeshUpload::send(std::size_t most) {
  std::size_t sent = 0;
  while (!done() && sent < most) {
    const Part& part = parts_[next_];
    const std::size_t count = std::min(part.bytes.size() - sentOfNext_, most - sent);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, part.buffer);
    glBufferSubData(GL_SHADER_STORAGE_BUFFER, GLintptr(sentOfNext_), GLsizeiptr(count),
                    part.bytes.data() + sentOfNext_);
    sent += count, sentOfNext_ += count;
    if (sentOfNext_ < part.bytes.size()) continue;
    ++next_, sentOfNext_ = 0;
  }
  return sent;
}

}  // namespace acentric
