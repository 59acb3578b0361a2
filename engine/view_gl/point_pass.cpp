#include "engine/view_gl/point_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/view/column_culling.h"
#include "engine/view/column_order.h"
#include "engine/view/warp.h"
#include "engine/view_gl/gl_check.h"
#include "engine/view_gl/whole_picture.h"

namespace acentric {
namespace {

/// First sample of the column at or below a row.
std::uint32_t firstAtRow(const DisplayCapture& capture, std::uint32_t begin, std::uint32_t end,
                         std::size_t row) {
  const auto samples = capture.samples.begin();
  return std::uint32_t(std::partition_point(samples + begin, samples + end,
                                            [&](const PackedSample& s) { return s.row < row; }) -
                       samples);
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

class ColumnPlanner {
 public:
  ColumnPlanner(const DisplayCapture& capture, const PieceDraw& piece, const PerspectiveView& view)
      : capture_(capture), piece_(piece), pictureFromWorld_(pictureMatrix(view)) {}

  /// Nothing when no sample of the column can fall on the picture.
  bool plan(int column, const CaptureChunk& chunk, ColumnPlan& out) const {
    const std::size_t k = std::size_t(column);
    const glm::vec2 direction = capture_.columnDirection[k];
    const float most = std::min(piece_.maxInverseDistance[k], std::numeric_limits<float>::max());
    TangentRange tangents{capture_.rowTangent.back(), capture_.rowTangent.front()};
    if (!piece_.sight.empty()) {
      const ColumnSight& sight = piece_.sight[k];
      if (sight.x0 >= sight.x1) return false;
      tangents = sight.tangents;
    }
    const std::uint32_t begin = capture_.columnStart[k], end = capture_.columnStart[k + 1];
    const std::uint32_t first = firstAtRow(capture_, begin, end, rowAtTangent(capture_, tangents.high));
    const std::uint32_t last = firstAtRow(capture_, first, end, rowBelowTangent(capture_, tangents.low));
    if (first == last) return false;

    const RowOrder order = rowOrder(glm::dvec2(direction), -glm::dvec3(piece_.baseline));
    const std::uint32_t pivot =
        firstAtRow(capture_, first, last, rowAtTangent(capture_, double(order.pivotTangent)));
    out.inPicture = glm::vec4(glm::vec3(pictureFromWorld_ * glm::dvec3(direction, 0)), most);
    out.parts = glm::uvec4(first - chunk.firstSample, pivot - chunk.firstSample, last - chunk.firstSample,
                           order.inwards ? 1 : 0);
    out.inPlan = direction;
    out.footInverse = order.footInverse;
    out.leastInverse = piece_.minInverseDistance.empty() ? 0.0f : piece_.minInverseDistance[k];
    return true;
  }

 private:
  const DisplayCapture& capture_;
  const PieceDraw& piece_;
  glm::dmat3 pictureFromWorld_;
};

const CaptureChunk* chunkOf(const CaptureBuffers& buffers, int column) {
  for (const CaptureChunk& chunk : buffers.chunks)
    if (column >= chunk.firstColumn && column < chunk.lastColumn) return &chunk;
  return nullptr;  // a column without samples
}

}  // namespace

struct PointPass::Piece : CapturePiece {
  const CaptureBuffers& buffers;
  std::vector<std::pair<const CaptureChunk*, int>> columns = {};  ///< visible ones, in drawing order

