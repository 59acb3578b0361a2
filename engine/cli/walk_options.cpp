/// Pictures of what is baked, and how good and fast they are.

#include <fmt/format.h>

#include "engine/cli/command_line.h"
#include "engine/cli/frame_pictures.h"

namespace acentric::cli {
namespace {

std::vector<std::string> renderers(bool truthToo) {
  std::vector<std::string> names = rendererNames();
  if (truthToo) names.emplace_back("truth");
  return names;
}
void addRenderer(CLI::App& command, std::string& renderer, bool truthToo) {
  const std::vector<std::string> names = renderers(truthToo);
  command
      .add_option("--renderer", renderer, fmt::format("{} (default: the project's)", fmt::join(names, ", ")))
      ->check(CLI::IsMember(names));
}

void addLook(CLI::App& command, Look& look) {
  command
      .add_option("--reconstruction", look.reconstruction, "point, splat or patches (default: the project's)")
      ->check(CLI::IsMember({"point", "splat", "patches"}));
}

void addGain(CLI::App& command, int& gain) {
  addNumber(command, "--gain", gain, "Factor by which differences are amplified", 1, 255);
}

void addMemory(CLI::App& command, Chosen& chosen) {
  command
      .add_option(
          "--memory", chosen.walkMegabytes,
          "Megabytes for captures in memory; a frame that needs more takes more (default: half of the "
          "machine's)")
      ->check(CLI::Range(1.0, 1e9));
}

void addView(CLI::App& command, ViewChoice& view) {
  auto* eye =
      command.add_option("--eye", view.eye, "x,y or x,y,z in metres (default: where the walk begins)");
  auto* yaw = command.add_option("--yaw", view.yawDegrees,
                                 "Degrees counter-clockwise from +x (default: as the walk begins)");
  auto* pitch = command.add_option("--pitch", view.pitchDegrees, "Degrees upwards")->capture_default_str();
  auto* fov = command.add_option("--fov", view.fovDegrees, "Horizontal field of view in degrees")
                  ->capture_default_str();
  command
      .add_option("--bookmark", view.bookmark,
                  "The view of one of the project's bookmarks (`info` lists them)")
      ->excludes(eye)
      ->excludes(yaw)
      ->excludes(pitch)
      ->excludes(fov);
  addSize(command, view.size);
}

void addAsk(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "ask",
                    "Ask what painted a pixel, how far it is from the truth, and what would improve it",
                    "  acentric ask kitchen.acentric.json --eye 1,2 --yaw 90 --pixel 480,270\n"
                    "  acentric ask kitchen.acentric.json --bookmark door --no-improvements --json",
                    runAsk);
  addProject(*c, chosen, o.project, "the one at the eye");
  addPresetOption(*c, chosen);
  addMemory(*c, chosen);
  addView(*c, o);
  c->add_option("--pixel", o.pixel, "column,row from the upper left corner (default: the middle)");
  c->add_flag("!--no-improvements", o.improvements, "Leave out what would improve it, which takes longest");
}

void addRender(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(
      app, chosen, "render", "Render one picture",
      "  acentric render kitchen.acentric.json --eye 1,2,1.6 --yaw 90 -o view.png --holes holes.png --stats\n"
      "  acentric render kitchen.acentric.json --bookmark door -o door.png\n"
      "  acentric render kitchen.acentric.json --mode sources -o cameras.png\n"
      "  acentric render kitchen.acentric.json --renderer truth -o truth.png",
      runRender);
  c->add_option("project", o.project, "Project file, or the folder of a bundle, or a walk")
      ->required()
      ->type_name("PROJECT|BUNDLE|WALK");
  addStoreyOption(*c, chosen, "the one at the eye");
  addPresetOption(*c, chosen);
  addMemory(*c, chosen);
  addView(*c, o);
  addRenderer(*c, o.renderer, true);
  addLook(*c, o.look);
  addChoice(*c, "--mode", o.mode,
            "What is shown: the picture, the ray-traced truth, their difference, both side by side, which "
            "camera painted what, or the holes",
            pictureModeNames());
  addTruthSamples(*c, o.truthSamples);
  addGain(*c, o.gain);
  c->add_option("-o,--output", o.output, "PNG to write")->required();
  c->add_option("--holes", o.holes, "PNG to write: white where no sample fell");
  c->add_flag("--stats", o.stats, "Print times and counts");
}

void addTour(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "tour", "Write a camera path through all regions",
                    "  acentric tour kitchen.acentric.json -o tour.json --frames 120", runTour);
  addProject(*c, chosen, o.project, "where the walk begins");
  c->add_option("-o,--output", o.output, "Path file to write")->required();
  addNumber(*c, "--frames", o.frames, "Number of frames", 1, 1000000);
}

