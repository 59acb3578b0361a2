#include "ui/space_mesh.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>

#include "ui/vertex_layout.h"

namespace acentric::ui {
namespace {

struct LineInstance {
  glm::vec3 from, to;  // metres from the origin
  float pixels;
  std::uint32_t colour;
};
struct FaceInstance {
  std::array<glm::vec3, 3> corners;
  std::uint32_t colour;
};
static_assert(sizeof(LineInstance) == 32 && sizeof(FaceInstance) == 40);

void layOut(const LineInstance*) {
  constexpr std::size_t kStride = sizeof(LineInstance);
  floats(0, 3, kStride, 0);
  floats(1, 3, kStride, sizeof(glm::vec3));
  floats(2, 1, kStride, 2 * sizeof(glm::vec3));
  glVertexAttribIPointer(3, 1, GL_UNSIGNED_INT, GLsizei(kStride), offset(offsetof(LineInstance, colour)));
}

void layOut(const FaceInstance*) {
  constexpr std::size_t kStride = sizeof(FaceInstance);
  for (const unsigned corner : {0U, 1U, 2U}) floats(corner, 3, kStride, corner * sizeof(glm::vec3));
  glVertexAttribIPointer(3, 1, GL_UNSIGNED_INT, GLsizei(kStride), offset(offsetof(FaceInstance, colour)));
}

std::vector<LineInstance> instancesOf(const std::vector<SpaceLine>& lines, const glm::dvec3& origin) {
  std::vector<LineInstance> out;
  out.reserve(lines.size());
  for (const SpaceLine& line : lines)
    out.push_back({glm::vec3(line.from - origin), glm::vec3(line.to - origin), line.pixels, line.colour});
  return out;
}

std::vector<FaceInstance> instancesOf(const std::vector<SpaceFace>& faces, const glm::dvec3& origin) {
  std::vector<FaceInstance> out;
  out.reserve(faces.size());
  for (const SpaceFace& face : faces)
    out.push_back({{glm::vec3(face.corners[0] - origin), glm::vec3(face.corners[1] - origin),
                    glm::vec3(face.corners[2] - origin)},
                   face.colour});
  return out;
}

std::uint64_t contentOf(std::span<const LineInstance> lines, std::span<const FaceInstance> faces) {
  ContentHash hash;
  hash.add(lines);
  hash.add(faces);
  return hash.value();
}

}  // namespace

template <class Instance>
void SpaceMesh::sendLasting(Instances& to, const std::vector<Instance>& instances) {
  constexpr std::size_t kRoomForPassing = 4096;
  to.lasting = instances.size();
  to.passing = 0;
  to.room = to.lasting + kRoomForPassing;
  glBindVertexArray(to.array.made());
  glBindBuffer(GL_ARRAY_BUFFER, to.data.made());
  glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(to.room * sizeof(Instance)), nullptr, GL_DYNAMIC_DRAW);
  if (!instances.empty())
    glBufferSubData(GL_ARRAY_BUFFER, 0, GLsizeiptr(instances.size() * sizeof(Instance)), instances.data());
  for (const unsigned place : {0U, 1U, 2U, 3U}) {
    glEnableVertexAttribArray(place);
    glVertexAttribDivisor(place, 1);
  }
  layOut(static_cast<const Instance*>(nullptr));
  glBindVertexArray(0);
}

template <class Instance>
void SpaceMesh::sendPassing(Instances& to, const std::vector<Instance>& instances) {
  to.passing = std::min(instances.size(), to.room - to.lasting);
  if (to.passing == 0) return;
  glBindBuffer(GL_ARRAY_BUFFER, to.data.name());
  glBufferSubData(GL_ARRAY_BUFFER, GLintptr(to.lasting * sizeof(Instance)),
                  GLsizeiptr(to.passing * sizeof(Instance)), instances.data());
}

