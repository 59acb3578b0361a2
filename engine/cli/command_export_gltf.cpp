#include <fmt/format.h>

#include "engine/cli/commands.h"
#include "engine/pipeline/export_gltf.h"

namespace acentric::cli {

Result<Report> runExportGltf(const ExportOptions& options, const Common& common) {
  const bool tiles = options.to == "3dtiles";
  const bool webp = options.textureFormat.value_or(tiles ? "webp" : "png") == "webp";
  if (options.colourQuality && !webp)
    return fail(ErrorKind::invalidArgument,
                "--colour-quality is of WebP: PNG keeps every bit; say --texture-format webp");
  // Before a model is imported for nothing.
  if (Status free = checkGltfTarget(options.output, tiles); !free) return tl::unexpected(free.error());
  const auto current = openChosen(options.project, common);
  if (!current) return tl::unexpected(current.error());
  const auto storeys = acentric::openStoreys(*current, common.host, common.progress, common.stop);
  if (!storeys) return tl::unexpected(storeys.error());
  ExportGltfOptions gltf;
  gltf.allowMissing = options.allowMissing;
  gltf.region.atlasPixels = options.texturePixels;
  gltf.region.bothHands = current->project.view.secondaryCover;
  gltf.region.generator = "Acentric " ACENTRIC_VERSION;
  gltf.tiles = tiles;
  gltf.region.meshopt = options.meshCompression.value_or(tiles ? "meshopt" : "none") == "meshopt";
  gltf.region.webp = webp;
  gltf.region.colourQuality =
      options.colourQuality.value_or(std::min(current->project.bake.colourQuality, kShippedColourQuality));
  if (options.region >= 0) gltf.onlyRegion = options.region;
  const auto runner = common.runner();
  const auto done = exportGltf(*storeys, options.output, gltf, *runner, common.progress, common.stop);
  if (!done) return tl::unexpected(done.error());
  const GltfRegionReport all = done->sum();
  Report report;
  report.json = {{"folder", options.output.string()},
                 {"regions", done->regions.size()},
                 {"bytes", all.bytes},
                 {"patches", all.patches},
                 {"triangles", all.triangles},
                 {"localTriangles", all.localTriangles},
                 {"textures", all.textures},
                 {"samples", all.samples},
                 {"missing", all.missing}};
  report.text = fmt::format(
      "{}: {} regions, {}\n  of captures: {} patches, {} triangles, {} textures, {} samples; near them: {} "
      "triangles\n",
      options.output.string(), countText(done->regions.size()), bytesText(all.bytes), countText(all.patches),
      countText(all.triangles), countText(all.textures), countText(all.samples),
      countText(all.localTriangles));
  if (all.missing > 0)
    report.text += fmt::format("warning: {} captures are missing; `acentric bake {}` makes them\n",
                               all.missing, options.project.string());
  return report;
}

}  // namespace acentric::cli
