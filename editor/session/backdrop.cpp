#include "editor/session/backdrop.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/image/colour.h"
#include "engine/scene/instances.h"
#include "engine/scene/texture_lookup.h"

namespace acentric::editor {
namespace {

constexpr Rgba8 kCutLine{206, 212, 222, 255};
constexpr Rgba8 kSolid{8, 9, 11, 255};
constexpr float kDim = 0.16F;  // the lattice is drawn over it and must stand out

glm::vec4 materialColour(const Scene& scene, const Hit& hit) {
  const Mesh& mesh = scene.meshOf(hit.mesh);
  const Material& material = scene.materials[std::size_t(mesh.material)];
  glm::vec4 colour = material.baseColour;
  const auto& uvs = mesh.uv[material.baseColourTexture.uvSet];
  if (material.baseColourTexture.used() && !uvs.empty()) {
    const glm::uvec3 corner = mesh.triangles[hit.triangle];
    const float b0 = 1 - hit.barycentric.x - hit.barycentric.y;
    const glm::vec2 uv =
        b0 * uvs[corner.x] + hit.barycentric.x * uvs[corner.y] + hit.barycentric.y * uvs[corner.z];
    colour *= sampleColour(scene, material.baseColourTexture, uv);
  }
  return colour;
}

/// Lit from above and a little from the side, darker towards the floor, so that heights read.
Rgba8 shade(const Scene& scene, const Hit& hit, float cutHeight, float floorHeight) {
  const Material& material = scene.materials[std::size_t(scene.meshOf(hit.mesh).material)];
  // Looking down and meeting the back of a one-sided surface: the cut went through a solid.
  const glm::vec3 wound = hit.geometricNormal();
  if (wound.z < 0 && !material.doubleSided) return kSolid;
  const glm::vec3 normal = wound.z < 0 ? -wound : wound;
  const float light =
      0.35F + 0.65F * std::max(0.0F, glm::dot(normal, glm::normalize(glm::vec3(-0.35F, 0.45F, 1.0F))));
  const float height = cutHeight - hit.distance;
  const float range = std::max(0.1F, cutHeight - floorHeight);
  const float lift = 0.8F + 0.35F * std::clamp((height - floorHeight) / range, 0.0F, 1.0F);
  const glm::vec3 colour = glm::vec3(materialColour(scene, hit));
  const float grey = glm::dot(colour, glm::vec3(0.2126F, 0.7152F, 0.0722F));
  const glm::vec3 calm = glm::mix(glm::vec3(grey), colour, 0.7F) + 0.02F;
  return encodeForDisplay(calm * (light * lift * kDim), 1.0F);
}

struct Raster {
  ColourImage& picture;
  glm::dvec2 min;
  double pixelsPerMetre;

  glm::dvec2 pixelOf(const glm::dvec2& world) const {
    const glm::dvec2 offset = (world - min) * pixelsPerMetre;
    return {offset.x, double(picture.height) - offset.y};
  }
  void line(glm::dvec2 a, glm::dvec2 b) const {
    const glm::dvec2 size(picture.width, picture.height);
    const glm::dvec2 low = glm::min(a, b);
    const glm::dvec2 high = glm::max(a, b);
    if (high.x < 0 || high.y < 0 || low.x >= size.x || low.y >= size.y) return;
    const double length = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
    // A line far longer than the picture is walked only where it can be seen.
    const int steps = int(std::clamp(std::ceil(length), 1.0, 1e5));
    for (int i = 0; i <= steps; ++i) {
      const glm::dvec2 p = a + (b - a) * (double(i) / steps);
      const int x = int(std::floor(p.x));
      const int y = int(std::floor(p.y));
      if (x >= 0 && y >= 0 && x < picture.width && y < picture.height) picture.at(x, y) = kCutLine;
    }
  }
};

/// Where the plane z = height cuts a triangle, if it does.
std::optional<std::pair<glm::dvec2, glm::dvec2>> cutTriangle(const std::array<glm::vec3, 3>& corners,
                                                             float height) {
  std::array<glm::dvec2, 3> points;
  int found = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 a(corners[i]);
    const glm::dvec3 b(corners[(i + 1) % 3]);
    if ((a.z < height) == (b.z < height)) continue;
    const double t = (height - a.z) / (b.z - a.z);
    points[std::size_t(found++)] = glm::dvec2(a) + t * (glm::dvec2(b) - glm::dvec2(a));
  }
  if (found != 2) return std::nullopt;
  return std::pair(points[0], points[1]);
}

void drawCuts(const Scene& scene, float height, const Raster& raster, const std::stop_token& stop) {
  const std::vector<Bounds> own = boundsOf(scene.prototypes);
  for (std::uint32_t m = 0; m < scene.placedCount(); ++m) {
    if (stop.stop_requested()) return;
    if (scene.isInstance(m)) {
      const Instance& instance = scene.instances[m - scene.meshes.size()];
      const Bounds box = boundsOf(instance, own[instance.prototype]);
      if (!(box.min.z < height && box.max.z >= height)) continue;
    }
    const PlacedMesh placed(scene, m);
    for (std::uint32_t t = 0; t < placed.mesh().triangles.size(); ++t)
      if (const auto cut = cutTriangle(placed.corners(t), height))
        raster.line(raster.pixelOf(cut->first), raster.pixelOf(cut->second));
  }
}

}  // namespace

