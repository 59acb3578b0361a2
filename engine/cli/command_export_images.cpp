#include <fmt/format.h>

#include "engine/cli/commands.h"
#include "engine/pipeline/export_images.h"

namespace acentric::cli {

Result<Report> runExportImages(const ExportOptions& options, const Common& common) {
  const auto open = openChosen(options.project, common);
  if (!open) return tl::unexpected(open.error());
  ExportImagesOptions images;
  images.format = options.to == "colmap"      ? ImageSetFormat::colmap
                  : options.to == "seurat"    ? ImageSetFormat::seurat
                  : options.to == "panoramas" ? ImageSetFormat::panoramas
                                              : ImageSetFormat::nerfstudio;
  images.facePixels = options.facePixels;
  if (options.region >= 0) images.onlyRegion = options.region;
  const auto runner = common.runner();
  const auto done = exportImages(*open, options.output, images, *runner, common.progress, common.stop);
  if (!done) return tl::unexpected(done.error());
  Report report;
  report.json = {{"folder", options.output.string()}, {"images", done->images}, {"points", done->points}};
  report.text =
      fmt::format("{}: {} pictures with distances", options.output.string(), countText(done->images));
  if (done->points > 0) report.text += fmt::format(", {} points", countText(done->points));
  report.text += "\n";
  return report;
}

}  // namespace acentric::cli
