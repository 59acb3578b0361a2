#include "engine/export/crop_light.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/scene/mesh_attributes.h"

namespace acentric {
namespace {

/// A floor of two triangles, 20 m wide, lit by place; near are triangles of these corners.
LocalGeometry floorNear(const std::vector<glm::vec2>& places, std::uint16_t resolution, bool back) {
  auto surfaces = std::make_shared<LocalSurfaces>();
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {20, 0, 0}, {20, 20, 0}, {0, 20, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  for (const glm::vec3& p : mesh.positions) mesh.uv[0].emplace_back(p.x / 20, p.y / 10);
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  SurfaceLight& light = surfaces->light;
  for (const glm::uvec3& corners : mesh.triangles) {
    light.firstSample.push_back(std::uint32_t(light.light.size()));
    light.resolution.push_back(resolution);
    light.hasBack.push_back(back ? 1 : 0);
    for (int side = 0; side <= int(back); ++side)
      for (int i = 0; i <= resolution; ++i)
        for (int j = 0; i + j <= resolution; ++j) {
          const glm::vec3 p = interpolate(mesh.positions, corners, glm::vec2(i, j) / float(resolution));
          light.light.push_back(packColour({p.x, p.y, float(side), 1}));
        }
  }
  light.firstSample.push_back(std::uint32_t(light.light.size()));
  surfaces->meshes.push_back(mesh);
  LocalGeometry local;
  local.surfaces = surfaces;
  for (std::size_t i = 0; i + 2 < places.size(); i += 3) {
    const std::uint32_t first = std::uint32_t(local.vertices.size());
    const glm::vec2 middle = places[i] + places[i + 1] + places[i + 2];
    const bool lower = middle.x >= middle.y;
    for (std::size_t c = i; c < i + 3; ++c) {
      const glm::vec2 p = places[c] / 20.0f;
      local.vertices.push_back(
          {{places[c], 0}, lower ? glm::vec2(p.x - p.y, p.y) : glm::vec2(p.x, p.y - p.x)});
    }
    local.triangles.push_back({{first, first + 1, first + 2}, 0, lower ? 0u : 1u});
  }
  return local;
}

void expectSame(const LocalGeometry& a, const LocalGeometry& b, bool back) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> share(0, 1);
  for (std::size_t t = 0; t < a.triangles.size(); ++t)
    for (int n = 0; n < 50; ++n) {
      glm::vec2 weights(share(random), share(random));
      if (weights.x + weights.y > 1) weights = 1.0f - weights;
      const auto at = [&](const LocalGeometry& local, auto value) {
        const LocalTriangle& triangle = local.triangles[t];
        const auto& v = local.vertices;
        const glm::vec2 place = v[triangle.vertices.x].barycentric * (1 - weights.x - weights.y) +
                                v[triangle.vertices.y].barycentric * weights.x +
                                v[triangle.vertices.z].barycentric * weights.y;
        return value(local.surfaces->meshes[0], triangle.triangle, place, local.surfaces->light);
      };
      const auto uv = [](const Mesh& mesh, std::uint32_t source, const glm::vec2& place,
                         const SurfaceLight&) {
        return interpolate(mesh.uv[0], mesh.triangles[source], place);
      };
      const auto light = [&](const Mesh&, std::uint32_t source, const glm::vec2& place,
                             const SurfaceLight& from) { return from.at(source, place, back); };
      EXPECT_LT(glm::distance(at(a, uv), at(b, uv)), 1e-5f);
      EXPECT_LT(glm::distance(at(a, light), at(b, light)), 1e-2f);
    }
}

TEST(CropLight, LeavesWhatIsNearAsItWas) {
  for (const bool back : {false, true}) {
    // At the end of the hypotenuse, in a corner, in the middle of a side, and turned against the source.
    const LocalGeometry local =
        floorNear({{17, 15}, {19, 15}, {19, 16}, {1, 15}, {3, 15}, {3, 18}}, 100, back);
    const LocalGeometry cropped = croppedLight(local);
    EXPECT_LT(cropped.surfaces->light.light.size(), local.surfaces->light.light.size() / 8);
    expectSame(local, cropped, back);
  }
}

TEST(CropLight, KeepsWhatIsNearAllOver) {
  const LocalGeometry local = floorNear({{0, 0}, {20, 0}, {20, 20}, {0, 0}, {20, 20}, {0, 20}}, 40, false);
  const LocalGeometry cropped = croppedLight(local);
  EXPECT_TRUE(cropped.surfaces->light.light == local.surfaces->light.light);
  EXPECT_EQ(cropped.surfaces->meshes[0].positions, local.surfaces->meshes[0].positions);
  expectSame(local, cropped, false);
}

TEST(CropLight, HoldsWhateverIsUsed) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(0, 20);
  for (int n = 0; n < 200; ++n) {
    std::vector<glm::vec2> places;
    const glm::vec2 middle(place(random), place(random));
    for (int c = 0; c < 3; ++c) {
      glm::vec2 p = glm::clamp(middle + 0.1f * glm::vec2(place(random), place(random)), 0.0f, 20.0f);
      if ((p.x >= p.y) != (middle.x >= middle.y)) std::swap(p.x, p.y);
      places.push_back(p);
    }
    if (middle.x < middle.y)
      for (glm::vec2& p : places) p.y = std::max(p.y, std::nextafter(p.x, 30.0f));
    const LocalGeometry local = floorNear(places, std::uint16_t(1 + n), n % 2 == 0);
    const LocalGeometry cropped = croppedLight(local);
    for (const LocalVertex& v : cropped.vertices) {
      EXPECT_GE(std::min(v.barycentric.x, v.barycentric.y), -1e-4f);
      EXPECT_LE(v.barycentric.x + v.barycentric.y, 1 + 1e-4f);
    }
    expectSame(local, cropped, false);
  }
}

}  // namespace
}  // namespace acentric
