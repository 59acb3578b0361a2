#include "engine/picture/plan_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/picture/cairo_canvas.h"
#include "engine/picture/drawing.h"
#include "engine/picture/legend.h"

namespace acentric {
namespace {

/// The page is laid out 1400 units wide and scaled to the picture's width.
constexpr double kPage = 1400, kPageMargin = 44, kLegendWidth = 270, kPageGap = 34, kFooter = 62;
constexpr double kPageTitle = 28, kSubtitle = 17, kLabel = 13, kInset = 22;
constexpr int kLargestRaster = 16384;

struct Box {
  glm::dvec2 min{std::numeric_limits<double>::max()}, max{std::numeric_limits<double>::lowest()};
  void add(const glm::dvec2& p) { min = glm::min(min, p), max = glm::max(max, p); }
  bool empty() const { return min.x > max.x; }
};

template <class Visit>
void forEachPoint(const PlanPicture& picture, const Visit& visit) {
  for (const PlanPolygon& polygon : picture.polygons) std::ranges::for_each(polygon.corners, visit);
  for (const PlanLine& line : picture.lines) std::ranges::for_each(line.points, visit);
  for (const PlanRaster& raster : picture.rasters) visit(raster.min), visit(raster.max);
  for (const PlanCamera& camera : picture.cameras) visit(camera.position);
  for (const PlanMarker& marker : picture.markers) visit(marker.position);
}

/// Where things are on the page, and how the plan lies in it.
struct Page {
  double height = 0;
  glm::dvec2 panelMin{0}, panelMax{0};
  glm::dvec2 legendAt{0};
  std::vector<std::string> title, subtitle;
  Box world;
  double unitsPerMetre = 1;

