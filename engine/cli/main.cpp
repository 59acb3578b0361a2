/// acentric: every action of the editor has a twin here. Parses, runs one command, prints its report.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <functional>

#include "engine/cli/commands.h"
#include "engine/cli/terminal.h"

namespace {

using namespace acentric;
using namespace acentric::cli;

constexpr int kFailed = 1, kUsage = 2;

struct Chosen {
  std::function<Result<Report>(const Common&)> run;
  std::string storey;
};

/// Adds a subcommand whose options are `options` and whose action is `run`.
template <class Options, class Run>
CLI::App* add(CLI::App& app, Chosen& chosen, const char* name, const char* description, const char* examples,
              Options& options, Run run) {
  CLI::App* command = app.add_subcommand(name, description);
  command->footer(std::string("Examples:\n") + examples);
  command->callback([&chosen, &options, run] {
    chosen.run = [&options, run](const Common& common) { return run(options, common); };
  });
  return command;
}

void addStoreyOption(CLI::App& command, Chosen& chosen, const char* otherwise) {
  command.add_option(
      "--storey", chosen.storey,
      fmt::format("Storey: its name, its height with the unit (3.2m), or its number (default: {})",
                  otherwise));
}

void addNew(CLI::App& app, Chosen& chosen, NewOptions& o) {
  CLI::App* c = add(app, chosen, "new", "Import a scene and lay a first tessellation over its walkable floor",
                    "  acentric new kitchen.glb -o kitchen.acentric.json\n"
                    "  acentric new street.gltf -o street.acentric.json --config e --cell 3 --outline "
                    "\"0,0;12,0;12,8;0,8\"",
                    o, runNew);
  c->add_option("scene", o.scene, "Model file: glTF, GLB, OBJ, PLY, STL, FBX, DAE, ...")->required();
  c->add_option("-o,--output", o.output, "Project file to write (*.acentric.json)")->required();
  c->add_option("--config", o.configuration, "Configuration a to g, of which the paper recommends b, e and g")
      ->capture_default_str();
  c->add_option("--cell", o.cellSize,
                "Edge length of the polygons in metres (default: from the walkable area)")
      ->check(CLI::Range(kLeastCellSize, kLargestCellSize));
  c->add_option("--eye-height", o.eyeHeight, "Metres above the floor")->capture_default_str();
  c->add_option("--outline", o.outline, "auto, or corners x,y;x,y;... in metres (loops separated by /)")
      ->capture_default_str();
  c->add_option("--samples-per-degree", o.samplesPerDegree, "Resolution of the captures (default 8)")
      ->check(CLI::Range(0.5, 64.0));
  c->add_option("--metres-per-unit", o.metresPerUnit, "Scale of the model (default: guessed, and said)");
  c->add_option("--up", o.up, "Up axis of the model: guess, y or z")
      ->check(CLI::IsMember({"guess", "y", "z"}))
      ->capture_default_str();
  c->add_option("--storey", o.storey,
                "Which storey: its number, its height with the unit (3.2m), all, or list to see them "
                "(default: the one with most floor)");
  c->add_flag("--ignore-sides", o.ignoreSides,
              "Find floor whichever way surfaces face: for rooms and levels whose walls face outwards");
  c->add_flag("--force", o.force, "Replace an existing project file");
}

void addStoreys(CLI::App& app, Chosen& chosen, StoreysOptions& o) {
  CLI::App* c = add(
      app, chosen, "storeys",
      "List the walk planes found in a scene, and the stairs and ramps between them; add them to a project",
      "  acentric storeys house.glb\n"
      "  acentric new house.glb -o house.acentric.json --storey all\n"
      "  acentric storeys house.acentric.json --add 3.2m --rename \"storey 1=attic\"",
      o, runStoreys);
  c->add_option("file", o.file, "Project file or model file")->required();
  c->add_option("--eye-height", o.eyeHeight, "Metres above the floor")->capture_default_str();
  c->add_option("--step-height", o.stepHeight, "Metres that a foot climbs at once")->capture_default_str();
  c->add_option("--grid", o.gridStep, "Metres between the places looked at (default: from the scene's size)");
  c->add_option("--least-share", o.leastShare, "Leave out planes of less than this share of the largest one")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  c->add_option("--least-area", o.leastArea, "Leave out planes of fewer square metres")
      ->capture_default_str();
  c->add_flag("--ignore-sides", o.ignoreSides,
              "Take surfaces for floor whichever way they face, and no place for the inside of a solid");
  c->add_option("--metres-per-unit", o.metresPerUnit, "Scale of a model (default: guessed)");
  c->add_option("--up", o.up, "Up axis of a model: guess, y or z")
      ->check(CLI::IsMember({"guess", "y", "z"}))
      ->capture_default_str();
  c->add_option("--add", o.add,
                "Lay cells on a plane found: its number here, its height (3.2m), or all that have none yet");
  c->add_option("--remove", o.remove, "Take a storey out of the project");
  c->add_option("--rename", o.rename, "Give a storey another name: OLD=NEW");
  c->add_option("--begin", o.begin, "The storey where the walk begins");
}

void addCheck(CLI::App& app, Chosen& chosen, CheckOptions& o) {
  CLI::App* c = add(app, chosen, "check",
                    "Find cameras in walls, too near surfaces or off the floor, and regions where nobody can "
                    "stand; say how to clear them",
                    "  acentric check kitchen.acentric.json\n"
                    "  acentric check kitchen.acentric.json --room 0.6 -o placement.svg --json",
                    o, runCheck);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "where the walk begins");
  c->add_option("--room", o.cameraRoom, "Metres that a camera needs in all directions")
      ->capture_default_str();
  c->add_option("--push", o.mostPush, "How far a place that clears a camera is looked for, metres")
      ->capture_default_str();
  c->add_flag("--all", o.all, "List every finding");
  c->add_option("-o,--output", o.output, "Picture of the plan to write (.svg or .png)");
}

