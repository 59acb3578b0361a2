#include "engine/view_gl/point_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/geometry/conventions.h"
#include "engine/view/column_culling.h"
#include "engine/view/column_order.h"
#include "engine/view_gl/gl_check.h"

namespace acentric {
namespace {

/// Splats are this much larger than a sample seen face on, as in view/warp.cpp: surfaces that the capture saw
/// at a slant, and the eye does not, are sampled farther apart.
constexpr double kSlantAllowance = 1.25;

/// First sample of the column at or below a row.
std::uint32_t firstAtRow(const DisplayCapture& capture, std::uint32_t begin, std::uint32_t end,
                         std::size_t row) {
  const auto rows = capture.row.begin();
  return std::uint32_t(std::lower_bound(rows + begin, rows + end, row) - rows);
}

/// First row whose tangent is not above `tangent` (tangents fall from row to row).
std::size_t rowAtTangent(const DisplayCapture& capture, double tangent) {
  return std::size_t(std::partition_point(capture.rowTangent.begin(), capture.rowTangent.end(),
                                          [&](float t) { return double(t) > tangent; }) -
                     capture.rowTangent.begin());
}
/// First row whose tangent is below `tangent`.
std::size_t rowBelowTangent(const DisplayCapture& capture, double tangent) {
  return std::size_t(std::partition_point(capture.rowTangent.begin(), capture.rowTangent.end(),
                                          [&](float t) { return double(t) >= tangent; }) -
                     capture.rowTangent.begin());
}

/// K M: world directions to (u z, v z, z).
glm::dmat3 pictureMatrix(const PerspectiveView& view) {
  const double focal = view.focalPixels();
  const glm::dmat3 pictureFromView(glm::dvec3(focal, 0, 0), glm::dvec3(0, focal, 0),
                                   glm::dvec3(0.5 * view.width, 0.5 * view.height, 1));
  return pictureFromView * view.viewFromWorld();
}

class ColumnPlanner {
 public:
  ColumnPlanner(const DisplayCapture& capture, const PieceDraw& piece, const PerspectiveView& view,
                int maxSide)
      : capture_(capture),
        piece_(piece),
        pictureFromWorld_(pictureMatrix(view)),
        planes_(frustumPlanes(view, {0, 0, view.width, view.height}, splatMargin(maxSide))),
        all_{capture.rowTangent.back(), capture.rowTangent.front()} {}

  /// Nothing when no sample of the column can fall on the picture.
  bool plan(int column, const CaptureChunk& chunk, ColumnPlan& out) const {
    const std::size_t k = std::size_t(column);
    const glm::vec2 direction = capture_.columnDirection[k];
    const float most = std::min(piece_.maxInverseDistance[k], std::numeric_limits<float>::max());
    const glm::dvec2 range(capture_.columnRange[k].x, std::min(capture_.columnRange[k].y, most));
    const auto tangents =
        visibleTangents(planes_, glm::dvec2(direction), glm::dvec3(piece_.baseline), range, all_);
    if (!tangents) return false;
    const std::uint32_t begin = capture_.columnStart[k], end = capture_.columnStart[k + 1];
    const std::uint32_t first = firstAtRow(capture_, begin, end, rowAtTangent(capture_, tangents->high));
    const std::uint32_t last = firstAtRow(capture_, first, end, rowBelowTangent(capture_, tangents->low));
    if (first == last) return false;

    const RowOrder order = rowOrder(glm::dvec2(direction), -glm::dvec3(piece_.baseline));
    const std::uint32_t pivot =
        firstAtRow(capture_, first, last, rowAtTangent(capture_, double(order.pivotTangent)));
    out.inPicture = glm::vec4(glm::vec3(pictureFromWorld_ * glm::dvec3(direction, 0)), most);
    out.parts = glm::uvec4(first - chunk.firstSample, pivot - chunk.firstSample, last - chunk.firstSample,
                           order.inwards ? 1 : 0);
    out.inPlan = direction;
    out.footInverse = order.footInverse;
    out.unused = 0;
    return true;
  }

