#include "engine/export/gltf_region.h"

#include <fmt/format.h>

#include "engine/export/bundle_json.h"
#include "engine/export/capture_mesh.h"
#include "engine/export/glb.h"
#include "engine/export/gltf_background.h"
#include "engine/export/gltf_local.h"

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

}  // namespace

Status GltfOptions::check() const {
  if (!(meshError >= 0.01 && meshError <= kLargestMeshError))
    return fail(ErrorKind::invalidArgument,
                fmt::format("the mesh error must lie in 0.01 .. {} samples", kLargestMeshError));
  if (atlasPixels < 128 || atlasPixels > 16384)
    return fail(ErrorKind::invalidArgument, "textures must have 128 to 16384 pixels a side");
  return {};
}

Result<GltfRegionReport> writeGltfRegion(const WalkScene& walk, int region, const GltfOptions& options,
                                         const std::filesystem::path& file, TaskRunner& runner,
                                         const std::stop_token& stop) {
  if (Status sound = options.check(); !sound) return tl::unexpected(sound.error());
  const Region& from = walk.layout->regions[std::size_t(region)];
  Glb glb(options.generator);
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
  return report;
}

}  // namespace acentric
