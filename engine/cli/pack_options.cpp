/// Packing a walk for acentric-bench-gl.

#include "engine/cli/command_line.h"

namespace acentric::cli {

void addPackCommand(CLI::App& bench, Chosen& chosen) {
  auto [c, o] = add(bench, chosen, "pack",
                    "Pack what pictures along a path read, for acentric-bench-gl on another machine",
                    "  acentric bench pack kitchen.acentric.json -o walk", runBenchPack);
  c->add_option("project", o.project, "Project file")->required();
  addStoreyOption(*c, chosen, "where the walk begins");
  c->add_option("-o,--output", o.output, "New folder")->required();
  c->add_option("--path", o.path, "Camera path (JSON; default: once round where the walk begins)");
  c->add_option("--frames", o.frames, "Frames of the way round")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  c->add_option("--size", o.size, "WIDTHxHEIGHT of the pictures, in pixels")->capture_default_str();
  c->add_option("--most-megabytes", o.mostMegabytes,
                "Frames whose captures do not fit in so much are left out")
      ->check(CLI::Range(0.001, 1e6))
      ->capture_default_str();
}

}  // namespace acentric::cli
