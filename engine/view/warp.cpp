#include "engine/view/warp.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/contract.h"
#include "engine/geometry/conventions.h"
#include "engine/view/column_order.h"
#include "engine/view/picture_axes.h"
#include "engine/view/splat_painter.h"

namespace acentric {
namespace {

/// What is constant over a piece.
ProjectColumn columnTemplate(const PictureAxes& axes, const PerspectiveView& view,
                             const ViewSettings& settings, const PieceDraw& piece,
                             const DisplayCapture& capture, const PixelRect& rect) {
  ProjectColumn column{};
  axes.project(glm::dvec3(0, 0, 1), column.z);
  axes.project(glm::dvec3(piece.baseline), column.b);
  const double focal = view.focalPixels();
  const double pitch = std::max(capture.camera.columnPitch(), capture.camera.rowPitch());
  column.footprint = settings.reconstruction == Reconstruction::splat
                         ? static_cast<float>(focal * pitch * kSlantAllowance)
                         : 0.0f;
  column.maxSide = static_cast<float>(settings.maxSplatPixels);
  column.slanted = followsSlant(settings.reconstruction);
  column.acrossStep = static_cast<float>(0.5 * kOverlap * capture.camera.columnPitch());
  column.perSpread = static_cast<float>(8 * 0.5 * kOverlap);
  column.downStep = static_cast<float>(0.5 * kOverlap * capture.camera.rowPitch());
  column.roles = piece.roles;
  column.centreX = 0.5f * static_cast<float>(view.width);
  column.centreY = 0.5f * static_cast<float>(view.height);
  column.inverseFocal = static_cast<float>(1 / focal);
  column.x0 = rect.x0, column.y0 = rect.y0, column.x1 = rect.x1, column.y1 = rect.y1;
  column.baseline[0] = piece.baseline.x, column.baseline[1] = piece.baseline.y;
  if (piece.clipToPart) {
    const AzimuthRange part = piece.part.azimuths;
    const glm::dvec2 low = directionOf(part.low), high = directionOf(part.low + part.width);
    column.low[0] = static_cast<float>(low.x), column.low[1] = static_cast<float>(low.y);
    column.high[0] = static_cast<float>(high.x), column.high[1] = static_cast<float>(high.y);
    column.partTest = part.width <= kPi ? PartTest::within : PartTest::without;
  }
  return column;
}

/// One canvas: all pieces in order, clipped to its columns.
class CanvasWarp {
 public:
  CanvasWarp(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
             const ViewPlan& plan, const WarpOptions& options, int x0, int x1, Canvas& canvas)
      : scene_(scene),
        view_(view),
        settings_(settings),
        plan_(plan),
        options_(options),
        canvas_(canvas),
        rect_(canvas.rect()),
        countedFrom_(x0),
        countedTo_(x1),
        axes_(view),
        planes_(frustumPlanes(view, rect_, splatMargin(settings.maxSplatPixels))) {}

  WarpCounts run() {
    const OpenTiles uncovered(rect_, options_.cull ? options_.cover : nullptr, canvas_.places ? 1 : 0);
    if (uncovered.none()) return counts_;
    if (!uncovered.all()) open_ = uncovered;
    const auto first = std::ranges::find(plan_.pieces, false, &PieceDraw::secondary);
    const std::size_t firstInFront = static_cast<std::size_t>(first - plan_.pieces.begin());
    drawPieces(firstInFront, plan_.pieces.size());
    if (firstInFront > 0) {
      openBelow_ = pieceSlot(plan_, firstInFront);
      if (options_.cull) open_.emplace(uncovered, canvas_, openBelow_);
      if (!open_ || !open_->none()) drawPieces(0, firstInFront);
      openBelow_ = 0;
      open_.reset();
    }
    if (!uncovered.all()) open_ = uncovered;
    for (std::size_t i = 0; i < plan_.reflections.size(); ++i) {
      const PieceDraw& piece = plan_.reflections[i];
      const DisplayCapture& capture = *scene_.captures[static_cast<std::size_t>(piece.camera)];
      drawPiece(piece, *capture.reflections, PaintMode::reflect, reflectionSlot(plan_, i));
    }
    return counts_;
  }

