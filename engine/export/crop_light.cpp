#include "engine/export/crop_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "engine/scene/mesh_attributes.h"

namespace acentric {
namespace {

/// A triangle of the lattice of a source triangle's samples: from its first corner `size` steps up both axes,
/// or down both (then it is turned by half a turn).
struct LatticeTriangle {
  glm::ivec2 first{0};
  int size = 0;
  bool down = false;

  glm::ivec2 at(int i, int j) const { return down ? first - glm::ivec2(i, j) : first + glm::ivec2(i, j); }
  glm::vec2 inside(const glm::vec2& place) const {
    return (down ? glm::vec2(first) - place : place - glm::vec2(first)) / float(size);
  }
};

/// What is used of a source triangle, in steps of its samples.
struct Used {
  glm::vec2 low{std::numeric_limits<float>::max()}, high{-std::numeric_limits<float>::max()};
  float lowSum = std::numeric_limits<float>::max(), highSum = -std::numeric_limits<float>::max();

  void add(const glm::vec2& place) {
    low = glm::min(low, place), high = glm::max(high, place);
    lowSum = std::min(lowSum, place.x + place.y), highSum = std::max(highSum, place.x + place.y);
  }
};

/// Source triangles of which at least so much is left are kept.
constexpr double kMostKept = 0.7;

/// The smaller of the two that hold what is used; of size 0 where that is no less than most of the whole.
LatticeTriangle smallest(const Used& used, int resolution) {
  const auto within = [&](float value) { return std::clamp(int(value), 0, resolution); };
  const glm::ivec2 low(within(std::floor(used.low.x)), within(std::floor(used.low.y)));
  const glm::ivec2 high(within(std::ceil(used.high.x)), within(std::ceil(used.high.y)));
  const int up = within(std::ceil(used.highSum)) - low.x - low.y;
  const int down = high.x + high.y - within(std::floor(used.lowSum));
  // One that is turned must not reach beyond the axes.
  const bool turned = down < up && high.x >= down && high.y >= down && high.x + high.y <= resolution;
  const LatticeTriangle triangle{turned ? high : low, std::max(turned ? down : up, 1), turned};
  const double kept = double(triangle.size) / resolution;
  return kept * kept > kMostKept || (!turned && low.x + low.y + triangle.size > resolution)
             ? LatticeTriangle{}
             : triangle;
}

class Cropper {
 public:
  Cropper(const LocalGeometry& local, int unusedBits)
      : local_(local), from_(*local.surfaces), unusedBits_(unusedBits), out_(local) {}

  LocalGeometry crop() {
    const std::vector<std::uint32_t> first = firstTrianglesOf(from_.meshes);
    findUsed(first);
    surfaces_.mirrorPlanes = from_.mirrorPlanes;
    for (std::size_t m = 0; m < from_.meshes.size(); ++m) cropMesh(from_.meshes[m], first[m]);
    surfaces_.light.firstSample.push_back(std::uint32_t(surfaces_.light.light.size()));
    if (surfaces_.light.light.empty()) surfaces_.light = from_.light;
    for (HalfColour& light : surfaces_.light.light) light = roundedLight(light, unusedBits_);
    std::vector<char> moved(out_.vertices.size(), 0);
    for (const LocalTriangle& t : out_.triangles) {
      const std::uint32_t source = first[t.mesh] + t.triangle;
      const LatticeTriangle& crop = crops_[source];
      if (crop.size == 0) continue;
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t vertex = t.vertices[c];
        if (std::exchange(moved[vertex], 1) != 0) continue;
        glm::vec2& place = out_.vertices[vertex].barycentric;
        place = crop.inside(place * float(from_.light.resolution[source]));
      }
    }
    out_.surfaces = std::make_shared<const LocalSurfaces>(std::move(surfaces_));
    return std::move(out_);
  }

