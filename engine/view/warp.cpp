#include "engine/view/warp.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/contract.h"
#include "engine/geometry/conventions.h"
#include "engine/view/column_order.h"
#include "engine/view/cracks.h"
#include "engine/view/picture_axes.h"
#include "engine/view/splat_painter.h"

namespace acentric {
namespace {

/// Planes and directions are of unit length, what kernels compute of float precision.
constexpr double kPlaneSlack = 2e-6;

/// Of a piece; rounded where the kernels compute in floats.
glm::dvec3 baselineOf(const PieceDraw& piece, const DisplayCapture&, const PerspectiveView&, float) {
  return glm::dvec3(piece.baseline);
}
glm::dvec3 baselineOf(const PieceDraw&, const DisplayCapture& capture, const PerspectiveView& view, double) {
  return capture.camera.centreOfProjection - view.eye;
}

/// What is constant over a piece.
template <class T>
ProjectColumnOf<T> columnTemplate(const PictureAxes& axes, const PerspectiveView& view,
                                  const ViewSettings& settings, const PieceDraw& piece,
                                  const DisplayCapture& capture, const PixelRect& rect, std::uint32_t slot) {
  const glm::dvec3 baseline = baselineOf(piece, capture, view, T());
  ProjectColumnOf<T> column{};
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
  column.x0 = rect.x0, column.y0 = rect.y0, column.x1 = rect.x1, column.y1 = rect.y1;
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
        axes_(view),
        planes_(frustumPlanes(view, rect_, splatMargin(settings.maxSplatPixels))) {
    for (std::size_t i = 0; i < planes_.normals.size(); ++i)
      blockTest_.z[i] = static_cast<float>(planes_.normals[i].z);
  }

  WarpCounts run() {
    const OpenTiles uncovered(rect_, options_.cull ? options_.cover : nullptr, pixelsReadBeside(plan_));
    if (!uncovered.none()) drawAllPieces(uncovered);
    if (plan_.reflections.empty()) return counts_;
    canvas_.settleMirrors();
    const bool local = !options_.coverMirrors.empty() && openCoverMirrors();
    open_ = OpenTiles::withMirrors(local ? OpenTiles(rect_, nullptr, 0) : uncovered, canvas_);
    if (open_->none()) return counts_;
    for (std::size_t i = 0; i < plan_.reflections.size(); ++i) {
      const PieceDraw& piece = plan_.reflections[i];
      const DisplayCapture& capture = *scene_.captures[static_cast<std::size_t>(piece.camera)];
      drawPiece(piece, *capture.reflections, PaintMode::reflect, reflectionSlot(plan_, i));
    }
    return counts_;
  }

 private:
  void drawAllPieces(const OpenTiles& uncovered) {
    if (!uncovered.all()) open_ = uncovered;
    const auto first = std::ranges::find(plan_.pieces, false, &PieceDraw::secondary);
    const std::size_t firstInFront = static_cast<std::size_t>(first - plan_.pieces.begin());
    drawPieces(firstInFront, plan_.pieces.size());
    if (firstInFront > 0) {
      openBelow_ = pieceSlot(plan_, firstInFront);
      Cracks cracks;
      cracks.open(canvas_, openBelow_);
      if (options_.cull) open_.emplace(uncovered, canvas_, openBelow_);
      if (!open_ || !open_->none()) drawPieces(0, firstInFront);
      cracks.close(canvas_);
      openBelow_ = 0;
      open_.reset();
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

  /// Which mirror local geometry shows at a pixel that it covers; else nothing.
  std::optional<std::uint8_t> coverMirrorAt(int x, int y) const {
    if (x < 0 || x >= view_.width || y < 0 || y >= view_.height) return {};
    const std::uint32_t cover = options_.cover->at(x, y);
    return cover == kUncovered ? std::nullopt : std::optional(options_.coverMirrors[cover]);
  }

  /// Makes holes of the pixels that mirrors among the local geometry cover, and says on the canvas whose they
  /// are. Are there any?
  bool openCoverMirrors() {
    bool any = false;
    for (int y = 0; y < view_.height; ++y)
      for (int x = rect_.x0; x < rect_.x1; ++x) {
        const auto mirror = coverMirrorAt(x, y);
        if (!mirror) continue;
        const std::size_t at = canvas_.indexOf(x) + static_cast<std::size_t>(y);
        canvas_.mirrors[at] = *mirror;
        any = any || *mirror != 0;
        if (*mirror != 0) canvas_.pixels[at] = kEmptyPixel;
      }
    return any;
  }

  void drawPiece(const PieceDraw& piece, const DisplayCapture& capture, PaintMode mode, std::uint32_t slot) {
    constants_ = columnTemplate<float>(axes_, view_, settings_, piece, capture, rect_, slot);
    if (options_.precise) beginPrecisely(piece, capture, slot);
    for (std::size_t i = 0; i < planes_.normals.size(); ++i)
      blockTest_.b[i] = static_cast<float>(glm::dot(planes_.normals[i], glm::dvec3(piece.baseline)));
    blockTest_.slack = static_cast<float>(kPlaneSlack * glm::length(piece.baseline));
    blockTest_.openTiles = nullptr;
    if (open_) open_->tell(blockTest_);
    directionSlack_ =
        kPlaneSlack *
        (1 + double(std::max(std::abs(capture.rowTangent.front()), std::abs(capture.rowTangent.back()))));
    for (const ColumnRun& run : piece.runs)
      for (int n = 0; n < run.last - run.first; ++n) {
        const auto k = static_cast<std::size_t>(run.ascending ? run.first + n : run.last - 1 - n);
        if (const std::uint32_t samples = choose(piece, capture, k); samples > 0)
          drawColumn(piece, capture, k, samples, mode, slot);
      }
  }

  void beginPrecisely(const PieceDraw& piece, const DisplayCapture& capture, std::uint32_t slot) {
    precise_ = columnTemplate<double>(axes_, view_, settings_, piece, capture, rect_, slot);
    rowTangent_.resize(static_cast<std::size_t>(capture.camera.rows));
    for (std::size_t r = 0; r < rowTangent_.size(); ++r)
      rowTangent_[r] = capture.camera.tangentAt(static_cast<double>(r) + 0.5);
  }

  int projectPrecisely(const DisplayCapture& capture, std::size_t k, const SampleColumn& column,
                       const SplatArrays& splats) {
    const glm::dvec2 direction = capture.camera.directionAt(static_cast<double>(k) + 0.5);
    axes_.project(glm::dvec3(direction, 0), precise_.a);
    precise_.maxInverseDistance = double(constants_.maxInverseDistance);
    precise_.minInverseDistance = double(constants_.minInverseDistance);
    precise_.direction[0] = direction.x, precise_.direction[1] = direction.y;
    return projectSamplesDouble(precise_, {rowTangent_.data(), column.samples, column.colour}, runs_.data(),
                                static_cast<int>(runs_.size()), splats);
  }

  /// Finds the runs of samples of column k that may be seen; returns how many samples those are.
  std::uint32_t choose(const PieceDraw& piece, const DisplayCapture& capture, std::size_t k) {
    if (options_.cull && !piece.sight.empty() &&
        (piece.sight[k].x1 <= rect_.x0 || piece.sight[k].x0 >= rect_.x1))
      return 0;
    const glm::dvec2 direction(capture.columnDirection[k]);
    axes_.project(glm::dvec3(direction, 0), constants_.a);
    constants_.maxInverseDistance = piece.maxInverseDistance[k];
    constants_.minInverseDistance = piece.minInverseDistance.empty() ? 0 : piece.minInverseDistance[k];
    constants_.direction[0] = capture.columnDirection[k].x,
    constants_.direction[1] = capture.columnDirection[k].y;

    const std::uint32_t start = capture.columnStart[k], size = capture.columnStart[k + 1] - start;
    runs_.clear();
    if (options_.cull)
      findRuns(capture, k, size);
    else if (size > 0)
      runs_.push_back({0, size});
    std::uint32_t samples = 0;
    for (const SampleRun& run : runs_) samples += run.end - run.first;
    counts_.samplesRead += samples;
    return samples;
  }

  /// Runs of blocks that may be seen, of column k of `size` samples.
  void findRuns(const DisplayCapture& capture, std::size_t k, std::uint32_t size) {
    const std::size_t first = capture.columnBlock[k], blocks = capture.columnBlock[k + 1] - first;
    const SampleBlocks& all = capture.blocks;
    const BlockColumn own{&all.leastInverse[first], &all.mostInverse[first], &all.lowTangent[first],
                          &all.highTangent[first], &all.roles[first]};
    for (std::size_t i = 0; i < planes_.normals.size(); ++i)
      blockTest_.a[i] = static_cast<float>(
          glm::dot(glm::dvec2(planes_.normals[i]), glm::dvec2(capture.columnDirection[k])) + directionSlack_);
    visibleBlocks_.resize(std::max(visibleBlocks_.size(), blocks));
    const int found =
        options_.findBlocks(constants_, blockTest_, own, static_cast<int>(blocks), visibleBlocks_.data());
    for (int i = 0; i < found; ++i) {
      const std::uint32_t from = visibleBlocks_[static_cast<std::size_t>(i)] * kSamplesPerBlock;
      if (runs_.empty() || runs_.back().end != from) runs_.push_back({from, from});
      runs_.back().end = std::min(from + kSamplesPerBlock, size);
    }
  }

  /// What `choose` found of column k.
  void drawColumn(const PieceDraw& piece, const DisplayCapture& capture, std::size_t k, std::uint32_t chosen,
                  PaintMode mode, std::uint32_t slot) {
    const std::size_t start = capture.columnStart[k];
    const PackedSample* const samples = capture.samples.data() + start;
    const SplatArrays& splats = splats_.room(chosen);
    const SampleColumn column =
        sampleColumn(capture.rowTangent.data(), samples, capture.colour.data() + start);
    const int count = options_.precise ? projectPrecisely(capture, k, column, splats)
                                       : options_.project(constants_, column, runs_.data(),
                                                          static_cast<int>(runs_.size()), splats);
    if (count == 0) return;

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
    const auto isAbove = [&](std::uint32_t index) {
      return capture.rowTangent[samples[index].row] > order.pivotTangent;
    };
    const int above = static_cast<int>(std::partition_point(splats.indices, splats.indices + count, isAbove) -
                                       splats.indices);
    counts_.samplesDrawn += paintSplats(target, mode, splats, 0, above, !order.inwards, capture.layered);
    counts_.samplesDrawn += paintSplats(target, mode, splats, above, count, order.inwards, capture.layered);
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
  BlockTest blockTest_{};
  std::vector<std::uint16_t> visibleBlocks_;
  double directionSlack_ = 0;          ///< of a column's direction against a plane, in BlockTest::a
  ProjectColumn constants_{};          ///< of the column that is being drawn
  ProjectColumnOf<double> precise_{};  ///< the same, if WarpOptions::precise
  std::vector<double> rowTangent_;     ///< of the capture, then
  std::vector<SampleRun> runs_;        ///< of its samples that may be seen
  SplatMemory splats_;
  WarpCounts counts_;
};

}  // namespace

bool wantsPatches(const ViewSettings& settings) {
  return settings.reconstruction == Reconstruction::patches && !depthTested(settings.renderer) &&
         settings.renderer != Renderer::precise;
}

bool drawsPatches(const WalkScene& scene, const ViewPlan& plan, const ViewSettings& settings) {
  const auto have = [&](const PieceDraw& piece) {
    return scene.captures[static_cast<std::size_t>(piece.camera)]->patches != nullptr;
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