  glm::dvec2 toPage(const glm::dvec2& p) const {
    const glm::dvec2 offset = unitsPerMetre * (p - 0.5 * (world.min + world.max));
    return 0.5 * (panelMin + panelMax) + glm::dvec2(offset.x, -offset.y);
  }
  std::vector<glm::dvec2> toPage(const std::vector<glm::dvec2>& points) const {
    std::vector<glm::dvec2> out;
    for (const glm::dvec2& p : points) out.push_back(toPage(p));
    return out;
  }
};

Page layOut(const PlanPicture& picture, CairoCanvas& ruler) {
  Page page;
  forEachPoint(picture, [&](const glm::dvec2& p) { page.world.add(p); });
  if (page.world.empty()) page.world = {{-1, -1}, {1, 1}};
  const glm::dvec2 size = glm::max(page.world.max - page.world.min, glm::dvec2(1e-6));
  page.title = ruler.wrap(picture.title, kPageTitle, kPage - 2 * kPageMargin, true);
  page.subtitle = ruler.wrap(picture.subtitle, kSubtitle, kPage - 2 * kPageMargin);
  const double top = kPageMargin + 1.25 * kPageTitle * double(page.title.size()) +
                     1.4 * kSubtitle * double(page.subtitle.size()) + 10;
  const bool legend = hasLegend(picture);
  const double panelWidth = kPage - 2 * kPageMargin - (legend ? kLegendWidth + kPageGap : 0);
  double panelHeight = std::clamp((panelWidth - 2 * kInset) * size.y / size.x + 2 * kInset, 320.0, 1250.0);
  if (legend) panelHeight = std::max(panelHeight, drawLegend(ruler, picture, {0, 0}, kLegendWidth));
  page.panelMin = {kPageMargin, top};
  page.panelMax = {kPageMargin + panelWidth, top + panelHeight};
  page.legendAt = {page.panelMax.x + kPageGap, top};
  page.unitsPerMetre = std::min((panelWidth - 2 * kInset) / size.x, (panelHeight - 2 * kInset) / size.y);
  page.height = std::ceil(page.panelMax.y + kFooter);
  return page;
}

double brightness(const Rgba8& c) { return (0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b) / 255; }

std::optional<Rgba8> fillOf(const PlanPolygon& polygon, const PlanPicture& picture) {
  if (polygon.value && picture.scale) return scaleColour(picture.scale->shareOf(*polygon.value));
  return polygon.fill;
}

void drawPolygons(CairoCanvas& canvas, const PlanPicture& picture, const Page& page) {
  for (const PlanPolygon& polygon : picture.polygons) {
    canvas.path(page.toPage(polygon.corners), true);
    if (const auto fill = fillOf(polygon, picture)) canvas.fillPath(*fill);
    if (polygon.strokeWidth > 0)
      canvas.strokePath(polygon.stroke, polygon.strokeWidth, false);
    else
      canvas.endPath();
  }
  for (const PlanPolygon& polygon : picture.polygons)
    if (polygon.marked) {
      canvas.path(page.toPage(polygon.corners), true);
      canvas.strokePath(kAlarmColour, 3, false);
    }
}

void drawPolygonLabels(CairoCanvas& canvas, const PlanPicture& picture, const Page& page) {
  for (const PlanPolygon& polygon : picture.polygons) {
    if (polygon.label.empty() || polygon.corners.empty()) continue;
    Box box;
    glm::dvec2 middle(0);
    for (const glm::dvec2& corner : page.toPage(polygon.corners)) {
      box.add(corner);
      middle += corner / double(polygon.corners.size());
    }
    const glm::dvec2 size = box.max - box.min;
    if (canvas.textWidth(polygon.label, kLabel) > 0.72 * size.x || kLabel > 0.4 * size.y) continue;
    const auto fill = fillOf(polygon, picture);
    const bool dark = fill && fill->a > 128 && brightness(*fill) < 0.5;
    canvas.text(polygon.label, middle + glm::dvec2(0, 0.36 * kLabel), kLabel,
                dark ? Rgba8{255, 255, 255, 255} : kInkColour, Align::middle);
  }
}

void drawLines(CairoCanvas& canvas, const PlanPicture& picture, const Page& page) {
  for (const PlanLine& line : picture.lines) {
    const std::vector<glm::dvec2> points = page.toPage(line.points);
    canvas.path(points, line.closed);
    canvas.strokePath(line.colour, line.width, line.dashed);
    if (!line.arrow || points.size() < 2) continue;
    const glm::dvec2 tip = points.back(), back = points[points.size() - 2] - tip;
    const double length = glm::length(back);
    if (!(length > 0)) continue;
    const glm::dvec2 along = back / length * (4 * line.width + 4), aside(-0.45 * along.y, 0.45 * along.x);
    canvas.path({tip + along + aside, tip, tip + along - aside}, false);
    canvas.strokePath(line.colour, line.width, false);
  }
}

void drawCameras(CairoCanvas& canvas, const PlanPicture& picture, const Page& page) {
  if (picture.cameras.empty()) return;
  // By default small enough that the sectors of a dense lattice stay apart.
  const glm::dvec2 size = page.unitsPerMetre * (page.world.max - page.world.min);
  const double roomEach = std::sqrt(size.x * size.y / double(picture.cameras.size()));
  const double radius = picture.cameraRadius > 0 ? picture.cameraRadius * page.unitsPerMetre
                                                 : std::clamp(0.45 * roomEach, 2.0, 20.0);
  for (const PlanCamera& camera : picture.cameras) {
    // Page angles run clockwise.
    canvas.wedge(page.toPage(camera.position), radius, -(camera.lowAzimuth + camera.fovRadians),
                 -camera.lowAzimuth);
    canvas.fillPath(
        {camera.colour.r, camera.colour.g, camera.colour.b, std::uint8_t(camera.colour.a * 2 / 5)});
    canvas.strokePath(camera.colour, std::min(1.0, 0.1 * radius), false);
  }
}

void drawMarkers(CairoCanvas& canvas, const PlanPicture& picture, const Page& page) {
  for (const PlanMarker& marker : picture.markers)
    drawMarker(canvas, marker.shape, page.toPage(marker.position), marker.size, marker.colour);
  for (const PlanMarker& marker : picture.markers) {
    if (marker.label.empty()) continue;
    const double width = canvas.textWidth(marker.label, kLabel);
    const glm::dvec2 at = page.toPage(marker.position);
    const double aside = marker.size + 4;
    const bool left = at.x + aside + width > page.panelMax.x;
    canvas.haloText(marker.label, at + glm::dvec2(left ? -aside : aside, 0.36 * kLabel), kLabel, kInkColour,
                    left ? Align::right : Align::left);
  }
}

/// A bar of about a fifth of the plan's width, a round number of metres long.
void drawScaleBar(CairoCanvas& canvas, const Page& page) {
  const double metres = 0.2 * (page.panelMax.x - page.panelMin.x) / page.unitsPerMetre;
  const double power = std::pow(10, std::floor(std::log10(metres)));
  const double length = metres >= 5 * power ? 5 * power : metres >= 2 * power ? 2 * power : power;
  const glm::dvec2 at(page.panelMin.x, page.panelMax.y + 16);
  const double width = length * page.unitsPerMetre, height = 7;
  for (int part = 0; part < 4; ++part)
    canvas.fillRectangle(at + glm::dvec2(0.25 * part * width, 0),
                         at + glm::dvec2(0.25 * (part + 1) * width, height),
                         part % 2 == 0 ? kInkColour : Rgba8{255, 255, 255, 255});
  canvas.strokeRectangle(at, at + glm::dvec2(width, height), kInkColour, 1);
  canvas.text("0", at + glm::dvec2(0, height + 17), kLabel, kInkColour);
  canvas.text(fmt::format("{} m", shortNumber(length)), at + glm::dvec2(width, height + 17), kLabel,
              kInkColour, Align::middle);
}

void drawPage(CairoCanvas& canvas, const PlanPicture& picture, const Page& page) {
  canvas.fillRectangle({0, 0}, {kPage, page.height}, {255, 255, 255, 255});
  double y = kPageMargin;
  for (const std::string& line : page.title) {
    canvas.text(line, {kPageMargin, y + 0.8 * kPageTitle}, kPageTitle, kInkColour, Align::left, true);
    y += 1.25 * kPageTitle;
  }
  for (const std::string& line : page.subtitle) {
    canvas.text(line, {kPageMargin, y + kSubtitle}, kSubtitle, {73, 80, 87, 255});
    y += 1.4 * kSubtitle;
  }
  canvas.fillRectangle(page.panelMin, page.panelMax, {246, 247, 249, 255});
  canvas.clipTo(page.panelMin, page.panelMax);
  for (const PlanRaster& raster : picture.rasters)
    canvas.image(raster.image, page.toPage({raster.min.x, raster.max.y}),
                 page.toPage({raster.max.x, raster.min.y}), raster.opacity, raster.smooth);
  drawPolygons(canvas, picture, page);
  drawLines(canvas, picture, page);
  drawCameras(canvas, picture, page);
  drawMarkers(canvas, picture, page);
  drawPolygonLabels(canvas, picture, page);
  canvas.endClip();
  canvas.strokeRectangle(page.panelMin, page.panelMax, {206, 212, 218, 255}, 1);
  drawScaleBar(canvas, page);
  drawLegend(canvas, picture, page.legendAt, kLegendWidth);
}

Status check(const PlanPicture& picture) {
  if (picture.width < 100 || picture.width > 16000)
    return fail(ErrorKind::invalidArgument,
                fmt::format("a picture's width must be 100..16000, not {}", picture.width));
  for (const PlanRaster& raster : picture.rasters)
    if (raster.image.empty() || std::max(raster.image.width, raster.image.height) > kLargestRaster)
      return fail(ErrorKind::invalidArgument,
                  fmt::format("a raster of a plan picture must have 1..{} pixels a side, not {} x {}",
                              kLargestRaster, raster.image.width, raster.image.height));
  bool finite = true;
  forEachPoint(picture,
               [&](const glm::dvec2& p) { finite = finite && std::abs(p.x) < 1e15 && std::abs(p.y) < 1e15; });
  if (!finite) return fail(ErrorKind::invalidArgument, "a plan picture holds a point that is not finite");
  return {};
}

/// A surface that draws nowhere: for measuring text before the page's size is known.
Page pageFor(const PlanPicture& picture) {
  const SurfacePtr nowhere(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, nullptr),
                           &cairo_surface_destroy);
  CairoCanvas ruler(nowhere.get(), 1);
  return layOut(picture, ruler);
}

/// Refers to `picture`.
Drawing drawingOf(const PlanPicture& picture) {
  const Page page = pageFor(picture);
  return {double(picture.width), page.height * picture.width / kPage,
          [&picture, page](cairo_surface_t* surface) {
            CairoCanvas canvas(surface, picture.width / kPage);
            drawPage(canvas, picture, page);
            return canvas.status();
          }};
}

}  // namespace

Status writePlanPicture(const PlanPicture& picture, const std::filesystem::path& path) {
  if (auto possible = checkDrawingPath(path); !possible) return possible;
  if (auto sound = check(picture); !sound) return sound;
  return writeDrawing(drawingOf(picture), path);
}

Result<ColourImage> drawPlanPicture(const PlanPicture& picture) {
  if (auto sound = check(picture); !sound) return tl::unexpected(sound.error());
  return pixelsOf(drawingOf(picture));
}

}  // namespace acentric
