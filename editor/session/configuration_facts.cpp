#include "editor/session/configuration_facts.h"

#include <algorithm>
#include <cmath>

#include "engine/bake/bake.h"
#include "engine/geometry/conventions.h"
#include "ui/translate.h"

namespace acentric::editor {

const char* adviceOn(Configuration configuration) {
  switch (configuration) {
    case Configuration::a:
      return tr("Wide rings, so few regions to cross: large, open floors");
    case Configuration::b:
      return tr("The fewest cameras for the area: a good first choice for rooms");
    case Configuration::c:
      return tr("A panorama at each corner: hardly any holes, about three times the cameras of b");
    case Configuration::d:
      return tr("Right angles: rectangular rooms and corridors");
    case Configuration::e:
      return tr("Right angles and a panorama at each corner: least holes, most to bake; cells can be split");
    case Configuration::f:
      return tr("The lattice of b with its rings in the triangles: twice the cameras");
    case Configuration::g:
      return tr("Small cells and a panorama at each corner: crowded places; cells can be split");
  }
  return "";
}

Layout patchOf(const LayoutSpec& spec, Configuration configuration) {
  constexpr double kReach = 4.2;  // edge lengths: a whole cell and its neighbours in every lattice
  LayoutSpec patch = spec;
  patch.configuration = configuration;
  patch.forgetCells();
  patch.freeApvs.clear(), patch.density.clear();
  const double reach = kReach * spec.cellSize;
  const glm::dvec2 low = spec.latticeOrigin - reach, high = spec.latticeOrigin + reach;
  patch.outline.loops = {{low, {high.x, low.y}, high, {low.x, high.y}}};
  return buildLayout(patch).value_or(Layout{});
}

ConfigurationFacts factsOf(const Layout& patch, const Bounds& scene, const BakeSettings& bake) {
  ConfigurationFacts facts;
  const auto middle = [&](int i, int j) { return cellPolygon(patch.spec, {i, j, 0}).centroid(); };
  const double area = std::abs(cross(middle(1, 0) - middle(0, 0), middle(0, 1) - middle(0, 0)));
  for (const Region& region : patch.regions)
    if (region.id.i == 0 && region.id.j == 0) facts.regions += 1 / area;
  for (const LayoutCamera& camera : patch.cameras) {
    if (camera.id.i != 0 || camera.id.j != 0) continue;
    const ColumnCamera columns = columnCameraFor(camera, patch, scene, bake);
    facts.cameras += 1 / area;
    facts.pixels += double(columns.columns) * columns.rows / area;
  }
  return facts;
}

std::optional<double> bytesPerPixel(const Layout& layout, const std::vector<bool>& baked,
                                    const std::vector<std::uint64_t>& bytes, const Bounds& scene,
                                    const BakeSettings& bake) {
  double pixels = 0, all = 0;
  for (std::size_t c = 0; c < layout.cameras.size() && c < baked.size() && c < bytes.size(); ++c) {
    if (!baked[c]) continue;
    const ColumnCamera columns = columnCameraFor(layout.cameras[c], layout, scene, bake);
    pixels += double(columns.columns) * columns.rows;
    all += double(bytes[c]);
  }
  return pixels > 0 ? std::optional(all / pixels) : std::nullopt;
}

std::optional<LaidCounts> laidCounts(const LayoutSpec& spec, Configuration configuration,
                                     const ConfigurationFacts& facts, double most) {
  if (facts.regions * spec.outline.area() > most) return std::nullopt;
  LayoutSpec laid = spec;
  if (laid.configuration != configuration) {
    laid.configuration = configuration;
    laid.forgetCells();
  }
  const auto layout = buildLayout(laid);
  if (!layout) return std::nullopt;
  return LaidCounts{layout->regions.size(), layout->cameras.size()};
}

}  // namespace acentric::editor
