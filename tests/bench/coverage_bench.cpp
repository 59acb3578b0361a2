/// Prints how soon the plan's coverage shows its first picture of a project, and when it is exact.
///   coverage_bench PROJECT...

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <thread>

#include "editor/session/coverage.h"
#include "engine/base/stopwatch.h"

namespace acentric::editor {
namespace {

void run(const std::filesystem::path& file) {
  ImportHost host;
  host.importer = ACENTRIC_IMPORTER;
  const auto open = openProject(file, host);
  if (!open) return fmt::print("{}\n", open.error().describe());
  fmt::print("{}: {} regions, {} cameras\n", file.string(), open->layout->regions.size(),
             open->layout->cameras.size());
  TaskRunner runner(std::max(0, int(std::thread::hardware_concurrency()) - 2));
  const std::pair<const char*, CoverageRequest> kinds[] = {
      {"surfaces", {CoverageKind::surfaces, {}}},
      {"plan", {CoverageKind::layout, {}}},
      {"cell", {CoverageKind::cell, open->layout->regions.front().id}}};
  for (const auto& [name, request] : kinds) {
    const Stopwatch watch;
    int pictures = 0;
    const Status done = measureCoverage(*open, request, runner, [&](const CoveragePicturePtr&) {
      if (++pictures > 1) return;
      fmt::print("  {:8}  first picture {:.3f} s", name, watch.seconds());
      std::fflush(stdout);
    });
    if (!done) return fmt::print("{}\n", done.error().describe());
    fmt::print(", exact {:.2f} s, {} pictures\n", watch.seconds(), pictures);
  }
}

}  // namespace
}  // namespace acentric::editor

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) acentric::editor::run(argv[i]);
}