  /// What mirrors show is laid over their pixels in order, whatever the rest is drawn by.
  bool depthTest() const { return depthTested(settings.renderer) && mirrors != Mirrors::reflect; }
  bool splat() const { return settings.reconstruction != Reconstruction::point; }
  /// A point whose centre is clipped is gone, splat and all: so the clip volume is larger than the picture by
  /// the largest splat, and the framebuffer's border cuts.
  int margin() const { return splat() ? settings.maxSplatPixels / 2 + 1 : 0; }
};

PointPass::PointPass(ProgramCache& programs, CaptureResidency& captures)
    : programs_(programs),
      captures_(captures),
      noAttributes_(GlVertexArray::make()),
      columnPlans_(GlBuffer::make()) {}

Status PointPass::draw(const CapturePiece& what, Samples samples, FrameTarget& target, FrameStats& stats) {
  const Result<const CaptureBuffers*> buffers = captures_.get(what.capture, what.name());
  if (!buffers) return tl::unexpected(buffers.error());
  Piece piece{what, **buffers};
  return drawPiece(piece, samples, target, stats);
}

Result<GlProgram*> PointPass::program(const Piece& piece, Samples samples) {
  Defines defines;
  if (piece.splat()) defines.push_back("SPLAT");
  if (piece.plan.clipToPart) defines.push_back("CLIP_TO_PART");
  if (!piece.plan.minInverseDistance.empty()) defines.push_back("CLIP_TO_PIECE");
  if (piece.leastDepths != 0) defines.push_back("IN_CRACKS");
  if (samples == Samples::opaque && piece.depthTest())
    defines.push_back("UNORDERED");
  else if (piece.capture->layered)
    defines.push_back("LAYERED");
  if (piece.capture->blended) defines.push_back(samples == Samples::clear ? "CLEAR" : "OPAQUE");
  if (!piece.capture->mirror.empty() && piece.mirrors != Mirrors::none) defines.push_back("MIRRORS");
  if (piece.mirrors == Mirrors::mark) defines.push_back("MARK_MIRRORS");
  if (piece.mirrors == Mirrors::reflect) defines.push_back("REFLECT");
  const Result<GlProgram*> found = programs_.get("points.vert", "points.frag", defines);
  if (!found) return found;
  GlProgram& program = **found;
  program.use();
  const PerspectiveView& view = piece.view;
  const glm::dmat3 pictureFromWorld = pictureMatrix(view);
  setUniform(program, "upInPicture", glm::vec3(pictureFromWorld[2]));
  setUniform(program, "baselineInPicture", glm::vec3(pictureFromWorld * glm::dvec3(piece.plan.baseline)));
  setUniform(program, "pictureSize", glm::vec2(view.width, view.height));
  glUniform1f(program.location("clipMargin"), float(piece.margin()));
  glUniform1ui(program.location("roles"), piece.plan.roles);
  glUniform1ui(program.location("sourceOfPiece"), GLuint(sourceOfCamera(piece.plan.camera)));
  glUniform1f(program.location("maxSide"), float(piece.settings.maxSplatPixels));
  if (piece.splat()) {
    const double focal = view.focalPixels();
    const double pitch = std::max(piece.capture->camera.columnPitch(), piece.capture->camera.rowPitch());
    glUniform1f(program.location("footprint"), float(focal * pitch * kSlantAllowance));
    glUniform1f(program.location("inverseFocal"), float(1 / focal));
  }
  if (piece.leastDepths != 0) setCracks(program, piece.leastDepths);
  if (piece.plan.clipToPart) {
    setPart(program, piece.plan);
    setUniform(program, "baselineInPlan", glm::vec2(piece.plan.baseline));
  }
  glBindVertexArray(noAttributes_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, piece.buffers.rowTangents.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, columnPlans_.name());
  glViewport(-piece.margin(), -piece.margin(), view.width + 2 * piece.margin(),
             view.height + 2 * piece.margin());
  return found;
}

Status PointPass::drawPiece(Piece& piece, Samples samples, FrameTarget& target, FrameStats& stats) {
  plans_.assign(std::size_t(piece.capture->camera.columns), ColumnPlan{});
  const ColumnPlanner planner(*piece.capture, piece.plan, piece.view);
  for (const ColumnRun& run : piece.plan.runs)
    for (int n = 0; n < run.last - run.first; ++n) {
      const int column = run.ascending ? run.first + n : run.last - 1 - n;
      const CaptureChunk* chunk = chunkOf(piece.buffers, column);
      if (chunk != nullptr && planner.plan(column, *chunk, plans_[std::size_t(column)]))
        piece.columns.emplace_back(chunk, column);
    }
  if (piece.columns.empty()) return {};
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, columnPlans_.name());
  glBufferData(GL_SHADER_STORAGE_BUFFER, GLsizeiptr(plans_.size() * sizeof(ColumnPlan)), plans_.data(),
               GL_STREAM_DRAW);

