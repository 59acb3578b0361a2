/// Session's searches: work in the background that ends in an edit, which can be undone like any other.

#include <fmt/format.h>

#include "editor/session/session.h"
#include "engine/inspect/fit.h"
#include "engine/inspect/refine.h"
#include "engine/pipeline/stair_storeys.h"

namespace acentric::editor {

void Session::findStoreys() {
  if (!built_ || searching_.running() || walkRefuses("Looking for storeys")) return;
  searching_.restart("Looking for storeys", [this, open = built_](const Job::Context& context) {
    context.progress()({0, 0, "finding the storeys"});
    Project project = open->project;
    Result<int> added = 0;
    StoreyOptions searching;
    searching.walkable.eyeHeight = project.layout().eyeHeight;
    if (const auto found = findSceneStoreys(*open->rays, searching))
      added = addStoreys(project, *open, found->planes, found->ignoredSides, context.stop());
    else
      added = tl::unexpected(found.error());
    context.post([this, added, found = std::move(project.storeys)] {
      if (!added) return messages_.addFailure("Looking for storeys", added.error());
      if (*added == 0)
        return messages_.add(MessageLevel::info, "The scene has no storey that the project lacks");
      // What was edited meanwhile stays.
      Edit edit{this->project(), *added == 1 ? "Add a storey" : "Add " + std::to_string(*added) + " storeys"};
      edit.project.storeys.insert(edit.project.storeys.end(), found.end() - *added, found.end());
      if (apply(std::move(edit)))
        messages_.add(MessageLevel::good,
                      "Found " + std::to_string(*added) + (*added == 1 ? " more storey" : " more storeys"));
    });
  });
}

void Session::findStairs() {
  if (!built_ || searching_.running() || walkRefuses("Looking for stairs")) return;
  searching_.restart("Looking for stairs", [this, open = built_](const Job::Context& context) {
    context.progress()({0, 0, "finding the stairs"});
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
      if (!added) return messages_.addFailure("Looking for stairs", added.error());
      for (const std::string& left : added->leftOut)
        messages_.add(MessageLevel::info, "No cells on the stairs " + left);
      if (added->pieces == 0)
        return messages_.add(MessageLevel::info,
                             "No stairs or ramps join storeys of the project that have no cells yet");
      if (this->project().storeys.size() != storeys)
        return messages_.add(MessageLevel::warning,
                             "Looking for stairs: the storeys were changed meanwhile; try again");
      // What was edited meanwhile stays.
      Edit edit{this->project(), added->ways == 1 ? "Add stairs" : fmt::format("Add {} stairs", added->ways)};
      edit.project.storeys.insert(edit.project.storeys.end(), found.storeys.begin() + std::ptrdiff_t(storeys),
                                  found.storeys.end());
      if (edit.project.paths.size() == paths)
        edit.project.paths.insert(edit.project.paths.end(), found.paths.begin() + std::ptrdiff_t(paths),
                                  found.paths.end());
      if (apply(std::move(edit)))
        messages_.add(MessageLevel::good,
                      fmt::format("Found {} stairs and ramps, in {} pieces", added->ways, added->pieces));
    });
  });
}

void Session::outlineFromScene() {
  if (!built_ || searching_.running() || walkRefuses("Finding the walkable area")) return;
  searching_.restart("Finding the walkable area", [this, open = built_](const Job::Context& context) {
    context.progress()({0, 0, "finding the walkable area"});
    const LayoutSpec& laid = open->project.layout();
    const auto outline = findOutlineAt(*open->rays, laid.floorHeight, laid.eyeHeight);
    context.post([this, open, outline] {
      if (!outline) return messages_.addFailure("Finding the walkable area", outline.error());
      if (*outline == open->project.layout().outline)
        return messages_.add(MessageLevel::info, "The outline is the scene's walkable area already");
      LayoutSpec spec = open->project.layout();
      spec.outline = *outline;
      offerLayout(
          *open, spec, "Outline from the scene",
          fmt::format("The walkable area about {:.2f} m is {:.1f} m²", spec.floorHeight, outline->area()));
    });
  });
}

void Session::offerLayout(const OpenProject& from, const LayoutSpec& spec, const std::string& label,
                          const std::string& found) {
  if (!hasProject() || project().layout() != from.project.layout())
    return messages_.add(MessageLevel::warning, label + ": the layout was changed meanwhile; try again");
  Edit edit{project(), label};
  edit.project.layout() = spec;
  Outline& walkable = edit.project.current().walkable;
  if (spec.outline.area() >= walkable.area()) walkable = {};  // all of it is laid out
  if (apply(std::move(edit))) messages_.add(MessageLevel::good, found);
}

void Session::fitCells() {
  if (!built_ || searching_.running() || walkRefuses("Fitting the cells")) return;
  searching_.restart("Fitting the cells", [this, open = built_,
                                           threads = bakeThreads()](const Job::Context& context) {
    FitOptions options;
    options.mostTriangles = std::size_t(open->project.budget.trianglesPerRegion);
    TaskRunner runner(threads - 1);
    const auto fitted = fitToBudget(open->project.layout(), TriangleTree(open->scene), options, runner,
                                    context.progress(), context.stop());
    context.post([this, open, fitted, most = options.mostTriangles] {
      if (!fitted) return messages_.addFailure("Fitting the cells", fitted.error());
      if (!fitted->satisfied)
        return messages_.add(
            MessageLevel::warning,
            fmt::format(
                "No cells down to {:g} m keep every region to {} triangles; the best, of {:g} m, reach {}",
                fitted->leastTried, most, fitted->spec.cellSize, fitted->budgets.worst()));
      offerLayout(*open, fitted->spec, "Fit cells to the budget",
                  fmt::format("Cells of {:g} m keep every region to {} triangles (most: {})",
                              fitted->spec.cellSize, most, fitted->budgets.worst()));
    });
  });
}

void Session::splitOverBudget() {
  if (!built_ || searching_.running() || walkRefuses("Splitting cells")) return;
  searching_.restart(
      "Splitting cells", [this, open = built_, threads = bakeThreads()](const Job::Context& context) {
        RefineOptions options;
        options.mostTriangles = std::size_t(open->project.budget.trianglesPerRegion);
        TaskRunner runner(threads - 1);
        const auto refined = refineToBudget(open->project.layout(), TriangleTree(open->scene), options,
                                            runner, context.progress(), context.stop());
        context.post([this, open, refined] {
          if (!refined) return messages_.addFailure("Splitting cells", refined.error());
          const std::string left = refined->over.empty()
                                       ? "none exceeds the budget now"
                                       : fmt::format("{} still exceed the budget: {}", refined->over.size(),
                                                     describe(refined->over.front().why));
          if (refined->split == 0) return messages_.add(MessageLevel::info, "No cell was split: " + left);
          offerLayout(*open, refined->spec, "Split what exceeds the budget",
                      fmt::format("{} cells were split: {}", refined->split, left));
        });
      });
}

}  // namespace acentric::editor
