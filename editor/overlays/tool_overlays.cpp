#include "editor/overlays/tool_overlays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ui/canvas_draw.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

using ui::imVec;
namespace palette = ui::palette;

ImVec2 sizeOf(ImFont* font, const std::string& text) {
  return font->CalcTextSizeA(font->FontSize, 1e6F, 0, text.c_str());
}

/// Right below a place, pushed back into the view.
void drawBeside(ImDrawList& list, const ui::CanvasView& view, ImFont* font, const glm::dvec2& screen,
                const std::string& text, const ui::Colour& colour) {
  const ImVec2 size = sizeOf(font, text);
  const glm::dvec2 end = view.areaMin() + view.areaSize();
  const float x = std::min(float(screen.x) + 16, float(end.x) - size.x - 14);
  const float y = std::min(float(screen.y) + 14, float(end.y) - size.y - 12);
  ui::drawLabel(list, font, {x, y}, colour, text.c_str());
}

void drawHandle(ImDrawList& list, const ImVec2& at, bool lit) {
  list.AddCircleFilled(at, lit ? 8.5F : 7, palette::backdrop.packed());
  list.AddCircleFilled(at, lit ? 7 : 5.5F, (lit ? palette::text : palette::accent).packed());
}

}  // namespace

void drawMarquee(ImDrawList& list, const ui::CanvasView& view, const MarqueeIntent& box, std::size_t cells,
                 ImFont* font) {
  const glm::dvec2 a = view.screenFromWorld(box.low), b = view.screenFromWorld(box.high);
  const ImVec2 low = imVec(glm::min(a, b)), high = imVec(glm::max(a, b));
  list.AddRectFilled(low, high, palette::accent.withOpacity(0.10F).packed());
  list.AddRect(low, high, palette::accent.packed(), 0, 0, 1.4F);
  drawBeside(list, view, font, ui::fromIm(high),
             box.how == Combine::toggle
                 ? trfMany("toggle {} cell", "toggle {} cells", cells, ui::formatCount(cells))
                 : trfMany("add {} cell", "add {} cells", cells, ui::formatCount(cells)),
             palette::text);
}

void drawLatticeHandles(ImDrawList& list, const ui::CanvasView& view, const LatticeHandles& handles,
                        const LatticeTool& tool, const glm::dvec2& pointer, ImFont* font) {
  const LatticeGrip under =
      tool.dragging() ? tool.grip() : handles.gripAt(view.worldFromScreen(pointer), view.pixelsPerMetre());
  const ImVec2 centre = imVec(view.screenFromWorld(handles.centre));
  const ImVec2 turn = imVec(view.screenFromWorld(handles.turn));
  const ImVec2 size = imVec(view.screenFromWorld(handles.size));
  const float radius = std::hypot(turn.x - centre.x, turn.y - centre.y);
  const ImU32 line = palette::accent.withOpacity(0.75F).packed();
  list.AddCircle(centre, radius, palette::backdrop.withOpacity(0.6F).packed(), 96, 3.5F);
  list.AddCircle(centre, radius, line, 96, 1.4F);
  list.AddLine(centre, turn, line, 1.4F);
  list.AddLine(centre, size, line, 1.4F);
  drawHandle(list, turn, under == LatticeGrip::turn);
  // A square, for the size.
  const float half = under == LatticeGrip::size ? 7.0F : 5.5F;
  list.AddRectFilled({size.x - half - 1.5F, size.y - half - 1.5F},
                     {size.x + half + 1.5F, size.y + half + 1.5F}, palette::backdrop.packed());
  list.AddRectFilled({size.x - half, size.y - half}, {size.x + half, size.y + half},
                     (under == LatticeGrip::size ? palette::text : palette::accent).packed());
  drawHandle(list, centre, under == LatticeGrip::origin);
  const float arm = 15;
  const ImU32 cross = (under == LatticeGrip::origin ? palette::text : palette::accent).packed();
  list.AddLine({centre.x - arm, centre.y}, {centre.x - 9, centre.y}, cross, 2);
  list.AddLine({centre.x + 9, centre.y}, {centre.x + arm, centre.y}, cross, 2);
  list.AddLine({centre.x, centre.y - arm}, {centre.x, centre.y - 9}, cross, 2);
  list.AddLine({centre.x, centre.y + 9}, {centre.x, centre.y + arm}, cross, 2);
  if (tool.dragging())
    return drawBeside(list, view, font, view.screenFromWorld(tool.hand()), tool.text(), palette::text);
  const char* what = under == LatticeGrip::origin ? tr("Moves the lattice")
                     : under == LatticeGrip::turn ? tr("Turns the lattice")
                     : under == LatticeGrip::size ? tr("Size of the cells")
                                                  : nullptr;
  if (what != nullptr) drawBeside(list, view, font, pointer, what, palette::text);
}

