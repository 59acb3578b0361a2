/// Projects: made, changed, baked, checked.

#include <fmt/format.h>

#include "engine/cli/command_line.h"

namespace acentric::cli {
namespace {

CLI::Option* addLight(CLI::App& command, std::string& light) {
  return command
      .add_option(
          "--light", light,
          "Where light comes from: in-textures (photographs and scans, shown as they are), computed, or "
          "guess, which is said")
      ->check(CLI::IsMember({"guess", "in-textures", "computed"}));
}

void addNew(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "new", "Import a scene and lay a first tessellation over its walkable floor",
                    "  acentric new kitchen.glb -o kitchen.acentric.json\n"
                    "  acentric new street.gltf -o street.acentric.json --config e --cell 3 --outline "
                    "\"0,0;12,0;12,8;0,8\"",
                    runNew);
  c->add_option("scene", o.scene, "Model file: glTF, GLB, OBJ, PLY, STL, FBX, DAE, ...")->required();
  c->add_option("-o,--output", o.output, "Project file to write (*.acentric.json)")->required();
  c->add_option(
       "--config", o.configuration,
       "Configuration a to g, of which the paper recommends b, e and g; auto: b, or e where only a part "
       "of the ground is laid out")
      ->capture_default_str();
  c->add_option("--cell", o.cellSize,
                "Edge length of the polygons in metres (default: from the walkable area)")
      ->check(CLI::Range(kLeastCellSize, kLargestCellSize));
  c->add_option("--eye-height", o.eyeHeight, "Metres above the floor")->capture_default_str();
  c->add_option("--outline", o.outline, "auto, or corners x,y;x,y;... in metres (loops separated by /)")
      ->capture_default_str();
  addNumber(*c, "--max-cameras", o.mostCameras,
            "Lay out only as much of the ground as so many cameras serve, where an outline is found (0 = no "
            "limit)",
            0, kMostFirstCameras);
  addNumber(*c, "--bake-minutes", o.bakeMinutes,
            "Likewise, as much as this machine is predicted to bake in so many minutes; a room is laid out "
            "as a whole (0 = no limit)",
            0.0, kMostBakeMinutes);
  c->add_option("--around", o.around,
                "Where that part begins: x,y in metres (default: where most floor is enclosed)");
  c->add_option("--samples-per-degree", o.samplesPerDegree,
                fmt::format("Resolution of the captures (default {})", BakeSettings{}.samplesPerDegree))
      ->check(CLI::Range(0.5, 64.0));
  c->add_option("--metres-per-unit", o.metresPerUnit, "Scale of the model (default: guessed, and said)");
  addChoice(*c, "--up", o.up, "Up axis of the model: guess, y or z", {"guess", "y", "z"});
  addLight(*c, o.light)->capture_default_str();
  c->add_option("--storey", o.storey,
                "Which storey: its number, its height with the unit (3.2m), all, or list to see them "
                "(default: the one with most floor)");
  c->add_flag("--stairs", o.stairs, "With --storey all: cells on the stairs and ramps between them too");
  c->add_flag("--ignore-sides", o.ignoreSides,
              "Find floor whichever way surfaces face: for rooms and levels whose walls face outwards");
  c->add_flag("!--no-estimate", o.estimate,
              "Do not estimate what the bake will take, which takes seconds; --max-cameras alone limits it");
  c->add_flag("--force", o.force, "Replace an existing project file");
  c->add_flag(
      "--link", o.link,
      "Of a model outside the project's folder: make a link to it there, instead of bringing its files");
}

void addCollect(CLI::App& app, Chosen& chosen) {
  auto [c, o] =
      add(app, chosen, "collect",
          "Bring a project's model and the files it names into the project's folder, so that the "
          "folder can be moved and shared",
          "  acentric collect kitchen.acentric.json\n  acentric collect kitchen.acentric.json --link",
          runCollect);
  c->add_option("project", o.project, "Project file")->required();
  c->add_flag("--link", o.link, "Make a link to a model that lies elsewhere, instead of bringing its files");
}

void addModel(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "model",
                    "Change how a project's model is read: its scale, with all that was laid out on it, and "
                    "where its light comes from",
                    "  acentric model city.acentric.json --metres-per-unit 0.15\n"
                    "  acentric model scan.acentric.json --light in-textures",
                    runModel);
  c->add_option("project", o.project, "Project file")->required();
  c->add_option("--metres-per-unit", o.metresPerUnit,
                "Scale of the model: outlines, floors, bookmarks and paths stay where they are on it")
      ->check(CLI::Range(1e-9, 1e6));
  addLight(*c, o.light);
}

