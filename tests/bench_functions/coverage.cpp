/// How soon the plan's coverage shows its first picture of a project, and when it is exact.

#include "editor/session/coverage.h"

#include "engine/base/stopwatch.h"
#include "tests/bench_functions/benches.h"

namespace acentric::bench {

Status benchCoverage(const Subject& subject, Figures& figures) {
  using namespace editor;
  ImportHost host;
  host.importer = ACENTRIC_IMPORTER;
  const auto open = openProject(subject.project, host);
  if (!open) return tl::unexpected(open.error());
  figures.fact("regions", open->layout->regions.size());
  figures.fact("cameras", open->layout->cameras.size());
  TaskRunner runner(std::max(0, subject.threads - 2));  // the editor keeps one for itself
  const std::pair<const char*, CoverageRequest> kinds[] = {
      {"surfaces", {CoverageKind::surfaces, {}}},
      {"plan", {CoverageKind::layout, {}}},
      {"cell", {CoverageKind::cell, open->layout->regions.front().id}}};
  for (const auto& [name, request] : kinds) {
    const Stopwatch watch;
    std::vector<double> first;
    const Status done = measureCoverage(*open, request, runner, [&](const CoveragePicturePtr&) {
      if (first.empty()) first.push_back(watch.seconds());
    });
    if (!done) return done;
    figures.add(std::string(name) + ": first picture", "s", first);
    figures.add(std::string(name) + ": exact", "s", {watch.seconds()});
  }
  return {};
}

}  // namespace acentric::bench