 private:
  void findUsed(const std::vector<std::uint32_t>& first) {
    std::vector<Used> used(from_.light.resolution.size());
    for (const LocalTriangle& t : local_.triangles) {
      const std::uint32_t source = first[t.mesh] + t.triangle;
      for (int c = 0; c < 3; ++c)
        used[source].add(local_.vertices[t.vertices[c]].barycentric * float(from_.light.resolution[source]));
    }
    for (std::size_t source = 0; source < used.size(); ++source)
      crops_.push_back(from_.light.resolution[source] > 1
                           ? smallest(used[source], from_.light.resolution[source])
                           : LatticeTriangle{});
  }

  void cropMesh(const Mesh& from, std::uint32_t first) {
    Mesh to;
    to.material = from.material;
    constexpr std::uint32_t kNone = 0xffffffff;
    std::vector<std::uint32_t> taken(from.positions.size(), kNone);
    for (std::size_t t = 0; t < from.triangles.size(); ++t) {
      const glm::uvec3& corners = from.triangles[t];
      // Colours have 8 bits: those between corners cannot be told.
      if (!from.colours.empty()) crops_[first + t] = {};
      const LatticeTriangle& crop = crops_[first + t];
      const int resolution = from_.light.resolution[first + t];
      glm::uvec3 added(0);
      for (int c = 0; c < 3; ++c) {
        if (crop.size > 0) {
          const glm::ivec2 at = crop.at(c == 1 ? crop.size : 0, c == 2 ? crop.size : 0);
          added[c] = addVertex(from, corners, glm::vec2(at) / float(resolution), to);
          continue;
        }
        std::uint32_t& place = taken[corners[c]];
        if (place == kNone) place = addVertex(from, glm::uvec3(corners[c]), glm::vec2(0), to);
        added[c] = place;
      }
      to.triangles.push_back(added);
      addLight(first + std::uint32_t(t), crop, resolution);
    }
    surfaces_.meshes.push_back(std::move(to));
  }

  static std::uint32_t addVertex(const Mesh& from, const glm::uvec3& corners, const glm::vec2& place,
                                 Mesh& to) {
    to.positions.push_back(interpolate(from.positions, corners, place));
    if (!from.normals.empty()) to.normals.push_back(interpolate(from.normals, corners, place));
    for (std::size_t set = 0; set < 2; ++set)
      if (!from.uv[set].empty()) to.uv[set].push_back(interpolate(from.uv[set], corners, place));
    if (!from.colours.empty()) to.colours.push_back(from.colours[corners.x]);
    return std::uint32_t(to.positions.size() - 1);
  }

  void addLight(std::uint32_t source, const LatticeTriangle& crop, int resolution) {
    SurfaceLight& to = surfaces_.light;
    const int size = crop.size > 0 ? crop.size : resolution;
    to.firstSample.push_back(std::uint32_t(to.light.size()));
    to.resolution.push_back(std::uint16_t(size));
    to.hasBack.push_back(from_.light.hasBack[source]);
    if (resolution == 0) return;
    for (int side = 0; side <= from_.light.hasBack[source]; ++side) {
      const HalfColour* samples = from_.light.light.data() + from_.light.firstSample[source] +
                                  std::size_t(side) * surfaceSampleCount(std::uint32_t(resolution));
      for (int i = 0; i <= size; ++i)
        for (int j = 0; i + j <= size; ++j) {
          const glm::ivec2 at = crop.size > 0 ? crop.at(i, j) : glm::ivec2(i, j);
          to.light.push_back(samples[surfaceSampleIndex(std::uint32_t(resolution), std::uint32_t(at.x),
                                                        std::uint32_t(at.y))]);
        }
    }
  }

  const LocalGeometry& local_;
  const LocalSurfaces& from_;
  const int unusedBits_;
  LocalGeometry out_;
  LocalSurfaces surfaces_;
  std::vector<LatticeTriangle> crops_;  ///< by source triangle; of size 0: it is kept
};

}  // namespace

LocalGeometry croppedLight(const LocalGeometry& local, int unusedBits) {
  return local.surfaces->light.empty() ? local : Cropper(local, unusedBits).crop();
}

}  // namespace acentric
