#include "engine/view/patch_painter.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/view/cracks.h"

namespace acentric {
namespace {

class PatchPainter {
 public:
  PatchPainter(const PatchPlan& plan, PaintPatchColumn kernel, int x0, int x1, PatchCanvas& memory,
               Canvas& canvas)
      : plan_(plan),
        kernel_(kernel),
        countedFrom_(x0),
        countedTo_(x1),
        mirrors_(!plan.reflections.empty()),
        memory_(memory),
        canvas_(canvas) {
    const std::size_t room = canvas.pixels.size() + kPatchRoom;
    memory.open.assign(room, kAllParts);
    for (auto* words : {&memory.source, &memory.mirror}) words->assign(room, 0);
    for (auto* sums : {&memory.red, &memory.green, &memory.blue, &memory.inverseZDepth})
      sums->assign(room, 0);
    memory.clear.assign(room, 1);
    memory.covered.assign(room, 0);
  }

  /// Nothing is painted where something covers the captures, but for what its mirrors show.
  void cover(const CoverImage& cover, std::span<const std::uint8_t> mirrors) {
    for (int y = 0; y < canvas_.height; ++y)
      for (int x = canvas_.x0; x < canvas_.x0 + canvas_.width; ++x) {
        const std::uint32_t local = cover.at(x, y);
        if (local == kUncovered) continue;
        const std::size_t at = canvas_.indexOf(x) + std::size_t(y);
        memory_.open[at] = 0;
        memory_.covered[at] = 1;
        if (mirrors_ && !mirrors.empty() && mirrors[local] != 0)
          memory_.mirror[at] = kAllParts | std::uint32_t(mirrors[local]) << 16;
      }
  }

  WarpCounts run() {
    paint(plan_.surfaces);
    settle(false);
    if (!plan_.behind.empty()) {
      Cracks cracks;
      cracks.open(canvas_, plan_.frontSlot);
      reopen();
      paint(plan_.behind);
      settle(false);
      cracks.close(canvas_);
    }
    if (mirrors_) {
      paint(plan_.reflections);
      paint(plan_.mirrors);
      settle(true);
    }
    return counts_;
  }

 private:
  void paint(const std::vector<StripDraw>& strips) {
    for (const StripDraw& strip : strips)
      for (const PatchDraw& draw : strip.patches) paint(strip, draw);
  }

  /// For the second cover: where nothing of the first lies, and its cracks.
  void reopen() {
    for (std::size_t at = 0; at < canvas_.pixels.size(); ++at) {
      if (memory_.mirror[at] != 0) continue;
      const bool open = slotOf(canvas_.pixels[at]) < plan_.frontSlot && memory_.covered[at] == 0;
      memory_.open[at] = open ? kAllParts : 0;
      memory_.source[at] = 0;
      memory_.red[at] = memory_.green[at] = memory_.blue[at] = 0;
      memory_.clear[at] = 1;
    }
  }

  /// From sums to colours on the canvas, over its background: pixels that show mirrors, or all others.
  void settle(bool mirrors) {
    for (std::size_t at = 0; at < canvas_.pixels.size(); ++at) {
      if ((memory_.mirror[at] != 0) != mirrors) continue;
      const int open = std::popcount(memory_.open[at]);
      int painted = kPixelParts - open - std::popcount(memory_.mirror[at] & kAllParts);
      glm::vec3 sum(memory_.red[at], memory_.green[at], memory_.blue[at]);
      const bool isReal = memory_.source[at] != 0 || (mirrors && painted > 0);
      if (open > 0 && inverseZDepthOf(canvas_.pixels[at]) >= 0) {  // also what shows in a crack
        const Rgba8 behind = colourOf(static_cast<std::uint32_t>(canvas_.pixels[at]));
        const glm::vec3 code(behind);
        sum += code * code * (float(open) * memory_.clear[at]);
        painted += open;
      } else if (!isReal) {
        continue;
      }
      if (painted <= 0) continue;
      const glm::uvec3 code(glm::min(glm::sqrt(sum / float(painted)) + 0.5f, glm::vec3(255)));
      const std::uint32_t slot =
          memory_.source[at] != 0 ? memory_.source[at] >> 8 : std::max(slotOf(canvas_.pixels[at]), 1u);
      canvas_.pixels[at] = canvasPixel(code.r | code.g << 8 | code.b << 16 | slot << 24,
                                       memory_.source[at] != 0 ? memory_.inverseZDepth[at] : 0);
    }
  }

  void paint(const StripDraw& strip, const PatchDraw& draw) {
    const int x0 = std::max(draw.polygon.x0(), canvas_.x0);
    const int x1 = std::min(draw.polygon.x1(), canvas_.x0 + canvas_.width);
    if (x0 >= x1) return;
    counts_.samplesRead += draw.polygon.x0() < countedTo_ && std::max(draw.polygon.x0(), 0) >= countedFrom_;
    PatchColumn column = draw.column;
    for (int x = x0; x < x1; ++x) {
      const glm::ivec2 rows = draw.polygon.rows(x);
      if (rows.x >= rows.y) continue;
      const float at = float(x);
      for (int i = 0; i < 3; ++i) column.start[i] = draw.column.start[i] + at * draw.column.across[i];
      column.depthStart = draw.column.depthStart + at * draw.column.depthAcross;
      if (strip.limited) {
        column.lowStart = strip.lowStart + at * strip.lowAcross;
        column.highStart = strip.highStart + at * strip.highAcross;
      }
      const int painted = kernel_(column, rows.x, rows.y, canvasColumn(x));
      if (x >= countedFrom_ && x < countedTo_) counts_.samplesDrawn += std::uint64_t(painted);
    }
  }

  PatchCanvasColumn canvasColumn(int x) {
    const std::size_t at = canvas_.indexOf(x);
    return {memory_.open.data() + at,   memory_.red.data() + at,
            memory_.green.data() + at,  memory_.blue.data() + at,
            memory_.clear.data() + at,  memory_.inverseZDepth.data() + at,
            memory_.source.data() + at, mirrors_ ? memory_.mirror.data() + at : nullptr};
  }

  const PatchPlan& plan_;
  PaintPatchColumn kernel_;
  int countedFrom_, countedTo_;
  bool mirrors_;
  PatchCanvas& memory_;
  Canvas& canvas_;
  WarpCounts counts_;
};

}  // namespace

WarpCounts paintPatches(const PatchPlan& plan, PaintPatchColumn kernel, const CoverImage* cover,
                        std::span<const std::uint8_t> coverMirrors, int x0, int x1, PatchCanvas& memory,
                        Canvas& canvas) {
  PatchPainter painter(plan, kernel, x0, x1, memory, canvas);
  if (cover != nullptr) painter.cover(*cover, coverMirrors);
  return painter.run();
}

}  // namespace acentric
