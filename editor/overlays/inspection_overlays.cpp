#include <fmt/format.h>

#include <algorithm>

#include "editor/overlays/plan_overlays.h"
#include "editor/overlays/scale_colour.h"
#include "ui/canvas_draw.h"
#include "ui/text_format.h"

namespace acentric::editor {
namespace {

using ui::imVec;
namespace palette = ui::palette;

ui::Colour colourOf(Severity severity) {
  switch (severity) {
    case Severity::note:
      return palette::muted;
    case Severity::warning:
      return palette::warning;
    case Severity::error:
      break;
  }
  return palette::danger;
}

}  // namespace

void drawTriangleLegend(ImDrawList& list, const ui::CanvasView& view, const Inspection& inspection,
                        std::size_t budget, ImFont* font) {
  const std::size_t most = std::max<std::size_t>(inspection.budgets.worst(), 1);
  const std::size_t over = budget > 0 ? inspection.budgets.over(budget).size() : 0;
  const ImVec2 low = imVec(view.areaMin() + glm::dvec2(30, view.areaSize().y - 74));
  constexpr float kWidth = 180, kHeight = 10;
  list.AddRectFilled({low.x - 8, low.y - 24}, {low.x + kWidth + 8, low.y + 32},
                     palette::panel.withOpacity(0.88F).packed(), 4);
  for (int step = 0; step < 36; ++step)
    list.AddRectFilled({low.x + float(step) * 5, low.y}, {low.x + float(step) * 5 + 5, low.y + kHeight},
                       scaleColour(step / 35.0).packed());
  const auto text = [&](float x, float y, const std::string& words, const ui::Colour& colour) {
    list.AddText(font, font->FontSize, {x, y}, colour.packed(), words.c_str());
  };
  text(low.x, low.y - 19, "Triangles of local geometry", palette::text);
  const std::string highest = ui::formatCount(most);
  text(low.x, low.y + 13, "0", palette::muted);
  text(low.x + kWidth - font->CalcTextSizeA(font->FontSize, 1000, 0, highest.c_str()).x, low.y + 13, highest,
       palette::muted);
  if (budget > 0)
    text(low.x + 24, low.y + 13, fmt::format("{} over {}", over, ui::formatCount(budget)),
         over > 0 ? palette::danger : palette::good);
}

const PlacementFinding* drawFindings(ImDrawList& list, const ui::CanvasView& view,
                                     const PlacementReport& report, const glm::dvec2& pointer) {
  constexpr double kReach = 9;  // pixels
  const PlacementFinding* under = nullptr;
  // The worst come first: they are drawn last, over the others.
  for (std::size_t f = report.findings.size(); f-- > 0;) {
    const PlacementFinding& finding = report.findings[f];
    const glm::dvec2 screen = view.screenFromWorld(finding.place);
    if (!view.contains(screen)) continue;
    const ui::Colour colour = colourOf(finding.severity);
    const ImVec2 at = imVec(screen);
    const bool near = glm::distance(screen, pointer) <= kReach;
    if (near) under = &finding;
    list.AddCircleFilled(at, near ? 6.5F : 5, palette::backdrop.withOpacity(0.85F).packed(), 16);
    list.AddCircle(at, near ? 6.5F : 5, colour.packed(), 16, 1.8F);
    if (finding.severity != Severity::note) {
      list.AddLine({at.x, at.y - 2.6F}, {at.x, at.y + 0.6F}, colour.packed(), 1.6F);
      list.AddCircleFilled({at.x, at.y + 2.6F}, 0.9F, colour.packed(), 6);
    }
    if (!finding.push) continue;
    const glm::dvec2 moved = view.screenFromWorld(finding.place + *finding.push);
    if (glm::distance(moved, screen) < 8) continue;
    list.AddLine(at, imVec(moved), colour.packed(), 1.4F);
    list.AddCircleFilled(imVec(moved), 2.6F, colour.packed(), 8);
  }
  return under;
}

}  // namespace acentric::editor
