#include "engine/inspect/placement_picture.h"

#include <fmt/format.h>

#include <array>

#include "engine/picture/layout_picture.h"

namespace acentric {
namespace {

struct SeverityStyle {
  Severity severity;
  MarkerShape shape;
  LegendSwatch swatch;
  Rgba8 colour;
};
constexpr std::array<SeverityStyle, 3> kStyles{
    {{Severity::error, MarkerShape::cross, LegendSwatch::cross, kAlarmColour},
     {Severity::warning, MarkerShape::diamond, LegendSwatch::diamond, {230, 119, 0, 255}},
     {Severity::note, MarkerShape::ring, LegendSwatch::ring, {25, 113, 194, 255}}}};

const SeverityStyle& styleOf(Severity severity) {
  for (const SeverityStyle& style : kStyles)
    if (style.severity == severity) return style;
  return kStyles.back();
}

}  // namespace

PlanPicture pictureOf(const Layout& layout, const PlacementReport& report, std::string title) {
  PlanPicture picture = pictureOf(layout, std::move(title));
  picture.subtitle = fmt::format("{} centres of projection, {} regions: {} errors, {} warnings, {} notes",
                                 report.centres, report.regions, report.count(Severity::error),
                                 report.count(Severity::warning), report.count(Severity::note));
  bool pushed = false, marked = false;
  // The worst come first and are drawn last, over the others.
  for (auto finding = report.findings.rbegin(); finding != report.findings.rend(); ++finding) {
    if (finding->region >= 0) {
      picture.polygons[std::size_t(finding->region)].marked = marked = true;
      continue;
    }
    const SeverityStyle& style = styleOf(finding->severity);
    picture.markers.push_back({finding->place, style.shape, style.colour, 9, {}});
    if (!finding->push) continue;
    pushed = true;
    PlanLine arrow;
    arrow.points = {finding->place, finding->place + *finding->push};
    arrow.colour = style.colour;
    arrow.arrow = true;
    picture.lines.push_back(std::move(arrow));
  }
  for (const SeverityStyle& style : kStyles)
    if (report.count(style.severity) > 0)
      picture.legend.push_back({nameOf(style.severity), style.colour, style.swatch});
  if (pushed) picture.legend.push_back({"push that clears it", kInkColour, LegendSwatch::line});
  if (marked) picture.legend.push_back({"no standing room", kAlarmColour, LegendSwatch::markedArea});
  return picture;
}

}  // namespace acentric
