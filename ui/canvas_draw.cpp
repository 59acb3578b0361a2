#include "ui/canvas_draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ui/text_format.h"
#include "ui/theme.h"

namespace acentric::ui {
namespace {

struct WorldBox {
  glm::dvec2 min, max;
};

WorldBox visibleBox(const CanvasView& view) {
  const glm::dvec2 a = view.worldFromScreen(view.areaMin());
  const glm::dvec2 b = view.worldFromScreen(view.areaMin() + view.areaSize());
  return {glm::min(a, b), glm::max(a, b)};
}

void gridLines(ImDrawList& list, const CanvasView& view, double step, const Colour& colour) {
  const WorldBox box = visibleBox(view);
  const glm::dvec2 low = view.areaMin();
  const glm::dvec2 high = view.areaMin() + view.areaSize();
  const ImU32 packed = colour.packed();
  for (double x = std::ceil(box.min.x / step) * step; x <= box.max.x; x += step) {
    const float at = float(std::round(view.screenFromWorld({x, 0}).x)) + 0.5F;
    list.AddLine({at, float(low.y)}, {at, float(high.y)}, packed);
  }
  for (double y = std::ceil(box.min.y / step) * step; y <= box.max.y; y += step) {
    const float at = float(std::round(view.screenFromWorld({0, y}).y)) + 0.5F;
    list.AddLine({float(low.x), at}, {float(high.x), at}, packed);
  }
}

std::string rulerText(double value, double step) {
  const int decimals = std::clamp(int(std::ceil(-std::log10(step) - 1e-9)), 0, 4);
  return fmt::format("{:.{}f}", std::abs(value) < step * 1e-6 ? 0.0 : value, decimals);
}

}  // namespace

void drawGrid(ImDrawList& list, const CanvasView& view) {
  const double step = niceStep(view.pixelsPerMetre(), 14);
  const double coarse = niceStep(view.pixelsPerMetre(), 64);
  gridLines(list, view, step, palette::text.withOpacity(0.035F));
  gridLines(list, view, coarse, palette::text.withOpacity(0.07F));
}

void drawRulers(ImDrawList& list, const CanvasView& view, ImFont* font, std::optional<glm::dvec2> pointer) {
  const float ruler = scaled(kRulerPixels);
  const glm::dvec2 low = view.areaMin();
  const glm::dvec2 high = low + view.areaSize();
  const ImU32 plate = palette::panel.withOpacity(0.92F).packed();
  const ImU32 tick = palette::faint.packed();
  const ImU32 text = palette::muted.packed();
  const float size = font->FontSize;
  list.AddRectFilled(imVec(low), {float(high.x), float(low.y) + ruler}, plate);
  list.AddRectFilled({float(low.x), float(low.y) + ruler}, {float(low.x) + ruler, float(high.y)}, plate);

  const double step = niceStep(view.pixelsPerMetre(), 64);
  const WorldBox box = visibleBox(view);
  for (double x = std::ceil(box.min.x / step) * step; x <= box.max.x; x += step) {
    const float at = float(std::round(view.screenFromWorld({x, 0}).x)) + 0.5F;
    if (at < float(low.x) + ruler) continue;
    list.AddLine({at, float(low.y) + ruler - scaled(5)}, {at, float(low.y) + ruler}, tick);
    list.AddText(font, size, {at + 3, float(low.y) + 1}, text, rulerText(x, step).c_str());
  }
  for (double y = std::ceil(box.min.y / step) * step; y <= box.max.y; y += step) {
    const float at = float(std::round(view.screenFromWorld({0, y}).y)) + 0.5F;
    if (at < float(low.y) + ruler + size) continue;
    list.AddLine({float(low.x) + ruler - scaled(5), at}, {float(low.x) + ruler, at}, tick);
    list.AddText(font, size, {float(low.x) + 2, at - size - 1}, text, rulerText(y, step).c_str());
  }
  if (pointer && view.contains(*pointer)) {
    const ImU32 mark = palette::accent.packed();
    const float x = float(pointer->x);
    const float y = float(pointer->y);
    list.AddLine({x, float(low.y)}, {x, float(low.y) + ruler}, mark);
    list.AddLine({float(low.x), y}, {float(low.x) + ruler, y}, mark);
  }
  list.AddRectFilled(imVec(low), {float(low.x) + ruler, float(low.y) + ruler}, palette::panel.packed());
  list.AddText(font, size, {float(low.x) + 4, float(low.y) + 2}, text, "m");
}

void drawScaleBar(ImDrawList& list, const CanvasView& view, ImFont* font) {
  const float ruler = scaled(kRulerPixels);
  const double length = niceStep(view.pixelsPerMetre(), double(scaled(70)));
  const float pixels = float(length * view.pixelsPerMetre());
  const std::string text = formatMetres(length);
  const ImVec2 textSize = font->CalcTextSizeA(font->FontSize, 1e6F, 0, text.c_str());
  const float left = float(view.areaMin().x) + ruler + scaled(14);
  const float bottom = float(view.areaMin().y + view.areaSize().y) - scaled(14);
  list.AddRectFilled({left - 8, bottom - textSize.y - 10},
                     {left + std::max(pixels, textSize.x) + 8, bottom + 7},
                     palette::backdrop.withOpacity(0.72F).packed(), 4);
  const ImU32 ink = palette::text.packed();
  list.AddLine({left, bottom}, {left + pixels, bottom}, ink, 2);
  list.AddLine({left, bottom - 5}, {left, bottom + 1}, ink, 2);
  list.AddLine({left + pixels, bottom - 5}, {left + pixels, bottom + 1}, ink, 2);
  list.AddText(font, font->FontSize, {left + (pixels - textSize.x) / 2, bottom - textSize.y - 5}, ink,
               text.c_str());
}

void drawCoordinates(ImDrawList& list, const CanvasView& view, ImFont* font, const glm::dvec2& world) {
  const std::string text = fmt::format("x {:.2f} m   y {:.2f} m", world.x, world.y);
  const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6F, 0, text.c_str());
  const glm::dvec2 corner = view.areaMin() + view.areaSize();
  drawLabel(list, font, {float(corner.x) - size.x - scaled(14), float(corner.y) - size.y - scaled(11)},
            palette::text, text.c_str());
}

