#include "engine/view_gl/local_buffers.h"

#include <fmt/format.h>

#include <cstddef>

#include "engine/view_gl/gl_check.h"

namespace acentric {
namespace {

void describeVertices(const LocalBuffers& buffers) {
  const auto attribute = [](GLuint index, GLint size, GLenum type, std::size_t offset) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, type, type == GL_UNSIGNED_SHORT ? GL_TRUE : GL_FALSE,
                          sizeof(LocalCorner), reinterpret_cast<const void*>(offset));
  };
  glBindVertexArray(buffers.vertexArray.name());
  glBindBuffer(GL_ARRAY_BUFFER, buffers.vertices.name());
  attribute(0, 3, GL_FLOAT, offsetof(LocalCorner, position));
  attribute(1, 2, GL_FLOAT, offsetof(LocalCorner, barycentric));
  attribute(2, 2, GL_FLOAT, offsetof(LocalCorner, baseUv));
  attribute(3, 2, GL_FLOAT, offsetof(LocalCorner, emissiveUv));
  attribute(4, 4, GL_UNSIGNED_SHORT, offsetof(LocalCorner, colour));
  glEnableVertexAttribArray(5);
  glVertexAttribIPointer(5, 2, GL_UNSIGNED_INT, sizeof(LocalCorner),
                         reinterpret_cast<const void*>(offsetof(LocalCorner, lightFirst)));
  attribute(6, 3, GL_FLOAT, offsetof(LocalCorner, normal));
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers.indices.name());
}

template <class Value>
GlBuffer makeBuffer(GLenum target, const std::vector<Value>& values) {
  GlBuffer buffer = GlBuffer::make();
  glBindBuffer(target, buffer.name());
  glBufferData(target, GLsizeiptr(values.size() * sizeof(Value)), values.data(), GL_STATIC_DRAW);
  return buffer;
}

}  // namespace

Result<LocalBuffers> uploadLocal(const WalkScene& walk,
                                 const std::shared_ptr<const LocalGeometry>& geometry) {
  LocalBuffers buffers;
  buffers.owner = geometry;
  buffers.lightOwner = walk.surfaceLight;
  buffers.mirrorsOwner = walk.mirrors;
  if (!geometry->polygon.corners.empty()) buffers.origin = glm::dvec3(geometry->polygon.corners.front(), 0);
  Result<LocalCorners> made = localCorners(walk, *geometry, buffers.origin);
  if (!made) return tl::unexpected(made.error());
  buffers.lit = made->lit, buffers.mirrors = made->mirrors;
  buffers.batches = std::move(made->batches);
  buffers.clearCorners = std::move(made->clearCorners);
  buffers.firstClear = made->firstClear;
  buffers.triangles = std::uint32_t(made->corners.size() / 3);

  GLint64 largest = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
  if (made->light.size() * sizeof(HalfColour) > std::size_t(std::max<GLint64>(largest, 0)))
    return fail(
        ErrorKind::tooLarge,
        fmt::format(
            "{} light samples in one region are more than this driver's storage buffers hold ({} MiB): "
            "bake coarser surface light, smaller cells, or use a CPU renderer",
            made->light.size(), largest >> 20),
        "local geometry");
  if (made->light.empty()) made->light.emplace_back(0);  // no buffer of size 0
  buffers.vertexArray = GlVertexArray::make();
  glBindVertexArray(buffers.vertexArray.name());
  buffers.vertices = makeBuffer(GL_ARRAY_BUFFER, made->corners);
  buffers.indices = GlBuffer::make();
  buffers.light = makeBuffer(GL_SHADER_STORAGE_BUFFER, made->light);
  describeVertices(buffers);
  if (Status uploaded = checkGl("uploading local geometry"); !uploaded)
    return tl::unexpected(uploaded.error());
  return buffers;
}

Result<LocalBuffers*> LocalResidency::get(const WalkScene& scene, std::size_t region) {
  const std::shared_ptr<const LocalGeometry>& geometry = scene.local[region];
  auto found = resident_.find(geometry.get());
  if (found == resident_.end()) {
    Result<LocalBuffers> buffers = uploadLocal(scene, geometry);
    if (!buffers) return tl::unexpected(buffers.error());
    found = resident_.emplace(geometry.get(), std::move(*buffers)).first;
  }
  return &found->second;
}

void LocalResidency::dropGone(const WalkScene& scene) {
  std::map<const LocalGeometry*, std::shared_ptr<const LocalGeometry>> wanted;
  for (const auto& local : scene.local) wanted.emplace(local.get(), local);
  std::erase_if(resident_, [&](const auto& entry) {
    const auto found = wanted.find(entry.first);
    const bool same = found != wanted.end() && found->second && entry.second.owner.lock() == found->second;
    if (!same || entry.second.mirrorsOwner.lock() != scene.mirrors) return true;
    if (found->second->surfaces) return false;  // surfaces of its own bring their light
    // A light that died reads as null, like none: so whether there was one is kept apart.
    const bool sameLight =
        scene.surfaceLight ? entry.second.lightOwner.lock() == scene.surfaceLight : !entry.second.lit;
    return !sameLight;
  });
}

}  // namespace acentric
