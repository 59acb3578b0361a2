#include "engine/view/patch_painter.h"

#include <algorithm>

#include "engine/view/cracks.h"

namespace acentric {
namespace {

/// Pixels whose surface the first cover sampled thinly: they are painted from the second, and keep that where
/// it shows the same surface more densely; its depth is then the nearer of both, as a depth test leaves it.
/// Not through glass, which the other cover may lack, nor for what a mirror shows.
class ThinPixels {
 public:
  /// Makes holes of them; their depth stays.
  void open(Canvas& canvas, const PatchCanvas& memory, std::uint32_t frontSlot) {
    thin_.clear();
    for (std::size_t i = 0; i < canvas.pixels.size(); ++i)
      if (memory.source[i] != 0 && memory.clear[i] == 1 && densityOf(memory.source[i]) < kThinDensity &&
          slotOf(canvas.pixels[i]) >= frontSlot) {
        thin_.push_back({i, densityOf(memory.source[i]), canvas.pixels[i]});
        canvas.pixels[i] &= ~kSlotBits;
      }
  }
  /// Gives them back what they were, where that is better.
  void close(Canvas& canvas, PatchCanvas& memory) {
    for (const Thin& thin : thin_) {
      CanvasPixel& pixel = canvas.pixels[thin.at];
      const float first = inverseZDepthOf(thin.pixel), second = inverseZDepthOf(pixel);
      const bool isSame = first < Cracks::kBefore * second && second < Cracks::kBefore * first;
      const bool isDenser = float(densityOf(memory.source[thin.at])) > kDenser * float(thin.density);
      const bool showsMirror = !memory.mirror.empty() && memory.mirror[thin.at] != 0;
      const bool isBare = memory.clear[thin.at] == 1 && !showsMirror;
      if (showsMirror) memory.mirror[thin.at] = 0;
      pixel = slotOf(pixel) == 0 || !isSame || !isDenser || !isBare
                  ? thin.pixel
                  : canvasPixel(static_cast<std::uint32_t>(pixel), std::max(first, second));
    }
  }

 private:
  struct Thin {
    std::size_t at = 0;
    std::uint32_t density = 0;
    CanvasPixel pixel = 0;  ///< as it was
  };
  std::vector<Thin> thin_;
};

class PatchPainter {
 public:
  PatchPainter(const PatchPlan& plan, const PatchKernel& kernel, int x0, int x1, PatchCanvas& memory,
               Canvas& canvas)
      : plan_(plan),
        kernel_(kernel),
        countedFrom_(x0),
        countedTo_(x1),
        cellShift_(cellShiftOf(canvas.height)),
        mirrors_(!plan.reflections.empty()),
        memory_(memory),
        canvas_(canvas) {
    const std::size_t room = canvas.pixels.size() + kPatchRoom;
    memory.open.assign(room, kAllParts);
    memory.source.assign(room, 0);
    memory.mirror.assign(mirrors_ ? room : 0, 0);
    for (auto* sums : {&memory.red, &memory.green, &memory.blue}) sums->assign(room, 0);
    memory.clear.assign(room, 1);
    memory.inverseZDepth.resize(room);
    memory.cells.assign(std::size_t(canvas.width), 0);
    memory.reached = memory.cells;
  }

  /// Nothing is painted where something covers the captures, but for what its mirrors show.
  void cover(const CoverImage& image, std::span<const std::uint8_t> mirrors) {
    constexpr int kTogether = 16;
    const int end = canvas_.x0 + canvas_.width;
    for (int first = canvas_.x0; first < end; first += kTogether)
      for (int y = 0; y < canvas_.height; ++y) {
        const auto row = std::span(&image.at(first, y), std::size_t(std::min(kTogether, end - first)));
        std::uint32_t all = kUncovered;
        for (const std::uint32_t local : row) all &= local;
        if (all == kUncovered) continue;
        for (int x = first; x < first + int(row.size()); ++x)
          if (image.at(x, y) != kUncovered) cover(x, y, image.at(x, y), mirrors);
      }
  }

  WarpCounts run() {
    paint(plan_.surfaces);
    settle(false);
    if (!plan_.behind.empty()) {
      Cracks cracks;
      cracks.open(canvas_, plan_.frontSlot);
      ThinPixels thin;
      thin.open(canvas_, memory_, plan_.frontSlot);
      forColumns([&](int x) { kernel_.reopen(canvasColumn(x), plan_.frontSlot, canvas_.column(x)); });
      paint(plan_.behind);
      settle(false);
      cracks.close(canvas_);
      thin.close(canvas_, memory_);
    }
    if (mirrors_) {
      paint(plan_.reflections, true);
      paint(plan_.mirrors, true);
      settle(true);
    }
    return counts_;
  }