void SpaceMesh::setLasting(const SpaceShapes& shapes, const glm::dvec3& origin) {
  origin_ = origin;
  const auto lines = instancesOf(shapes.lines, origin_);
  const auto faces = instancesOf(shapes.faces, origin_);
  sendLasting(lines_, lines);
  sendLasting(faces_, faces);
  lasting_ = contentOf(lines, faces);
  passing_ = 0;
}

void SpaceMesh::setPassing(const SpaceShapes& shapes) {
  const auto lines = instancesOf(shapes.lines, origin_);
  const auto faces = instancesOf(shapes.faces, origin_);
  sendPassing(lines_, lines);
  sendPassing(faces_, faces);
  passing_ = contentOf(lines, faces);
}

void SpaceMesh::setDistances(int width, int height, std::span<const float> metres) {
  if (width < 1 || height < 1 || metres.size() < std::size_t(width) * std::size_t(height))
    return clearDistances();
  glBindTexture(GL_TEXTURE_2D, distances_.made());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, width, height, 0, GL_RED, GL_FLOAT, metres.data());
  for (const GLenum name : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, name, GL_NEAREST);
  for (const GLenum name : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D, name, GL_CLAMP_TO_EDGE);
  glBindTexture(GL_TEXTURE_2D, 0);
  measured_ = true;
  ContentHash hash;
  hash.add(metres);
  distanceContent_ = hash.value();
}

void SpaceMesh::setUniforms(const GlProgram& program, const SpaceView& view, const CanvasTarget& target,
                            float hidden) const {
  // Right, up and forward of the picture, divided by what its borders see of them.
  const glm::dmat3 axes = view.viewFromWorld;
  const glm::dvec3 from = axes * (origin_ - view.eye);
  glm::mat4 clip(0);
  for (int c = 0; c < 3; ++c)
    clip[c] = {float(axes[c].x / view.tangents.x), float(-axes[c].y / view.tangents.y), 0, float(axes[c].z)};
  clip[3] = {float(from.x / view.tangents.x), float(-from.y / view.tangents.y), 0, float(from.z)};
  glUniformMatrix4fv(program.location("uClipFromLocal"), 1, GL_FALSE, &clip[0][0]);
  const glm::vec3 eye(view.eye - origin_);
  glUniform3f(program.location("uEye"), eye.x, eye.y, eye.z);
  const glm::dvec2 scale = view.areaSize / target.size;
  const glm::dvec2 middle = (view.areaMin + 0.5 * view.areaSize - target.min) / target.size;
  program.set("uAreaInTarget", float(scale.x), float(scale.y), float(2 * middle.x - 1),
              float(1 - 2 * middle.y));
  program.set("uAreaSize", float(view.areaSize.x), float(view.areaSize.y));
  program.set("uDistances", 0);
  program.set("uMeasured", measured_ ? 1.0F : 0.0F);
  program.set("uHidden", hidden);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, distances_.name());
}

void SpaceMesh::render(const SpaceView& view, const CanvasTarget& target, float hidden) {
  if (faces_.total() > 0 && face_.use()) {
    setUniforms(face_, view, target, hidden);
    glBindVertexArray(faces_.array.name());
    glDrawArraysInstanced(GL_TRIANGLES, 0, 3, GLsizei(faces_.total()));
  }
  if (lines_.total() > 0 && line_.use()) {
    setUniforms(line_, view, target, hidden);
    glBindVertexArray(lines_.array.name());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(lines_.total()));
  }
  glBindVertexArray(0);
  glBindTexture(GL_TEXTURE_2D, 0);
}

void SpaceMesh::draw(ImDrawList& list, const SpaceView& view, float hidden) {
  ContentHash hash;
  for (const std::uint64_t part : {lasting_, passing_, distanceContent_}) hash.add(part);
  hash.add(origin_);
  hash.add(view);
  hash.add(hidden);
  pending_ = {[this, view, hidden](const CanvasTarget& target) { render(view, target, hidden); },
              hash.value()};
  addRender(list, &pending_);
}

const std::string& SpaceMesh::problem() const {
  return line_.problem().empty() ? face_.problem() : line_.problem();
}

}  // namespace acentric::ui