void addWalk(CLI::App& app, Chosen& chosen) {
  auto [c, o] =
      add(app, chosen, "walk", "Render a camera path to PNG frames and a contact sheet",
          "  acentric walk kitchen.acentric.json --path tour.json -o frames\n"
          "  acentric walk kitchen.acentric.json --modes picture,truth,difference,sources -o frames",
          runWalk);
  addProject(*c, chosen, o.project, "those along the path");
  addPresetOption(*c, chosen);
  addMemory(*c, chosen);
  c->add_option("--path", o.path,
                "One of the project's paths by its name, or a camera path (JSON) such as `acentric tour` "
                "writes (default: a tour of 60 frames)");
  c->add_option("-o,--output", o.output, "Folder for the frames")->required();
  addSize(*c, o.size);
  c->add_option("--fov", o.fovDegrees, "Horizontal field of view in degrees (default: the project's)");
  addRenderer(*c, o.renderer, true);
  addLook(*c, o.look);
  c->add_option(
       "--modes", o.modes,
       "What is written of each frame, separated by commas: the picture, the ray-traced truth, their "
       "difference, both beside each other, which camera painted what (sources), or the holes")
      ->delimiter(',')
      ->check(CLI::IsMember(pictureModeNames()))
      ->capture_default_str();
  addTruthSamples(*c, o.truthSamples);
  addGain(*c, o.gain);
}

void addMeasure(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "measure",
                    "Compare frames along a path with ray-traced truth: PSNR, SSIM, hole share, time",
                    "  acentric measure kitchen.acentric.json --path tour.json --frames 20 --images compare\n"
                    "  acentric measure kitchen.acentric.json --path tour.json --frames 20 --seams --json",
                    runMeasure);
  addProject(*c, chosen, o.project, "those along the path");
  addPresetOption(*c, chosen);
  addMemory(*c, chosen);
  c->add_option("--path", o.path, "A path of the project, or a file (default: a tour of 60 frames)");
  addRenderer(*c, o.renderer, false);
  addLook(*c, o.look);
  addSize(*c, o.size);
  c->add_option("--fov", o.fovDegrees, "Horizontal field of view in degrees (default: the project's)");
  c->add_option("--frames", o.frames, "Only so many frames, evenly chosen (0 = all)")->capture_default_str();
  addTruthSamples(*c, o.truthSamples);
  c->add_flag(
      "--seams", o.seams,
      "Also how visible the border of local geometry is, and how much the picture changes where the path "
      "goes from region to region");
  addNumber(*c, "--crossings", o.crossings,
            "With --seams: only so many changes of region, evenly chosen (0 = all)", 0, 1000000);
  c->add_flag(
      "--attribution", o.attribution,
      "Also what the error comes from: holes, silhouettes, seams, metals and mirrors, local polygons, sky, "
      "resampling; and what captures of this density could show at best");
  c->add_option("--images", o.images, "Folder for pictures: frame, truth, difference, holes");
}

/// Also what the walk is there to replace.
std::vector<std::string> benchRenderers() {
  std::vector<std::string> names = renderers(true);
  names.insert(names.end(), {"polygons", "gl-polygons"});
  return names;
}

