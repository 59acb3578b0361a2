#include "editor/overlays/scale_legend.h"

#include <algorithm>

#include "editor/overlays/scale_colour.h"
#include "ui/canvas_draw.h"

namespace acentric::editor {
namespace {
namespace palette = ui::palette;
}

void drawScaleLegend(ImDrawList& list, const ui::CanvasView& view, const ScaleLegend& legend, ImFont* font) {
  constexpr float kBar = 180, kBarHeight = 10, kLine = 17, kAboveScaleBar = 52;
  constexpr int kSteps = 36;
  const auto widthOf = [&](const std::string& text) {
    return font->CalcTextSizeA(font->FontSize, 2000, 0, text.c_str()).x;
  };
  float width = std::max(kBar, widthOf(legend.title));
  for (const auto& [text, colour] : legend.lines) width = std::max(width, widthOf(text));
  const bool scale = !legend.low.empty() || !legend.high.empty();
  const float height = kLine + (scale ? kBarHeight + kLine : 0) + kLine * float(legend.lines.size());
  const ImVec2 low = ui::imVec(view.areaMin() + glm::dvec2(30, view.areaSize().y));
  float y = low.y - kAboveScaleBar - height;
  list.AddRectFilled({low.x - 8, y - 6}, {low.x + width + 8, y + height + 3},
                     palette::panel.withOpacity(0.9F).packed(), 4);
  const auto text = [&](float x, const std::string& words, const ui::Colour& colour) {
    list.AddText(font, font->FontSize, {x, y}, colour.packed(), words.c_str());
  };
  text(low.x, legend.title, palette::text);
  y += kLine;
  if (scale) {
    for (int step = 0; step < kSteps; ++step)
      list.AddRectFilled({low.x + float(step) * kBar / kSteps, y + 1},
                         {low.x + float(step + 1) * kBar / kSteps, y + 1 + kBarHeight},
                         scaleColour(double(step) / (kSteps - 1)).packed());
    y += kBarHeight + 3;
    text(low.x, legend.low, palette::muted);
    text(low.x + kBar - widthOf(legend.high), legend.high, palette::muted);
    y += kLine - 3;
  }
  for (const auto& [words, colour] : legend.lines) {
    text(low.x, words, colour);
    y += kLine;
  }
}

}  // namespace acentric::editor
