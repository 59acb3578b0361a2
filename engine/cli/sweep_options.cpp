/// What accuracy costs, and settings chosen by it.

#include "engine/cli/command_line.h"
#include "engine/pipeline/knobs.h"

namespace acentric::cli {
namespace {

/// Which frames settings are compared in, and how.
template <class Options>
void addFrames(CLI::App& command, Options& o, const char* repeats) {
  addSize(command, o.size);
  addNumber(command, "--frames", o.frames, "Frames along the path, evenly chosen", 1, 10000);
  addNumber(command, "--repeats", o.repeats, repeats, 1, 1000);
  addTruthSamples(command, o.truthSamples);
}

void addSweep(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(
      app, chosen, "sweep",
      "Measure what accuracy costs: settings of a project against the same truth, one at a time and combined",
      "  acentric sweep kitchen.acentric.json --path tour.json --knobs reconstruction,splat-limit,renderer\n"
      "  acentric sweep kitchen.acentric.json --knobs samples-per-degree=4/6/8,layers --budget-minutes 60 -o "
      "sweep\n"
      "  acentric sweep kitchen.acentric.json --list-knobs",
      runSweep);
  c->add_option("project", o.project, "Project file; what it lacks is baked into the sweep's folder")
      ->required();
  addStoreyOption(*c, chosen, "where the walk begins");
  c->add_option("--path", o.path, "A path of the project, or a file (default: a tour)");
  c->add_option("--knobs", o.knobs,
                "What is changed, separated by commas, with the values that are tried if they are not to be "
                "the usual ones: layers=1/2 (default: all that --list-knobs names)")
      ->delimiter(',');
  c->add_flag("--list-knobs", o.list, "Name what can be changed");
  addNumber(*c, "--budget-minutes", o.budgetMinutes,
            "Minutes that it may take; what would not fit is skipped, and said to be. A later call goes on",
            0.01, 1e5);
  addFrames(*c, o, "Times that frames and loading are timed");
  addNumber(*c, "--crossings", o.crossings, "Changes of region that flicker is measured at (0 = all)", 0,
            1000000);
  c->add_flag("!--no-search", o.search, "Only one change at a time, no combinations");
  c->add_flag("!--no-numerics", o.numerics,
              "Leave out floats against doubles, exact against naive signs and bits of distances (`acentric "
              "bench numerics`)");
  c->add_flag("--again", o.again, "Forget what was measured into the folder before");
  c->add_option("-o,--output", o.output,
                "Folder for sweep.json, sweep.csv, sweep.html and captures (default: NAME.sweep beside the "
                "project)");
}

void addPropose(CLI::App& app, Chosen& chosen) {
  auto [c, o] =
      add(app, chosen, "propose",
          "Look for a layout and settings that keep to budgets, by measuring some on a few cameras",
          "  acentric propose kitchen.acentric.json --max-mb 60 --max-ms 16 --min-psnr 35\n"
          "  acentric propose kitchen.acentric.json --max-mb 200 --knobs configuration,cell-size=1.5/2/3 "
          "--budget-minutes 30 --apply",
          runPropose);
  c->add_option("project", o.project, "Project file; what it lacks is baked into the folder of this search")
      ->required();
  addStoreyOption(*c, chosen, "where the walk begins");
  const auto goal = [c = c](const char* name, double& value, const char* help) {
    c->add_option(name, value, help)->check(CLI::PositiveNumber);
  };
  goal("--max-mb", o.mostMegabytes, "Megabytes that captures and light may take on disk");
  goal("--max-ms", o.mostMilliseconds, "Milliseconds that the median frame may take, of --size");
  goal("--min-psnr", o.leastPsnr, "dB that the median frame is to have against the ray-traced truth");
  c->add_option("--path", o.path, "A path of the project, or a file (default: a tour)");
  c->add_option("--knobs", o.knobs,
                "What may be changed beside the samples per degree, as for `acentric sweep` (default: "
                "configuration, cell size, near band, layers, colour quality, reconstruction)")
      ->delimiter(',');
  addNumber(*c, "--budget-minutes", o.budgetMinutes, "Minutes that it may take. A later call goes on", 0.01,
            1e5);
  addFrames(*c, o, "Times that frames are timed");
  c->add_flag("--again", o.again, "Forget what was measured into the folder before");
  c->add_flag("--apply", o.apply, "Write the best to the project");
  c->add_option("-o,--output", o.output,
                "Folder for sweep.json, sweep.csv, sweep.html and captures (default: NAME.goals beside the "
                "project)");
}

void addPreset(CLI::App& app, Chosen& chosen) {
  auto [c, o] = add(app, chosen, "preset", "Set a project as a sweep found worth having",
                    "  acentric preset kitchen.acentric.json fast\n"
                    "  acentric preset kitchen.acentric.json balanced --from sweep --apply",
                    runPreset);
  c->add_option("project", o.project, "Project file")->required();
  c->add_option("name", o.name, "fast, balanced or accurate; proposal, of `acentric propose`")->required();
  c->add_option("--from", o.from,
                "Folder of a sweep, or its sweep.json (default: NAME.sweep beside the project)");
  c->add_flag("--apply", o.apply, "Write the changes to the project");
}

}  // namespace

void addPresetOption(CLI::App& command, Chosen& chosen) {
  CLI::Option* preset = command.add_option(
      "--preset", chosen.preset,
      "Take the project as a sweep found worth having (fast, balanced or accurate); its file stays as it is");
  command
      .add_option("--preset-from", chosen.presetFrom,
                  "Folder of that sweep, or its sweep.json (default: NAME.sweep beside the project)")
      ->needs(preset);
}

void addSweepCommands(CLI::App& app, Chosen& chosen) {
  addSweep(app, chosen);
  addPropose(app, chosen);
  addPreset(app, chosen);
}

}  // namespace acentric::cli
