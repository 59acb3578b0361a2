/// What is off costs nothing: every published file that shows one effect, looked at from all around, and the
/// rays counted by their purpose.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/bake/shading.h"
#include "engine/scene/import.h"
#include "engine/scene/material_rules.h"
#include "tests/support/scenes.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> effectFiles() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(test::scenesFolder() / "gltf_effects"))
    if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
      files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

/// Rays traced for pictures from all around, and what they met.
struct Look {
  RayCounts rays;
  int lit = 0, clear = 0, mirror = 0;  ///< surfaces met first, by kind of material
  int sunny = 0;                       ///< lit ones that face some sun
};

Look lookAt(const RayScene& scene) {
  const Bounds& bounds = scene.scene().bounds;
  const float size = std::max(glm::length(bounds.size()), 1e-3f);
  BakeSettings settings;
  settings.surfaceTexel = std::clamp(double(size) / 10, kLeastBakeLength, kLargestBakeLength);
  settings.ambientRadius = std::clamp(double(size) / 4, kLeastBakeLength, kLargestBakeLength);
  settings.ambientRays = settings.shadowRays = 4;
  settings.bounces = 1;
  const Shader shader(scene, settings);
  const auto rules = materialRules(scene.scene(), scene.plan());
  const LightSet lights = lightSet(scene.scene(), scene.plan());
  Look look;
  constexpr int kEyes = 10, kSide = 5;
  for (int n = 0; n < kEyes; ++n) {
    const float z = 1 - (float(n) + 0.5f) * 2 / kEyes, flat = std::sqrt(1 - z * z);
    const glm::vec3 eye =
        bounds.centre() +
        1.2f * size * glm::vec3(flat * std::cos(2.4f * float(n)), flat * std::sin(2.4f * float(n)), z);
    for (int i = 0; i < kSide * kSide * kSide; ++i) {
      const glm::vec3 share((glm::vec3(i % kSide, i / kSide % kSide, i / kSide / kSide) + 0.37f) /
                            float(kSide));
      const Ray ray{eye, glm::normalize(bounds.min + share * bounds.size() - eye)};
      shader.seenAlong(ray, &RayCounts::primary, look.rays);
      const Hit hit = scene.trace(ray);
      if (!hit.found()) continue;
      const MaterialRules& rule = rules[std::size_t(scene.scene().meshes[hit.mesh].material)];
      look.clear += rule.clear() ? 1 : 0;
      look.mirror += rule.mirror && !rule.clear() ? 1 : 0;
      // Mirrors and clear surfaces need not be lit: those that are faint, or show something else, are not.
      if (rule.unlit || rule.mirror || rule.clear()) continue;
      ++look.lit;
      const Surface surface = surfaceAt<false>(scene.scene(), hit, -ray.direction, {}, false);
      for (const DirectionalSource& sun : lights.directional)
        look.sunny += glm::dot(surface.geometricNormal, sun.towards) > 0.3f &&
                              glm::dot(surface.normal, sun.towards) > 0.3f
                          ? 1
                          : 0;
    }
  }
  return look;
}

void expectNoRaysOfAbsentEffects(const EffectPlan& plan, const RayCounts& rays) {
  if (!plan.on(Effect::hardShadows)) {
    EXPECT_EQ(rays.shadow, 0u);
  }
  if (!plan.on(Effect::softShadows)) {
    EXPECT_EQ(rays.softShadow, 0u);
  }
  if (!plan.on(Effect::directionalLights) && !plan.on(Effect::pointLights) && !plan.on(Effect::spotLights)) {
    EXPECT_EQ(rays.shadow, 0u);
  }
  if (!plan.on(Effect::ambientOcclusion)) {
    EXPECT_EQ(rays.ambient, 0u);
  }
  if (!plan.on(Effect::diffuseInterreflection)) {
    EXPECT_EQ(rays.bounce, 0u);
  }
  if (!plan.on(Effect::mirrorReflection)) {
    EXPECT_EQ(rays.mirror, 0u);
  }
  if (!plan.on(Effect::transmission) && !plan.on(Effect::alphaBlend)) {
    EXPECT_EQ(rays.through, 0u);
  }
}

Look lookWith(const ScenePtr& scene, const EffectPlan& plan) {
  const auto rays = RayScene::build(scene, plan);
  EXPECT_TRUE(rays.has_value()) << (rays ? "" : rays.error().describe());
  const Look look = rays ? lookAt(**rays) : Look{};
  expectNoRaysOfAbsentEffects(plan, look.rays);
  return look;
}

TEST(EffectRays, OfAbsentEffectsAreNeverTracedAndOfPresentOnesAre) {
  ACENTRIC_NEEDS_SCENES();
  int looked = 0;
  RayCounts sum;
  for (const fs::path& file : effectFiles()) {
    auto parsed = parseScene(file, {});
    if (!parsed) continue;  // some files are to be refused
    SCOPED_TRACE(file.filename().string());
    const auto scene = std::make_shared<const Scene>(std::move(*parsed));
    const EffectPlan plan = planEffects(*scene);
    const Look look = lookWith(scene, plan);
    ++looked;
    sum += look.rays;
    if (look.lit > 0 && plan.on(Effect::ambientOcclusion)) {
      EXPECT_GT(look.rays.ambient, 0u);
    }
    if (look.lit > 0 && plan.on(Effect::diffuseInterreflection)) {
      EXPECT_GT(look.rays.bounce, 0u);
    }
    if (look.sunny > 0 && plan.on(Effect::hardShadows)) {
      EXPECT_GT(look.rays.shadow, 0u);
    }
    if (look.mirror > 0) {
      EXPECT_GT(look.rays.mirror, 0u);
    }
    if (look.clear > 0) {
      EXPECT_GT(look.rays.through, 0u);
    }

    // Everything off: what is seen first, and nothing else.
    EffectOverrides off;
    for (int e = 0; e < kEffectCount; ++e) off[Effect(e)] = false;
    const RayCounts bare = lookWith(scene, planEffects(*scene, off)).rays;
    EXPECT_EQ(bare.total(), bare.primary);
    EXPECT_EQ(bare.through, 0u);
  }
  EXPECT_GT(looked, 100);
  for (const auto counter : {&RayCounts::shadow, &RayCounts::softShadow, &RayCounts::ambient,
                             &RayCounts::mirror, &RayCounts::through})
    EXPECT_GT(sum.*counter, 0u) << "some file calls for it";
}

TEST(EffectRays, SwitchingOneEffectOffStopsItsRaysAndBouncesCanBeSwitchedOn) {
  ACENTRIC_NEEDS_SCENES();
  for (const char* name :
       {"playcanvas/Lights.glb", "blender_io/14_emission_strength/14_emission_strength.gltf",
        "blender_io/15_transmission/15_transmission.gltf"}) {
    SCOPED_TRACE(name);
    auto parsed = parseScene(test::scenesFolder() / "gltf_effects" / name, {});
    ASSERT_TRUE(parsed.has_value());
    const auto scene = std::make_shared<const Scene>(std::move(*parsed));
    const EffectPlan plan = planEffects(*scene);
    for (int e = 0; e < kEffectCount; ++e)
      if (plan.on(Effect(e))) lookWith(scene, planEffects(*scene, {{Effect(e), false}}));
    const Look bounced = lookWith(scene, planEffects(*scene, {{Effect::diffuseInterreflection, true}}));
    EXPECT_GT(bounced.rays.bounce, 0u);
    EXPECT_EQ(bounced.rays.ambient, 0u);
  }
}

}  // namespace
}  // namespace acentric
