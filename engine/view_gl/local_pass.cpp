#include "engine/view_gl/local_pass.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <numeric>

#include "engine/view_gl/gl_check.h"

namespace acentric {
namespace {

/// What LocalShading says of each material; the same rules for both renderers.
std::vector<LocalMaterial> materialsOf(const WalkScene& scene) { return LocalShading(scene).materials(); }

/// A texture that the scene names but does not hold reads as white.
const std::shared_ptr<const ColourImage>* imageOf(const Scene& scene, const TextureUse& use) {
  if (!use.used()) return nullptr;
  const int image = scene.textures[std::size_t(use.texture)].image;
  if (image < 0 || !scene.images[std::size_t(image)] || scene.images[std::size_t(image)]->empty())
    return nullptr;
  return &scene.images[std::size_t(image)];
}

/// Numbers of the clear triangles, farthest corner first.
std::vector<std::uint32_t> farToNear(const LocalBuffers& buffers, const glm::vec3& eye) {
  std::vector<float> farthest(buffers.clearCorners.size() / 3);
  for (std::size_t n = 0; n < farthest.size(); ++n)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const glm::vec3 offset = buffers.clearCorners[3 * n + corner] - eye;
      farthest[n] = std::max(farthest[n], glm::dot(offset, offset));
    }
  std::vector<std::uint32_t> order(farthest.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return farthest[a] > farthest[b]; });
  for (std::uint32_t& n : order) n += buffers.firstClear;
  return order;
}

const LocalBatch& batchOf(const std::vector<LocalBatch>& batches, std::uint32_t triangle) {
  const auto behind =
      std::upper_bound(batches.begin(), batches.end(), triangle,
                       [](std::uint32_t t, const LocalBatch& b) { return t < b.firstTriangle; });
  return *(behind - 1);
}

}  // namespace

LocalPass::LocalPass(ProgramCache& programs, TextureCache& textures)
    : programs_(programs), textures_(textures) {}

Status LocalPass::bindTexture(GlProgram& program, const char* uniform, int unit, const WalkScene& scene,
                              const TextureUse& use) {
  const Result<GLuint> texture = textures_.texture(*imageOf(*scene.scene, use));
  if (!texture) return tl::unexpected(texture.error());
  glActiveTexture(GL_TEXTURE0 + GLenum(unit));
  glBindTexture(GL_TEXTURE_2D, *texture);
  glBindSampler(GLuint(unit), textures_.sampler(scene.scene->textures[std::size_t(use.texture)]));
  glUniform1i(program.location(uniform), unit);
  return {};
}

Status LocalPass::prepare(const WalkScene& scene, const PerspectiveView& view, const LocalBuffers& buffers,
                          const LocalBatch& batch, const LocalMaterial& material, Draws draws) {
  const Material& source = *material.material;
  const bool looks = draws == Draws::looks, coloured = looks || material.masked;
  const bool textured = coloured && material.textured && batch.baseUv &&
                        imageOf(*scene.scene, source.baseColourTexture) != nullptr;
  const bool emissionTextured = looks && material.emissionTextured && batch.emissiveUv &&
                                imageOf(*scene.scene, source.emissiveTexture) != nullptr;
  Defines defines;
  const auto define = [&](bool on, const char* name) {
    if (on) defines.push_back(name);
  };
  define(textured, "TEXTURE");
  define(coloured && material.vertexColours && batch.vertexColours, "VERTEX_COLOURS");
  define(material.masked, "ALPHA_TEST");
  define(material.blended, "ALPHA_BLEND");
  define(looks && material.emits, "EMISSION");
  define(emissionTextured, "EMISSION_TEXTURE");
  define(material.transmissive, "FRESNEL");
  define(looks && buffers.lit && !material.unlit, "SURFACE_LIGHT");
  define(material.clear(), "CLEAR");
  define(!looks, "MARK_MIRROR");
  const Result<GlProgram*> found = programs_.get("local.vert", "local.frag", defines);
  if (!found) return tl::unexpected(found.error());
  GlProgram& program = **found;
  program.use();

  const float focal = float(view.focalPixels());
  const glm::vec3 originFromEye(buffers.origin - view.eye);
  const glm::mat3 viewFromWorld(view.viewFromWorld());
  glUniform3fv(program.location("originFromEye"), 1, glm::value_ptr(originFromEye));
  glUniformMatrix3fv(program.location("viewFromWorld"), 1, GL_FALSE, glm::value_ptr(viewFromWorld));
  glUniform2f(program.location("clipScale"), 2 * focal / float(view.width), 2 * focal / float(view.height));
  glUniform4fv(program.location("baseColour"), 1, glm::value_ptr(source.baseColour));
  glUniform1f(program.location("exposure"), scene.exposure);
  glUniform1ui(program.location("sourceLocal"), kSourceLocal);
  if (!looks)
    glUniform1ui(program.location("mirrorNumber"),
                 batch.isMirror() ? scene.mirrors->seenFrom(batch.mirrorPlane, view.eye) : 0);
  glUniform1f(program.location("alphaCutoff"), source.alphaCutoff);
  glUniform1f(program.location("transmission"), source.transmission);
  glUniform3fv(program.location("emission"), 1, glm::value_ptr(source.emissive));
  if (textured)
    if (Status bound = bindTexture(program, "baseTexture", 0, scene, source.baseColourTexture); !bound)
      return bound;
  if (emissionTextured)
    if (Status bound = bindTexture(program, "emissionTexture", 1, scene, source.emissiveTexture); !bound)
      return bound;
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, buffers.light.name());
  glBindVertexArray(buffers.vertexArray.name());
  return {};
}

