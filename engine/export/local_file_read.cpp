#include <algorithm>
#include <cmath>

#include "engine/export/bundle_read.h"
#include "engine/export/local_lanes.h"
#include "engine/store/keyed.h"
#include "engine/store/light_coder.h"

namespace acentric {
namespace {

using namespace local_file;

/// Parts of the source triangle: rounding may leave its border by this.
constexpr float kBeyond = 0.01f;

struct MeshCounts {
  std::uint32_t material = 0, vertices = 0, triangles = 0;
  std::uint8_t flags = 0;
};

std::uint64_t recordBytesOf(std::uint8_t flags, std::uint64_t vertices, std::uint64_t triangles,
                            std::uint64_t places, std::uint64_t sources, std::uint64_t streamBytes) {
  const std::uint64_t perPlace =
      24 + (flags & kUv0 ? 8u : 0u) + (flags & kUv1 ? 8u : 0u) + (flags & kColours ? 4u : 0u);
  const std::uint64_t perSource = 12 + (flags & kLight ? 3u : 0u) + (flags & kMirrors ? 1u : 0u);
  return 20 * vertices + 16 * triangles + perPlace * places + perSource * sources + streamBytes;
}

class LocalFileReader {
 public:
  LocalFileReader(BlockFileReader& file, std::size_t materials, std::size_t mirrors)
      : file_(file), materials_(materials), mirrors_(mirrors) {}

  Result<LocalGeometry> read() {
    for (const auto& step : {&LocalFileReader::readCounts, &LocalFileReader::readArrays,
                             &LocalFileReader::makeMeshes, &LocalFileReader::checkTriangles})
      if (Status done = (this->*step)(); !done) return tl::unexpected(done.error());
    local_.surfaces = std::make_shared<const LocalSurfaces>(std::move(surfaces_));
    return std::move(local_);
  }

 private:
  Status readCounts() {
    const auto vertices = file_.described<std::uint32_t>(), triangles = file_.described<std::uint32_t>(),
               places = file_.described<std::uint32_t>(), sources = file_.described<std::uint32_t>(),
               samples = file_.described<std::uint32_t>(), meshes = file_.described<std::uint32_t>();
    arrays_.flags = file_.described<std::uint8_t>();
    streamBytes_ = file_.described<std::uint32_t>(), unusedBits_ = file_.described<std::uint8_t>();
    std::uint64_t ofVertices = 0, ofTriangles = 0;
    for (std::uint32_t m = 0; m < meshes && file_.describesMore(); ++m) {
      MeshCounts mesh;
      mesh.material = file_.described<std::uint32_t>(), mesh.vertices = file_.described<std::uint32_t>();
      mesh.triangles = file_.described<std::uint32_t>(), mesh.flags = file_.described<std::uint8_t>();
      if (mesh.material >= materials_) return file_.malformed("uses a material that the bundle has not");
      if ((mesh.flags & ~arrays_.flags) != 0)
        return file_.malformed("has a mesh with more attributes than its arrays");
      ofVertices += mesh.vertices, ofTriangles += mesh.triangles;
      meshes_.push_back(mesh);
    }
    constexpr std::uint8_t kKnown = kLight | kMirrors | kUv0 | kUv1 | kColours;
    if (!file_.describedAll() || meshes_.size() != meshes || ofVertices != places || ofTriangles != sources ||
        (arrays_.flags & ~kKnown) != 0 || (streamBytes_ > 0) != ((arrays_.flags & kLight) != 0) ||
        !file_.mayHold(samples * std::uint64_t(sizeof(HalfColour)) + triangles * kVerticesBytes))
      return file_.malformed("its description makes no sense");
    if (file_.rawBytes() != recordBytesOf(arrays_.flags, vertices, triangles, places, sources, streamBytes_))
      return file_.malformed("its counts contradict its size");
    local_.vertices.resize(vertices), arrays_.triangle.resize(triangles);
    arrays_.place.resize(places), arrays_.source.resize(sources);
    if (arrays_.flags & kUv0) arrays_.uv[0].resize(places);
    if (arrays_.flags & kUv1) arrays_.uv[1].resize(places);
    if (arrays_.flags & kColours) arrays_.colour.resize(places);
    if (arrays_.flags & kMirrors) arrays_.plane.resize(sources);
    if (arrays_.flags & kLight) {
      SurfaceLight& light = surfaces_.light;
      light.resolution.resize(sources), light.hasBack.resize(sources);
      samples_ = samples;
    }
    return {};
  }

  Status readArrays() {
    Status read;
    forEachArray(local_.vertices, arrays_, surfaces_.light, [&](const auto& lanes, std::size_t count) {
      if (read) read = file_.nextRecords(lanes, count);
    });
    if (read && (arrays_.flags & kLight)) read = readLight();
    if (read && !file_.atEnd()) return file_.malformed("has more blocks than its description needs");
    return read;
  }

