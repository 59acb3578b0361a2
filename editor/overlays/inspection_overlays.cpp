#include <fmt/format.h>

#include <algorithm>

#include "editor/overlays/plan_overlays.h"
#include "editor/overlays/scale_legend.h"
#include "ui/canvas_draw.h"
#include "ui/text_format.h"
#include "ui/theme.h"
#include "ui/translate.h"

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

/// An error is a filled triangle, a warning a ring, both with an exclamation mark; a note is a small ring.
void drawFinding(ImDrawList& list, const ImVec2& at, Severity severity, float size) {
  const ui::Colour colour = colourOf(severity);
  const float r = ui::scaled(severity == Severity::note ? 3.5F : 5.5F) * size;
  const ui::Colour ground = palette::backdrop.withOpacity(0.85F);
  if (severity == Severity::error) {
    const auto corners = [&at](float reach, auto draw) {
      draw(ImVec2(at.x, at.y - 1.25F * reach), ImVec2(at.x + 1.15F * reach, at.y + 0.8F * reach),
           ImVec2(at.x - 1.15F * reach, at.y + 0.8F * reach));
    };
    corners(r * 1.35F, [&](auto a, auto b, auto c) { list.AddTriangleFilled(a, b, c, ground.packed()); });
    corners(r, [&](auto a, auto b, auto c) { list.AddTriangleFilled(a, b, c, colour.packed()); });
  } else {
    list.AddCircleFilled(at, r, ground.packed(), 16);
    list.AddCircle(at, r, colour.packed(), 16, ui::scaled(1.8F));
  }
  if (severity == Severity::note) return;
  const ui::Colour ink = severity == Severity::error ? palette::backdrop : colour;
  list.AddLine({at.x, at.y - 0.55F * r}, {at.x, at.y + 0.15F * r}, ink.packed(), ui::scaled(1.6F));
  list.AddCircleFilled({at.x, at.y + 0.5F * r}, ui::scaled(0.9F), ink.packed(), 6);
}

}  // namespace

void drawTriangleLegend(ImDrawList& list, const ui::CanvasView& view, const Inspection& inspection,
                        std::size_t budget, ImFont* font) {
  const std::size_t most = std::max<std::size_t>(inspection.budgets.worst(), 1);
  ScaleLegend legend{tr("Triangles of local geometry"), "0", ui::formatCount(most), {}};
  if (budget > 0) {
    const std::size_t over = inspection.budgets.over(budget).size();
    legend.lines.push_back({trf("{} over {}", over, ui::formatCount(budget)), palette::alarm});
  }
  drawScaleLegend(list, view, legend, font);
}

void drawBytesLegend(ImDrawList& list, const ui::CanvasView& view, std::uint64_t most, std::uint64_t all,
                     ImFont* font) {
  if (all == 0)
    return drawScaleLegend(list, view, {tr("Bytes on disk: nothing is baked yet"), "", "", {}}, font);
  ScaleLegend legend{tr("Bytes on disk of the captures that a region shows"), "0", ui::formatBytes(most), {}};
  legend.lines.push_back(
      {trf("{} in all; captures serve several regions", ui::formatBytes(all)), palette::muted});
  drawScaleLegend(list, view, legend, font);
}

void drawDensityLegend(ImDrawList& list, const ui::CanvasView& view, double samplesPerDegree, ImFont* font) {
  const auto perDegree = [&](double density) { return fmt::format("{:.3g}", density * samplesPerDegree); };
  ScaleLegend legend{
      tr("Samples per degree"), perDegree(kLeastRegionDensity), perDegree(kMostRegionDensity), {}};
  legend.lines.push_back({trf("cells without colour: {}", perDegree(1)), palette::muted});
  legend.lines.push_back({tr("captures of several cells: the most of them"), palette::muted});
  drawScaleLegend(list, view, legend, font);
}

void drawChecksLegend(ImDrawList& list, const ui::CanvasView& view, const PlacementReport& report,
                      ImFont* font) {
  ScaleLegend legend{tr("Where cameras stand"), "", "", {}};
  const auto add = [&](Severity severity, const char* what) {
    const int count = report.count(severity);
    if (count == 0) return;
    legend.lines.push_back(
        {fmt::format("{}  {}", what, count), palette::muted,
         [severity](ImDrawList& on, const ImVec2& at) { drawFinding(on, at, severity, 0.9F); }});
  };
  add(Severity::error, tr("badly: inside a solid, or too near"));
  add(Severity::warning, tr("deserves a look: floor, nearness"));
  add(Severity::note, tr("note: nothing to mend"));
  if (legend.lines.empty()) legend.lines.push_back({trf("all {} stand free", report.centres), palette::good});
  drawScaleLegend(list, view, legend, font);
}

const PlacementFinding* drawFindings(ImDrawList& list, const ui::CanvasView& view,
                                     const PlacementReport& report, const glm::dvec2& pointer) {
  const double reach = double(ui::scaled(9));
  const PlacementFinding* under = nullptr;
  // The worst come first: they are drawn last, over the others.
  for (std::size_t f = report.findings.size(); f-- > 0;) {
    const PlacementFinding& finding = report.findings[f];
    const glm::dvec2 screen = view.screenFromWorld(finding.place);
    if (!view.contains(screen)) continue;
    const ui::Colour colour = colourOf(finding.severity);
    const ImVec2 at = imVec(screen);
    const bool near = glm::distance(screen, pointer) <= reach;
    if (near) under = &finding;
    drawFinding(list, at, finding.severity, near ? 1.3F : 1);
    if (!finding.push) continue;
    const glm::dvec2 moved = view.screenFromWorld(finding.place + *finding.push);
    if (glm::distance(moved, screen) < 8) continue;
    list.AddLine(at, imVec(moved), colour.packed(), 1.4F);
    list.AddCircleFilled(imVec(moved), 2.6F, colour.packed(), 8);
  }
  return under;
}

}  // namespace acentric::editor