 private:
  /// Pieces [first, last) of the plan.
  void drawPieces(std::size_t first, std::size_t last) {
    bool blended = false;
    const auto pass = [&](PaintMode plain, PaintMode withBlended, bool blendedOnly) {
      for (std::size_t i = first; i < last; ++i) {
        const DisplayCapture& capture = *scene_.captures[static_cast<std::size_t>(plan_.pieces[i].camera)];
        blended = blended || capture.blended;
        if (!blendedOnly || capture.blended)
          drawPiece(plan_.pieces[i], capture, capture.blended ? withBlended : plain, pieceSlot(plan_, i));
      }
    };
    if (!options_.depthTest) return pass(PaintMode::over, PaintMode::overBlended, false);
    pass(PaintMode::nearest, PaintMode::nearest, false);
    if (blended) pass(PaintMode::blendOnNearest, PaintMode::blendOnNearest, true);
  }

  void drawPiece(const PieceDraw& piece, const DisplayCapture& capture, PaintMode mode, std::uint32_t slot) {
    ProjectColumn column = columnTemplate(axes_, view_, settings_, piece, capture, rect_);
    for (const ColumnRun& run : piece.runs)
      for (int n = 0; n < run.last - run.first; ++n)
        drawColumn(piece, capture, column, mode, slot, run.ascending ? run.first + n : run.last - 1 - n);
  }

  void drawColumn(const PieceDraw& piece, const DisplayCapture& capture, ProjectColumn& column,
                  PaintMode mode, std::uint32_t slot, int index) {
    const std::size_t k = static_cast<std::size_t>(index);
    const glm::dvec2 direction(capture.columnDirection[k]);
    ColumnSight sight{
        {static_cast<double>(capture.rowTangent.back()), static_cast<double>(capture.rowTangent.front())},
        rect_.x0,
        rect_.x1};
    if (options_.cull && !piece.sight.empty()) sight = piece.sight[k];
    if (sight.x1 <= rect_.x0 || sight.x0 >= rect_.x1) return;

    axes_.project(glm::dvec3(direction, 0), column.a);
    axes_.project(double(column.acrossStep) * glm::dvec3(-direction.y, direction.x, 0), column.across);
    column.maxInverseDistance = piece.maxInverseDistance[k];
    column.minInverseDistance = piece.minInverseDistance.empty() ? 0 : piece.minInverseDistance[k];
    column.direction[0] = capture.columnDirection[k].x, column.direction[1] = capture.columnDirection[k].y;
    const int count = projectVisible(piece, capture, column, k, sight.tangents);
    if (count == 0) return;

    const RowOrder order = rowOrder(direction, -glm::dvec3(piece.baseline));
    const std::size_t start = capture.columnStart[k];
    const std::uint16_t* const row = capture.row.data() + start;
    const PaintTarget target{&canvas_,
                             rect_,
                             capture.colour.data() + start,
                             row,
                             capture.inverseDistance.data() + start,
                             capture.mirror.empty() ? nullptr : capture.mirror.data() + start,
                             slot,
                             static_cast<std::uint32_t>(index),
                             order.footInverse,
                             countedFrom_,
                             countedTo_,
                             openBelow_};
    // Rows above the pivot (upper = smaller numbers) and the others, each towards it or away from it.
    const Splat* splats = splats_.data();
    const Splat* pivot = std::partition_point(splats, splats + count, [&](const Splat& s) {
      return capture.rowTangent[row[s.index]] > order.pivotTangent;
    });
    const int above = static_cast<int>(pivot - splats);
    counts_.samplesDrawn += paintSplats(target, mode, splats, above, !order.inwards, capture.layered);
    counts_.samplesDrawn += paintSplats(target, mode, pivot, count - above, order.inwards, capture.layered);
  }