void addStart(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "start", "Show or set where the walk begins, and where it looks",
                    "  acentric start kitchen.acentric.json\n"
                    "  acentric start kitchen.acentric.json --at 2.5,1 --yaw 90\n"
                    "  acentric start kitchen.acentric.json --find",
                    runStart);
  addProject(*c, chosen, o.project, "where the walk begins");
  auto* const at = c->add_option("--at", o.at, "Place on the plan: x,y in metres");
  auto* const yaw = c->add_option("--yaw", o.yawDegrees, "Degrees, 0 along +x, 90 along +y")
                        ->check(CLI::Range(-360.0, 360.0));
  c->add_flag("--find", o.find, "Where a new project would begin: a place with room and the richest view")
      ->excludes(at)
      ->excludes(yaw);
}

void addInfo(CLI::App& app, Chosen& chosen) {
  auto [c, o] =
      add(app, chosen, "info", "Show scene, effects and why they are on, layout, local triangles, bake state",
          "  acentric info kitchen.acentric.json\n  acentric info kitchen.acentric.json --regions --json",
          runInfo);
  addProject(*c, chosen, o.project, "where the walk begins");
  c->add_flag("--regions", o.regions, "List every region with its local triangles");
}

void addStoreys(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(
      app, chosen, "storeys",
      "List the walk planes found in a scene, and the stairs and ramps between them; add them to a project",
      "  acentric storeys house.glb\n"
      "  acentric new house.glb -o house.acentric.json --storey all --stairs\n"
      "  acentric storeys house.acentric.json --add 3.2m --rename \"storey 1=attic\" --add-stairs all",
      runStoreys);
  c->add_option("file", o.file, "Project file or model file")->required();
  c->add_option("--eye-height", o.eyeHeight, "Metres above the floor")->capture_default_str();
  c->add_option("--step-height", o.stepHeight, "Metres that a foot climbs at once")->capture_default_str();
  c->add_option("--grid", o.gridStep, "Metres between the places looked at (default: from the scene's size)");
  addNumber(*c, "--least-share", o.leastShare, "Leave out planes of less than this share of the largest one",
            0.0, 1.0);
  c->add_option("--least-area", o.leastArea, "Leave out planes of fewer square metres")
      ->capture_default_str();
  c->add_flag("--ignore-sides", o.ignoreSides,
              "Take surfaces for floor whichever way they face, and no place for the inside of a solid");
  c->add_option("--metres-per-unit", o.metresPerUnit, "Scale of a model (default: guessed)");
  addChoice(*c, "--up", o.up, "Up axis of a model: guess, y or z", {"guess", "y", "z"});
  addLight(*c, o.light)->capture_default_str();
  c->add_option("--add", o.add,
                "Lay cells on a plane found: its number here, its height (3.2m), or all that have none yet");
  c->add_option("--add-stairs", o.addStairs,
                "Lay cells on the stairs and ramps between storeys of the project: all, or of two as "
                "LOWER:UPPER");
  c->add_flag("--remove-stairs", o.removeStairs, "Take all stairs and ramps out of the project");
  c->add_option("--remove", o.remove, "Take a storey out of the project");
  c->add_option("--rename", o.rename, "Give a storey another name: OLD=NEW");
  c->add_option("--begin", o.begin, "The storey where the walk begins");
}

void addLayout(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "layout", "Show a layout, and what it would be with changes; apply them",
                    "  acentric layout kitchen.acentric.json -o layout.svg\n"
                    "  acentric layout kitchen.acentric.json --config e --cell 1.5 --rotate 30 --json\n"
                    "  acentric layout kitchen.acentric.json --remove 1,0,0 --free 2,3,0.8,0,60,ccw --apply",
                    runLayout);
  addProject(*c, chosen, o.project, "where the walk begins");
  c->add_option("--config", o.edits.configuration, "Configuration a to g");
  c->add_option("--cell", o.edits.cellSize, "Edge length of the polygons in metres")
      ->check(CLI::Range(kLeastCellSize, kLargestCellSize));
  c->add_option("--origin", o.edits.origin, "Where the lattice begins: x,y in metres");
  c->add_flag("--fit", o.fit,
              "Move and turn the lattice and leave out cells with hardly any floor, as a new project does");
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
  c->add_option("--density", o.edits.density,
                "Samples per degree of a cell, times the project's (0.25 to 4): i,j,slot=times (may be "
                "repeated); 1 takes it back")
      ->type_name("CELL=TIMES");
  c->add_option("--free", o.edits.free,
                "Place an APV beside the lattice: x,y,dx,dy,fov,ccw|cw (may be repeated); dx = dy = 0 is a "
                "panorama");
  c->add_option("--remove-free", o.edits.removeFree, "Take a free APV away, by its number");
  c->add_option(
       "--panoramas", o.edits.panoramas,
       "Place a panorama in the middle of each ring, or of each region, to fill holes; or none: take all "
       "free panoramas away")
      ->check(CLI::IsMember({"rings", "regions", "none"}));
  c->add_flag("--apply", o.apply, "Write the changes to the project");
  c->add_option("-o,--output", o.output, "Picture of the plan to write (.svg or .png)");
}

