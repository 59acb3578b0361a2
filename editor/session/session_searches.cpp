/// Session's searches: work in the background that ends in an edit, which can be undone like any other.

#include <fmt/format.h>

#include "editor/session/engine_texts.h"
#include "editor/session/session.h"
#include "engine/inspect/fit.h"
#include "engine/inspect/lattice_fit.h"
#include "engine/inspect/refine.h"
#include "engine/pipeline/scene_probe.h"
#include "engine/pipeline/stair_storeys.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {

void Session::findStoreys() {
  if (!built_ || searching_.running() || walkRefuses(tr("Looking for storeys"))) return;
  searching_.restart(tr("Looking for storeys"), [this, open = built_](const Job::Context& context) {
    context.progress()({0, 0, trLater("finding the storeys")});
    Project project = open->project;
    Result<int> added = 0;
    StoreyOptions searching;
    searching.walkable.eyeHeight = project.layout().eyeHeight;
    if (const auto found = findSceneStoreys(*open->rays, searching))
      added = addStoreys(project, *open, found->planes, found->ignoredSides, context.stop());
    else
      added = tl::unexpected(found.error());
    context.post([this, added, found = std::move(project.storeys)] {
      if (!added) return messages_.addFailure(tr("Looking for storeys"), added.error());
      if (*added == 0)
        return messages_.add(MessageLevel::info, tr("The scene has no storey that the project lacks"));
      // What was edited meanwhile stays.
      Edit edit{this->project(), trfMany("Add a storey", "Add {} storeys", std::uint64_t(*added), *added)};
      edit.project.storeys.insert(edit.project.storeys.end(), found.end() - *added, found.end());
      if (apply(std::move(edit)))
        messages_.add(MessageLevel::good, trfMany("Found {} more storey", "Found {} more storeys",
                                                  std::uint64_t(*added), *added));
    });
  });
}

void Session::findStairs() {
  if (!built_ || searching_.running() || walkRefuses(tr("Looking for stairs"))) return;
  searching_.restart(tr("Looking for stairs"), [this, open = built_](const Job::Context& context) {
    context.progress()({0, 0, trLater("finding the stairs")});
    Project project = open->project;
    const std::size_t storeys = project.storeys.size(), paths = project.paths.size();
    StoreyOptions searching;
    searching.walkable.eyeHeight = project.layout().eyeHeight;
    Result<AddedStairs> added = AddedStairs{};
    if (const auto found = findSceneStoreys(*open->rays, searching))
      added = addStairs(project, *open->rays, *found, {searching.walkable, {}}, context.progress(),
                        context.stop());
    else
      added = tl::unexpected(found.error());
    context.post([this, added, storeys, paths, found = std::move(project)] {
      if (!added) return messages_.addFailure(tr("Looking for stairs"), added.error());
      for (const std::string& left : added->leftOut)
        messages_.add(MessageLevel::info, trf("No cells on the stairs {}", left));
      if (added->pieces == 0)
        return messages_.add(MessageLevel::info,
                             tr("No stairs or ramps join storeys of the project that have no cells yet"));
      if (this->project().storeys.size() != storeys)
        return messages_.add(MessageLevel::warning,
                             tr("Looking for stairs: the storeys were changed meanwhile; try again"));
      // What was edited meanwhile stays.
      Edit edit{this->project(),
                trfMany("Add stairs", "Add {} stairs", std::uint64_t(added->ways), added->ways)};
      edit.project.storeys.insert(edit.project.storeys.end(), found.storeys.begin() + std::ptrdiff_t(storeys),
                                  found.storeys.end());
      if (edit.project.paths.size() == paths)
        edit.project.paths.insert(edit.project.paths.end(), found.paths.begin() + std::ptrdiff_t(paths),
                                  found.paths.end());
      if (apply(std::move(edit)))
        messages_.add(MessageLevel::good,
                      trf("Found {} stairs and ramps, in {} pieces", added->ways, added->pieces));
    });
  });
}

void Session::outlineFromScene() {
  if (!built_ || searching_.running() || walkRefuses(tr("Finding the walkable area"))) return;
  searching_.restart(tr("Finding the walkable area"), [this, open = built_](const Job::Context& context) {
    context.progress()({0, 0, trLater("finding the walkable area")});
    const LayoutSpec& laid = open->project.layout();
    const auto outline = findOutlineAt(*open->rays, laid.floorHeight, laid.eyeHeight);
    context.post([this, open, outline] {
      if (!outline) return messages_.addFailure(tr("Finding the walkable area"), outline.error());
      if (*outline == open->project.layout().outline)
        return messages_.add(MessageLevel::info, tr("The outline is the scene's walkable area already"));
      LayoutSpec spec = open->project.layout();
      spec.outline = *outline;
      offerLayout(
          *open, spec, tr("Outline from the scene"),
          trf("The walkable area about {:.2f} m is {}", spec.floorHeight, ui::formatArea(outline->area())));
    });
  });
}

