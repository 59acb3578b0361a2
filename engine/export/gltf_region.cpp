#include "engine/export/gltf_region.h"

#include <fmt/format.h>

#include "engine/export/bundle_json.h"
#include "engine/export/capture_mesh.h"
#include "engine/export/glb.h"
#include "engine/export/gltf_background.h"
#include "engine/export/gltf_local.h"
#include "engine/export/webp.h"
#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

Glb::Json corners(const ConvexPolygon& polygon, double z) {
  Glb::Json out = Glb::Json::array();
  for (const glm::dvec2& corner : polygon.corners) {
    const glm::vec3 at = gltfPosition({corner, z});
    out.push_back({at.x, at.z});
  }
  return out;
}

/// Of positions as a share of their distance from the region's middle, so that none is off by more than
/// kPackedShare of the mesh error as the eye sees it. That may stand `from` metres off the middle, and is at
/// least the near band's width from what captures show: things are at most 1 + from / band times as far from
/// the middle as from it.
double positionErrorOf(const WalkScene& walk, int region, const GltfOptions& options) {
  constexpr double kLeastBand = 0.25;
  const Layout& layout = *walk.layout;
  const ConvexPolygon& polygon = layout.regions[std::size_t(region)].polygon;
  double pitch = radians(1), from = 0;
  for (const int camera : gltfCameras(layout, region, options))
    if (const auto& capture = walk.captures[std::size_t(camera)])
      pitch = std::min({pitch, capture->camera.columnPitch(), capture->camera.rowPitch()});
  for (const glm::dvec2& corner : polygon.corners)
    from = std::max(from, glm::distance(corner, polygon.centroid()));
  return kPackedShare * options.meshError * pitch / (1 + from / std::max(layout.spec.nearBand, kLeastBand));
}

}  // namespace

Status GltfOptions::check() const {
  if (!(meshError >= 0.01 && meshError <= kLargestMeshError))
    return fail(ErrorKind::invalidArgument,
                fmt::format("the mesh error must lie in 0.01 .. {} samples", kLargestMeshError));
  if (atlasPixels < 128 || atlasPixels > 16384)
    return fail(ErrorKind::invalidArgument, "textures must have 128 to 16384 pixels a side");
  if (webp && atlasPixels > kLargestWebp)
    return fail(ErrorKind::invalidArgument,
                fmt::format("WebP textures have at most {} pixels a side", kLargestWebp));
  if (colourQuality < 0 || colourQuality > kLosslessColours)
    return fail(ErrorKind::invalidArgument, fmt::format("the colour quality is 0 to {}", kLosslessColours));
  return {};
}

Result<GltfRegionReport> writeGltfRegion(const WalkScene& walk, int region, const GltfOptions& options,
                                         const std::filesystem::path& file, TaskRunner& runner,
                                         const std::stop_token& stop) {
  if (Status sound = options.check(); !sound) return tl::unexpected(sound.error());
  const Region& from = walk.layout->regions[std::size_t(region)];
  GlbCoding coding;
  coding.meshopt = options.meshopt, coding.webp = options.webp, coding.quality = options.colourQuality;
  coding.middle = gltfPosition({from.polygon.centroid(), walk.layout->eyeZ()});
  coding.positionError = positionErrorOf(walk, region, options);
  Glb glb(options.generator, coding);
  GltfRegionReport report;
  if (Status added = addCaptures(glb, walk, region, options, report, runner, stop); !added)
    return tl::unexpected(added.error());
  if (const auto& local = walk.local[std::size_t(region)])
    if (Status added = addLocal(glb, walk, *local, report); !added) return tl::unexpected(added.error());
  addSky(glb, walk, region);
  const double floor = walk.layout->spec.floorHeight;
  glb.setExtras({{"region", region},
                 {"kind", bundle_words::kKinds[std::size_t(from.kind)]},
                 {"polygon", corners(from.polygon, floor)},
                 {"nearPolygon", corners(from.grown, floor)},
                 {"floorHeight", floor},
                 {"eyeHeight", walk.layout->eyeZ() - floor},
                 {"cameras", gltfCameras(*walk.layout, region, options)},
                 {"meshErrorSamples", options.meshError}});
  const auto bytes = glb.write(file);
  if (!bytes) return tl::unexpected(bytes.error());
  report.bytes = *bytes;
  const Bounds& box = glb.bounds();
  report.bounds = {{box.min.x, -box.max.z, box.min.y}, {box.max.x, -box.min.z, box.max.y}};
  return report;
}

}  // namespace acentric
