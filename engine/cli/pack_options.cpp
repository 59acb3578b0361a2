/// Packing a walk for acentric-bench-gl.

#include "engine/cli/command_line.h"

namespace acentric::cli {

void addPackCommand(CLI::App& bench, Chosen& chosen) {
  auto [c, o] = add(bench, chosen, "pack",
                    "Pack what pictures along a path read, for acentric-bench-gl on another machine",
                    "  acentric bench pack kitchen.acentric.json -o walk", runBenchPack);
  addProject(*c, chosen, o.project, "where the walk begins");
  c->add_option("-o,--output", o.output, "New folder")->required();
  c->add_option("--path", o.path, "Camera path (JSON; default: once round where the walk begins)");
  addNumber(*c, "--frames", o.frames, "Frames of the way round", 1, 100000);
  c->add_option("--size", o.size, "WIDTHxHEIGHT of the pictures, in pixels")->capture_default_str();
  addNumber(*c, "--most-megabytes", o.mostMegabytes,
            "Frames whose captures do not fit in so much are left out", 0.001, 1e6);
}

}  // namespace acentric::cli
