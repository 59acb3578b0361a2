#include <utility>
#include <vector>

#include "engine/base/contract.h"
#include "engine/export/local_file.h"
#include "engine/export/local_lanes.h"
#include "engine/store/keyed.h"
#include "engine/store/light_coder.h"

namespace acentric {
namespace {

/// Is it all of its source triangle, corner by corner? What names nothing that there is, is not.
bool isWhole(const LocalGeometry& local, const LocalTriangle& triangle, const Mesh& mesh) {
  if (triangle.triangle >= mesh.triangles.size()) return false;
  const glm::uvec3& corners = mesh.triangles[triangle.triangle];
  for (int c = 0; c < 3; ++c) {
    if (triangle.vertices[c] >= local.vertices.size() || corners[c] >= mesh.positions.size()) return false;
    const LocalVertex& vertex = local.vertices[triangle.vertices[c]];
    if (vertex.barycentric != local_file::kCorners[c] || vertex.position != mesh.positions[corners[c]])
      return false;
  }
  return true;
}

/// Vertices that triangles name, numbered as they are met. Numbers of none stay so, for readers to refuse.
class UsedVertices {
 public:
  explicit UsedVertices(const LocalGeometry& local) : local_(local), number_(local.vertices.size(), kNone) {}

  glm::uvec3 numbersOf(const LocalTriangle& triangle) {
    glm::uvec3 numbers(0);
    for (int c = 0; c < 3; ++c) {
      numbers[c] = triangle.vertices[c];
      if (numbers[c] >= number_.size()) continue;
      std::uint32_t& number = number_[triangle.vertices[c]];
      if (number == kNone) {
        number = std::uint32_t(vertices.size());
        vertices.push_back(local_.vertices[triangle.vertices[c]]);
      }
      numbers[c] = number;
    }
    return numbers;
  }

  std::vector<LocalVertex> vertices;

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  const LocalGeometry& local_;
  std::vector<std::uint32_t> number_;
};

Status fill(BlockFileWriter& file, const LocalGeometry& local) {
  require(local.surfaces != nullptr, "what a bundle holds is self-contained");
  const LocalSurfaces& surfaces = *local.surfaces;
  local_file::Arrays arrays;
  std::vector<std::uint32_t> firstTriangle, firstVertex;
  for (const Mesh& mesh : surfaces.meshes) {
    firstVertex.push_back(std::uint32_t(arrays.place.size()));
    firstTriangle.push_back(std::uint32_t(arrays.source.size()));
    arrays.flags |= arrays.append(mesh);
  }
  UsedVertices used(local);
  for (const LocalTriangle& t : local.triangles) {
    const bool whole = isWhole(local, t, surfaces.meshes[t.mesh]);
    arrays.triangle.push_back(glm::uvec4(whole ? glm::uvec3(local_file::kWhole) : used.numbersOf(t),
                                         firstTriangle[t.mesh] + t.triangle));
  }
  if (!surfaces.light.empty()) arrays.flags |= local_file::kLight;
  if (!surfaces.mirrorPlanes.empty()) arrays.flags |= local_file::kMirrors;
  for (const auto& planes : surfaces.mirrorPlanes)
    arrays.plane.insert(arrays.plane.end(), planes.begin(), planes.end());

  for (const std::size_t count : {used.vertices.size(), arrays.triangle.size(), arrays.place.size(),
                                  arrays.source.size(), surfaces.light.light.size(), surfaces.meshes.size()})
    file.describe(static_cast<std::uint32_t>(count));
  file.describe(arrays.flags);
  if (!surfaces.light.empty())
    if (Status sound = checkSurfaceLight(surfaces.light); !sound) return sound;
  const int unused = unusedBits(surfaces.light);
  const std::vector<std::byte> light =
      surfaces.light.empty() ? std::vector<std::byte>() : codeLight(surfaces.light, unused);
  file.describe(static_cast<std::uint32_t>(light.size()));
  file.describe(static_cast<std::uint8_t>(unused));
  file.claim(surfaces.light.light.size() * sizeof(HalfColour) +
             arrays.triangle.size() * local_file::kVerticesBytes);
  for (const Mesh& mesh : surfaces.meshes) {
    file.describe(static_cast<std::uint32_t>(mesh.material));
    file.describe(static_cast<std::uint32_t>(mesh.positions.size()));
    file.describe(static_cast<std::uint32_t>(mesh.triangles.size()));
    file.describe(local_file::flagsOf(mesh));
  }
  Status added;
  local_file::forEachArray(std::as_const(used.vertices), std::as_const(arrays), surfaces.light,
                           [&](const auto& lanes, std::size_t count) {
                             if (added) added = file.addRecords(lanes, count);
                           });
  if (added && !light.empty()) added = file.addStream(light);
  return added;
}

}  // namespace

Result<std::vector<std::byte>> localFileBytes(const LocalGeometry& local) {
  BlockFileWriter file(BlockFileKind::localGeometry, {});
  if (Status filled = fill(file, local); !filled) return tl::unexpected(filled.error());
  return file.bytes();
}

Status writeLocalFile(const LocalGeometry& local, const std::filesystem::path& path) {
  return withinMemory(path, [&]() -> Status {
    BlockFileWriter file(BlockFileKind::localGeometry, {});
    if (Status filled = fill(file, local); !filled) return filled;
    return file.write(path);
  });
}

}  // namespace acentric
