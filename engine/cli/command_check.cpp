#include <fmt/format.h>

#include "engine/base/stopwatch.h"
#include "engine/cli/commands.h"
#include "engine/cli/region_report.h"
#include "engine/inspect/lattice_shift.h"
#include "engine/inspect/placement_picture.h"
#include "engine/pipeline/scene_probe.h"

namespace acentric::cli {
namespace {

constexpr std::size_t kMostShown = 40;

Json pointJson(const glm::dvec2& p) { return Json::array({p.x, p.y}); }

Json toJson(const PlacementFinding& finding, const Layout& layout) {
  Json json = {{"flaw", nameOf(finding.flaw)},
               {"severity", nameOf(finding.severity)},
               {"place", pointJson(finding.place)},
               {"reason", finding.reason}};
  if (finding.region >= 0)
    json["region"] = cli::toJson(layout.regions[std::size_t(finding.region)]);
  else
    json["cameras"] = finding.cameras;
  if (finding.push) json["push"] = pointJson(*finding.push);
  if (finding.panorama) json["panorama"] = pointJson(*finding.panorama);
  if (finding.suffices) json["suffices"] = true;
  return json;
}

std::string textOf(const PlacementFinding& finding, const Layout& layout) {
  const std::string what = finding.region >= 0
                               ? placeText(layout.regions[std::size_t(finding.region)])
                               : fmt::format("centre at ({:.2f}, {:.2f}) m, {} cameras", finding.place.x,
                                             finding.place.y, finding.cameras.size());
  std::string text = fmt::format("{:<8} {}: {}", nameOf(finding.severity), what, finding.reason);
  if (finding.push)
    text += fmt::format("; {:.2f} m towards {:.0f} degrees clears it", glm::length(*finding.push),
                        degrees(wrapAngle(std::atan2(finding.push->y, finding.push->x))));
  if (finding.panorama)
    text += fmt::format("; a panorama at ({:.2f}, {:.2f}) m would help", finding.panorama->x,
                        finding.panorama->y);
  if (finding.suffices) text += "; it shows what its cells need all the same";
  return text + "\n";
}

std::string countsText(const PlacementReport& report) {
  return fmt::format("{} errors, {} warnings, {} notes", report.count(Severity::error),
                     report.count(Severity::warning), report.count(Severity::note));
}

Json countsJson(const PlacementReport& report) {
  return {{"errors", report.count(Severity::error)},
          {"warnings", report.count(Severity::warning)},
          {"notes", report.count(Severity::note)}};
}

/// The origin that leaves the cameras freest, if a check of it finds fewer errors, or as many and fewer
/// warnings.
Status suggestOrigin(const OpenProject& open, const PlacementReport& now, const PlacementRules& rules,
                     TaskRunner& runner, const Common& common, Report& report) {
  const SurfaceProbe probe = probeFor(*open.rays);
  ShiftOptions options;
  options.crowding.cameraRoom = rules.cameraRoom;
  options.crowding.floorTolerance = rules.floorTolerance;
  options.crowding.trustSides = !now.ignoredSides;
  const LatticeShift shift = findFreestOrigin(open.layout->spec, options, probe, common.stop);
  if (shift.origin == open.layout->spec.latticeOrigin) return {};
  LayoutSpec spec = open.layout->spec;
  spec.latticeOrigin = shift.origin;
  const auto layout = buildLayout(spec);
  if (!layout) return tl::unexpected(layout.error());
  const auto after = checkPlacement(*layout, open.scene->bounds, rules, probe, runner, common.stop);
  if (!after) return tl::unexpected(after.error());
  const auto badness = [](const PlacementReport& r) {
    return std::pair(r.count(Severity::error), r.count(Severity::warning));
  };
  if (badness(*after) >= badness(now)) return {};
  report.json["suggestedOrigin"] = {{"origin", pointJson(shift.origin)}, {"after", countsJson(*after)}};
  report.text += fmt::format("with the lattice's origin at ({:.2f}, {:.2f}) m: {}\n", shift.origin.x,
                             shift.origin.y, countsText(*after));
  return {};
}

}  // namespace

Result<Report> runCheck(const CheckOptions& options, const Common& common) {
  const auto open = openChosen(options.project, common);
  if (!open) return tl::unexpected(open.error());
  const auto runner = common.runner();
  PlacementRules rules;
  rules.cameraRoom = options.cameraRoom;
  rules.mostPush = options.mostPush;
  if (common.progress) common.progress({0, 0, "checking the placement"});
  const Stopwatch watch;
  const auto found =
      checkPlacement(*open->layout, open->scene->bounds, rules, probeFor(*open->rays), *runner, common.stop);
  if (!found) return tl::unexpected(found.error());
  const double seconds = watch.seconds();

  Report report;
  Json findings = Json::array();
  for (const PlacementFinding& finding : found->findings) findings.push_back(toJson(finding, *open->layout));
  report.json = {{"project", options.project.string()}, {"centres", found->centres},
                 {"regions", found->regions},           {"seconds", seconds},
                 {"counts", countsJson(*found)},        {"ignoredSides", found->ignoredSides},
                 {"findings", std::move(findings)}};
  report.text = fmt::format("{} centres of projection and {} regions: {} ({:.2f} s)\n", found->centres,
                            found->regions, countsText(*found), seconds);
  if (found->ignoredSides)
    report.text +=
        "nearly all centres seem to be inside a solid: either the walls show their backs to the room, or the "
        "layout lies in the ground; which side a surface shows was ignored\n";
  const std::size_t shown =
      options.all ? found->findings.size() : std::min(found->findings.size(), kMostShown);
  for (std::size_t f = 0; f < shown; ++f) report.text += textOf(found->findings[f], *open->layout);
  if (shown < found->findings.size())
    report.text += fmt::format("and {} more; --all or --json lists them\n", found->findings.size() - shown);
  if (found->count(Severity::error) + found->count(Severity::warning) > 0)
    if (Status suggested = suggestOrigin(*open, *found, rules, *runner, common, report); !suggested)
      return tl::unexpected(suggested.error());
  if (!options.output.empty()) {
    if (Status written = writePlanPicture(pictureOf(*open->layout, *found, open->scene->name + ": placement"),
                                          options.output);
        !written)
      return tl::unexpected(written.error());
    report.json["picture"] = options.output.string();
    report.text += fmt::format("wrote {}\n", options.output.string());
  }
  return report;
}

}  // namespace acentric::cli
