#include <fmt/format.h>

#include <algorithm>

#include "engine/cli/commands.h"
#include "engine/pipeline/scene_storeys.h"
#include "engine/pipeline/stair_storeys.h"

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
                      {"enclosure", plane.enclosure},
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

namespace {

Status addPlanes(Project& project, const OpenProject& open, const Storeys& found, const std::string& choice,
                 const Common& common) {
  std::vector<WalkPlane> planes = found.planes;
  if (choice != "all") {
    const auto parsed = parseStoreyChoice(choice);
    if (!parsed) return tl::unexpected(parsed.error());
    auto plane = chooseStorey(found, *parsed);
    if (!plane) return tl::unexpected(plane.error());
    if (hasStoreyOn(project, *plane))
      return fail(ErrorKind::invalidArgument,
                  fmt::format("the project has a storey at {:.2f} m there already", plane->height), "--add");
    planes = {std::move(*plane)};
  }
  const auto added = addStoreys(project, open, planes, found.ignoredSides, common.stop);
  if (!added) return tl::unexpected(added.error());
  return {};
}

Status removeStorey(Project& project, const std::string& choice) {
  const auto storey = storeyOf(project, choice);
  if (!storey) return tl::unexpected(storey.error());
  if (project.storeys.size() == 1)
    return fail(ErrorKind::invalidArgument, "a project keeps at least one storey", "--remove");
  acentric::removeStorey(project, *storey);
  return {};
}

Status renameStorey(Project& project, const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos)
    return fail(ErrorKind::invalidArgument, fmt::format("'{}': give OLD=NEW", text), "--rename");
  const auto storey = storeyOf(project, text.substr(0, equals));
  if (!storey) return tl::unexpected(storey.error());
  project.storeys[std::size_t(*storey)].name = text.substr(equals + 1);
  return {};
}

Result<AddedStairs> addStairs(Project& project, const OpenProject& open, const Storeys& found,
                              const std::string& choice, const WalkableOptions& walkable,
                              const Common& common) {
  StairRequest request;
  request.walkable = walkable;
  if (choice != "all") {
    const auto colon = choice.find(':');
    if (colon == std::string::npos)
      return fail(ErrorKind::invalidArgument,
                  fmt::format("'{}': give all, or two storeys as LOWER:UPPER", choice), "--add-stairs");
    const auto lower = storeyOf(project, choice.substr(0, colon));
    if (!lower) return tl::unexpected(lower.error());
    const auto upper = storeyOf(project, choice.substr(colon + 1));
    if (!upper) return tl::unexpected(upper.error());
    request.between = StairEnds{*lower, *upper};
  }
  return acentric::addStairs(project, *open.rays, found, request, common.progress, common.stop);
}

/// What is found in the scene becomes storeys: planes first, so that stairs may join them.
Result<AddedStairs> addFound(Project& project, const OpenProject& open, const StoreysOptions& options,
                             const StoreyOptions& searching, const Common& common) {
  AddedStairs all;
  if (options.add.empty() && options.addStairs.empty()) return all;
  if (common.progress) common.progress({0, 0, "finding the storeys"});
  const auto found = findSceneStoreys(*open.rays, searching);
  if (!found) return tl::unexpected(found.error());
  for (const std::string& choice : options.add)
    if (Status done = addPlanes(project, open, *found, choice, common); !done)
      return tl::unexpected(done.error());
  for (const std::string& choice : options.addStairs) {
    const auto added = addStairs(project, open, *found, choice, searching.walkable, common);
    if (!added) return tl::unexpected(added.error());
    all.ways += added->ways;
    all.pieces += added->pieces;
    all.leftOut.insert(all.leftOut.end(), added->leftOut.begin(), added->leftOut.end());
  }
  return all;
}

Result<Report> editStoreys(const StoreysOptions& options, const StoreyOptions& searching,
                           const Common& common) {
  const auto open = openChosen(options.file, common);
  if (!open) return tl::unexpected(open.error());
  Project project = open->project;
  for (const std::string& text : options.rename)
    if (Status done = renameStorey(project, text); !done) return tl::unexpected(done.error());
  for (const std::string& choice : options.remove)
    if (Status done = removeStorey(project, choice); !done) return tl::unexpected(done.error());
  if (options.removeStairs) acentric::removeStairs(project);
  const auto stairs = addFound(project, *open, options, searching, common);
  if (!stairs) return tl::unexpected(stairs.error());
  if (!options.begin.empty()) {
    const auto storey = storeyOf(project, options.begin);
    if (!storey) return tl::unexpected(storey.error());
    project.storey = *storey;
  }
  if (Status saved = saveProject(project, options.file); !saved) return tl::unexpected(saved.error());
  Report report;
  report.json = {
      {"project", options.file.string()}, {"storey", project.current().name}, {"storeys", Json::array()}};
  for (const Storey& storey : project.storeys) {
    report.json["storeys"].push_back({{"name", storey.name},
                                      {"floorHeight", storey.layout.floorHeight},
                                      {"squareMetres", storey.layout.outline.area()},
                                      {"stairs", isStairs(storey)}});
    const std::string rest = storey.walkable.empty() ? std::string()
                                                     : fmt::format(" laid out, of {:.1f} that can be walked",
                                                                   storey.walkable.area());
    if (!rest.empty()) report.json["storeys"].back()["walkableSquareMetres"] = storey.walkable.area();
    report.text += fmt::format("{} {}: {:.2f} m, {:.1f} m2{}\n", storey == project.current() ? '>' : ' ',
                               storey.name, storey.layout.floorHeight, storey.layout.outline.area(), rest);
  }
  if (!options.addStairs.empty()) {
    report.json["stairs"] = {
        {"ways", stairs->ways}, {"pieces", stairs->pieces}, {"leftOut", stairs->leftOut}};
    report.text += fmt::format("{} stairs and ramps, in {} pieces\n", stairs->ways, stairs->pieces);
    for (const std::string& left : stairs->leftOut) report.text += "  left out: " + left + "\n";
  }
  report.text += fmt::format("wrote {}\n", options.file.string());
  return report;
}

}  // namespace

Result<Report> runStoreys(const StoreysOptions& options, const Common& common) {
  StoreyOptions storeys;
  storeys.walkable.eyeHeight = options.eyeHeight;
  storeys.walkable.stepHeight = options.stepHeight;
  storeys.walkable.gridStep = options.gridStep;
  storeys.walkable.ignoreSides = options.ignoreSides;
  storeys.leastShare = options.leastShare;
  storeys.leastArea = options.leastArea;
  if (options.edits() && options.file.extension() != ".json")
    return fail(ErrorKind::invalidArgument,
                "storeys are added to a project: make one with `acentric new` first", options.file.string());
  if (options.edits()) return editStoreys(options, storeys, common);
  const auto found =
      findFileStoreys(options.file, importOptions(options.up, options.metresPerUnit, options.light), storeys,
                      common.host, common.progress, common.stop);
  if (!found) return tl::unexpected(found.error());
  return storeysReport(*found);
}

}  // namespace acentric::cli
