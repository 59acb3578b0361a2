/// What a layout will give, before it is baked.

#include "engine/cli/command_line.h"

namespace acentric::cli {
namespace {

void addCheck(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "check",
                    "Find cameras in walls, too near surfaces or off the floor, and regions where nobody can "
                    "stand; say how to clear them",
                    "  acentric check kitchen.acentric.json\n"
                    "  acentric check kitchen.acentric.json --room 0.6 -o placement.svg --json",
                    runCheck);
  addProject(*c, chosen, o.project, "where the walk begins");
  c->add_option("--room", o.cameraRoom, "Metres that a camera needs in all directions")
      ->capture_default_str();
  c->add_option("--push", o.mostPush, "How far a place that clears a camera is looked for, metres")
      ->capture_default_str();
  c->add_flag("--all", o.all, "List every finding");
  c->add_option("-o,--output", o.output, "Picture of the plan to write (.svg or .png)");
}

void addBudget(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "budget", "Count the triangles of each region's local geometry",
                    "  acentric budget kitchen.acentric.json --max 200000 -o budget.svg\n"
                    "  acentric budget kitchen.acentric.json --json",
                    runBudget);
  addProject(*c, chosen, o.project, "where the walk begins");
  c->add_option("--max", o.most, "Triangles that a region may have (default: the project's budget)")
      ->check(CLI::PositiveNumber);
  c->add_option("-o,--output", o.output, "Picture of the plan to write (.svg or .png)");
}

void addFit(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "fit", "Find the largest cells whose regions keep to a number of triangles",
                    "  acentric fit kitchen.acentric.json --max 200000 --rotate -o fit.svg\n"
                    "  acentric fit kitchen.acentric.json --max 200000 --min-cell 0.5 --simplify --apply\n"
                    "  acentric fit kitchen.acentric.json --max 200000 --split --merge -o split.svg",
                    runFit);
  addProject(*c, chosen, o.project, "where the walk begins");
  c->add_option("--max", o.most, "Triangles that a region may have")->required()->check(CLI::PositiveNumber);
  addNumber(*c, "--min-cell", o.leastCell, "Smallest cells to try, or to split into, metres", kLeastCellSize,
            kLargestCellSize);
  auto* split = c->add_flag("--split", o.split,
                            "Keep the project's cells and split those that exceed the number (e and g only)");
  c->add_flag("--merge", o.merge, "With --split, undo splits whose whole keeps to the number")->needs(split);
  c->add_flag("--rotate", o.rotate, "Try turned lattices as well")->excludes(split);
  c->add_flag("--shift", o.shift, "Try shifted lattices as well")->excludes(split);
  c->add_flag(
      "--simplify", o.simplify,
      "Simplify the regions that exceed the number where no cells (then the project's are kept) or no "
      "splits prevent it");
  addNumber(*c, "--max-error", o.maxError, "Metres that simplified surfaces may lie from the scene's", 1e-6,
            10.0);
  c->add_flag("--apply", o.apply, "Write the cells found, or the simplification, to the project file");
  c->add_option("-o,--output", o.output, "Picture of the plan to write (.svg or .png)");
}

void addCoverage(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(
      app, chosen, "coverage",
      "Show how densely the cameras sample the plan and the surfaces, and which surfaces would be holes",
      "  acentric coverage kitchen.acentric.json --plan -o plan.svg\n"
      "  acentric coverage kitchen.acentric.json --surfaces --points 50000 -o surfaces.png --csv points.csv\n"
      "  acentric coverage kitchen.acentric.json --pruning\n"
      "  acentric coverage kitchen.acentric.json --path tour.json --correlate --json",
      runCoverage);
  addProject(*c, chosen, o.project, "where the walk begins");
  c->add_flag("--plan", o.plan, "Count the cameras that hold each point of the plan");
  c->add_flag("--surfaces", o.surfaces, "Judge points on the scene's surfaces (default)");
  c->add_flag("--pruning", o.pruning,
              "Tell what pruning loses of what random eyes see, and how many test eyes that takes");
  c->add_flag("--correlate", o.correlate,
              "Compare predicted holes with those of rendered frames, eye by eye (needs a bake)");
  addNumber(*c, "--points", o.points, "Points on the surfaces", 1, 10000000);
  addNumber(*c, "--eyes", o.eyesPerRegion, "Places to stand that are tried in each region", 1, 1000);
  addNumber(*c, "--grid", o.grid, "Points of the plan along its longer side", 1, 8192);
  addNumber(*c, "--reach", o.reach, "In the plan, only cameras within so many metres (0 = any distance)", 0.0,
            1e9);
  c->add_option("--path", o.path, "Camera path (JSON; default: random eyes)");
  c->add_option(
       "--frames", o.frames,
       "Frames of the path that are compared, evenly chosen (0 = all); without a path: random eyes, each "
       "of which looks all round in six frames")
      ->capture_default_str();
  c->add_option("--size", o.size,
                "WIDTHxHEIGHT of the display (960x540), or of compared frames (640x360; "
                "320x180 without a path)");
  addChoice(*c, "--renderer", o.renderer, "Renderer of compared frames", rendererNames());
  c->add_option("--csv", o.csv, "File for every point's (or cell's, or frame's) figures");
  c->add_option("-o,--output", o.output, "Picture to write (.svg or .png)");
}

void addEstimate(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "estimate",
                    "Tell what a bake will take (samples, bytes, minutes) by baking a little of it",
                    "  acentric estimate kitchen.acentric.json --threads 2\n"
                    "  acentric estimate kitchen.acentric.json --effort 4 -o estimate.svg --json",
                    runEstimate);
  addProject(*c, chosen, o.project, "all of them");
  addNumber(*c, "--effort", o.effort,
            "How much more or less to probe than usual: four times halves the error", 0.0, 1000.0);
  c->add_option("-o,--output", o.output, "Picture of the plan to write (.svg or .png)");
}

}  // namespace

void addInspectionCommands(CLI::App& app, Chosen& chosen) {
  addCheck(app, chosen);
  addBudget(app, chosen);
  addFit(app, chosen);
  addCoverage(app, chosen);
  addEstimate(app, chosen);
}

}  // namespace acentric::cli
