#include "editor/overlays/coverage_layer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "editor/overlays/scale_colour.h"
#include "editor/overlays/scale_legend.h"
#include "ui/canvas_draw.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

namespace palette = ui::palette;

constexpr double kLeastRate = 0.125, kMostRate = 2;  ///< ends of the scale, samples per pixel

double rateOf(const PointCoverage& point) { return point.samplesPerMetre / point.pixelsPerMetre; }

ui::Colour colourOf(const PointCoverage& point) {
  if (point.surfaceClass == SurfaceClass::neverSampled) return palette::alarm;
  if (point.surfaceClass == SurfaceClass::local) return palette::plain;
  return scaleColour(std::log(rateOf(point) / kLeastRate) / std::log(kMostRate / kLeastRate));
}

/// What is worse lies on top: never sampled, then from the poorest rate to the best, then what is only near.
double badness(const PointCoverage& point) {
  if (point.surfaceClass == SurfaceClass::neverSampled) return 1e9;
  if (point.surfaceClass == SurfaceClass::local) return -1e9;
  return -rateOf(point);
}

/// Counts at the ends of the scale: of one cell from the ideal one camera on, of a layout what there is.
struct CountScale {
  int low = 1, high = 1;
  explicit CountScale(const CoveragePicture& picture) {
    const bool cell = picture.request.kind == CoverageKind::cell;
    low = cell ? 1 : std::max(picture.fewestCameras, 1);
    high = std::max(picture.mostCameras, low + (cell ? 3 : 1));
  }
  ui::Colour colour(int count) const {
    return count == 0 ? ui::Colour(palette::alarm) : scaleColour(double(count - low) / (high - low));
  }
};

std::string percent(double share) { return ui::formatPercent(share); }

std::string textOf(const PointCoverage& point) {
  const std::string seen =
      trf("\nSeen from {} regions, missed by {} of them", point.seenFrom.size(), point.missedFrom.size());
  if (point.surfaceClass == SurfaceClass::neverSampled)
    return tr("Never sampled: a hole wherever it is seen") + seen;
  if (point.surfaceClass == SurfaceClass::local) return tr("Only near: always drawn as geometry") + seen;
  return trf("Sampled at {} of what is needed: {:.0f} samples per metre, the nearest eye needs {:.0f}{}",
             percent(rateOf(point)), point.samplesPerMetre, point.pixelsPerMetre, seen);
}

ScaleLegend surfaceLegend(const CoveragePicture& picture) {
  const CoverageSummary& all = picture.surfaces->all;
  const double never = all.share(SurfaceClass::neverSampled);
  ScaleLegend legend{
      tr("Samples, share of what the nearest eye needs"), percent(kLeastRate), percent(kMostRate), {}};
  legend.lines.push_back({trf("{} never sampled", percent(never)), palette::alarm});
  legend.lines.push_back(
      {trf("median {}; under half {}, over double {}", percent(picture.medianRate),
           percent(all.share(SurfaceClass::under)), percent(all.share(SurfaceClass::over))),
       palette::text});
  legend.lines.push_back(
      {trf("{} only near, drawn as geometry", percent(all.share(SurfaceClass::local))), palette::plain});
  const std::string points =
      trf("{} points, from {} eyes", ui::formatCount(all.points), ui::formatCount(picture.eyes));
  legend.lines.push_back(
      {picture.exact ? trf("{}: exact", points) : fmt::format("{}: {:.0f} %", points, 100 * picture.progress),
       palette::muted});
  return legend;
}

ScaleLegend countLegend(const CoveragePicture& picture) {
  const CoverageShares& shares = picture.shares;
  const bool cell = picture.request.kind == CoverageKind::cell;
  const CountScale scale(picture);
  ScaleLegend legend{cell ? tr("Cameras of the cell per point") : tr("Cameras per point"),
                     fmt::format("{}", scale.low),
                     fmt::format("{}", scale.high),
                     {}};
  legend.lines.push_back({trf("{} held by none", percent(shares.none)), palette::alarm});
  legend.lines.push_back({trf("{:.1f} on average; by one {}, by more {}", shares.mean, percent(shares.once),
                              percent(shares.more)),
                          palette::text});
  if (cell)
    legend.lines.push_back(
        {trfMany("Its cover holds {} exactly once", "Each of its covers holds {} exactly once",
                 std::uint64_t(picture.covers), percent(picture.coverHoldsOnce)),
         picture.coverHoldsOnce < 1 ? palette::danger : palette::good});
  legend.lines.push_back({trf("{} x {} points{}", picture.plan.grid.columns, picture.plan.grid.rows,
                              picture.exact ? tr(": exact") : tr(", finer ones follow")),
                          palette::muted});
  return legend;
}

}  // namespace

std::optional<CoverageRequest> wantedCoverage(const EditorState& state,
                                              const std::optional<CellId>& hovered) {
  if (state.overlay != PlanOverlay::coverage) return std::nullopt;
  CoverageRequest wanted{state.coverageKind, {}};
  if (wanted.kind == CoverageKind::cell)
    wanted.cell = state.selection.size() == 1 ? std::optional(*state.selection.begin()) : hovered;
  return wanted;
}

