#include "engine/picture/layout_picture.h"

#include <fmt/format.h>

#include <array>

namespace acentric {
namespace {

struct KindStyle {
  RegionKind kind;
  Rgba8 fill;
  const char* name;
};

/// Pale, so that cameras and labels stay readable over them.
constexpr std::array<KindStyle, 4> kKinds{{{RegionKind::ring, {199, 226, 245, 255}, "ring"},
                                           {RegionKind::gapTriangle, {251, 225, 170, 255}, "gap triangle"},
                                           {RegionKind::gapSquare, {188, 228, 209, 255}, "gap square"},
                                           {RegionKind::gapHexagon, {237, 207, 224, 255}, "gap hexagon"}}};

}  // namespace

PlanPicture pictureOf(const Layout& layout, std::string title) {
  PlanPicture picture;
  picture.title = std::move(title);
  picture.subtitle = fmt::format("{}: {}, cells of {:g} m, {} regions, {} cameras",
                                 nameOf(layout.spec.configuration), describe(layout.spec.configuration),
                                 layout.spec.cellSize, layout.regions.size(), layout.cameras.size());
  std::array<bool, kKinds.size()> met{};
  for (const Region& region : layout.regions) {
    PlanPolygon polygon;
    polygon.corners = region.polygon.corners;
    for (std::size_t k = 0; k < kKinds.size(); ++k)
      if (kKinds[k].kind == region.kind) polygon.fill = kKinds[k].fill, met[k] = true;
    polygon.stroke = kFaintColour;
    picture.polygons.push_back(std::move(polygon));
  }
  for (const auto& loop : layout.spec.outline.loops) {
    PlanLine line;
    line.points = loop;
    line.closed = true;
    line.dashed = true;
    line.width = 2.2;
    picture.lines.push_back(std::move(line));
  }
  for (const LayoutCamera& camera : layout.cameras)
    picture.cameras.push_back({camera.position, camera.lowAzimuth, camera.fovRadians});
  for (std::size_t k = 0; k < kKinds.size(); ++k)
    if (met[k]) picture.legend.push_back({kKinds[k].name, kKinds[k].fill, LegendSwatch::area});
  if (!layout.spec.outline.empty())
    picture.legend.push_back({"walkable outline", kInkColour, LegendSwatch::dashedLine});
  if (!picture.cameras.empty())
    picture.legend.push_back({"capture camera", PlanCamera{}.colour, LegendSwatch::camera});
  return picture;
}

}  // namespace acentric
