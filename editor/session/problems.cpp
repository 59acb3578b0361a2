#include "editor/session/problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <string_view>

#include "editor/session/engine_texts.h"
#include "engine/base/contract.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

using Problems = std::vector<Problem>;

constexpr std::size_t kMendedSingly = 3;  ///< places where cameras stand badly; more are also offered as one

std::string nameOf(const Region& region) {
  return region.id.slot == kFreeSlot ? trf("Panorama {}", region.id.i)
         : region.id.slot == 0       ? trf("Cell ({}, {})", region.id.i, region.id.j)
                                     : trf("Cell ({}, {}, {})", region.id.i, region.id.j, region.id.slot);
}

ProblemPlace placeOf(const Region& region, PlanLook look) {
  ProblemPlace place{{region.id}, region.polygon.corners.front(), region.polygon.corners.front(), look};
  for (const glm::dvec2& corner : region.polygon.corners)
    place.low = glm::min(place.low, corner), place.high = glm::max(place.high, corner);
  return place;
}

/// Around a point of the plan, as wide as some cells.
ProblemPlace placeAt(const glm::dvec2& point, double cellSize, PlanLook look) {
  return {{}, point - 1.5 * cellSize, point + 1.5 * cellSize, look};
}

/// Of each camera, a region that uses it.
std::vector<int> regionsOfCameras(const Layout& layout) {
  std::vector<int> regions(layout.cameras.size(), -1);
  for (std::size_t r = 0; r < layout.regions.size(); ++r)
    for (const Cover& cover : layout.regions[r].covers)
      for (const Piece& piece : cover.pieces) {
        int& region = regions[std::size_t(piece.camera)];
        if (region < 0) region = int(r);
      }
  return regions;
}

/// Findings that are more than notes, of one centre only the worst.
std::vector<const PlacementFinding*> toMend(const PlacementReport& report) {
  std::vector<const PlacementFinding*> findings;
  std::set<std::pair<double, double>> centres;
  for (const PlacementFinding& finding : report.findings)
    if (finding.severity != Severity::note &&
        (finding.region >= 0 || centres.emplace(finding.place.x, finding.place.y).second))
      findings.push_back(&finding);
  return findings;
}

ProblemFix fitCells() { return {tr("Fit cells"), RunAction{"layout.fit"}}; }

/// `region` uses the cameras of the finding, or is what it is about; null: none is known.
std::optional<ProblemFix> fixOf(const PlacementFinding& finding, const Region* region, bool withoutRoom) {
  if (region != nullptr && region->id.slot == kFreeSlot) {
    if (!finding.push) return std::nullopt;
    return ProblemFix{trf("Move {:.2f} m", glm::length(*finding.push)),
                      MoveFreeApv{region->id.i, *finding.push}};
  }
  if (finding.panorama) return ProblemFix{tr("Add a panorama"), AddPanorama{*finding.panorama}};
  if (region != nullptr && withoutRoom) return ProblemFix{tr("Remove the cell"), RemoveCell{region->id}};
  return fitCells();
}

void addPlacement(Problems& problems, const Inspection& inspection) {
  const Layout& layout = *inspection.layout;
  const auto& findings = inspection.placement.findings;
  const std::vector<const PlacementFinding*> worst = toMend(inspection.placement);
  if (!worst.empty()) {
    const std::vector<int> regionOf = regionsOfCameras(layout);
    std::set<int> withoutRoom;
    for (const PlacementFinding& finding : findings)
      if (finding.flaw == PlacementFlaw::noStandingRoom) withoutRoom.insert(finding.region);
    if (worst.size() > kMendedSingly)
      problems.push_back(
          {std::ranges::max(worst, {}, &PlacementFinding::severity)->severity,
           trf("Cameras or cells stand badly in {} places: fit them all at once", worst.size()),
           {.look = PlanLook::checks},
           fitCells()});
    const std::size_t listed = std::min(worst.size(), kMostOfAKind);
    for (const PlacementFinding* finding : std::span(worst).first(listed)) {
      const int of = finding->region >= 0        ? finding->region
                     : !finding->cameras.empty() ? regionOf[std::size_t(finding->cameras.front())]
                                                 : -1;
      Problem problem{finding->severity, engineText(finding->reason),
                      placeAt(finding->place, layout.spec.cellSize, PlanLook::checks)};
      const Region* region = of >= 0 ? &layout.regions[std::size_t(of)] : nullptr;
      if (region != nullptr) {
        problem.place.cells = {region->id};
        problem.text = finding->region >= 0
                           ? nameOf(*region) + ": " + engineText(finding->reason)
                           : trf("{}, a camera: {}", nameOf(*region), engineText(finding->reason));
      }
      problem.fix = fixOf(*finding, region, of >= 0 && withoutRoom.contains(of));
      problems.push_back(std::move(problem));
    }
  }
}

