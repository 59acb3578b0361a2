/// Pictures of what is baked, and how good and fast they are.

#include "engine/cli/command_line.h"

namespace acentric::cli {
namespace {

void addReconstruction(CLI::App& command, std::string& reconstruction) {
  command
      .add_option("--reconstruction", reconstruction,
                  "point, splat or filtered (default: the project's); gl draws splats for filtered")
      ->check(CLI::IsMember({"point", "splat", "filtered"}));
}

void addRender(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(
      app, chosen, "render", "Render one picture",
      "  acentric render kitchen.acentric.json --eye 1,2,1.6 --yaw 90 -o view.png --holes holes.png --stats\n"
      "  acentric render kitchen.acentric.json --renderer truth -o truth.png",
      runRender);
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
  addReconstruction(*c, o.reconstruction);
  c->add_option("--truth-samples", o.truthSamples, "Rays per pixel of --renderer truth: 1, 4, 9 or 16")
      ->check(CLI::IsMember({1, 4, 9, 16}))
      ->capture_default_str();
  c->add_option("-o,--output", o.output, "PNG to write")->required();
  c->add_option("--holes", o.holes, "PNG to write: white where no sample fell");
  c->add_flag("--stats", o.stats, "Print times and counts");
}

void addTour(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "tour", "Write a camera path through all regions",
                    "  acentric tour kitchen.acentric.json -o tour.json --frames 120", runTour);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "where the walk begins");
  c->add_option("-o,--output", o.output, "Path file to write")->required();
  c->add_option("--frames", o.frames, "Number of frames")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
}

void addWalk(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "walk", "Render a camera path to PNG frames and a contact sheet",
                    "  acentric walk kitchen.acentric.json --path tour.json -o frames", runWalk);
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
  addReconstruction(*c, o.reconstruction);
}

void addMeasure(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "measure",
                    "Compare frames along a path with ray-traced truth: PSNR, SSIM, hole share, time",
                    "  acentric measure kitchen.acentric.json --path tour.json --frames 20 --images compare",
                    runMeasure);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "those along the path");
  c->add_option("--path", o.path, "Camera path (JSON; default: a tour of 60 frames)");
  c->add_option("--renderer", o.renderer, "list, scalar, zbuffer or gl")
      ->check(CLI::IsMember({"list", "scalar", "zbuffer", "gl"}))
      ->capture_default_str();
  addReconstruction(*c, o.reconstruction);
  c->add_option("--size", o.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  c->add_option("--fov", o.fovDegrees, "Horizontal field of view in degrees (default: the project's)");
  c->add_option("--frames", o.frames, "Only so many frames, evenly chosen (0 = all)")->capture_default_str();
  c->add_option("--truth-samples", o.truthSamples, "Rays per pixel of the truth: 1, 4, 9 or 16")
      ->check(CLI::IsMember({1, 4, 9, 16}))
      ->capture_default_str();
  c->add_option("--images", o.images, "Folder for pictures: frame, truth, difference, holes");
}

void addBenchView(CLI::App& bench, Chosen& chosen) {
  auto [c, o] = add(bench, chosen, "view", "Time the renderers against each other along a path",
                    "  acentric bench view kitchen.acentric.json --renderers list,zbuffer --json", runBench);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "where the walk begins");
  c->add_option("--renderers", o.renderers, "Which, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember({"list", "scalar", "zbuffer", "gl"}))
      ->capture_default_str();
  addReconstruction(*c, o.reconstruction);
  c->add_option("--path", o.path, "Path file (default: a tour)");
  c->add_option("--size", o.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  c->add_option("--frames", o.frames, "Frames of the tour, or of the path, evenly chosen")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  c->add_option("--repeats", o.repeats, "Times each frame is rendered, after one warm-up")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}

void addBenchBake(CLI::App& bench, Chosen& chosen) {
  auto [c, o] = add(bench, chosen, "bake", "Time what a bake does, against the ray tracer alone",
                    "  acentric bench bake kitchen.acentric.json --json", runBenchBake);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "where the walk begins");
  c->add_option("--cameras", o.bench.cameras, "Of the ring that is baked, at the spawn")
      ->check(CLI::Range(6, 72))
      ->capture_default_str();
  c->add_option("--side", o.bench.side, "Columns, and rows, of each camera")
      ->check(CLI::Range(8, 16384))
      ->capture_default_str();
  c->add_option("--repeats", o.bench.repeats, "Times each set of effects is baked; the fastest counts")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
}

void addBench(CLI::App& app, Chosen& chosen) {
  CLI::App* bench = app.add_subcommand("bench", "Time what the program does on this machine");
  bench->require_subcommand(1);
  bench->fallthrough();
  addBenchView(*bench, chosen);
  addBenchBake(*bench, chosen);
}

}  // namespace

void addWalkCommands(CLI::App& app, Chosen& chosen) {
  addRender(app, chosen);
  addTour(app, chosen);
  addWalk(app, chosen);
  addMeasure(app, chosen);
  addBench(app, chosen);
}

}  // namespace acentric::cli
