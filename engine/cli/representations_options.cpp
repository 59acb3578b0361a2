/// Ways of keeping a scene against each other.

#include <fmt/format.h>

#include "engine/cli/command_line.h"

namespace acentric::cli {

void addRepresentationsCommand(CLI::App& bench, Chosen& chosen) {
  auto [c, o] = add(
      bench, chosen, "representations",
      "Compare ways of keeping the scene, at as many bytes, from random eyes and along paths: holes, PSNR, "
      "SSIM, bake and frame time",
      "  acentric bench representations kitchen.acentric.json -o compared\n"
      "  acentric bench representations kitchen.acentric.json --only grid,mesh --poses 100 --path walk.json "
      "-o compared",
      runBenchRepresentations);
  addProject(*c, chosen, o.project, "where the walk begins");
  c->add_option("-o,--output", o.output, "Folder to work in; what an earlier run baked there is used again")
      ->required();
  c->add_option("--path", o.paths, "A path of the project, or a file, measured besides; may be repeated");
  c->add_option("--only", o.bench.only,
                fmt::format("Besides the project's own, separated by commas: {}",
                            fmt::join(representationNames(), ", ")))
      ->delimiter(',')
      ->check(CLI::IsMember(representationNames()));
  c->add_option("--panoramas", o.bench.panoramas,
                "On the grid, and where most is unseen; half as many head boxes (default: as many as the "
                "sectors of the project's cameras add up to)")
      ->check(CLI::Range(1, 100000));
  addNumber(*c, "--poses", o.bench.poses, "Random eyes in the walkable area", 1, 100000);
  c->add_option("--seed", o.bench.seed, "Of the random eyes")->capture_default_str();
  addSize(*c, o.size);
  c->add_option("--fov", o.bench.fovDegrees, "Horizontal field of view in degrees (default: the project's)");
  addTruthSamples(*c, o.bench.truthSamples);
  addNumber(*c, "--tolerance", o.bench.tolerance, "Share by which bytes may differ from the project's", 0.001,
            1.0);
}

}  // namespace acentric::cli
