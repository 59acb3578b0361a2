#pragma once
/// A baked project with everything that a bundle must bring over: mirrors, glass, textures with a
/// transparency, vertex colours, a lamp, a sky through a window, light on surfaces.

#include "engine/geometry/conventions.h"
#include "engine/pipeline/export_bundle.h"
#include "engine/pipeline/walk_source.h"
#include "tests/pipeline/small_project.h"

namespace acentric::test {

inline ColourImage checks() {
  ColourImage image(16, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x) {
      const bool hole = x % 4 == 1 && y % 4 == 1;
      image.at(x, y) = {std::uint8_t(40 + 12 * x), std::uint8_t(250 - 20 * y), 90, hole ? 0 : 255};
    }
  return image;
}

inline ScenePtr everythingScene() {
  SceneBuilder builder;
  Material floor = matte({0.9f, 0.8f, 0.7f});
  floor.baseColourTexture = builder.texture(checks());
  floor.baseColourTexture.transform = glm::mat3x2(3, 0.5f, -0.5f, 3, 0.1f, 0.2f);
  builder.quad(builder.material(floor), {-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0});
  builder.lastMesh().colours = {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {255, 255, 255, 255}};
  builder.box(builder.material(matte({0.5f, 0.6f, 0.7f})), {-4, -4, 0}, {4, 3.9f, 2.5f}, true);
  Material leaves = matte({0.4f, 0.9f, 0.3f});
  leaves.alphaMode = AlphaMode::mask;
  leaves.baseColourTexture = floor.baseColourTexture;
  builder.quad(builder.material(leaves), {-1, 0.9f, 0.4f}, {0, 0.9f, 0.4f}, {0, 0.9f, 1.8f},
               {-1, 0.9f, 1.8f});
  Material silver;
  silver.baseColour = {0.9f, 0.9f, 0.9f, 1};
  silver.roughness = 0;
  const int mirror = builder.material(silver);
  builder.quad(mirror, {2.2f, -2, 0.2f}, {2.2f, -2, 2.2f}, {2.2f, 2, 2.2f}, {2.2f, 2, 0.2f});
  builder.quad(mirror, {1.1f, -0.6f, 0.2f}, {1.1f, -0.6f, 1.7f}, {1.1f, 0.2f, 1.7f}, {1.1f, 0.2f, 0.2f});
  Material glass = matte({0.8f, 0.95f, 0.9f});
  glass.transmission = 0.8f;
  builder.quad(builder.material(glass), {-1.2f, -1, 0.2f}, {-1.2f, 0.4f, 0.2f}, {-1.2f, 0.4f, 2},
               {-1.2f, -1, 2});
  Material veil = matte({0.9f, 0.2f, 0.2f});
  veil.baseColour.a = 0.4f;
  veil.alphaMode = AlphaMode::blend;
  builder.quad(builder.material(veil), {-0.4f, -1.3f, 0.3f}, {0.5f, -1.3f, 0.3f}, {0.5f, -1.3f, 1.9f},
               {-0.4f, -1.3f, 1.9f});
  Material lamp = matte({0.1f, 0.1f, 0.1f});
  lamp.emissive = {3, 2, 1};
  builder.sphere(builder.material(lamp), {-0.7f, -0.6f, 2}, 0.25f, 10);
  Material sign = matte({0.1f, 0.8f, 0.9f});
  sign.unlit = true;
  builder.box(builder.material(sign), {0.4f, 0.6f, 0}, {0.7f, 0.9f, 1.1f});
  builder.sun({0.3f, 0.9f, -0.5f}, 3).sky({0.3f, 0.5f, 0.9f}, {0.8f, 0.8f, 0.9f}, {0.2f, 0.2f, 0.2f});
  return builder.scene();
}

inline Project everythingProject() {
  Project project = smallProject(1, 2);
  project.layout().outline.loops = {{{-0.3, -0.3}, {0.3, -0.3}, {0.3, 1.15}, {-0.3, 1.15}}};
  project.bake.ambientRays = 4;
  project.bake.maxLayers = 3;
  project.bake.surfaceTexel = 0.3;
  project.exposure = 0.8f;
  project.fovDegrees = 70;
  project.storeys.front().spawn = {{0.2, 0.1}, 0.5};
  project.bookmarks = {{"the lamp", 0, {0.1, -0.2, 1.6}, 0.25, -0.125, 50}};
  project.paths = {{"round", 0, {{{{0.1, 0.2, 1.6}, 0, 0, 0}, {{-0.2, 0.2, 1.6}, 1, 0.1, 2.5}}}}};
  return project;
}

/// Opened, with captures and light beside `file`.
inline OpenProject bakedProject(const std::filesystem::path& file, TaskRunner& runner) {
  const ScenePtr scene = everythingScene();
  EffectOverrides cheap;  // light from all around is not what bundles are about
  for (const Effect effect : {Effect::ambientOcclusion, Effect::diffuseInterreflection, Effect::areaLights})
    cheap[effect] = false;
  auto rays = RayScene::build(scene, planEffects(*scene, cheap));
  EXPECT_TRUE(rays);
  OpenProject open = openWith(*rays, everythingProject(), file);
  const auto baked = bakeProject(open, {}, runner);
  EXPECT_TRUE(baked) << (baked ? "" : baked.error().describe());
  return open;
}

/// Poses that see all of it, of one picture size.
inline std::vector<PerspectiveView> everyView(const Layout& layout) {
  std::vector<PerspectiveView> views;
  for (const glm::dvec2 eye : {glm::dvec2(0.15, 0.1), glm::dvec2(-0.25, -0.2), glm::dvec2(0.1, 1.12)})
    for (const double degrees : {0.0, 100.0, 200.0, 290.0}) {
      PerspectiveView view;
      view.eye = glm::dvec3(eye, layout.eyeZ());
      view.yawRadians = radians(degrees), view.pitchRadians = radians(degrees / 20 - 8);
      view.fovRadians = radians(80);
      view.width = 160, view.height = 110;
      views.push_back(view);
    }
  return views;
}

}  // namespace acentric::test