void addBudget(Problems& problems, const Inspection& inspection, const TriangleBudget& budget) {
  if (budget.trianglesPerRegion == 0) return;
  const Layout& layout = *inspection.layout;
  const auto over = inspection.budgets.over(std::size_t(budget.trianglesPerRegion));
  const Severity severity = budget.simplifies() ? Severity::note : Severity::warning;
  const ProblemFix fix = canSplit(layout.spec.configuration)
                             ? ProblemFix{tr("Split"), RunAction{"budget.split"}}
                             : ProblemFix{tr("Fit cells"), RunAction{"budget.fit"}};
  for (std::size_t i = 0; i < std::min(over.size(), kMostOfAKind); ++i) {
    const Region& region = layout.regions[std::size_t(over[i])];
    ProblemPlace place = placeOf(region, PlanLook::triangles);
    place.section = "Triangle budget";
    problems.push_back({severity,
                        trf("{} has {} triangles of local geometry, the budget is {}{}", nameOf(region),
                            inspection.budgets.triangles[std::size_t(over[i])], budget.trianglesPerRegion,
                            budget.simplifies() ? tr(": it is simplified") : ""),
                        std::move(place), budget.simplifies() ? std::nullopt : std::optional(fix)});
  }
  if (over.size() > kMostOfAKind)
    problems.push_back({severity,
                        trf("{} more cells are above the triangle budget", over.size() - kMostOfAKind),
                        {.look = PlanLook::triangles, .section = "Triangle budget"}});
}

void addLayout(Problems& problems, const Layout& layout) {
  const auto laid =
      std::ranges::count_if(layout.regions, [](const Region& region) { return region.id.slot != kFreeSlot; });
  if (layout.regions.empty() && layout.spec.outline.empty())
    problems.push_back(
        {Severity::error, tr("There is no outline and no cell: nowhere to walk"), {.section = "Layout"}});
  else if (laid == 0 && !layout.spec.outline.empty())
    problems.push_back({Severity::error,
                        tr("There is no cell in the outline: all of them were removed"),
                        {.section = "Layout"}});
}

void addCaptures(Problems& problems, const ProblemFacts& facts) {
  for (const FailedCamera& failed : facts.failed) {
    Problem problem{Severity::error,
                    trf("Camera {} could not be baked: {}", failed.camera, failed.error),
                    {.bakeCameras = true},
                    ProblemFix{tr("Bake"), RunAction{"bake.start"}}};
    problems.push_back(std::move(problem));
  }
  if (facts.captures == nullptr) return;
  const CaptureStatus& captures = *facts.captures;
  const std::size_t missing = captures.cameras.size() - std::size_t(captures.baked);
  const auto stale = std::size_t(std::ranges::count(captures.stale, true));
  const ProblemFix bake{tr("Bake"), RunAction{"bake.start"}};
  if (stale > 0)
    problems.push_back({Severity::warning,
                        trfMany("{} capture is out of date: what is shown was changed since",
                                "{} captures are out of date: what is shown was changed since", stale, stale),
                        {.section = "Bake quality"},
                        bake});
  if (missing > stale)
    problems.push_back({captures.baked > 0 ? Severity::warning : Severity::note,
                        captures.baked == 0 && stale == 0
                            ? tr("Nothing is baked yet")
                            : trfMany("{} capture is not baked yet", "{} captures are not baked yet",
                                      missing - stale, missing - stale),
                        {},
                        bake});
  if (facts.previews > 0)
    problems.push_back({Severity::note,
                        trfMany("{} capture is only a preview or a draft so far",
                                "{} captures are only a preview or a draft so far",
                                std::uint64_t(facts.previews), facts.previews),
                        {},
                        bake});
}