void drawConvex(ImDrawList& list, const CanvasView& view, std::span<const glm::dvec2> corners,
                const Colour& fill, const Colour& line, float thickness) {
  std::vector<ImVec2> points;
  points.reserve(corners.size());
  // Reversed: counter-clockwise in the world is clockwise on the screen's terms, which ImGui's antialiasing
  // wants.
  for (std::size_t i = corners.size(); i-- > 0;) points.push_back(imVec(view.screenFromWorld(corners[i])));
  const int count = int(points.size());
  if (fill.a > 0) list.AddConvexPolyFilled(points.data(), count, fill.packed());
  if (line.a > 0) list.AddPolyline(points.data(), count, line.packed(), ImDrawFlags_Closed, thickness);
}

void drawDashed(ImDrawList& list, const CanvasView& view, std::span<const glm::dvec2> points, bool closed,
                const Colour& line, float thickness) {
  const double dash = double(scaled(6));
  constexpr double kLongestEdge = 4000;  // beyond it the dashes cannot be told apart: draw it solid
  const ImU32 packed = line.packed();
  const std::size_t edges = points.size() < 2 ? 0 : points.size() - (closed ? 0 : 1);
  for (std::size_t i = 0; i < edges; ++i) {
    const glm::dvec2 a = view.screenFromWorld(points[i]);
    const glm::dvec2 b = view.screenFromWorld(points[(i + 1) % points.size()]);
    const double length = glm::length(b - a);
    if (length > kLongestEdge || length < dash) {
      list.AddLine(imVec(a), imVec(b), packed, thickness);
      continue;
    }
    const glm::dvec2 along = (b - a) / length;
    for (double at = 0; at < length; at += 2 * dash)
      list.AddLine(imVec(a + along * at), imVec(a + along * std::min(length, at + dash)), packed, thickness);
  }
}

void drawLabel(ImDrawList& list, ImFont* font, const ImVec2& position, const Colour& colour,
               const char* text) {
  const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6F, 0, text);
  list.AddRectFilled({position.x - scaled(5), position.y - scaled(2)},
                     {position.x + size.x + scaled(5), position.y + size.y + scaled(2)},
                     palette::backdrop.withOpacity(0.78F).packed(), 3);
  list.AddText(font, font->FontSize, position, colour.packed(), text);
}

}  // namespace acentric::ui