void addLayout(CLI::App& app, Chosen& chosen, LayoutOptions& o) {
  CLI::App* c = add(app, chosen, "layout", "Show a layout, and what it would be with changes; apply them",
                    "  acentric layout kitchen.acentric.json -o layout.svg\n"
                    "  acentric layout kitchen.acentric.json --config e --cell 1.5 --rotate 30 --json\n"
                    "  acentric layout kitchen.acentric.json --remove 1,0,0 --free 2,3,0.8,0,60,ccw --apply",
                    o, runLayout);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "where the walk begins");
  c->add_option("--config", o.edits.configuration, "Configuration a to g");
  c->add_option("--cell", o.edits.cellSize, "Edge length of the polygons in metres")
      ->check(CLI::Range(kLeastCellSize, kLargestCellSize));
  c->add_option("--origin", o.edits.origin, "Where the lattice begins: x,y in metres");
  c->add_option("--rotate", o.edits.rotationDegrees, "How far the lattice is turned, degrees");
  c->add_option("--eye-height", o.edits.eyeHeight, "Metres above the floor");
  c->add_option("--near-band", o.edits.nearBand, "Metres around a region that are drawn as polygons");
  c->add_option("--outline", o.outline,
                "auto (find it again at the project's floor), or corners x,y;x,y;... in metres (loops "
                "separated by /)");
  c->add_option("--add", o.edits.add, "Place a cell: i,j,slot or i,j,slot,level (may be repeated)");
  c->add_option("--remove", o.edits.remove, "Take a cell away (may be repeated)");
  c->add_option("--split", o.edits.split, "Split a cell into four (e and g; may be repeated)");
  c->add_option("--join", o.edits.join, "Undo the split of a cell (may be repeated)");
  c->add_option("--free", o.edits.free,
                "Place an APV beside the lattice: x,y,dx,dy,fov,ccw|cw (may be repeated); dx = dy = 0 is a "
                "panorama");
  c->add_option("--remove-free", o.edits.removeFree, "Take a free APV away, by its number");
  c->add_flag("--apply", o.apply, "Write the changes to the project");
  c->add_option("-o,--output", o.output, "Picture of the plan to write (.svg or .png)");
}

void addInfo(CLI::App& app, Chosen& chosen, InfoOptions& o) {
  CLI::App* c =
      add(app, chosen, "info", "Show scene, effects and why they are on, layout, local triangles, bake state",
          "  acentric info kitchen.acentric.json\n  acentric info kitchen.acentric.json --regions --json", o,
          runInfo);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "where the walk begins");
  c->add_flag("--regions", o.regions, "List every region with its local triangles");
}

void addBudget(CLI::App& app, Chosen& chosen, BudgetOptions& o) {
  CLI::App* c = add(app, chosen, "budget", "Count the triangles of each region's local geometry",
                    "  acentric budget kitchen.acentric.json --max 200000 -o budget.svg\n"
                    "  acentric budget kitchen.acentric.json --json",
                    o, runBudget);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "where the walk begins");
  c->add_option("--max", o.most, "Triangles that a region may have (default: the project's budget)")
      ->check(CLI::PositiveNumber);
  c->add_option("-o,--output", o.output, "Picture of the plan to write (.svg or .png)");
}

