/// Benches of single functions.

#include "engine/cli/command_line.h"

namespace acentric::cli {

void addFunctionsCommand(CLI::App& bench, Chosen& chosen) {
  auto [c, o] = add(bench, chosen, "functions",
                    "Time single functions beside naive variants and references, or one build beside another",
                    "  acentric bench functions --json\n"
                    "  acentric bench functions budgets simplify --model kitchen.gltf\n"
                    "  acentric bench functions warp --beside ../before/build/release/bin --rounds 5",
                    runBenchFunctions);
  c->add_option(
      "names", o.names,
      "Which: layout, hard-cases, warp, gl-frames, plan; with --model budgets, simplify; with --project "
      "coverage (default: all that have what they need)");
  c->add_option("--model", o.model, "Model file to work on");
  c->add_option("--project", o.project, "Project file to work on");
  c->add_option("--at", o.at, "Place of the model to simplify around: x,y in metres (default: its middle)");
  c->add_option("--triangles", o.triangles, "To simplify to (0 = by the error alone)")->capture_default_str();
  c->add_option("--regions", o.regions, "To count triangles of")->capture_default_str();
  c->add_option("--beside", o.beside,
                "Folder of another build's programs: both run by turns, and figures are told beside its");
  addNumber(*c, "--rounds", o.rounds, "Of turns, with --beside", 1, 1000);
}

}  // namespace acentric::cli
