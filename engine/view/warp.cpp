#include "engine/view/warp.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/contract.h"
#include "engine/geometry/conventions.h"
#include "engine/view/column_order.h"
#include "engine/view/cracks.h"
#include "engine/view/picture_axes.h"
#include "engine/view/splat_painter.h"

namespace acentric {
namespace {

/// Of a piece; rounded where the kernels compute in floats.
glm::dvec3 baselineOf(const PieceDraw& piece, const DisplayCapture&, const PerspectiveView&, float) {
  return glm::dvec3(piece.baseline);
}
glm::dvec3 baselineOf(const PieceDraw&, const DisplayCapture& capture, const PerspectiveView& view, double) {
  return capture.camera.centreOfProjection - view.eye;
}

/// What is constant over a piece.
template <class T>
ProjectColumn<T> columnTemplate(const PictureAxes& axes, const PerspectiveView& view,
                                const ViewSettings& settings, const PieceDraw& piece,
                                const DisplayCapture& capture, const PixelRect& rect, std::uint32_t slot) {
  const glm::dvec3 baseline = baselineOf(piece, capture, view, T());
  ProjectColumn<T> column{};
  axes.project(glm::dvec3(0, 0, 1), column.z);
  axes.project(baseline, column.b);
  const double focal = view.focalPixels();
  const double pitch = std::max(capture.camera.columnPitch(), capture.camera.rowPitch());
  column.footprint = settings.reconstruction == Reconstruction::point
                         ? T(0)
                         : static_cast<T>(focal * pitch * kSlantAllowance);
  column.maxSide = static_cast<T>(settings.maxSplatPixels);
  column.roles = piece.roles;
  column.centreX = T(0.5) * static_cast<T>(view.width);
  column.centreY = T(0.5) * static_cast<T>(view.height);
  column.inverseFocal = static_cast<T>(1 / focal);
  column.canvas = rect;
  column.slot = slot;
  column.baseline[0] = static_cast<T>(baseline.x), column.baseline[1] = static_cast<T>(baseline.y);
  if (piece.clipToPart) {
    const AzimuthRange part = piece.part.azimuths;
    const glm::dvec2 low = directionOf(part.low), high = directionOf(part.low + part.width);
    column.low[0] = static_cast<T>(low.x), column.low[1] = static_cast<T>(low.y);
    column.high[0] = static_cast<T>(high.x), column.high[1] = static_cast<T>(high.y);
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
        axes_(view) {}

  WarpCounts run() {
    drawAllPieces();
    if (plan_.reflections.empty()) return counts_;
    canvas_.settleMirrors();
    if (!options_.coverMirrors.empty()) openCoverMirrors();
    for (std::size_t i = 0; i < plan_.reflections.size(); ++i) {
      const PieceDraw& piece = plan_.reflections[i];
      const DisplayCapture& capture = *scene_.captures[static_cast<std::size_t>(piece.camera)];
      drawPiece(piece, *capture.reflections, PaintMode::reflect, reflectionSlot(plan_, i));
    }
    return counts_;
  }

 private:
  void drawAllPieces() {
    const auto first = std::ranges::find(plan_.pieces, false, &PieceDraw::secondary);
    const std::size_t firstInFront = static_cast<std::size_t>(first - plan_.pieces.begin());
    drawPieces(firstInFront, plan_.pieces.size());
    if (firstInFront > 0) {
      openBelow_ = pieceSlot(plan_, firstInFront);
      Cracks cracks;
      cracks.open(canvas_, openBelow_);
      drawPieces(0, firstInFront);
      cracks.close(canvas_);
      openBelow_ = 0;
    }
  }

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

  /// Makes holes of the pixels that mirrors among the local geometry cover, and says on the canvas whose they
  /// are.
  void openCoverMirrors() {
    for (int y = 0; y < view_.height; ++y)
      for (int x = rect_.x0; x < rect_.x1; ++x) {
        const std::uint32_t cover = options_.cover->at(x, y);
        if (cover == kUncovered) continue;
        const std::uint8_t mirror = options_.coverMirrors[cover];
        const std::size_t at = canvas_.indexOf(x) + static_cast<std::size_t>(y);
        canvas_.mirrors[at] = mirror;
        if (mirror != 0) canvas_.pixels[at] = kEmptyPixel;
      }
  }

  void drawPiece(const PieceDraw& piece, const DisplayCapture& capture, PaintMode mode, std::uint32_t slot) {
    constants_ = columnTemplate<float>(axes_, view_, settings_, piece, capture, rect_, slot);
    if (options_.precise) beginPrecisely(piece, capture, slot);
    for (const ColumnRun& run : piece.runs)
      for (int n = 0; n < run.last - run.first; ++n) {
        const auto k = static_cast<std::size_t>(run.ascending ? run.first + n : run.last - 1 - n);
        if (begin(piece, capture, k)) drawColumn(piece, capture, k, mode, slot);
      }
  }

  void beginPrecisely(const PieceDraw& piece, const DisplayCapture& capture, std::uint32_t slot) {
    precise_ = columnTemplate<double>(axes_, view_, settings_, piece, capture, rect_, slot);
    rowTangent_.resize(static_cast<std::size_t>(capture.camera.rows));
    for (std::size_t r = 0; r < rowTangent_.size(); ++r)
      rowTangent_[r] = capture.camera.tangentAt(static_cast<double>(r) + 0.5);
  }

  std::span<const Splat> projectPrecisely(const DisplayCapture& capture, std::size_t k,
                                          const SampleColumn<float>& column) {
    const glm::dvec2 direction = capture.camera.directionAt(static_cast<double>(k) + 0.5);
    axes_.project(glm::dvec3(direction, 0), precise_.a);
    precise_.maxInverseDistance = double(constants_.maxInverseDistance);
    precise_.minInverseDistance = double(constants_.minInverseDistance);
    precise_.direction[0] = direction.x, precise_.direction[1] = direction.y;
    return projectSamples(precise_, {rowTangent_.data(), column.samples, column.colour}, splats_);
  }

  static std::uint32_t sizeOf(const DisplayCapture& capture, std::size_t k) {
    return capture.columnStart[k + 1] - capture.columnStart[k];
  }

  /// What is constant over column k. May any of it be seen?
  bool begin(const PieceDraw& piece, const DisplayCapture& capture, std::size_t k) {
    const std::uint32_t size = sizeOf(capture, k);
    if (size == 0 ||
        (!piece.sight.empty() && (piece.sight[k].x1 <= rect_.x0 || piece.sight[k].x0 >= rect_.x1)))
      return false;
    axes_.project(glm::dvec3(capture.columnDirection[k], 0), constants_.a);
    constants_.maxInverseDistance = piece.maxInverseDistance[k];
    constants_.minInverseDistance = piece.minInverseDistance.empty() ? 0 : piece.minInverseDistance[k];
    constants_.direction[0] = capture.columnDirection[k].x,
    constants_.direction[1] = capture.columnDirection[k].y;
    counts_.samplesRead += size;
    return true;
  }

  void drawColumn(const PieceDraw& piece, const DisplayCapture& capture, std::size_t k, PaintMode mode,
                  std::uint32_t slot) {
    const std::size_t start = capture.columnStart[k];
    const PackedSample* const samples = capture.samples.data() + start;
    const SampleColumn<float> column{
        capture.rowTangent.data(), {samples, sizeOf(capture, k)}, capture.colour.data() + start};
    const std::span<const Splat> splats =
        options_.precise ? projectPrecisely(capture, k, column) : projectSamples(constants_, column, splats_);
    if (splats.empty()) return;

    const RowOrder order = rowOrder(glm::dvec2(capture.columnDirection[k]), -glm::dvec3(piece.baseline));
    const PaintTarget target{&canvas_,
                             capture.colour.data() + start,
                             samples,
                             capture.mirror.empty() ? nullptr : capture.mirror.data() + start,
                             slot,
                             static_cast<std::uint32_t>(k),
                             order.footInverse,
                             drawnRange(capture, piece, k),
                             countedFrom_,
                             countedTo_,
                             openBelow_};
    // Rows above the pivot (upper = smaller numbers) and the others, each towards it or away from it.
    const auto isAbove = [&](const Splat& splat) {
      return capture.rowTangent[samples[splat.index].row] > order.pivotTangent;
    };
    const auto above =
        static_cast<std::size_t>(std::ranges::partition_point(splats, isAbove) - splats.begin());
    counts_.samplesDrawn += paintSplats(target, mode, splats.first(above), !order.inwards, capture.layered);
    counts_.samplesDrawn += paintSplats(target, mode, splats.subspan(above), order.inwards, capture.layered);
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
  std::uint32_t openBelow_ = 0;       ///< PaintTarget::openBelow
  ProjectColumn<float> constants_{};  ///< of the column that is being drawn
  ProjectColumn<double> precise_{};   ///< the same, if WarpOptions::precise
  std::vector<double> rowTangent_;    ///< of the capture, then
  std::vector<Splat> splats_;
  WarpCounts counts_;
};

}  // namespace

bool wantsPatches(const ViewSettings& settings) {
  return settings.reconstruction == Reconstruction::patches && !depthTested(settings.renderer) &&
         settings.renderer != Renderer::precise;
}

bool drawsPatches(const WalkScene& scene, const ViewPlan& plan, const ViewSettings& settings) {
  const auto have = [&](const PieceDraw& piece) {
    return scene.captures[static_cast<std::size_t>(piece.camera)]->hasPatches();
  };
  return wantsPatches(settings) && std::ranges::all_of(plan.pieces, have);
}

int pixelsReadBeside(const ViewPlan& plan) {
  const bool second = std::ranges::find(plan.pieces, true, &PieceDraw::secondary) != plan.pieces.end();
  return second ? Cracks::kReach : 0;
}

void clearCanvas(const WalkScene& scene, const PerspectiveView& view, const ViewPlan& plan, int x0, int x1,
                 Canvas& canvas) {
  const bool blended = std::ranges::any_of(plan.pieces, [&](const PieceDraw& piece) {
    return scene.captures[static_cast<std::size_t>(piece.camera)]->blended;
  });
  canvas.x0 = x0;
  canvas.width = x1 - x0;
  canvas.height = view.height;
  const std::size_t size = static_cast<std::size_t>(canvas.width) * static_cast<std::size_t>(canvas.height);
  canvas.pixels.assign(size, kEmptyPixel);
  canvas.stamps.assign(blended ? size : 0, 0);
  canvas.blended.resize(blended ? size : 0);  // of use where there is a stamp
  canvas.mirrors.assign(plan.reflections.empty() ? 0 : size, 0);
  canvas.mirrorPixels.resize(canvas.mirrors.size());  // of use where there is a mirror
}

WarpCounts warpPieces(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                      const ViewPlan& plan, const WarpOptions& options, int x0, int x1, Canvas& canvas) {
  require(reflectionSlot(plan, plan.reflections.size()) <= static_cast<std::uint32_t>(kMaxSlots) + 1,
          "more pieces than a canvas pixel can name");
  return CanvasWarp(scene, view, settings, plan, options, x0, x1, canvas).run();
}

}  // namespace acentric