void drawRuler(ImDrawList& list, const ui::CanvasView& view, const MeasureTool::Ruler& ruler, ImFont* font) {
  const glm::dvec2 from = view.screenFromWorld(ruler.from), to = view.screenFromWorld(ruler.to);
  list.AddLine(imVec(from), imVec(to), palette::backdrop.withOpacity(0.8F).packed(), 4.5F);
  list.AddLine(imVec(from), imVec(to), palette::warning.packed(), 2);
  const auto end = [&](const glm::dvec2& at, bool corner) {
    if (corner)
      list.AddRect({float(at.x) - 6, float(at.y) - 6}, {float(at.x) + 6, float(at.y) + 6},
                   palette::warning.packed(), 0, 0, 2);
    list.AddCircleFilled(imVec(at), 3.5F, palette::warning.packed());
  };
  end(from, ruler.fromCorner);
  end(to, ruler.toCorner);
  if (ruler.from == ruler.to) return;
  // The angle at the beginning, from east.
  const double turn = std::atan2(-(to.y - from.y), to.x - from.x);
  const float radius = float(std::min(28.0, glm::distance(from, to) / 2));
  list.AddLine(imVec(from), {float(from.x) + radius + 8, float(from.y)},
               palette::warning.withOpacity(0.5F).packed(), 1.2F);
  list.PathArcTo(imVec(from), radius, float(std::min(0.0, -turn)), float(std::max(0.0, -turn)), 24);
  list.PathStroke(palette::warning.withOpacity(0.8F).packed(), 0, 1.4F);
  drawBeside(list, view, font, to, describe(ruler), palette::text);
}

void drawOutlineRectangle(ImDrawList& list, const ui::CanvasView& view, std::span<const glm::dvec2> corners,
                          ImFont* font) {
  if (corners.size() != 4) return;
  ui::drawConvex(list, view, corners, palette::accent.withOpacity(0.10F), palette::accent, 2);
  const glm::dvec2 size = corners[2] - corners[0];
  drawBeside(list, view, font, view.screenFromWorld({corners[2].x, corners[0].y}),
             fmt::format("{:.2f} m x {:.2f} m = {}", size.x, size.y, ui::formatArea(size.x * size.y)),
             palette::text);
}

void drawOutlineFaults(ImDrawList& list, const ui::CanvasView& view, std::span<const OutlineFault> faults,
                       ImFont* font) {
  constexpr std::size_t kInWords = 4;
  for (std::size_t f = 0; f < faults.size(); ++f) {
    const glm::dvec2 screen = view.screenFromWorld(faults[f].place);
    if (!view.contains(screen)) continue;
    const ImVec2 at = imVec(screen);
    list.AddCircleFilled(at, 9, palette::backdrop.withOpacity(0.9F).packed());
    list.AddCircle(at, 9, palette::danger.packed(), 0, 2);
    list.AddLine({at.x - 4, at.y - 4}, {at.x + 4, at.y + 4}, palette::danger.packed(), 2);
    list.AddLine({at.x - 4, at.y + 4}, {at.x + 4, at.y - 4}, palette::danger.packed(), 2);
    if (f < kInWords) drawBeside(list, view, font, screen, faults[f].text, palette::danger);
  }
}

void drawLoopAreas(ImDrawList& list, const ui::CanvasView& view, std::span<const LoopArea> areas,
                   ImFont* font) {
  for (const LoopArea& area : areas) {
    const std::string text = (area.hole ? tr("hole, ") : "") + ui::formatArea(area.squareMetres);
    const ImVec2 size = sizeOf(font, text);
    const glm::dvec2 at = view.screenFromWorld(area.place);
    if (!view.contains(at)) continue;
    ui::drawLabel(list, font, {float(at.x) - size.x / 2, float(at.y) + 9}, palette::text, text.c_str());
  }
}

}  // namespace acentric::editor
