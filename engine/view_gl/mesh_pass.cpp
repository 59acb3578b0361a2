#include "engine/view_gl/mesh_pass.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <limits>

#include "engine/view_gl/gl_check.h"

namespace acentric {
namespace {

/// By so many bounds fringes lie behind the samples beside them: those may be off by two against each other.
constexpr double kFringeDepth = 3;

constexpr GLsizei kCornersPerPatch = 6;

/// Columns [first, second).
using Columns = std::pair<int, int>;

/// Those in sight, rising and apart.
std::vector<Columns> columnsInSight(const std::vector<ColumnRun>& runs) {
  std::vector<Columns> sorted, joined;
  for (const ColumnRun& run : runs) sorted.emplace_back(run.first, run.last);
  std::ranges::sort(sorted);
  for (const Columns& columns : sorted)
    if (!joined.empty() && columns.first <= joined.back().second)
      joined.back().second = std::max(joined.back().second, columns.second);
    else
      joined.push_back(columns);
  return joined;
}

}  // namespace

MeshPass::MeshPass(ProgramCache& programs)
    : programs_(programs), noAttributes_(GlVertexArray::make()), limits_(GlBuffer::make()) {}

Result<GlProgram*> MeshPass::program(const CapturePiece& piece, const MeshBuffers& mesh) {
  Defines defines;
  if (piece.plan.clipToPart) defines.push_back("CLIP_TO_PART");
  if (piece.leastDepths != 0) defines.push_back("IN_CRACKS");
  if (isFiltered(piece.settings.reconstruction)) defines.push_back("PLACES");
  if (piece.mirrors == Mirrors::mark) {
    if (!piece.capture->mirror.empty()) defines.push_back("MIRRORS");
    defines.push_back("MARK_MIRRORS");
  }
  const Result<GlProgram*> found = programs_.get("mesh.vert", "mesh.frag", defines);
  if (!found) return found;
  GlProgram& program = **found;
  program.use();
  const PerspectiveView& view = piece.view;
  const ColumnCamera& camera = piece.capture->camera;
  const glm::dmat3 pictureFromWorld = pictureMatrix(view);
  setUniform(program, "eastInPicture", glm::vec3(pictureFromWorld[0]));
  setUniform(program, "northInPicture", glm::vec3(pictureFromWorld[1]));
  setUniform(program, "upInPicture", glm::vec3(pictureFromWorld[2]));
  setUniform(program, "baselineInPicture", glm::vec3(pictureFromWorld * glm::dvec3(piece.plan.baseline)));
  setUniform(program, "pictureSize", glm::vec2(view.width, view.height));
  setUniform(program, "pitches", glm::vec2(camera.columnPitch(), camera.rowPitch()));
  setUniform(program, "fringes", glm::vec2(kOpenFringe, mesh.bound.fringeStep));
  glUniform1ui(program.location("firstTangent"), GLuint(2 * (camera.columns + 1)));
  glUniform1ui(program.location("roles"), piece.plan.roles);
  glUniform1ui(program.location("sourceOfPiece"), GLuint(sourceOfCamera(piece.plan.camera)));
  glUniform1f(program.location("fringeDepth"), float(kFringeDepth * mesh.bound.inverseDistance));
  if (piece.leastDepths != 0) setCracks(program, piece.leastDepths);
  if (piece.plan.clipToPart) {
    setPart(program, piece.plan);
    const glm::mat3 worldFromPicture(glm::inverse(pictureFromWorld));
    glUniformMatrix3fv(program.location("worldFromPicture"), 1, GL_FALSE, glm::value_ptr(worldFromPicture));
    glUniform1f(program.location("pictureHeight"), float(view.height));
  }
  return found;
}

Status MeshPass::draw(const CapturePiece& piece, MeshBuffers& mesh, FrameStats& stats) {
  const DisplayCapture& capture = *piece.capture;
  const Result<GlProgram*> ready = program(piece, mesh);
  if (!ready) return tl::unexpected(ready.error());

  std::vector<glm::vec2> limits;
  for (std::size_t k = 0; k < std::size_t(capture.camera.columns); ++k)
    limits.emplace_back(std::min(piece.plan.maxInverseDistance[k], std::numeric_limits<float>::max()),
                        piece.plan.minInverseDistance.empty() ? 0.0f : piece.plan.minInverseDistance[k]);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, limits_.name());
  glBufferData(GL_SHADER_STORAGE_BUFFER, GLsizeiptr(limits.size() * sizeof limits[0]), limits.data(),
               GL_STREAM_DRAW);
  glBindVertexArray(noAttributes_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, mesh.borders.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, limits_.name());
  for (MeshChunk& chunk : mesh.chunks) drawChunk(piece, chunk, mesh, stats);
  MeshCost cost = mesh.cost;
  cost.bytes = mesh.bytes;  // lists of patches included
  const auto known = std::ranges::find(stats.meshes, cost.camera, &MeshCost::camera);
  known == stats.meshes.end() ? stats.meshes.push_back(cost) : void(*known = cost);
  return checkGl("drawing meshes");
}

void MeshPass::drawChunk(const CapturePiece& piece, MeshChunk& chunk, MeshBuffers& mesh, FrameStats& stats) {
  const PatchList& list = patchesFor(piece.plan.roles, piece.capture->camera.columns, chunk, mesh);
  std::vector<GLint> firsts;
  std::vector<GLsizei> counts;
  std::uint32_t drawn = 0;  // of the list
  for (const auto& [first, last] : columnsInSight(piece.plan.runs)) {
    // Also those that begin before and reach in.
    const std::size_t reaching = std::size_t(std::max(first - mesh.widestPatch + 1, 0));
    const std::uint32_t begin = std::max(list.columnStart[reaching], drawn);
    drawn = std::max(list.columnStart[std::size_t(last)], drawn);
    if (begin == drawn) continue;
    firsts.push_back(GLint(begin) * kCornersPerPatch);
    counts.push_back(GLsizei(drawn - begin) * kCornersPerPatch);
    stats.meshTriangles += 2 * std::uint64_t(drawn - begin);
  }
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, list.numbers.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, chunk.patchBuffer.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, chunk.texels.name());
  if (chunk.mirrors) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, chunk.mirrors.name());
  glMultiDrawArrays(GL_TRIANGLES, firsts.data(), counts.data(), GLsizei(firsts.size()));
}

}  // namespace acentric