 private:
  const DisplayCapture& capture_;
  const PieceDraw& piece_;
  glm::dmat3 pictureFromWorld_;
  FrustumPlanes planes_;
  TangentRange all_;
};

const CaptureChunk* chunkOf(const CaptureBuffers& buffers, int column) {
  for (const CaptureChunk& chunk : buffers.chunks)
    if (column >= chunk.firstColumn && column < chunk.lastColumn) return &chunk;
  return nullptr;  // a column without samples
}

void setUniform(GlProgram& program, const char* name, const glm::vec2& value) {
  glUniform2f(program.location(name), value.x, value.y);
}
void setUniform(GlProgram& program, const char* name, const glm::vec3& value) {
  glUniform3f(program.location(name), value.x, value.y, value.z);
}

}  // namespace

PointPass::PointPass(ProgramCache& programs, CaptureResidency& captures)
    : programs_(programs),
      captures_(captures),
      noAttributes_(GlVertexArray::make()),
      columnPlans_(GlBuffer::make()) {}

Status PointPass::draw(const WalkScene& scene, const ViewPlan& plan, const PerspectiveView& view,
                       const ViewSettings& settings, const FrameTarget& target, FrameStats& stats) {
  glBindVertexArray(noAttributes_.name());
  for (const PieceDraw& piece : plan.pieces)
    if (Status drawn = drawPiece(scene, piece, view, settings, target, stats); !drawn) return drawn;
  return {};
}

Status PointPass::drawPiece(const WalkScene& scene, const PieceDraw& piece, const PerspectiveView& view,
                            const ViewSettings& settings, const FrameTarget& target, FrameStats& stats) {
  const auto& shared = scene.captures[std::size_t(piece.camera)];
  if (!shared || shared->row.empty() || piece.runs.empty()) return {};
  const DisplayCapture& capture = *shared;
  const std::string name = fmt::format("capture of camera {}", piece.camera);
  const Result<const CaptureBuffers*> buffers = captures_.get(shared, name.c_str());
  if (!buffers) return tl::unexpected(buffers.error());

  Defines defines;
  const bool splat = settings.reconstruction == Reconstruction::splat;
  if (splat) defines.push_back("SPLAT");
  if (piece.clipToPart) defines.push_back("CLIP_TO_PART");
  if (capture.layered) defines.push_back("LAYERED");
  if (capture.blended) defines.push_back("LINEAR");
  const Result<GlProgram*> found = programs_.get("points.vert", "points.frag", defines);
  if (!found) return tl::unexpected(found.error());
  GlProgram& program = **found;

  // A point whose centre is clipped is gone, splat and all: so the clip volume is larger than the picture by
  // the largest splat, and the framebuffer's border cuts.
  const int margin = splat ? settings.maxSplatPixels / 2 + 1 : 0;
  glViewport(-margin, -margin, target.width() + 2 * margin, target.height() + 2 * margin);
  const glm::dmat3 pictureFromWorld = pictureMatrix(view);
  program.use();
  setUniform(program, "upInPicture", glm::vec3(pictureFromWorld[2]));
  setUniform(program, "baselineInPicture", glm::vec3(pictureFromWorld * glm::dvec3(piece.baseline)));
  setUniform(program, "pictureSize", glm::vec2(view.width, view.height));
  glUniform1f(program.location("clipMargin"), float(margin));
  glUniform1ui(program.location("sourceOfPiece"), GLuint(piece.camera) + 1);
  if (splat) {
    const double focal = view.focalPixels();
    const double pitch = std::max(capture.camera.columnPitch(), capture.camera.rowPitch());
    glUniform1f(program.location("footprint"), float(focal * pitch * kSlantAllowance));
    glUniform1f(program.location("inverseFocal"), float(1 / focal));
    glUniform1f(program.location("maxSide"), float(settings.maxSplatPixels));
  }
  if (piece.clipToPart) {
    const AzimuthRange& part = piece.part.azimuths;
    setUniform(program, "baselineInPlan", glm::vec2(piece.baseline));
    setUniform(program, "partLow", glm::vec2(directionOf(part.low)));
    setUniform(program, "partHigh", glm::vec2(directionOf(part.low + part.width)));
    glUniform1i(program.location("partIsWide"), part.width > kPi ? 1 : 0);
  }
  // Opaque samples go into the picture as the codes they are; blended ones mix in linear light.
  if (capture.blended) {
    glEnable(GL_FRAMEBUFFER_SRGB);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  } else {
    glDisable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_BLEND);
  }
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, (*buffers)->rowTangents.name());

  plans_.assign(std::size_t(capture.camera.columns), ColumnPlan{});
  const ColumnPlanner planner(capture, piece, view, settings.maxSplatPixels);
  std::vector<std::pair<const CaptureChunk*, int>> columns;  // in drawing order
  for (const ColumnRun& run : piece.runs)
    for (int n = 0; n < run.last - run.first; ++n) {
      const int column = run.ascending ? run.first + n : run.last - 1 - n;
      const CaptureChunk* chunk = chunkOf(**buffers, column);
      if (chunk != nullptr && planner.plan(column, *chunk, plans_[std::size_t(column)]))
        columns.emplace_back(chunk, column);
    }
  if (columns.empty()) return {};
  ++stats.images;
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, columnPlans_.name());
  glBufferData(GL_SHADER_STORAGE_BUFFER, GLsizeiptr(plans_.size() * sizeof(ColumnPlan)), plans_.data(),
               GL_STREAM_DRAW);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, columnPlans_.name());

  for (std::size_t n = 0; n < columns.size();) {
    const CaptureChunk* chunk = columns[n].first;
    firsts_.clear();
    counts_.clear();
    for (; n < columns.size() && columns[n].first == chunk; ++n) {
      const glm::uvec4& parts = plans_[std::size_t(columns[n].second)].parts;
      firsts_.push_back(GLint(parts.x));
      counts_.push_back(GLsizei(parts.z - parts.x));
      stats.samplesRead += parts.z - parts.x;
      stats.samplesDrawn += parts.z - parts.x;
    }
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, chunk->samples.name());
    glMultiDrawArrays(GL_POINTS, firsts_.data(), counts_.data(), GLsizei(firsts_.size()));
  }
  return checkGl("drawing captures");
}

}  // namespace acentric