/// What is timed, and along which frames.
void addFrameTiming(CLI::App& command, BenchOptions& options) {
  command.add_option("--renderers", options.renderers, "Which, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(benchRenderers()))
      ->capture_default_str();
  addLook(command, options.look);
  command.add_option("--path", options.path, "A path of the project, or a file (default: a tour)");
  addSize(command, options.size);
  addNumber(command, "--frames", options.frames, "Frames along the tour or the path", 1, 100000);
  addNumber(command, "--repeats", options.repeats, "Times each frame is rendered, after one warm-up", 1,
            1000);
}

void addBenchView(CLI::App& bench, Chosen& chosen) {
  auto [c, o] = add(bench, chosen, "view", "Time the renderers against each other along a path",
                    "  acentric bench view kitchen.acentric.json --renderers list,zbuffer --json\n"
                    "  acentric bench view kitchen.acentric.json --renderers list,truth,polygons,gl-polygons",
                    runBench);
  addProject(*c, chosen, o.project, "where the walk begins");
  addMemory(*c, chosen);
  addFrameTiming(*c, o);
  c->add_flag("--stream", o.stream,
              "Walk the path in real time with the first renderer while captures come and go");
  addNumber(*c, "--speed", o.metresPerSecond, "Of --stream, metres per second", 0.01, 1000.0);
  c->add_flag("--wait-for-captures", o.waitForCaptures,
              "Of --stream with OpenGL: frames wait until the captures that they lack are on the graphics "
              "card");
}

void addBenchGrowth(CLI::App& bench, Chosen& chosen) {
  auto [c, o] =
      add(bench, chosen, "growth",
          "Time frames of several projects, and draw how they grow with the number of triangles",
          "  acentric bench growth small.acentric.json large.acentric.json --chart growth.svg\n"
          "  tools/city-growth FOLDER     # makes cities of 0.1, 1 and 10 million triangles, and bakes them\n"
          "  tools/city-growth --forest FOLDER    # a town in a forest, of 0.1 to 1,000 million",
          runBenchGrowth);
  c->add_option("projects", o.projects, "Project files, baked")->required();
  addFrameTiming(*c, o.view);
  c->add_option("--chart", o.chart, "Chart to draw: .svg or .png");
  c->add_flag(
      "--processor-time", o.processorTime,
      "Tell what all threads together took, for machines that do other work too, in place of what passed "
      "on the clock");
}

void addBenchWalkGrowth(CLI::App& bench, Chosen& chosen) {
  auto [c, o] = add(bench, chosen, "walk-growth",
                    "Walk through layouts of ever more regions while captures come and go, and tell how time "
                    "and memory grow",
                    "  acentric bench walk-growth --chart walk-growth.svg\n"
                    "  acentric bench walk-growth --regions 1000,1000000 --frames 600 --json",
                    runBenchWalkGrowth);
  c->add_option("--regions", o.regions, "How many, separated by commas; of each at least so many")
      ->delimiter(',')
      ->check(CLI::Range(20, 4'000'000))
      ->capture_default_str();
  c->add_option("--config", o.configuration, "Configuration of the lattice, a to g")->capture_default_str();
  addNumber(*c, "--cell", o.cellSize, "Metres, edge of a cell", 0.5, 50.0);
  addNumber(*c, "--samples-per-degree", o.samplesPerDegree, "Of the captures", 0.5, 64.0);
  addNumber(*c, "--regions-per-page", o.regionsPerPage, "Of the index", 1, 10000);
  addMemory(*c, chosen);
  addChoice(*c, "--renderer", o.renderer, "Which", renderers(false));
  addSize(*c, o.size);
  addNumber(*c, "--frames", o.frames,
            "Steps of a thirtieth of a second; a frame that takes longer waits for nothing", 1, 1000000);
  addNumber(*c, "--speed", o.metresPerSecond, "Metres per second", 0.01, 1000.0);
  c->add_option("--chart", o.chart, "Chart to draw: .svg or .png");
}

void addBenchBake(CLI::App& bench, Chosen& chosen) {
  auto [c, o] = add(bench, chosen, "bake", "Time what a bake does, against the ray tracer alone",
                    "  acentric bench bake kitchen.acentric.json --json", runBenchBake);
  addProject(*c, chosen, o.project, "where the walk begins");
  addNumber(*c, "--cameras", o.bench.cameras, "Of the ring that is baked, at the spawn", 6, 72);
  addNumber(*c, "--side", o.bench.side, "Columns, and rows, of each camera", 8, 16384);
  addNumber(*c, "--repeats", o.bench.repeats, "Times each set of effects is baked; the fastest counts", 1,
            100);
}

void addBenchHoles(CLI::App& bench, Chosen& chosen) {
  auto [c, o] =
      add(bench, chosen, "holes",
          "Compare what one panorama, a ring, both, and layered captures leave open on a short walk",
          "  acentric bench holes kitchen.acentric.json -o holes\n"
          "  acentric bench holes kitchen.acentric.json --at 1,2 --yaw 90 --frames 9 --json",
          runBenchHoles);
  addProject(*c, chosen, o.project, "where the walk begins");
  c->add_option("--at", o.place, "x,y of a ring, or near one, in metres (default: where the walk begins)");
  c->add_option("--yaw", o.yawDegrees, "Degrees counter-clockwise from +x (default: as the walk begins)");
  addSize(*c, o.size);
  c->add_option("--fov", o.fovDegrees, "Horizontal field of view in degrees (default: the project's)");
  addNumber(*c, "--frames", o.frames, "Frames from the ring's centre to its left", 1, 1000);
  addTruthSamples(*c, o.truthSamples);
  c->add_option("-o,--output", o.output,
                "Folder for the table (holes.txt, holes.json) and the picture (holes.png)");
}

void addBench(CLI::App& app, Chosen& chosen) {
  CLI::App* bench = app.add_subcommand("bench", "Time what the program does on this machine");
  bench->require_subcommand(1);
  bench->fallthrough();
  addBenchView(*bench, chosen);
  addBenchBake(*bench, chosen);
  addBenchGrowth(*bench, chosen);
  addBenchWalkGrowth(*bench, chosen);
  addBenchHoles(*bench, chosen);
}

}  // namespace

void addWalkCommands(CLI::App& app, Chosen& chosen) {
  addRender(app, chosen);
  addAsk(app, chosen);
  addTour(app, chosen);
  addWalk(app, chosen);
  addMeasure(app, chosen);
  addBench(app, chosen);
}

}  // namespace acentric::cli