Status LocalPass::markMirrors(const WalkScene& scene, const PerspectiveView& view, FrameTarget& target,
                              LocalBuffers& buffers) {
  const std::vector<LocalMaterial> materials = materialsOf(scene);
  if (Status begun = target.beginMirrors(); !begun) return begun;
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  for (const bool mirrors : {false, true}) {
    for (const GLuint kept : {0u, 1u, 3u}) {
      const GLboolean written = kept == 1 && mirrors ? GL_TRUE : GL_FALSE;
      glColorMaski(kept, written, written, written, written);
    }
    for (const LocalBatch& batch : buffers.batches) {
      const LocalMaterial& material = materials[std::size_t(batch.material)];
      if (material.clear() || batch.isMirror() != mirrors) continue;
      if (Status ready = prepare(scene, view, buffers, batch, material, Draws::mirrorNumber); !ready)
        return ready;
      glDrawArrays(GL_TRIANGLES, GLint(3 * batch.firstTriangle), GLsizei(3 * batch.triangles));
    }
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_DEPTH_TEST);
  return checkGl("marking mirrors among local geometry");
}

Status LocalPass::drawOpaque(const WalkScene& scene, const PerspectiveView& view, const FrameTarget& target,
                             LocalBuffers& buffers, bool marked) {
  const std::vector<LocalMaterial> materials = materialsOf(scene);
  target.bindForDrawing();
  glDisable(GL_BLEND);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(marked ? GL_GEQUAL : GL_GREATER);
  glEnable(GL_STENCIL_TEST);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  for (const LocalBatch& batch : buffers.batches) {
    const LocalMaterial& material = materials[std::size_t(batch.material)];
    if (material.clear()) continue;
    if (Status ready = prepare(scene, view, buffers, batch, material, Draws::looks); !ready) return ready;
    const auto drawWhere = [&](GLenum stencil, GLint value, GLuint bits) {
      glStencilFunc(stencil, value, bits);
      glDrawArrays(GL_TRIANGLES, GLint(3 * batch.firstTriangle), GLsizei(3 * batch.triangles));
    };
    if (!marked || !batch.isMirror()) {
      drawWhere(GL_ALWAYS, kCovered, 0xff);
      continue;
    }
    glColorMaski(0, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);  // only the source changes
    drawWhere(GL_EQUAL, kCovered | kReflection, kReflection);
    glColorMaski(0, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    drawWhere(GL_NOTEQUAL, kCovered | kReflection, kReflection);
  }
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_STENCIL_TEST);
  return checkGl("drawing local geometry");
}

Status LocalPass::drawClear(const WalkScene& scene, const PerspectiveView& view, const FrameTarget& target,
                            LocalBuffers& buffers) {
  const std::vector<LocalMaterial> materials = materialsOf(scene);
  const auto clear = [&](const LocalBatch& batch) { return materials[std::size_t(batch.material)].clear(); };
  if (std::none_of(buffers.batches.begin(), buffers.batches.end(), clear)) return {};

  std::vector<std::uint32_t> order = farToNear(buffers, glm::vec3(view.eye - buffers.origin));
  std::erase_if(order, [&](std::uint32_t t) { return !clear(batchOf(buffers.batches, t)); });
  std::vector<GLuint> indices;
  for (std::uint32_t t : order) indices.insert(indices.end(), {3 * t, 3 * t + 1, 3 * t + 2});
  glBindVertexArray(buffers.vertexArray.name());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices.size() * sizeof(GLuint)), indices.data(),
               GL_STREAM_DRAW);

  target.bindForDrawing();
  glEnable(GL_FRAMEBUFFER_SRGB);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  glColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);  // the source stays that of what shows through
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_FALSE);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_NOTEQUAL, 0, 0xff);  // over a hole there is nothing to tint
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  for (std::size_t n = 0; n < order.size();) {
    const LocalBatch& batch = batchOf(buffers.batches, order[n]);
    std::size_t end = n + 1;
    while (end < order.size() && &batchOf(buffers.batches, order[end]) == &batch) ++end;
    if (Status ready =
            prepare(scene, view, buffers, batch, materials[std::size_t(batch.material)], Draws::looks);
        !ready)
      return ready;
    glDrawElements(GL_TRIANGLES, GLsizei(3 * (end - n)), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(3 * n * sizeof(GLuint)));
    n = end;
  }
  glDepthMask(GL_TRUE);
  glColorMaski(1, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_FRAMEBUFFER_SRGB);
  return checkGl("drawing clear local geometry");
}

}  // namespace acentric