  /// Projects the samples of column k block by block, leaving out blocks that cannot be seen. Splats count
  /// samples from the column's first.
  int projectVisible(const PieceDraw& piece, const DisplayCapture& capture, const ProjectColumn& column,
                     std::size_t k, const TangentRange& tangents) {
    const glm::dvec2 range(drawnRange(capture, piece, k));
    const std::size_t start = capture.columnStart[k], end = capture.columnStart[k + 1];
    const std::size_t firstBlock = capture.columnBlock[k], blocks = capture.columnBlock[k + 1] - firstBlock;
    splats_.resize(std::max<std::size_t>(splats_.size(), end - start + 16));
    int count = 0;
    std::size_t from = start;  // of the run of visible blocks that is being gathered
    const auto flush = [&](std::size_t to) {
      if (to <= from) return;
      for (std::size_t i = from; i < to; i += 64 / sizeof(Rgba8)) __builtin_prefetch(&capture.colour[i]);
      count += options_.project(column, capture.rowTangent.data(), capture.row.data() + from,
                                capture.inverseDistance.data() + from, capture.roles.data() + from,
                                capture.slant.data() + from, static_cast<int>(to - from),
                                static_cast<std::uint32_t>(from - start), splats_.data() + count);
      counts_.samplesRead += to - from;
    };
    for (std::size_t b = 0; b < blocks; ++b) {
      if (!options_.cull ||
          mayShow(piece, capture, column, k, capture.blocks[firstBlock + b], tangents, range))
        continue;
      flush(start + b * kSamplesPerBlock);
      from = start + (b + 1) * kSamplesPerBlock;
    }
    flush(end);
    return count;
  }

  bool mayShow(const PieceDraw& piece, const DisplayCapture& capture, const ProjectColumn& column,
               std::size_t k, const SampleBlock& block, const TangentRange& tangents,
               const glm::dvec2& range) const {
    if ((block.roles & piece.roles) == 0) return false;
    const TangentRange rows{static_cast<double>(capture.rowTangent[block.lastRow]),
                            static_cast<double>(capture.rowTangent[block.firstRow])};
    if (rows.high < tangents.low || rows.low > tangents.high) return false;
    const glm::dvec2 drawn{std::max(double(block.range.x), range.x),
                           std::min(double(block.range.y), range.y)};
    if (!mayBeVisible(planes_, glm::dvec2(capture.columnDirection[k]), glm::dvec3(piece.baseline), drawn,
                      rows))
      return false;
    return !open_ || open_->mayReach(column, rows, glm::vec2(drawn));
  }

  const WalkScene& scene_;
  const PerspectiveView& view_;
  const ViewSettings& settings_;
  const ViewPlan& plan_;
  const WarpOptions& options_;
  Canvas& canvas_;
  PixelRect rect_;
  int countedFrom_, countedTo_;
  PictureAxes axes_;
  FrustumPlanes planes_;
  std::uint32_t openBelow_ = 0;  ///< PaintTarget::openBelow
  std::optional<OpenTiles>
      open_;  ///< what is drawn at the moment need not reach elsewhere; none: all is open
  std::vector<Splat> splats_;
  WarpCounts counts_;
};

}  // namespace

void clearCanvas(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                 const ViewPlan& plan, int x0, int x1, Canvas& canvas) {
  const bool blended = std::ranges::any_of(plan.pieces, [&](const PieceDraw& piece) {
    return scene.captures[static_cast<std::size_t>(piece.camera)]->blended;
  });
  canvas.x0 = x0;
  canvas.width = x1 - x0;
  canvas.height = view.height;
  canvas.places = settings.reconstruction == Reconstruction::filtered;
  const std::size_t size = static_cast<std::size_t>(canvas.width) * static_cast<std::size_t>(canvas.height);
  canvas.pixels.assign(size, kEmptyPixel);
  canvas.stamps.assign(blended ? size : 0, 0);
  canvas.mirrors.assign(plan.reflections.empty() ? 0 : size, 0);
}

WarpCounts warpPieces(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                      const ViewPlan& plan, const WarpOptions& options, int x0, int x1, Canvas& canvas) {
  require(reflectionSlot(plan, plan.reflections.size()) <= static_cast<std::uint32_t>(kMaxSlots) + 1,
          "more pieces than a canvas pixel can name");
  return CanvasWarp(scene, view, settings, plan, options, x0, x1, canvas).run();
}

}  // namespace acentric
