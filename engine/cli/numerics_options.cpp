/// Careful arithmetic against less.

#include "engine/cli/command_line.h"

namespace acentric::cli {

void addNumericsCommand(CLI::App& bench, Chosen& chosen) {
  auto [c, o] = add(
      bench, chosen, "numerics",
      "Error and time of careful arithmetic against less: the warp in floats and doubles, exact and naive "
      "signs, bits of distances; on frames of a walk and on hard cases",
      "  acentric bench numerics kitchen.acentric.json --path tour.json\n"
      "  acentric bench numerics kitchen.acentric.json --frames 12 -o numerics --json",
      runBenchNumerics);
  c->add_option("project", o.project, "Project file, baked")->required();
  addStoreyOption(*c, chosen, "where the walk begins");
  addPresetOption(*c, chosen);
  c->add_option("--path", o.path, "A path of the project, or a file (default: a tour)");
  addSize(*c, o.size);
  addNumber(*c, "--frames", o.frames, "Frames along the path, evenly chosen", 1, 10000);
  addNumber(*c, "--repeats", o.repeats, "Times that each way is timed", 1, 1000);
  c->add_option("-o,--output", o.output, "Folder for numerics.json, numerics.csv and numerics.html");
}

}  // namespace acentric::cli
