#include "editor/overlays/scale_legend.h"

#include <algorithm>

#include "editor/overlays/scale_colour.h"
#include "ui/canvas_draw.h"
#include "ui/theme.h"

namespace acentric::editor {
namespace {
namespace palette = ui::palette;
}

void drawScaleLegend(ImDrawList& list, const ui::CanvasView& view, const ScaleLegend& legend, ImFont* font) {
  const float bar = ui::scaled(180), barHeight = ui::scaled(10), line = ui::scaled(17);
  const float aboveScaleBar = ui::scaled(52), swatch = ui::scaled(18);
  constexpr int kSteps = 36;
  const auto widthOf = [&](const std::string& text) {
    return font->CalcTextSizeA(font->FontSize, 2000, 0, text.c_str()).x;
  };
  float width = std::max(bar, widthOf(legend.title));
  for (const LegendLine& entry : legend.lines) width = std::max(width, swatch + widthOf(entry.words));
  const bool scale = !legend.low.empty() || !legend.high.empty();
  const float height = line + (scale ? barHeight + line : 0) + line * float(legend.lines.size());
  const ImVec2 low = ui::imVec(view.areaMin() + glm::dvec2(double(ui::scaled(30)), view.areaSize().y));
  float y = low.y - aboveScaleBar - height;
  list.AddRectFilled({low.x - 8, y - 6}, {low.x + width + 8, y + height + 3},
                     palette::panel.withOpacity(0.9F).packed(), 4);
  const auto text = [&](float x, const std::string& words, const ui::Colour& colour) {
    list.AddText(font, font->FontSize, {x, y}, colour.packed(), words.c_str());
  };
  text(low.x, legend.title, palette::text);
  y += line;
  if (scale) {
    for (int step = 0; step < kSteps; ++step)
      list.AddRectFilled({low.x + float(step) * bar / kSteps, y + 1},
                         {low.x + float(step + 1) * bar / kSteps, y + 1 + barHeight},
                         scaleColour(double(step) / (kSteps - 1)).packed());
    y += barHeight + 3;
    text(low.x, legend.low, palette::muted);
    text(low.x + bar - widthOf(legend.high), legend.high, palette::muted);
    y += line - 3;
  }
  for (const auto& [words, colour, sign] : legend.lines) {
    // Words about the whole are in an ink of texts; those about a class have its colour before them.
    const bool ink = colour.packed() == palette::text.packed() || colour.packed() == palette::muted.packed();
    const ImVec2 before(low.x + ui::scaled(5), y + font->FontSize / 2);
    if (sign)
      sign(list, before);
    else if (!ink)
      list.AddCircleFilled(before, ui::scaled(4.5F), colour.packed());
    text(low.x + (ink && !sign ? 0 : swatch), words, ink ? colour : ui::Colour(palette::text));
    y += line;
  }
}

}  // namespace acentric::editor