  if (samples != Samples::clear) {
    const Result<GlProgram*> opaque = program(piece, Samples::opaque);
    if (!opaque) return tl::unexpected(opaque.error());
    drawColumns(piece, -1, stats);
  }
  if (samples != Samples::opaque && piece.capture->blended)
    if (Status drawn = drawClearRanks(piece, target, stats); !drawn) return drawn;
  return checkGl("drawing captures");
}

Status PointPass::drawClearRanks(Piece& piece, FrameTarget& target, FrameStats& stats) {
  const bool marks = piece.mirrors == Mirrors::mark;
  const Result<GlProgram*> lay =
      programs_.get("whole_picture.vert", "clear_layer.frag", marks ? Defines{"MARK_MIRRORS"} : Defines{});
  if (!lay) return tl::unexpected(lay.error());
  int ranks = 0;
  for (const auto& column : piece.columns)
    ranks = std::max(ranks, int(piece.buffers.clearRanks[std::size_t(column.second)]));
  for (int rank = ranks - 1; rank >= 0; --rank) {  // farthest from the camera first
    if (Status ready = target.beginClearLayer(); !ready) return ready;
    glDisable(GL_BLEND);
    glDisable(GL_FRAMEBUFFER_SRGB);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glDepthMask(GL_FALSE);
    glEnable(GL_STENCIL_TEST);
    if (piece.plan.secondary)
      glStencilFunc(GL_EQUAL, kCovered, kCovered | kInFront | kTinted);
    else
      glStencilFunc(GL_NOTEQUAL, 0, kCovered);  // over a hole there is nothing to tint
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    const Result<GlProgram*> clear = program(piece, Samples::clear);
    if (!clear) return tl::unexpected(clear.error());
    glUniform1ui((*clear)->location("rank"), GLuint(rank));
    glUniform1ui((*clear)->location("lastRank"), GLuint(kMostClearRanks - 1));
    drawColumns(piece, rank, stats);
    glDepthMask(GL_TRUE);
    glDisable(GL_DEPTH_TEST);
    glStencilFunc(GL_ALWAYS, kTinted, 0xff);
    glStencilMask(piece.plan.secondary ? 0 : kTinted);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);

    marks ? target.bindForPieces() : target.bindForDrawing();
    glEnable(GL_FRAMEBUFFER_SRGB);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    // The source stays that of what shows through.
    glColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    drawWholePicture(**lay, noAttributes_, {{"layer", target.clearLayer()}});
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glStencilMask(0xff);
    glDisable(GL_STENCIL_TEST);
  }
  return {};
}

void PointPass::drawColumns(const Piece& piece, int clearRank, FrameStats& stats) {
  for (std::size_t n = 0; n < piece.columns.size();) {
    const CaptureChunk* chunk = piece.columns[n].first;
    firsts_.clear();
    counts_.clear();
    for (; n < piece.columns.size() && piece.columns[n].first == chunk; ++n) {
      const std::size_t column = std::size_t(piece.columns[n].second);
      if (clearRank >= 0 && int(piece.buffers.clearRanks[column]) <= clearRank) continue;
      const glm::uvec4& parts = plans_[column].parts;
      firsts_.push_back(GLint(parts.x));
      counts_.push_back(GLsizei(parts.z - parts.x));
      if (clearRank < 0) stats.samplesRead += parts.z - parts.x;
    }
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, chunk->samples.name());
    if (chunk->layers) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, chunk->layers.name());
    if (chunk->mirrors) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, chunk->mirrors.name());
    glMultiDrawArrays(GL_POINTS, firsts_.data(), counts_.data(), GLsizei(firsts_.size()));
  }
  stats.samplesDrawn = stats.samplesRead;  // which of them fell on the picture only the graphics card knows
}

}  // namespace acentric