void addFit(CLI::App& app, Chosen& chosen, FitCommandOptions& o) {
  CLI::App* c = add(app, chosen, "fit", "Find the largest cells whose regions keep to a number of triangles",
                    "  acentric fit kitchen.acentric.json --max 200000 --rotate -o fit.svg\n"
                    "  acentric fit kitchen.acentric.json --max 200000 --min-cell 0.5 --simplify --apply\n"
                    "  acentric fit kitchen.acentric.json --max 200000 --split --merge -o split.svg",
                    o, runFit);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "where the walk begins");
  c->add_option("--max", o.most, "Triangles that a region may have")->required()->check(CLI::PositiveNumber);
  c->add_option("--min-cell", o.leastCell, "Smallest cells to try, or to split into, metres")
      ->check(CLI::Range(kLeastCellSize, kLargestCellSize))
      ->capture_default_str();
  auto* split = c->add_flag("--split", o.split,
                            "Keep the project's cells and split those that exceed the number (e and g only)");
  c->add_flag("--merge", o.merge, "With --split, undo splits whose whole keeps to the number")->needs(split);
  c->add_flag("--rotate", o.rotate, "Try turned lattices as well")->excludes(split);
  c->add_flag("--shift", o.shift, "Try shifted lattices as well")->excludes(split);
  c->add_flag(
      "--simplify", o.simplify,
      "Simplify the regions that exceed the number where no cells (then the project's are kept) or no "
      "splits prevent it");
  c->add_option("--max-error", o.maxError, "Metres that simplified surfaces may lie from the scene's")
      ->check(CLI::Range(1e-6, 10.0))
      ->capture_default_str();
  c->add_flag("--apply", o.apply, "Write the cells found, or the simplification, to the project file");
  c->add_option("-o,--output", o.output, "Picture of the plan to write (.svg or .png)");
}

void addBake(CLI::App& app, Chosen& chosen, BakeOptions& o) {
  CLI::App* c = add(
      app, chosen, "bake", "Bake what is missing; may be stopped and started again at any time",
      "  acentric bake kitchen.acentric.json --threads 2\n  acentric bake kitchen.acentric.json --dry-run", o,
      runBake);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "all of them");
  c->add_option("--only", o.only, "Only these cameras (numbers as in --dry-run)")->delimiter(',');
  c->add_flag("--dry-run", o.dryRun, "List what would be baked");
  c->add_flag("--prune", o.prune, "Delete captures that the project no longer uses");
}

void addRender(CLI::App& app, Chosen& chosen, RenderOptions& o) {
  CLI::App* c = add(
      app, chosen, "render", "Render one picture",
      "  acentric render kitchen.acentric.json --eye 1,2,1.6 --yaw 90 -o view.png --holes holes.png --stats\n"
      "  acentric render kitchen.acentric.json --renderer truth -o truth.png",
      o, runRender);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "the one at the eye");
  c->add_option("--eye", o.eye, "x,y or x,y,z in metres (default: where the walk begins)");
  c->add_option("--yaw", o.yawDegrees, "Degrees counter-clockwise from +x")->capture_default_str();
  c->add_option("--pitch", o.pitchDegrees, "Degrees upwards")->capture_default_str();
  c->add_option("--fov", o.fovDegrees, "Horizontal field of view in degrees")->capture_default_str();
  c->add_option("--size", o.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  c->add_option("--renderer", o.renderer, "list, scalar, zbuffer, gl or truth")
      ->check(CLI::IsMember({"list", "scalar", "zbuffer", "gl", "truth"}))
      ->capture_default_str();
  c->add_option("--truth-samples", o.truthSamples, "Rays per pixel of --renderer truth: 1, 4, 9 or 16")
      ->check(CLI::IsMember({1, 4, 9, 16}))
      ->capture_default_str();
  c->add_option("-o,--output", o.output, "PNG to write")->required();
  c->add_option("--holes", o.holes, "PNG to write: white where no sample fell");
  c->add_flag("--stats", o.stats, "Print times and counts");
}

