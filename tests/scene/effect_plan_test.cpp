#include "engine/scene/effect_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace acentric {
namespace {

using testing::HasSubstr;

/// One material on one triangle each.
Scene sceneWith(std::vector<Material> materials) {
  Scene scene;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    Mesh mesh;
    mesh.name = "mesh";
    mesh.material = int(i);
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.triangles = {{0, 1, 2}};
    scene.meshes.push_back(mesh);
  }
  scene.materials = std::move(materials);
  return scene;
}

Light lightOf(LightKind kind, const char* name) {
  Light light;
  light.kind = kind;
  light.name = name;
  return light;
}

Material named(const char* name) {
  Material material;
  material.name = name;
  return material;
}

TEST(EffectPlan, APlainSceneWithoutLightCallsForNothing) {
  const EffectPlan plan = planEffects(sceneWith({named("plain")}));
  for (int i = 0; i < kEffectCount; ++i) {
    const auto effect = Effect(i);
    EXPECT_FALSE(plan[effect].calledFor) << nameOf(effect);
    EXPECT_FALSE(plan.on(effect)) << nameOf(effect);
    EXPECT_FALSE(plan[effect].reason.empty()) << nameOf(effect);
  }
}

TEST(EffectPlan, EachMaterialPropertyCallsForItsEffect) {
  const auto calledBy = [](auto change) {
    Material material = named("brass");
    change(material);
    const EffectPlan plan = planEffects(sceneWith({material}));
    std::set<Effect> on;
    for (int i = 0; i < kEffectCount; ++i)
      if (plan.on(Effect(i))) {
        on.insert(Effect(i));
        EXPECT_THAT(plan[Effect(i)].reason, HasSubstr("brass"));
      }
    return on;
  };
  EXPECT_EQ(calledBy([](Material& m) { m.baseColourTexture.texture = 0; }), std::set{Effect::textures});
  EXPECT_EQ(calledBy([](Material& m) { m.alphaMode = AlphaMode::mask; }), std::set{Effect::alphaTest});
  EXPECT_EQ(calledBy([](Material& m) { m.alphaMode = AlphaMode::blend; }), std::set{Effect::alphaBlend});
  EXPECT_EQ(calledBy([](Material& m) { m.metallic = 1, m.roughness = 0.05f; }),
            std::set{Effect::mirrorReflection});
  EXPECT_EQ(calledBy([](Material& m) { m.metallic = 1, m.roughness = 0.2f; }), std::set<Effect>{});
  EXPECT_EQ(calledBy([](Material& m) { m.transmission = 0.5f; }), std::set{Effect::transmission});
  EXPECT_EQ(calledBy([](Material& m) { m.normalTexture.texture = 0; }), std::set{Effect::normalMaps});
  EXPECT_EQ(calledBy([](Material& m) { m.unlit = true; }), std::set{Effect::unlit});
}

TEST(EffectPlan, WhatGlowsLightsOthersOnlyIfBrightAndLargeEnough) {
  Material lamp = named("lamp");
  lamp.emissive = {0, 1, 0};
  Scene scene = sceneWith({lamp, named("wall")});
  const EffectPlan alone = planEffects(scene);
  for (const Effect effect :
       {Effect::emission, Effect::areaLights, Effect::softShadows, Effect::diffuseInterreflection})
    EXPECT_TRUE(alone.on(effect)) << nameOf(effect);
  EXPECT_FALSE(alone.on(Effect::hardShadows));
  EXPECT_THAT(alone[Effect::areaLights].reason, HasSubstr("lamp"));

  scene.lights = {lightOf(LightKind::directional, "sun")};
  scene.lights[0].intensity = 5;
  EXPECT_TRUE(planEffects(scene).on(Effect::areaLights));
  scene.lights[0].intensity = 5000;
  const EffectPlan outshone = planEffects(scene);
  EXPECT_TRUE(outshone.on(Effect::emission));
  EXPECT_FALSE(outshone.on(Effect::areaLights));
  EXPECT_FALSE(outshone.on(Effect::softShadows));
  EXPECT_THAT(outshone[Effect::areaLights].reason, HasSubstr("too faint or small"));
}

TEST(EffectPlan, LightsWithASizeCastSoftShadowsOnly) {
  Scene scene = sceneWith({named("wall")});
  scene.lights = {lightOf(LightKind::point, "bulb"), lightOf(LightKind::directional, "sun")};
  scene.lights[0].radius = 0.1f;
  const EffectPlan both = planEffects(scene);
  EXPECT_TRUE(both.on(Effect::hardShadows) && both.on(Effect::softShadows));
  EXPECT_THAT(both[Effect::softShadows].reason, HasSubstr("bulb"));
  scene.lights[1].angularRadius = 0.005f;
  EXPECT_FALSE(planEffects(scene).on(Effect::hardShadows));
  EXPECT_THAT(planEffects(scene)[Effect::softShadows].reason, HasSubstr("2 lights with a size"));
}