void Session::offerLayout(const OpenProject& from, const LayoutSpec& spec, const std::string& label,
                          const std::string& found) {
  if (!hasProject() || project().layout() != from.project.layout())
    return messages_.add(MessageLevel::warning,
                         trf("{}: the layout was changed meanwhile; try again", label));
  Edit edit{project(), label};
  edit.project.layout() = spec;
  Outline& walkable = edit.project.current().walkable;
  if (spec.outline.area() >= walkable.area()) walkable = {};  // all of it is laid out
  if (apply(std::move(edit))) messages_.add(MessageLevel::good, found);
}

void Session::fitToFloor() {
  if (!built_ || searching_.running() || walkRefuses(tr("Fitting the cells"))) return;
  LatticeFitOptions options;
  if (const auto known = inspection()) options.shift.crowding.trustSides = !known->placement.ignoredSides;
  searching_.restart(tr("Fitting the cells"), [this, open = built_, options](const Job::Context& context) {
    context.progress()({0, 0, trLater("placing the cells")});
    const LatticeFit fit = fitLattice(open->project.layout(), options, probeFor(*open->rays), context.stop());
    if (context.stop().stop_requested()) return;
    context.post([this, open, fit, to = buildLayout(fit.spec)] {
      if (!to || fit.spec == open->project.layout())
        return messages_.add(MessageLevel::info,
                             tr("The cells fit the floor already; smaller ones may fit it better"));
      offerLayout(*open, fit.spec, tr("Fit the cells to the floor"),
                  trf("{} cameras instead of {}; {:.1f} % of the floor lies in cells", to->cameras.size(),
                      open->layout->cameras.size(), 100 * fit.served));
    });
  });
}

void Session::fitCells() {
  if (!built_ || searching_.running() || walkRefuses(tr("Fitting the cells"))) return;
  searching_.restart(tr("Fitting the cells"), [this, open = built_,
                                               threads = bakeThreads()](const Job::Context& context) {
    FitOptions options;
    options.mostTriangles = std::size_t(open->project.budget.trianglesPerRegion);
    TaskRunner runner(threads - 1);
    const auto fitted = fitToBudget(open->project.layout(), TriangleTree(open->scene), options, runner,
                                    context.progress(), context.stop());
    context.post([this, open, fitted, most = options.mostTriangles] {
      if (!fitted) return messages_.addFailure(tr("Fitting the cells"), fitted.error());
      if (!fitted->satisfied)
        return messages_.add(
            MessageLevel::warning,
            trf("No cells down to {:g} m keep every region to {} triangles; the best, of {:g} m, reach {}",
                fitted->leastTried, most, fitted->spec.cellSize, fitted->budgets.worst()));
      offerLayout(*open, fitted->spec, tr("Fit cells to the budget"),
                  trf("Cells of {:g} m keep every region to {} triangles (most: {})", fitted->spec.cellSize,
                      most, fitted->budgets.worst()));
    });
  });
}

void Session::splitOverBudget() {
  if (!built_ || searching_.running() || walkRefuses(tr("Splitting cells"))) return;
  searching_.restart(
      tr("Splitting cells"), [this, open = built_, threads = bakeThreads()](const Job::Context& context) {
        RefineOptions options;
        options.mostTriangles = std::size_t(open->project.budget.trianglesPerRegion);
        TaskRunner runner(threads - 1);
        const auto refined = refineToBudget(open->project.layout(), TriangleTree(open->scene), options,
                                            runner, context.progress(), context.stop());
        context.post([this, open, refined] {
          if (!refined) return messages_.addFailure(tr("Splitting cells"), refined.error());
          const std::string left = refined->over.empty()
                                       ? tr("none exceeds the budget now")
                                       : trf("{} still exceed the budget: {}", refined->over.size(),
                                             engineText(describe(refined->over.front().why)));
          if (refined->split == 0)
            return messages_.add(MessageLevel::info, trf("No cell was split: {}", left));
          offerLayout(*open, refined->spec, tr("Split what exceeds the budget"),
                      trf("{} cells were split: {}", refined->split, left));
        });
      });
}

}  // namespace acentric::editor