void addScene(Problems& problems, const ProblemFacts& facts) {
  const std::string model = facts.built->project.scene.filename().string();
  if (facts.scene.state == SceneFiles::State::missing)
    problems.push_back({Severity::error,
                        trf("The model {} is not where it was; {}", model,
                            facts.scene.fromCache ? tr("it is shown as it was last imported")
                                                  : tr("nothing of it can be shown")),
                        {.section = "Scene"},
                        ProblemFix{tr("Locate…"), RunAction{"file.locate"}}});
  if (facts.scene.state == SceneFiles::State::changed)
    problems.push_back(
        {Severity::warning,
         trf("{} changed on disk since it was imported",
             facts.scene.changed.size() == 1 ? facts.scene.changed.front().filename().string()
                                             : trf("{} files of the model", facts.scene.changed.size())),
         {.section = "Scene"},
         ProblemFix{tr("Import again"), RunAction{"file.reimport"}}});
  for (const std::string& line : facts.built->scene->report.ignored)
    if (line.starts_with("texture "))
      problems.push_back({Severity::warning, trf("Not shown: {}", line), {.section = "Scene"}});
}

/// A scale that a person has chosen is not asked about.
void addScale(Problems& problems, const ProblemFacts& facts) {
  const auto& doubt = facts.inspection->scale;
  if (!doubt || facts.built->project.import.metresPerUnit > 0) return;
  problems.push_back(
      {Severity::warning,
       trf("Is the scale right? {}. If it is right, enter {:g} metres per unit", engineText(doubt->text),
           facts.built->scene->report.metresPerUnit),
       {.section = "Scene"},
       ProblemFix{trf("Scale to {:g}", doubt->metresPerUnit), ScaleModel{doubt->metresPerUnit}}});
}

void addFiles(Problems& problems, const ProblemFacts& facts) {
  if (facts.lockedBy)
    problems.push_back({Severity::warning,
                        trf("The project is read-only here: it is open at {}", describe(*facts.lockedBy)),
                        {},
                        ProblemFix{tr("Save as…"), RunAction{"file.saveAs"}}});
  if (facts.projectFileChanged)
    problems.push_back({Severity::warning,
                        tr("Another program has changed the project's file"),
                        {},
                        ProblemFix{tr("Reload"), RunAction{"file.reload"}}});
  if (facts.lost) problems.push_back({Severity::error, *facts.lost});
  if (facts.diskShort)
    problems.push_back(
        {Severity::error, trf("The disk has {:.1f} GB free: too little for what the bake is expected to take",
                              double(facts.freeBytes) / 1e9)});
}

}  // namespace

std::vector<Problem> findProblems(const ProblemFacts& facts) {
  Problems problems;
  if (facts.built == nullptr) return problems;
  addFiles(problems, facts);
  addScene(problems, facts);
  addLayout(problems, *facts.built->layout);
  addCaptures(problems, facts);
  if (facts.inspection != nullptr && facts.inspection->layout == facts.built->layout) {
    addScale(problems, facts);
    addPlacement(problems, *facts.inspection);
    addBudget(problems, *facts.inspection, facts.built->project.budget);
  }
  if (facts.foretoldHoles && *facts.foretoldHoles > kToleratedHoles)
    problems.push_back({Severity::warning,
                        trf("Captures will miss {:.1f} % of what is seen from the walkable area: holes",
                            100 * *facts.foretoldHoles),
                        {.look = PlanLook::coverage}});
  std::ranges::stable_sort(problems, std::greater(), &Problem::severity);
  // Nothing else can be judged at a wrong scale.
  std::ranges::stable_partition(
      problems, [](const Problem& p) { return p.fix && std::holds_alternative<ScaleModel>(p.fix->way); });
  return problems;
}

int countProblems(const std::vector<Problem>& problems, Severity severity) {
  return int(std::ranges::count(problems, severity, &Problem::severity));
}

}  // namespace acentric::editor