void addWalk(CLI::App& app, Chosen& chosen, WalkOptions& o) {
  CLI::App* c = add(app, chosen, "walk", "Render a camera path to PNG frames and a contact sheet",
                    "  acentric walk kitchen.acentric.json --path tour.json -o frames", o, runWalk);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "those along the path");
  c->add_option("--path", o.path,
                "Camera path (JSON), such as `acentric tour` writes (default: a tour of 60 frames)");
  c->add_option("-o,--output", o.output, "Folder for the frames")->required();
  c->add_option("--size", o.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  c->add_option("--fov", o.fovDegrees, "Horizontal field of view in degrees (default: the project's)");
  c->add_option("--renderer", o.renderer, "list, scalar, zbuffer, gl or truth")
      ->check(CLI::IsMember({"list", "scalar", "zbuffer", "gl", "truth"}))
      ->capture_default_str();
}

void addTour(CLI::App& app, Chosen& chosen, TourOptions& o) {
  CLI::App* c = add(app, chosen, "tour", "Write a camera path through all regions",
                    "  acentric tour kitchen.acentric.json -o tour.json --frames 120", o, runTour);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "where the walk begins");
  c->add_option("-o,--output", o.output, "Path file to write")->required();
  c->add_option("--frames", o.frames, "Number of frames")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
}

void addMeasure(CLI::App& app, Chosen& chosen, MeasureOptions& o) {
  CLI::App* c = add(app, chosen, "measure",
                    "Compare frames along a path with ray-traced truth: PSNR, SSIM, hole share, time",
                    "  acentric measure kitchen.acentric.json --path tour.json --frames 20 --images compare",
                    o, runMeasure);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "those along the path");
  c->add_option("--path", o.path, "Camera path (JSON; default: a tour of 60 frames)");
  c->add_option("--renderer", o.renderer, "list, scalar, zbuffer or gl")
      ->check(CLI::IsMember({"list", "scalar", "zbuffer", "gl"}))
      ->capture_default_str();
  c->add_option("--size", o.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  c->add_option("--fov", o.fovDegrees, "Horizontal field of view in degrees (default: the project's)");
  c->add_option("--frames", o.frames, "Only so many frames, evenly chosen (0 = all)")->capture_default_str();
  c->add_option("--truth-samples", o.truthSamples, "Rays per pixel of the truth: 1, 4, 9 or 16")
      ->check(CLI::IsMember({1, 4, 9, 16}))
      ->capture_default_str();
  c->add_option("--images", o.images, "Folder for pictures: frame, truth, difference, holes");
}

void addValidate(CLI::App& app, Chosen& chosen, ValidateOptions& o) {
  CLI::App* c = add(app, chosen, "validate",
                    "Check a project, its scene and every capture and simplified region on disk",
                    "  acentric validate kitchen.acentric.json --json", o, runValidate);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "all of them");
}

void addBench(CLI::App& app, Chosen& chosen, BenchOptions& o) {
  CLI::App* c = add(app, chosen, "bench", "Time the renderers against each other on a tour of the project",
                    "  acentric bench kitchen.acentric.json --renderers list,zbuffer --json", o, runBench);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "where the walk begins");
  c->add_option("--renderers", o.renderers, "Which, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember({"list", "scalar", "zbuffer", "gl"}))
      ->capture_default_str();
  c->add_option("--size", o.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  c->add_option("--frames", o.frames, "Frames of the tour")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  c->add_option("--repeats", o.repeats, "Times each frame is rendered, after one warm-up")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}

void addEstimate(CLI::App& app, Chosen& chosen, EstimateCommandOptions& o) {
  CLI::App* c = add(app, chosen, "estimate",
                    "Tell what a bake will take (samples, bytes, minutes) by baking a little of it",
                    "  acentric estimate kitchen.acentric.json --threads 2\n"
                    "  acentric estimate kitchen.acentric.json --seconds 10 -o estimate.svg --json",
                    o, runEstimate);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "all of them");
  c->add_option("--seconds", o.seconds, "Time to spend; more narrows the error")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  c->add_option("-o,--output", o.output, "Picture of the plan to write (.svg or .png)");
}

