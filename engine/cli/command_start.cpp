#include <fmt/format.h>

#include "engine/cli/commands.h"
#include "engine/cli/layout_edits.h"
#include "engine/geometry/conventions.h"
#include "engine/pipeline/start_view.h"
#include "engine/pipeline/walk_ground.h"

namespace acentric::cli {
namespace {

Result<glm::dvec2> placeToStand(const std::string& text, const Layout& layout) {
  const auto place = parsePoint(text);
  if (!place) return place;
  if (layout.regionAt(*place)) return place;
  const glm::dvec2 nearest = nearestStandingCentimetre(layout, *place);
  return fail(ErrorKind::invalidArgument,
              fmt::format("no region holds ({:g}, {:g}) m; the nearest place to stand is {:.2f},{:.2f}",
                          place->x, place->y, nearest.x, nearest.y),
              "--at");
}

}  // namespace

Result<Report> runStart(const StartOptions& options, const Common& common) {
  const auto open = openChosen(options.project, common);
  if (!open) return tl::unexpected(open.error());
  Project project = open->project;
  Spawn& start = project.spawn();
  const bool edits = options.find || !options.at.empty() || options.yawDegrees;
  if (options.find) start = chooseStart(*open->layout, *open->rays);
  if (!options.at.empty()) {
    const auto place = placeToStand(options.at, *open->layout);
    if (!place) return tl::unexpected(place.error());
    start.position = *place;
  }
  if (options.yawDegrees) start.yawRadians = radians(*options.yawDegrees);
  if (edits) {
    start.stored = true;
    if (Status saved = saveEdited(project, options.project); !saved) return tl::unexpected(saved.error());
  }
  Report report;
  report.json = {{"project", options.project.string()},
                 {"storey", project.current().name},
                 {"position", {start.position.x, start.position.y}},
                 {"yawDegrees", degrees(start.yawRadians)},
                 {"stored", start.stored}};
  report.text =
      fmt::format("{}{}: the walk begins at ({:.2f}, {:.2f}) m, looking {:.1f} degrees{}\n",
                  options.project.string(), storeyText(project), start.position.x, start.position.y,
                  degrees(start.yawRadians), start.stored ? "" : " (found: the project keeps no start)");
  return report;
}

}  // namespace acentric::cli