PlanBox planBoxOf(const Bounds& scene, const Layout& layout, const Outline& walkable) {
  constexpr double kReach = 1.5;  // times what is laid out, to each side: more would be drawn too coarsely
  if (scene.empty()) return {{-5, -5}, {5, 5}};
  const glm::dvec2 sceneMin(scene.min.x, scene.min.y);
  const glm::dvec2 sceneMax(scene.max.x, scene.max.y);
  glm::dvec2 low(std::numeric_limits<double>::max());
  glm::dvec2 high(std::numeric_limits<double>::lowest());
  const auto add = [&](const glm::dvec2& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  };
  for (const Region& region : layout.regions)
    for (const glm::dvec2& corner : region.polygon.corners) add(corner);
  for (const auto& loop : layout.spec.outline.loops)
    for (const glm::dvec2& corner : loop) add(corner);
  if (low.x > high.x) return {sceneMin, sceneMax};
  const glm::dvec2 size = high - low;
  const double reach = kReach * std::max(size.x, size.y);
  const glm::dvec2 least = low - reach, most = high + reach;
  for (const auto& loop : walkable.loops)
    for (const glm::dvec2& corner : loop) add(glm::clamp(corner, least, most));
  const glm::dvec2 room = 0.25 * (high - low) + 2.0;
  const PlanBox box{glm::max(sceneMin, low - room), glm::min(sceneMax, high + room)};
  const bool apart = box.min.x >= box.max.x || box.min.y >= box.max.y;  // laid out beside the scene
  return apart ? PlanBox{sceneMin, sceneMax} : box;
}

std::optional<Backdrop> drawBackdrop(const RayScene& scene, double cutHeight, const PlanBox& box, int pixels,
                                     TaskRunner& runner, std::stop_token stop) {
  const glm::dvec2 size = glm::max(box.max - box.min, glm::dvec2(1e-3));
  constexpr double kLongestSide = 4096;
  const double pixelsPerMetre =
      std::min(pixels / std::sqrt(size.x * size.y), kLongestSide / std::max(size.x, size.y));
  Backdrop backdrop;
  backdrop.min = box.min;
  backdrop.picture = ColourImage(std::max(1, int(std::lround(size.x * pixelsPerMetre))),
                                 std::max(1, int(std::lround(size.y * pixelsPerMetre))), Rgba8(0));
  ColourImage& picture = backdrop.picture;
  backdrop.max = box.min + glm::dvec2(picture.width, picture.height) / pixelsPerMetre;
  const float floorHeight = scene.scene().bounds.min.z;
  const float cut = float(cutHeight);
  runner.parallelFor(std::size_t(picture.height), [&](std::size_t row) {
    if (stop.stop_requested()) return;
    const double y = box.min.y + (picture.height - double(row) - 0.5) / pixelsPerMetre;
    for (int x = 0; x < picture.width; ++x) {
      const glm::vec3 origin(float(box.min.x + (x + 0.5) / pixelsPerMetre), float(y), cut);
      const Hit hit = scene.trace({origin, {0, 0, -1}});
      if (hit.found()) picture.at(x, int(row)) = shade(scene.scene(), hit, cut, floorHeight);
    }
  });
  if (!stop.stop_requested()) drawCuts(scene.scene(), cut, {picture, box.min, pixelsPerMetre}, stop);
  if (stop.stop_requested()) return std::nullopt;
  return backdrop;
}

}  // namespace acentric::editor