void addCoverage(CLI::App& app, Chosen& chosen, CoverageOptions& o) {
  CLI::App* c = add(
      app, chosen, "coverage",
      "Show how densely the cameras sample the plan and the surfaces, and which surfaces would be holes",
      "  acentric coverage kitchen.acentric.json --plan -o plan.svg\n"
      "  acentric coverage kitchen.acentric.json --surfaces --points 50000 -o surfaces.png --csv points.csv\n"
      "  acentric coverage kitchen.acentric.json --path tour.json --correlate --json",
      o, runCoverage);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "where the walk begins");
  c->add_flag("--plan", o.plan, "Count the cameras that hold each point of the plan");
  c->add_flag("--surfaces", o.surfaces, "Judge points on the scene's surfaces (default)");
  c->add_flag("--correlate", o.correlate,
              "Along a path, compare predicted holes with those of rendered frames (needs a bake)");
  c->add_option("--points", o.points, "Points on the surfaces")
      ->check(CLI::Range(1, 10000000))
      ->capture_default_str();
  c->add_option("--eyes", o.eyesPerRegion, "Places to stand that are tried in each region")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  c->add_option("--grid", o.grid, "Points of the plan along its longer side")
      ->check(CLI::Range(1, 8192))
      ->capture_default_str();
  c->add_option("--reach", o.reach, "In the plan, only cameras within so many metres (0 = any distance)")
      ->check(CLI::Range(0.0, 1e9))
      ->capture_default_str();
  c->add_option("--path", o.path, "Camera path (JSON; default: a tour)");
  c->add_option("--frames", o.frames, "Frames of the path that are compared, evenly chosen (0 = all)")
      ->capture_default_str();
  c->add_option("--size", o.size, "WIDTHxHEIGHT of the display (960x540), or of compared frames (640x360)");
  c->add_option("--renderer", o.renderer, "Renderer of compared frames: list, scalar, zbuffer or gl")
      ->check(CLI::IsMember({"list", "scalar", "zbuffer", "gl"}))
      ->capture_default_str();
  c->add_option("--csv", o.csv, "File for every point's (or cell's, or frame's) figures");
  c->add_option("-o,--output", o.output, "Picture to write (.svg or .png)");
}

int finish(const Result<Report>& result, bool json) {
  finishProgress();
  if (!result) {
    const Error& error = result.error();
    if (json)
      fmt::print(
          "{}\n",
          Json{{"error",
                {{"kind", acentric::nameOf(error.kind)}, {"message", error.message}, {"where", error.where}}}}
              .dump(2));
    fmt::print(stderr, "acentric: {}\n", error.describe());
    return kFailed;
  }
  if (json)
    fmt::print("{}\n", result->json.dump(2, ' ', false, Json::error_handler_t::replace));
  else
    fmt::print("{}", result->text);
  return result->success ? 0 : kFailed;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Acentric: walkthroughs made of acentric panorama views (APV)\nimport a scene, lay cameras over its "
      "floor, bake, walk"};
  app.require_subcommand(1);
  app.fallthrough();
  app.set_version_flag("--version", ACENTRIC_VERSION);
  app.footer(
      "Examples:\n  acentric new room.glb -o room.acentric.json\n  acentric bake room.acentric.json\n"
      "  acentric render room.acentric.json -o view.png --stats\nEach command has its own --help.");
  Common common;
  bool json = false;
  app.add_flag("--json", json, "Print the report as JSON");
  app.add_option("--threads", common.threads, "Threads to use (default: all processors)")
      ->check(CLI::Range(1, 1024));
  app.add_option("--import-seconds", common.host.timeLimitSeconds, "Time limit of an import")
      ->capture_default_str();

  Chosen chosen;
  NewOptions newOptions;
  StoreysOptions storeys;
  CheckOptions check;
  LayoutOptions layout;
  InfoOptions info;
  BudgetOptions budget;
  FitCommandOptions fit;
  BakeOptions bakeOptions;
  RenderOptions render;
  WalkOptions walk;
  TourOptions tour;
  MeasureOptions measure;
  ValidateOptions validate;
  BenchOptions bench;
  addNew(app, chosen, newOptions);
  addStoreys(app, chosen, storeys);
  addCheck(app, chosen, check);
  addLayout(app, chosen, layout);
  addInfo(app, chosen, info);
  addBudget(app, chosen, budget);
  addFit(app, chosen, fit);
  addBake(app, chosen, bakeOptions);
  addRender(app, chosen, render);
  addWalk(app, chosen, walk);
  addTour(app, chosen, tour);
  addMeasure(app, chosen, measure);
  addValidate(app, chosen, validate);
  addBench(app, chosen, bench);
  CoverageOptions coverage;
  addCoverage(app, chosen, coverage);
  EstimateCommandOptions estimate;
  addEstimate(app, chosen, estimate);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : kUsage;
  }
  common.storey = chosen.storey;
  common.stop = stopOnInterrupt();
  if (!json) common.progress = terminalProgress();
  return finish(chosen.run(common), json);
}
