#include <fmt/format.h>

#include "engine/cli/commands.h"
#include "engine/pipeline/scene_storeys.h"

namespace acentric::cli {

Report storeysReport(const Storeys& storeys) {
  Report report;
  Json planes = Json::array(), links = Json::array();
  for (std::size_t s = 0; s < storeys.planes.size(); ++s) {
    const WalkPlane& plane = storeys.planes[s];
    planes.push_back({{"number", s},
                      {"height", plane.height},
                      {"squareMetres", plane.outline.area()},
                      {"coveredShare", plane.coveredShare},
                      {"outline", formatOutline(plane.outline)}});
    report.text += describeStorey(storeys, int(s)) + "\n";
  }
  for (const StoreyLink& link : storeys.links) {
    links.push_back({{"lower", link.lower}, {"upper", link.upper}, {"place", {link.place.x, link.place.y}}});
    report.text += fmt::format(
        "  way from {} to {} at ({:.2f}, {:.2f}) m, rising {:.2f} m\n", link.lower, link.upper, link.place.x,
        link.place.y,
        storeys.planes[std::size_t(link.upper)].height - storeys.planes[std::size_t(link.lower)].height);
  }
  if (storeys.ignoredSides) report.text += "  which side a surface shows was ignored\n";
  report.json = {
      {"storeys", std::move(planes)}, {"links", std::move(links)}, {"ignoredSides", storeys.ignoredSides}};
  return report;
}

Result<Report> runStoreys(const StoreysOptions& options, const Common& common) {
  StoreyOptions storeys;
  storeys.walkable.eyeHeight = options.eyeHeight;
  storeys.walkable.stepHeight = options.stepHeight;
  storeys.walkable.gridStep = options.gridStep;
  storeys.walkable.ignoreSides = options.ignoreSides;
  storeys.leastShare = options.leastShare;
  storeys.leastArea = options.leastArea;
  const auto found = findFileStoreys(options.file, importOptions(options.up, options.metresPerUnit), storeys,
                                     common.host, common.progress, common.stop);
  if (!found) return tl::unexpected(found.error());
  return storeysReport(*found);
}

}  // namespace acentric::cli
