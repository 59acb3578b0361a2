#include <fmt/format.h>

#include "engine/bench/packed_walk.h"
#include "engine/cli/commands.h"

namespace acentric::cli {

Result<Report> runBenchPack(const BenchPackOptions& options, const Common& common) {
  const auto size = parseSize(options.size);
  if (!size) return tl::unexpected(size.error());
  const auto open = openChosen(options.project, common);
  if (!open) return tl::unexpected(open.error());
  const Layout& layout = *open->layout;
  const auto region = layout.regionAt(clampToPlan(layout, open->project.spawn().position));
  const auto path = options.path.empty()
                        ? Result<CameraPath>(roundIn(layout, region.value_or(0), options.frames))
                        : loadPath(options.path);
  if (!path) return tl::unexpected(path.error());
  const CameraPath frames = framesOf(*path);
  const auto packed = packWalk(*open, frames, {size->width, size->height},
                               std::uint64_t(options.mostMegabytes * 1e6), options.output);
  if (!packed) return tl::unexpected(packed.error());
  Report report;
  report.json = {{"folder", options.output.string()},
                 {"frames", packed->path.poses.size()},
                 {"framesLeftOut", frames.poses.size() - packed->path.poses.size()},
                 {"cameras", packed->cameras},
                 {"bytes", packed->bytes}};
  report.text =
      fmt::format("{}: {} of {} frames, {} cameras, {}\n", options.output.string(), packed->path.poses.size(),
                  frames.poses.size(), packed->cameras, bytesText(packed->bytes));
  return report;
}

}  // namespace acentric::cli
