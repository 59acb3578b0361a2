/// From a model to its first view.

#include "engine/cli/command_line.h"

namespace acentric::cli {

void addFirstViewCommand(CLI::App& bench, Chosen& chosen) {
  auto [c, o] =
      add(bench, chosen, "first-view",
          "Seconds until the first view of a new project is there: coarse, at full quality, with its light",
          "  acentric bench first-view kitchen.glb --threads 2\n"
          "  acentric bench first-view town.gltf --metres-per-unit 0.01 --json",
          runBenchFirstView);
  c->add_option("scenes", o.scenes, "Model files; of each a project is made, in a temporary folder")
      ->required();
  c->add_option("--metres-per-unit", o.metresPerUnit, "Scale of the models (default: as their files say)")
      ->check(CLI::NonNegativeNumber);
  c->add_option("--cell-size", o.cellSize, "Metres (default: from the walkable area)")
      ->check(CLI::NonNegativeNumber);
  c->add_option("--samples-per-degree", o.samplesPerDegree,
                "Resolution of the captures (default: as new projects)")
      ->check(CLI::NonNegativeNumber);
}

}  // namespace acentric::cli