 private:
  void cover(int x, int y, std::uint32_t local, std::span<const std::uint8_t> mirrors) {
    const std::size_t at = canvas_.indexOf(x) + std::size_t(y);
    memory_.open[at] = 0;
    if (mirrors_ && !mirrors.empty() && mirrors[local] != 0)
      memory_.mirror[at] = kAllParts | std::uint32_t(mirrors[local]) << 16;
  }

  template <class Each>
  void forColumns(const Each& each) const {
    for (int x = canvas_.x0; x < canvas_.x0 + canvas_.width; ++x) each(x);
  }

  void paint(const std::vector<StripDraw>& strips, bool reflections = false) {
    forColumns([&](int x) { kernel_.findCells(canvasColumn(x), reflections); });
    for (std::size_t x = 0; x < memory_.cells.size(); ++x) memory_.reached[x] |= memory_.cells[x];
    for (const StripDraw& strip : strips) {
      if (strip.x0 >= canvas_.x0 + canvas_.width || strip.x1 <= canvas_.x0) continue;
      for (const PatchDraw& draw : strip.patches) paint(strip, draw);
    }
  }

  void settle(bool mirrors) {
    forColumns([&](int x) { kernel_.settle(canvasColumn(x), mirrors, canvas_.column(x)); });
    std::ranges::fill(memory_.reached, 0);
  }

  /// Those that hold rows of [first, end).
  std::uint64_t cellsOf(int first, int end) const {
    return (~std::uint64_t(0) << (first >> cellShift_)) &
           (~std::uint64_t(0) >> (63 - ((end - 1) >> cellShift_)));
  }

  void paint(const StripDraw& strip, const PatchDraw& draw) {
    const PolygonRows& polygon = draw.polygon;
    int x0 = std::max(polygon.x0(), canvas_.x0);
    int x1 = std::min(polygon.x1(), canvas_.x0 + canvas_.width);
    if (x0 >= x1) return;
    counts_.samplesRead += polygon.x0() < countedTo_ && std::max(polygon.x0(), 0) >= countedFrom_;
    const std::uint64_t reached = cellsOf(polygon.y0(), polygon.y1());
    const auto isClosed = [&](int x) { return (memory_.cells[std::size_t(x - canvas_.x0)] & reached) == 0; };
    while (x0 < x1 && isClosed(x0)) ++x0;
    while (x0 < x1 && isClosed(x1 - 1)) --x1;
    if (x0 == x1) return;
    const auto cells = std::span(memory_.cells).subspan(std::size_t(x0 - canvas_.x0), std::size_t(x1 - x0));
    polygon.rows(x0, x1, memory_.rows);
    PatchColumn column = draw.column;
    for (int x = x0; x < x1; ++x) {
      const std::size_t i = std::size_t(x - x0);
      const RowRange& rows = memory_.rows[i];
      if (rows.first >= rows.end || (cells[i] & cellsOf(rows.first, rows.end)) == 0) continue;
      const float at = float(x);
      for (int k = 0; k < 3; ++k) column.start[k] = draw.column.start[k] + at * draw.column.across[k];
      column.depthStart = draw.column.depthStart + at * draw.column.depthAcross;
      if (strip.limited) {
        column.lowStart = strip.lowStart + at * strip.lowAcross;
        column.highStart = strip.highStart + at * strip.highAcross;
      }
      const int painted = kernel_.paint(column, rows.first, rows.end, canvasColumn(x));
      if (x >= countedFrom_ && x < countedTo_) counts_.samplesDrawn += std::uint64_t(painted);
    }
  }

  PatchCanvasColumn canvasColumn(int x) {
    const std::size_t at = canvas_.indexOf(x);
    return {canvas_.height,
            memory_.open.data() + at,
            memory_.red.data() + at,
            memory_.green.data() + at,
            memory_.blue.data() + at,
            memory_.clear.data() + at,
            memory_.inverseZDepth.data() + at,
            memory_.source.data() + at,
            mirrors_ ? memory_.mirror.data() + at : nullptr,
            memory_.cells.data() + (x - canvas_.x0),
            memory_.reached.data() + (x - canvas_.x0),
            cellShift_};
  }

  const PatchPlan& plan_;
  const PatchKernel& kernel_;
  int countedFrom_, countedTo_;
  int cellShift_;
  bool mirrors_;
  PatchCanvas& memory_;
  Canvas& canvas_;
  WarpCounts counts_;
};

}  // namespace

WarpCounts paintPatches(const PatchPlan& plan, const PatchKernel& kernel, const CoverImage* cover,
                        std::span<const std::uint8_t> coverMirrors, int x0, int x1, PatchCanvas& memory,
                        Canvas& canvas) {
  PatchPainter painter(plan, kernel, x0, x1, memory, canvas);
  if (cover != nullptr) painter.cover(*cover, coverMirrors);
  return painter.run();
}

}  // namespace acentric
