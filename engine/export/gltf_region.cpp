#include "engine/export/gltf_region.h"

#include <fmt/format.h>

#include <map>

#include "engine/export/bundle_json.h"
#include "engine/export/glb.h"
#include "engine/export/near_model.h"
#include "engine/export/patch_model.h"
#include "engine/export/sky_model.h"
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

/// Which roles of which cameras the region draws.
std::map<int, std::uint8_t> camerasOf(const Layout& layout, int region, const GltfOptions& options) {
  std::map<int, std::uint8_t> cameras;
  const Region& from = layout.regions[std::size_t(region)];
  for (std::size_t c = 0; c < from.covers.size(); ++c) {
    if (c > 0 && !options.bothHands) break;
    for (const Piece& piece : from.covers[c].pieces)
      cameras[piece.camera] |= roleBit(layout.cameras[std::size_t(piece.camera)], piece.role);
  }
  return cameras;
}

Status addCaptures(const WalkScene& walk, int region, const GltfOptions& options, DrawModel& model,
                   GltfRegionReport& report, const std::stop_token& stop) {
  std::vector<ShownCapture> shown;
  for (const auto& [camera, roles] : camerasOf(*walk.layout, region, options)) {
    ++report.cameras;
    const DisplayCapture* capture = walk.captures[std::size_t(camera)].get();
    if (capture == nullptr) {
      ++report.missing;
      continue;
    }
    if (!capture->hasPatches())
      return fail(ErrorKind::unsupported,
                  "has no planes of surfaces: turn silhouettes on in the bake settings, and bake it again",
                  fmt::format("the capture of camera {}", camera));
    shown.push_back({capture, roles});
  }
  const PatchModelCounts counts = addPatches(shown, RoleMeshes::together, options.atlasPixels, model, stop);
  report.patches = counts.patches, report.triangles = counts.triangles;
  report.textures = counts.textures, report.samples = counts.samples;
  return stop.stop_requested() ? fail(ErrorKind::cancelled, "writing glTF was stopped") : Status();
}

/// Of positions as a share of their distance from the region's middle, so that none is off by more than
/// kPackedError samples as the eye sees it. That may stand `from` metres off the middle, and is at
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
  return kPackedError * pitch / (1 + from / std::max(layout.spec.nearBand, kLeastBand));
}

}  // namespace

Status GltfOptions::check() const {
  if (atlasPixels < kLeastAtlas || atlasPixels > kLargestAtlas)
    return fail(ErrorKind::invalidArgument,
                fmt::format("textures must have {} to {} pixels a side", kLeastAtlas, kLargestAtlas));
  if (webp && atlasPixels > kLargestWebp)
    return fail(ErrorKind::invalidArgument,
                fmt::format("WebP textures have at most {} pixels a side", kLargestWebp));
  if (colourQuality < 0 || colourQuality > kLosslessColours)
    return fail(ErrorKind::invalidArgument, fmt::format("the colour quality is 0 to {}", kLosslessColours));
  return {};
}

Result<GltfRegionReport> writeGltfRegion(const WalkScene& walk, int region, const GltfOptions& options,
                                         const std::filesystem::path& file, const std::stop_token& stop) {
  if (Status sound = options.check(); !sound) return tl::unexpected(sound.error());
  const Region& from = walk.layout->regions[std::size_t(region)];
  GlbCoding coding;
  coding.meshopt = options.meshopt, coding.webp = options.webp, coding.quality = options.colourQuality;
  coding.middle = gltfPosition({from.polygon.centroid(), walk.layout->eyeZ()});
  coding.positionError = positionErrorOf(walk, region, options);
  DrawModel model;
  GltfRegionReport report;
  if (Status added = addCaptures(walk, region, options, model, report, stop); !added)
    return tl::unexpected(added.error());
  if (const auto& local = walk.local[std::size_t(region)])
    report.localTriangles = addNear(walk, std::size_t(region), *local, options.atlasPixels, model).triangles;
  addSky(walk, glm::dvec3(from.polygon.centroid(), walk.layout->eyeZ()), model);
  Glb glb(options.generator, coding);
  if (Status added = glb.add(std::move(model)); !added) return tl::unexpected(added.error());
  const double floor = walk.layout->spec.floorHeight;
  glb.setExtras({{"region", region},
                 {"kind", bundle_words::kKinds[std::size_t(from.kind)]},
                 {"polygon", corners(from.polygon, floor)},
                 {"nearPolygon", corners(from.grown, floor)},
                 {"floorHeight", floor},
                 {"eyeHeight", walk.layout->eyeZ() - floor},
                 {"cameras", gltfCameras(*walk.layout, region, options)}});
  const auto bytes = glb.write(file);
  if (!bytes) return tl::unexpected(bytes.error());
  report.bytes = *bytes;
  const Bounds& box = glb.bounds();
  report.bounds = {{box.min.x, -box.max.z, box.min.y}, {box.max.x, -box.min.z, box.max.y}};
  return report;
}

std::vector<int> gltfCameras(const Layout& layout, int region, const GltfOptions& options) {
  std::vector<int> cameras;
  for (const auto& [camera, roles] : camerasOf(layout, region, options)) cameras.push_back(camera);
  return cameras;
}

}  // namespace acentric
