/// Local geometry of a region to what is drawn. web/src/engine/local_reader.ts is the other side.

#include "engine/export/bundle_read.h"
#include "engine/view/local_corners.h"
#include "web/runtime/module.h"

using namespace acentric;

namespace {

struct PageBatch {
  std::uint32_t material, flags, plane;  ///< flags: 1 vertex colours, 2 base, 4 emissive coordinates, 8 clear
  std::uint32_t firstTriangle, triangles;
};

/// Addresses of arrays.
struct PageLocal {
  std::uint32_t cornerCount;
  const LocalCorner* corners;
  std::uint32_t batchCount;
  const PageBatch* batches;
  std::uint32_t clearCount;
  const glm::vec3* clearCorners;
  std::uint32_t samples;
  const HalfColour* light;
  std::uint32_t firstClear, lit, mirrors;
};

}  // namespace

/// Of the file that was taken, relative to (x, y, z). Null where it is damaged.
EXPORTED(readLocal) const PageLocal* readLocal(double x, double y, double z) {
  static LocalCorners read;
  static std::vector<PageBatch> batches;
  static PageLocal page;
  const auto local =
      readLocalFile(std::move(moduleBytes), "", moduleBundle.materials.size(), moduleBundle.mirrors.size());
  if (!local) {
    moduleMessage = local.error().message;
    return nullptr;
  }
  WalkScene walk;
  auto scene = std::make_shared<Scene>();
  scene->materials = moduleBundle.materials;
  walk.scene = scene;
  if (!moduleBundle.mirrors.empty()) walk.mirrors = std::make_shared<const FlatMirrors>(moduleBundle.mirrors);
  auto corners = localCorners(walk, *local, {x, y, z});
  if (!corners) {
    moduleMessage = corners.error().message;
    return nullptr;
  }
  read = std::move(*corners);
  batches.clear();
  for (const LocalBatch& b : read.batches)
    batches.push_back({std::uint32_t(b.material),
                       (b.vertexColours ? 1u : 0u) | (b.baseUv ? 2u : 0u) | (b.emissiveUv ? 4u : 0u) |
                           (b.firstTriangle >= read.firstClear ? 8u : 0u),
                       b.mirrorPlane, b.firstTriangle, b.triangles});
  page = {std::uint32_t(read.corners.size()),
          read.corners.data(),
          std::uint32_t(batches.size()),
          batches.data(),
          std::uint32_t(read.clearCorners.size()),
          read.clearCorners.data(),
          std::uint32_t(read.light.size()),
          read.light.data(),
          read.firstClear,
          read.lit ? 1u : 0u,
          read.mirrors ? 1u : 0u};
  return &page;
}