void addBake(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "bake", "Bake what is missing; may be stopped and started again at any time",
                    "  acentric bake kitchen.acentric.json --threads 2\n"
                    "  acentric bake kitchen.acentric.json --dry-run\n"
                    "  acentric bake kitchen.acentric.json --along tour.json\n"
                    "  acentric bake kitchen.acentric.json --shard 2/8",
                    runBake);
  addProject(*c, chosen, o.project, "all of them");
  addPresetOption(*c, chosen);
  auto* only = c->add_option("--only", o.only, "Only these cameras (numbers as in --dry-run)");
  only->delimiter(',');
  auto* along = c->add_option(
      "--along", o.along,
      "Only the cameras that a walk along this path needs: one of the project's by its name, or a file");
  along->excludes(only);
  c->add_option("--frames", o.frames, "Of --along: only so many frames, evenly chosen (0 = all)")
      ->needs(along)
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  c->add_option("--shard", o.shard,
                "Bake a share: 2/8 is the second of eight, which may run side by side on machines that share "
                "the project's folder");
  addChoice(*c, "--light", o.light, "Light on local geometry: with the captures, without it, or only it",
            {"with", "without", "only"});
  c->add_flag("--list", o.list, "Tell of each camera: samples by layer, surfaces dropped, bytes");
  c->add_flag("--dry-run", o.dryRun, "List what would be baked");
  c->add_flag("--prune", o.prune, "Delete captures that the project no longer uses");
  addChoice(*c, "--quality", o.quality, "preview, draft or final: the walk shows the best of each camera",
            {"preview", "draft", "final"});
  c->add_flag("--coarse-first", o.coarseFirst,
              "Begin with all of the first view, then a preview of every camera, then the rest");
  c->add_option("--memory", o.memoryMegabytes, "Megabytes that what is baked may take until it is written")
      ->check(CLI::Range(1.0, 1e6));
  c->add_flag("--verify", o.verify, "Read what is baked to its end first, and bake again what is damaged");
  c->add_flag("--take-over", o.takeOver,
              "Bake although another process does, which then ends (one that died is noticed by itself)");
}

void addFarm(CLI::App& app, Chosen& chosen) {
  CLI::App* farm = app.add_subcommand("farm", "Bake on several machines");
  farm->require_subcommand(1);
  auto [c, o] = add(*farm, chosen, "slurm",
                    "Write the scripts of a bake as Slurm jobs, one after all that verifies; submit them",
                    "  acentric farm slurm kitchen.acentric.json --nodes 4 --submit\n"
                    "  acentric farm slurm kitchen.acentric.json --nodes 8 --partition night --threads 16 "
                    "--print",
                    runFarmSlurm);
  c->add_option("project", o.project, "Project file, in a folder that all nodes share")->required();
  addStoreyOption(*c, chosen, "all of them");
  c->add_option("--nodes", o.nodes, "How many nodes bake at once")->check(CLI::Range(1, 100'000));
  c->add_option("--partition", o.partition, "Partition of the cluster (default: the cluster's)");
  addNumber(*c, "--task-seconds", o.taskSeconds, "A task's cameras are worth at least so many seconds", 1.0,
            1e6);
  c->add_option("-o,--out", o.output,
                "Folder of the scripts and logs, shared too (default: beside the project)");
  c->add_option("--program", o.program, "acentric on the nodes (default: where this one is)");
  c->add_flag("--print", o.print, "Print the scripts");
  c->add_flag("--submit", o.submit, "Submit them with sbatch");
}

void addValidate(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "validate",
                    "Check a project, its scene and every capture and simplified region on disk",
                    "  acentric validate kitchen.acentric.json --json", runValidate);
  addProject(*c, chosen, o.project, "all of them");
}

}  // namespace

void addSize(CLI::App& command, std::string& size) {
  command.add_option("--size", size, "WIDTHxHEIGHT in pixels")->capture_default_str();
}

void addTruthSamples(CLI::App& command, int& samples) {
  addChoice(command, "--truth-samples", samples, "Rays per pixel of the truth: 1, 4, 9 or 16", {1, 4, 9, 16});
}

void addProject(CLI::App& command, Chosen& chosen, std::filesystem::path& project, const char* otherwise) {
  command.add_option("project", project, "Project file")->required();
  addStoreyOption(command, chosen, otherwise);
}

void addStoreyOption(CLI::App& command, Chosen& chosen, const char* otherwise) {
  command.add_option(
      "--storey", chosen.storey,
      fmt::format("Storey: its name, its height with the unit (3.2m), or its number (default: {})",
                  otherwise));
}

void addProjectCommands(CLI::App& app, Chosen& chosen) {
  addNew(app, chosen);
  addCollect(app, chosen);
  addModel(app, chosen);
  addStart(app, chosen);
  addInfo(app, chosen);
  addStoreys(app, chosen);
  addLayout(app, chosen);
  addBake(app, chosen);
  addFarm(app, chosen);
  addValidate(app, chosen);
}

}  // namespace acentric::cli
