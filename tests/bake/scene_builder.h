#pragma once
/// Small scenes made by hand, whose light and distances are known by a formula.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <utility>

#include "engine/bake/ray_scene.h"
#include "engine/scene/effect_plan.h"
#include "engine/scene/scene.h"

namespace acentric::test {

inline Material matte(glm::vec3 colour = glm::vec3(1)) {
  Material m;
  m.name = "matte";
  m.baseColour = glm::vec4(colour, 1);
  m.metallic = 0;
  return m;
}

/// Of white and black texels.
inline ColourImage chequers(int size) {
  ColourImage image(size, size, {0, 0, 0, 255});
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      if ((x + y) % 2 == 0) image.at(x, y) = {255, 255, 255, 255};
  return image;
}

class SceneBuilder {
 public:
  SceneBuilder() { scene_.name = "made by hand"; }

  int material(const Material& m) {
    scene_.materials.push_back(m);
    return int(scene_.materials.size()) - 1;
  }

  /// Corners counter-clockwise as seen from the front.
  SceneBuilder& quad(int material, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
    Mesh& mesh = newMesh(material);
    mesh.positions = {a, b, c, d};
    mesh.normals.assign(4, glm::normalize(glm::cross(b - a, c - a)));
    mesh.uv[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return *this;
  }
  /// A horizontal square that faces up.
  SceneBuilder& floor(int material, float halfSize, float z = 0, glm::vec2 centre = glm::vec2(0)) {
    const float h = halfSize;
    return quad(material, {centre.x - h, centre.y - h, z}, {centre.x + h, centre.y - h, z},
                {centre.x + h, centre.y + h, z}, {centre.x - h, centre.y + h, z});
  }
  /// Six sides that face outwards, or inwards (a room).
  SceneBuilder& box(int material, glm::vec3 lo, glm::vec3 hi, bool inwards = false) {
    const auto corner = [&](int i) {
      return glm::vec3((i & 1) ? hi.x : lo.x, (i & 2) ? hi.y : lo.y, (i & 4) ? hi.z : lo.z);
    };
    constexpr std::array<std::array<int, 4>, 6> kSides{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {3, 2, 6, 7}, {2, 0, 4, 6}, {1, 3, 7, 5}}};
    for (const auto& s : kSides) {
      if (inwards)
        quad(material, corner(s[3]), corner(s[2]), corner(s[1]), corner(s[0]));
      else
        quad(material, corner(s[0]), corner(s[1]), corner(s[2]), corner(s[3]));
    }
    return *this;
  }
  Mesh& lastMesh() { return scene_.meshes.back(); }

  SceneBuilder& sun(glm::vec3 direction, float lux, glm::vec3 colour = glm::vec3(1)) {
    Light light;
    light.direction = glm::normalize(direction);
    light.intensity = lux;
    light.colour = colour;
    scene_.lights.push_back(light);
    return *this;
  }
  SceneBuilder& point(glm::vec3 position, float candela, float range = 0) {
    Light light;
    light.kind = LightKind::point;
    light.position = position;
    light.intensity = candela;
    light.range = range;
    scene_.lights.push_back(light);
    return *this;
  }
  SceneBuilder& spot(glm::vec3 position, glm::vec3 direction, float candela, float inner, float outer) {
    point(position, candela);
    Light& light = scene_.lights.back();
    light.kind = LightKind::spot;
    light.direction = glm::normalize(direction);
    light.innerCone = inner;
    light.outerCone = outer;
    return *this;
  }
  /// Size of the light added last: metres of a lamp, radians of a sun.
  SceneBuilder& size(float radius) {
    Light& light = scene_.lights.back();
    (light.kind == LightKind::directional ? light.angularRadius : light.radius) = radius;
    return *this;
  }
  /// A sphere of `rings` x 2 `rings` faces, turned outwards.
  SceneBuilder& sphere(int material, glm::vec3 centre, float radius, int rings) {
    Mesh& mesh = newMesh(material);
    const float pi = 3.14159265f;
    for (int i = 0; i <= rings; ++i)
      for (int j = 0; j <= 2 * rings; ++j) {
        const float polar = pi * float(i) / float(rings), around = pi * float(j) / float(rings);
        const glm::vec3 out(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
                            std::cos(polar));
        mesh.positions.push_back(centre + radius * out);
        mesh.normals.push_back(out);
      }
    const auto at = [&](int i, int j) { return std::uint32_t(i * (2 * rings + 1) + j); };
    for (int i = 0; i < rings; ++i)
      for (int j = 0; j < 2 * rings; ++j) {
        if (i > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + 1 < rings) mesh.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
      }
    return *this;
  }
  SceneBuilder& sky(glm::vec3 everywhere) { return sky(everywhere, everywhere, everywhere); }
  SceneBuilder& sky(glm::vec3 zenith, glm::vec3 horizon, glm::vec3 ground) {
    scene_.sky = {zenith, horizon, ground};
    return *this;
  }
  TextureUse texture(ColourImage image) {
    scene_.images.push_back(std::make_shared<ColourImage>(std::move(image)));
    Texture texture;
    texture.image = int(scene_.images.size()) - 1;
    texture.nearest = true;
    scene_.textures.push_back(texture);
    TextureUse use;
    use.texture = int(scene_.textures.size()) - 1;
    return use;
  }

  ScenePtr scene() const {
    auto made = std::make_shared<Scene>(scene_);
    made->bounds = boundsOf(*made);
    made->parts = partsOf(*made);
    made->key = keyOf(made->parts);
    return made;
  }
  /// Traceable, with the effects that the scene calls for less those named.
  RayScenePtr rays(std::initializer_list<Effect> off = {}) const {
    const ScenePtr made = scene();
    EffectOverrides overrides;
    for (const Effect effect : off) overrides[effect] = false;
    auto built = RayScene::build(made, planEffects(*made, overrides));
    EXPECT_TRUE(built.has_value()) << (built ? "" : built.error().describe());
    return built ? *built : nullptr;
  }

 private:
  Mesh& newMesh(int material) {
    scene_.meshes.emplace_back();
    scene_.meshes.back().name = "mesh " + std::to_string(scene_.meshes.size());
    scene_.meshes.back().material = material;
    return scene_.meshes.back();
  }
  Scene scene_;
};

inline void expectNear(const glm::vec3& actual, const glm::vec3& expected, float relative) {
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(actual[i], expected[i], relative * std::max(std::abs(expected[i]), 1e-6f)) << "channel " << i;
}

}  // namespace acentric::test
