#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "engine/pipeline/camera_path.h"
#include "engine/pipeline/walk_stream.h"

namespace acentric {

Result<LoadedWalk> loadWalk(const OpenProject& open, const LoadedWalk* former, TaskRunner& runner,
                            const Progress& progress, std::stop_token stop) {
  auto start = startWalk(open, former);
  if (!start) return tl::unexpected(start.error());
  std::vector<int> cameras(open.keys.size()), regions(open.layout->regions.size());
  std::iota(cameras.begin(), cameras.end(), 0);
  std::iota(regions.begin(), regions.end(), 0);
  WalkStreamOptions options;
  options.memoryBytes = std::numeric_limits<std::size_t>::max();
  options.threads = 0;
  WalkStream stream(std::move(*start), options);
  if (Status done = stream.complete(cameras, regions, runner, progress, stop); !done)
    return fail(done.error().kind, done.error().message, open.file.string());
  LoadedWalk loaded = *stream.walk();
  std::ranges::move(stream.takeWarnings(), std::back_inserter(loaded.warnings));
  if (const std::string simplified = simplifiedText(loaded); !simplified.empty())
    loaded.warnings.push_back(simplified);
  return loaded;
}

std::string coarseText(const LoadedWalk& loaded) {
  if (loaded.coarse == 0) return {};
  return fmt::format("{} of {} cameras {} so far", loaded.coarse, loaded.keys.size(),
                     loaded.coarse == 1 ? "is a preview or a draft" : "are previews or drafts");
}

std::string simplifiedText(const LoadedWalk& loaded) {
  std::size_t before = 0, after = 0, above = 0, beyond = 0;
  double error = 0;
  for (const LoadedWalk::Simplified& s : loaded.simplified) {
    before += s.report.before, after += s.report.after;
    above += s.report.withinBudget ? 0 : 1, beyond += s.report.withinError ? 0 : 1;
    error = std::max(error, s.report.maxError);
  }
  if (loaded.simplified.empty()) return {};
  std::string line = fmt::format(
      "the local geometry of {} regions is simplified: {} triangles became {}, the surfaces lie at most "
      "{:.2g} mm "
      "apart",
      loaded.simplified.size(), before, after, 1e3 * error);
  if (above > 0)
    line += fmt::format("; {} of them are still above the budget, because the error allows no more", above);
  if (beyond > 0) line += fmt::format("; {} of them exceed the error", beyond);
  return line;
}

glm::dvec3 clampToLayout(const Layout& layout, const glm::dvec3& eye) {
  return {clampToPlan(layout, glm::dvec2(eye)), eye.z};
}

}  // namespace acentric