  Status readLight() {
    SurfaceLight& light = surfaces_.light;
    std::uint64_t next = 0;
    for (std::size_t t = 0; t < light.resolution.size(); ++t) {
      light.firstSample.push_back(std::uint32_t(next));
      const std::uint64_t resolution = light.resolution[t];
      if (light.hasBack[t] > 1) return file_.malformed("has a triangle with neither one side nor two");
      if (resolution > 0) next += (resolution + 1) * (resolution + 2) / 2 << light.hasBack[t];
      if (next > samples_) break;
    }
    // Without any there is one, so that surfaces are lit.
    if (std::max<std::uint64_t>(next, 1) != samples_)
      return file_.malformed("has other light samples than its resolutions need");
    light.firstSample.push_back(std::uint32_t(next));
    light.light.assign(samples_, HalfColour(0));
    const auto stream = file_.nextStream(streamBytes_);
    if (!stream) return tl::unexpected(stream.error());
    if (Status decoded = decodeLight(*stream, unusedBits_, light); !decoded)
      return file_.malformed(decoded.error().message);
    return {};
  }

  Status makeMeshes() {
    std::size_t vertex = 0, triangle = 0;
    for (const MeshCounts& counts : meshes_) {
      Mesh mesh;
      mesh.material = int(counts.material);
      for (std::size_t v = vertex; v < vertex + counts.vertices; ++v) {
        mesh.positions.push_back(arrays_.place[v].position);
        mesh.normals.push_back(arrays_.place[v].normal);
        if (counts.flags & kUv0) mesh.uv[0].push_back(arrays_.uv[0][v]);
        if (counts.flags & kUv1) mesh.uv[1].push_back(arrays_.uv[1][v]);
        if (counts.flags & kColours) mesh.colours.push_back(arrays_.colour[v]);
      }
      for (std::size_t t = triangle; t < triangle + counts.triangles; ++t) {
        const glm::uvec3& corners = arrays_.source[t];
        for (int c = 0; c < 3; ++c)
          if (corners[c] < vertex || corners[c] >= vertex + counts.vertices)
            return file_.malformed("has a source triangle with a corner outside its mesh");
        mesh.triangles.push_back(corners - glm::uvec3(std::uint32_t(vertex)));
      }
      if (arrays_.flags & kMirrors) {
        const auto from = arrays_.plane.begin() + std::ptrdiff_t(triangle);
        surfaces_.mirrorPlanes.emplace_back(from, from + std::ptrdiff_t(counts.triangles));
      }
      firstTriangle_.push_back(std::uint32_t(triangle));
      vertex += counts.vertices, triangle += counts.triangles;
      surfaces_.meshes.push_back(std::move(mesh));
    }
    const auto wrong = [&](std::uint8_t plane) {
      return plane != FlatMirrors::kNoPlane && plane >= mirrors_;
    };
    if (std::ranges::any_of(arrays_.plane, wrong))
      return file_.malformed("uses a mirror that the bundle has not");
    return {};
  }

  static bool isPlaced(const LocalVertex& v) {
    return std::isfinite(v.position.x) && std::isfinite(v.position.y) && std::isfinite(v.position.z);
  }

  Status checkTriangles() {
    for (const LocalVertex& v : local_.vertices) {
      const auto inside = [](float w) { return w >= -kBeyond && w <= 1 + kBeyond; };
      if (!isPlaced(v) || !inside(v.barycentric.x) || !inside(v.barycentric.y))
        return file_.malformed("has a vertex that lies nowhere in its source triangle");
    }
    const std::size_t stored = local_.vertices.size();
    for (glm::uvec4 t : arrays_.triangle) {
      if (t.w >= arrays_.source.size()) return file_.malformed("has a triangle of no source triangle");
      if (glm::uvec3(t) == glm::uvec3(kWhole)) {
        for (int c = 0; c < 3; ++c) {
          t[c] = std::uint32_t(local_.vertices.size());
          local_.vertices.push_back({arrays_.place[arrays_.source[t.w][c]].position, kCorners[c]});
          if (!isPlaced(local_.vertices.back()))
            return file_.malformed("has a source triangle with a corner that lies nowhere");
        }
      } else if (t.x >= stored || t.y >= stored || t.z >= stored) {
        return file_.malformed("has a triangle without a vertex");
      }
      auto mesh = std::ranges::upper_bound(firstTriangle_, t.w);  // of empty meshes the last
      const auto number = std::uint32_t(mesh - firstTriangle_.begin() - 1);
      local_.triangles.push_back({glm::uvec3(t), number, t.w - firstTriangle_[number]});
    }
    return {};
  }

  BlockFileReader& file_;
  const std::size_t materials_, mirrors_;
  std::uint32_t streamBytes_ = 0;  ///< of coded light
  std::uint32_t samples_ = 0;
  std::uint8_t unusedBits_ = 0;
  std::vector<MeshCounts> meshes_;
  std::vector<std::uint32_t> firstTriangle_;  ///< by mesh
  Arrays arrays_;
  LocalGeometry local_;
  LocalSurfaces surfaces_;
};

}  // namespace

Result<LocalGeometry> readLocalFile(std::vector<std::byte> bytes, const std::string& name,
                                    std::size_t materials, std::size_t mirrors) {
  return withinMemory(name, [&]() -> Result<LocalGeometry> {
    auto file = BlockFileReader::of(std::move(bytes), name, BlockFileKind::localGeometry);
    if (!file) return tl::unexpected(file.error());
    return LocalFileReader(*file, materials, mirrors).read();
  });
}

}  // namespace acentric
