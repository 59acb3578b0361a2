#include <fmt/format.h>

#include <algorithm>

#include "editor/overlays/plan_overlays.h"
#include "editor/overlays/scale_legend.h"
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
  ScaleLegend legend{"Triangles of local geometry", "0", ui::formatCount(most), {}};
  if (budget > 0) {
    const std::size_t over = inspection.budgets.over(budget).size();
    legend.lines.push_back({fmt::format("{} over {}", over, ui::formatCount(budget)),
                            over > 0 ? palette::danger : palette::good});
  }
  drawScaleLegend(list, view, legend, font);
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