TEST(EffectPlan, LightsCallForTheirKindAndShadows) {
  Scene scene = sceneWith({named("wall")});
  scene.lights = {lightOf(LightKind::point, "lamp"), lightOf(LightKind::spot, "torch")};
  const EffectPlan local = planEffects(scene);
  EXPECT_FALSE(local.on(Effect::directionalLights));
  EXPECT_TRUE(local.on(Effect::pointLights));
  EXPECT_TRUE(local.on(Effect::spotLights));
  EXPECT_THAT(local[Effect::pointLights].reason, HasSubstr("1 point light: lamp"));
  EXPECT_TRUE(local.on(Effect::hardShadows));
  EXPECT_FALSE(local.on(Effect::softShadows));
  EXPECT_THAT(local[Effect::softShadows].reason, HasSubstr("no size"));
  EXPECT_TRUE(local.on(Effect::diffuseInterreflection));

  scene.lights = {lightOf(LightKind::directional, "sun")};
  EXPECT_FALSE(planEffects(scene).on(Effect::ambientOcclusion));
  scene.sky.zenith = glm::vec3(1);
  EXPECT_TRUE(planEffects(scene).on(Effect::ambientOcclusion));
  EXPECT_TRUE(planEffects(scene).on(Effect::sky));
}

TEST(EffectPlan, ADarkLightDoesNotCount) {
  Scene scene = sceneWith({named("wall")});
  scene.lights = {lightOf(LightKind::point, "off")};
  scene.lights[0].intensity = 0;
  EXPECT_FALSE(planEffects(scene)[Effect::pointLights].calledFor);
  EXPECT_FALSE(planEffects(scene)[Effect::hardShadows].calledFor);
}

TEST(EffectPlan, AllUnlitMeansNoLightAtAll) {
  Material unlit = named("sign");
  unlit.unlit = true;
  Scene scene = sceneWith({unlit});
  scene.lights = {lightOf(LightKind::directional, "sun"), lightOf(LightKind::point, "lamp")};
  scene.sky.zenith = glm::vec3(1);
  const EffectPlan plan = planEffects(scene);
  for (const Effect effect : {Effect::directionalLights, Effect::pointLights, Effect::sky,
                              Effect::hardShadows, Effect::ambientOcclusion, Effect::diffuseInterreflection})
    EXPECT_FALSE(plan[effect].calledFor) << nameOf(effect);
  EXPECT_TRUE(plan.on(Effect::unlit));
}

TEST(EffectPlan, BouncesAreCalledForByLampsAloneAndTakeTheOcclusionsPlace) {
  Scene scene = sceneWith({named("wall")});
  scene.lights = {lightOf(LightKind::point, "lamp")};
  const EffectPlan lamp = planEffects(scene);
  EXPECT_TRUE(lamp.on(Effect::diffuseInterreflection));
  EXPECT_FALSE(lamp.on(Effect::ambientOcclusion));
  const EffectPlan without = planEffects(scene, {{Effect::diffuseInterreflection, false}});
  EXPECT_FALSE(without.on(Effect::diffuseInterreflection));
  EXPECT_TRUE(without.on(Effect::ambientOcclusion));
  EXPECT_THAT(without[Effect::ambientOcclusion].reason, HasSubstr("stands in for bounced light"));

  scene.sky.zenith = glm::vec3(1);
  EXPECT_FALSE(planEffects(scene).on(Effect::diffuseInterreflection));
  EXPECT_TRUE(planEffects(scene).on(Effect::ambientOcclusion));
  const EffectPlan wanted = planEffects(scene, {{Effect::diffuseInterreflection, true}});
  EXPECT_TRUE(wanted.on(Effect::diffuseInterreflection));
  EXPECT_FALSE(wanted.on(Effect::ambientOcclusion));
}

TEST(EffectPlan, OverridesWinAndChangeTheKey) {
  Scene scene = sceneWith({named("wall")});
  scene.lights = {lightOf(LightKind::directional, "sun")};
  const EffectPlan plain = planEffects(scene);
  const EffectPlan off = planEffects(scene, {{Effect::hardShadows, false}});
  EXPECT_TRUE(off[Effect::hardShadows].calledFor);
  EXPECT_FALSE(off.on(Effect::hardShadows));
  EXPECT_TRUE(off[Effect::hardShadows].overridden);
  Hasher a, b;
  plain.addTo(a);
  off.addTo(b);
  EXPECT_NE(a.finish(), b.finish());
}

TEST(EffectPlan, MaterialsWithoutTrianglesAndWhiteVertexColoursDoNotCount) {
  Scene scene = sceneWith({named("used")});
  Material spare = named("spare");
  spare.emissive = glm::vec3(1);
  scene.materials.push_back(spare);
  scene.meshes[0].colours.assign(3, glm::u8vec4(255));
  EXPECT_FALSE(planEffects(scene).on(Effect::emission));
  EXPECT_FALSE(planEffects(scene).on(Effect::vertexColours));
  scene.meshes[0].colours[1] = {255, 0, 0, 255};
  EXPECT_TRUE(planEffects(scene).on(Effect::vertexColours));
}

TEST(EffectPlan, AReasonNamesAtMostThreeMaterials) {
  std::vector<Material> materials;
  for (const char* name : {"Floor", "Wall", "frame", "door"}) {
    materials.push_back(named(name));
    materials.back().baseColourTexture.texture = 0;
  }
  EXPECT_EQ(planEffects(sceneWith(materials))[Effect::textures].reason,
            "4 materials with textures: Floor, Wall, frame, ...");
}

TEST(EffectPlan, NamesAndLabelsAreAllDifferent) {
  std::set<std::string> names, labels;
  for (int i = 0; i < kEffectCount; ++i) names.insert(nameOf(Effect(i))), labels.insert(labelOf(Effect(i)));
  EXPECT_EQ(names.size(), std::size_t(kEffectCount));
  EXPECT_EQ(labels.size(), std::size_t(kEffectCount));
}

}  // namespace
}  // namespace acentric