void CoverageLayer::sendRaster() {
  const PlanGrid& grid = shown_->plan.grid;
  const CountScale scale(*shown_);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(std::size_t(grid.columns) * std::size_t(grid.rows) * 4);
  for (int y = grid.rows - 1; y >= 0; --y)
    for (int x = 0; x < grid.columns; ++x) {
      const std::uint16_t count = shown_->plan.counts[grid.indexOf(x, y)];
      const ui::Colour colour = scale.colour(count);
      const double opacity = count == kNotCounted ? 0 : 0.5;
      for (const double channel : {double(colour.r), double(colour.g), double(colour.b), opacity})
        pixels.push_back(std::uint8_t(std::lround(255 * channel)));
    }
  raster_.upload(grid.columns, grid.rows, pixels, false);
}

void CoverageLayer::sendPoints() {
  std::vector<const PointCoverage*> points;
  for (const PointCoverage& point : shown_->surfaces->points)
    if (point.surfaceClass != SurfaceClass::unseen) points.push_back(&point);
  std::ranges::stable_sort(points, {}, [](const PointCoverage* point) { return badness(*point); });
  std::vector<ui::CanvasMark> marks;
  std::vector<ImU32> colours;
  for (const PointCoverage* point : points) {
    marks.push_back({glm::dvec2(point->point.position), 0, 0});
    colours.push_back(colourOf(*point).packed());
  }
  points_.setPlaces(marks);
  points_.setColours(colours);
}

void CoverageLayer::drawBelow(ImDrawList& list, const ui::CanvasView& view,
                              const CoveragePicturePtr& picture) {
  if (const ui::Palette* palette = &ui::currentPalette(); picture != shown_ || palette != palette_) {
    shown_ = picture;
    palette_ = palette;
    if (shown_ && shown_->surfaces)
      sendPoints();
    else if (shown_)
      sendRaster();
  }
  if (!shown_ || shown_->surfaces || raster_.empty()) return;
  const PlanGrid& grid = shown_->plan.grid;
  const glm::dvec2 high = grid.corner + grid.step * glm::dvec2(grid.columns, grid.rows);
  list.AddImage(raster_.imguiId(), ui::imVec(view.screenFromWorld({grid.corner.x, high.y})),
                ui::imVec(view.screenFromWorld({high.x, grid.corner.y})));
}

float CoverageLayer::pointPixels(const ui::CanvasView& view) const {
  // As large as each point's share of the surface while there are few, never so large as to hide others.
  const SurfaceCoverage& surfaces = *shown_->surfaces;
  const double share = surfaces.squareMetresPerPoint * surfaces.wanted /
                       double(std::max<std::size_t>(surfaces.points.size(), 1));
  return float(std::clamp(0.4 * std::sqrt(share) * view.pixelsPerMetre(), 1.5, 5.0));
}

void CoverageLayer::drawAbove(ImDrawList& list, const ui::CanvasView& view) {
  if (!shown_ || !shown_->surfaces) return;
  points_.draw(list, view, {pointPixels(view), palette::backdrop.withOpacity(0).vec(), 0, 1});
}

void CoverageLayer::drawLegend(ImDrawList& list, const ui::CanvasView& view, const CoveragePicture* picture,
                               CoverageKind kind, ImFont* font) const {
  if (picture != nullptr)
    return drawScaleLegend(list, view, picture->surfaces ? surfaceLegend(*picture) : countLegend(*picture),
                           font);
  drawScaleLegend(
      list, view,
      {kind == CoverageKind::cell ? tr("Point at a cell, or select one") : tr("Measuring coverage"),
       {},
       {},
       {}},
      font);
}

std::string CoverageLayer::textAt(const ui::CanvasView& view, const CoveragePicture* picture,
                                  const glm::dvec2& pointer) const {
  if (picture == nullptr) return {};
  const glm::dvec2 world = view.worldFromScreen(pointer);
  if (!picture->surfaces) {
    const PlanGrid& grid = picture->plan.grid;
    const glm::dvec2 cell = glm::floor((world - grid.corner) / grid.step);
    if (cell.x < 0 || cell.y < 0 || cell.x >= grid.columns || cell.y >= grid.rows) return {};
    const std::uint16_t count = picture->plan.counts[grid.indexOf(int(cell.x), int(cell.y))];
    if (count == kNotCounted) return {};
    return count == 0 ? tr("Held by no camera")
                      : trfMany("Held by {} camera", "Held by {} cameras", count, count);
  }
  const double reach = (double(pointPixels(view)) + 3) / view.pixelsPerMetre();
  const PointCoverage* best = nullptr;
  for (const PointCoverage& point : picture->surfaces->points) {
    if (point.surfaceClass == SurfaceClass::unseen) continue;
    if (glm::distance(glm::dvec2(point.point.position), world) > reach) continue;
    if (best == nullptr || badness(point) > badness(*best)) best = &point;
  }
  return best != nullptr ? textOf(*best) : std::string();
}

}  // namespace acentric::editor
