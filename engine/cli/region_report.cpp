#include "engine/cli/region_report.h"

#include <fmt/format.h>

#include "engine/base/json_text.h"

namespace acentric::cli {

const char* nameOf(RegionKind kind) {
  switch (kind) {
    case RegionKind::ring:
      return "ring";
    case RegionKind::gapTriangle:
      return "gapTriangle";
    case RegionKind::gapSquare:
      return "gapSquare";
    case RegionKind::gapHexagon:
      return "gapHexagon";
  }
  return "ring";
}

Json toJson(const CellId& id) {
  Json address = {id.i, id.j, id.slot};
  if (id.level != 0) address.push_back(id.level);
  return address;
}

Json toJson(const Region& region) {
  const glm::dvec2 centre = region.polygon.centroid();
  return {{"cell", toJson(region.id)}, {"kind", nameOf(region.kind)}, {"centre", {centre.x, centre.y}}};
}

std::string placeText(const Region& region) {
  const glm::dvec2 centre = region.polygon.centroid();
  return fmt::format("{} {:<11} at ({:.2f}, {:.2f}) m", jsonText(toJson(region.id)), nameOf(region.kind),
                     centre.x, centre.y);
}

}  // namespace acentric::cli
