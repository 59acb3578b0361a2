/// One property each, read from small published files whose figures are known.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/scene/effect_plan.h"
#include "tests/scene/scene_fixtures.h"

namespace acentric::test {
namespace {

class EffectFiles : public testing::Test {
 protected:
  void SetUp() override { ACENTRIC_NEEDS_SCENES(); }

  static Scene parsed(const std::string& file) {
    auto scene = parseScene(scenesFolder() / "gltf_effects" / file, {});
    if (!scene) {
      ADD_FAILURE() << scene.error().describe();
      return {};
    }
    expectSound(*scene);
    return std::move(*scene);
  }
  static Scene blender(const std::string& name) {
    return parsed("blender_io/" + name + "/" + name + ".gltf");
  }
  static const Material* material(const Scene& scene, const std::string& name) {
    for (const Material& m : scene.materials)
      if (m.name == name) return &m;
    ADD_FAILURE() << "no material " << name;
    return &scene.materials.front();
  }
};

TEST_F(EffectFiles, TextureTransform) {
  const Scene scene = blender("09_texture_transform");
  const Material& m = *material(scene, "Material");
  // offset (0.1, 0.2), rotation 0.3, scale (4, 5) at uv (1, 1)
  const glm::vec2 got = m.baseColourTexture.transform * glm::vec3(1, 1, 1);
  const float c = std::cos(0.3f), s = std::sin(0.3f);
  EXPECT_NEAR(got.x, c * 4 + s * 5 + 0.1f, 1e-5f);
  EXPECT_NEAR(got.y, -s * 4 + c * 5 + 0.2f, 1e-5f);
  EXPECT_NE(m.normalTexture.transform, m.baseColourTexture.transform);
  EXPECT_TRUE(planEffects(scene).on(Effect::normalMaps));
}

TEST_F(EffectFiles, LightsOfEveryKind) {
  const Scene scene = parsed("playcanvas/Lights.glb");
  ASSERT_EQ(scene.lights.size(), 4u);
  EXPECT_EQ(scene.lights[0].kind, LightKind::point);
  EXPECT_EQ(scene.lights[0].colour, glm::vec3(1, 0, 0));
  EXPECT_FLOAT_EQ(scene.lights[0].intensity, 5);
  EXPECT_LT(glm::distance(scene.lights[0].position, glm::vec3(2.5988045f, 1.0054539f, 3.5685081f)), 1e-5f);
  EXPECT_EQ(scene.lights[1].kind, LightKind::spot);
  EXPECT_NEAR(scene.lights[1].outerCone, 0.3926991f, 1e-6f);
  EXPECT_LT(glm::distance(scene.lights[1].direction, glm::vec3(0, 0, -1)), 1e-5f);
  EXPECT_EQ(scene.lights[3].kind, LightKind::directional);
  EXPECT_TRUE(scene.sky.present());
  const EffectPlan plan = planEffects(scene);
  for (const Effect effect :
       {Effect::directionalLights, Effect::pointLights, Effect::spotLights, Effect::sky, Effect::hardShadows})
    EXPECT_TRUE(plan.on(effect)) << nameOf(effect);
}

TEST_F(EffectFiles, AlphaMaskCutoff) {
  const Scene scene = blender("01_alpha_mask");
  const Material& m = *material(scene, "Alpha_Mask");
  EXPECT_EQ(m.alphaMode, AlphaMode::mask);
  EXPECT_FLOAT_EQ(m.alphaCutoff, 0.42f);
  EXPECT_TRUE(m.doubleSided);
  EXPECT_EQ(m.baseColour, glm::vec4(1, 0, 0, 1));
  EXPECT_TRUE(planEffects(scene).on(Effect::alphaTest));
  EXPECT_FLOAT_EQ(
      parsed("asset_generator/Material_AlphaMask/Material_AlphaMask_03.gltf").materials[0].alphaCutoff, 1.1f);
  EXPECT_FLOAT_EQ(
      parsed("asset_generator/Material_AlphaMask/Material_AlphaMask_00.gltf").materials[0].alphaCutoff, 0.5f);
}

TEST_F(EffectFiles, EmissiveStrength) {
  const Scene scene = blender("14_emission_strength");
  const Material& strong = *material(scene, "pbrEmissiveStrength");
  EXPECT_LT(glm::distance(strong.emissive, glm::vec3(4.5f, 4.0f, 3.5f)), 1e-5f);
  EXPECT_LT(glm::distance(material(scene, "pbrEmissive")->emissive, glm::vec3(0.9f, 0.8f, 0.7f)), 1e-6f);
  EXPECT_EQ(material(scene, "SpecGloss")->metallic, 0);
  EXPECT_EQ(material(scene, "SpecGloss")->roughness, 1);
}

TEST_F(EffectFiles, TransmissionAndUnlit) {
  const Scene scene = blender("15_transmission");
  EXPECT_FLOAT_EQ(material(scene, "transmissionFactor")->transmission, 0.8f);
  EXPECT_FLOAT_EQ(material(scene, "pbr")->transmission, 0);
  EXPECT_TRUE(planEffects(scene).on(Effect::transmission));
  EXPECT_TRUE(planEffects(blender("01_unlit")).on(Effect::unlit));
}

TEST_F(EffectFiles, VertexColoursAndAlphaBlend) {
  EXPECT_TRUE(planEffects(blender("22_vertex_color")).on(Effect::vertexColours));
  // Float, byte and word colours, first three without alpha, then three with an alpha of a fifth.
  const auto coloursOf = [](int number) {
    const Scene scene = parsed(fmt::format(
        "asset_generator/Mesh_PrimitiveVertexColor/Mesh_PrimitiveVertexColor_{:02}.gltf", number));
    EXPECT_TRUE(planEffects(scene).on(Effect::vertexColours)) << number;
    return scene.meshes.empty() ? std::vector<glm::u8vec4>{} : scene.meshes[0].colours;
  };
  std::vector<glm::u8vec4> expected{{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255},
                                    {255, 0, 0, 255}, {0, 0, 255, 255}, {255, 255, 0, 255}};
  for (int i = 0; i < 3; ++i) EXPECT_EQ(coloursOf(i), expected) << i;
  for (glm::u8vec4& colour : expected) colour.a = 51;
  for (int i = 3; i < 6; ++i) EXPECT_EQ(coloursOf(i), expected) << i;
  EXPECT_TRUE(planEffects(blender("01_alpha_blend")).on(Effect::alphaBlend));
}

TEST_F(EffectFiles, Instances) {
  const Scene scene = parsed("playcanvas/simple-instancing.glb");
  EXPECT_EQ(scene.meshes.size(), 125u);
  EXPECT_EQ(scene.triangleCount(), 125u * 12u);
}

TEST_F(EffectFiles, NegativeScalesKeepFacesAndNormalsOnOneSide) {
  for (int i = 0; i < 13; ++i) {
    const Scene scene =
        parsed(fmt::format("asset_generator/Node_NegativeScale/Node_NegativeScale_{:02}.gltf", i));
    for (const Mesh& mesh : scene.meshes)
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        ASSERT_GT(glm::dot(faceNormal(mesh, t), mesh.normals[mesh.triangles[t].x]), 0.5f) << "file " << i;
  }
}

TEST_F(EffectFiles, WrapModesAndInterleavedBuffers) {
  const Scene scene = blender("13_texture_wrapping");
  bool clamp = false, mirror = false, repeat = false;
  for (const Texture& t : scene.textures)
    for (const Wrap wrap : {t.wrapU, t.wrapV})
      clamp |= wrap == Wrap::clamp, mirror |= wrap == Wrap::mirror, repeat |= wrap == Wrap::repeat;
  EXPECT_TRUE(clamp && mirror && repeat);
  const Scene whole = parsed("asset_generator/Buffer_Interleaved/Buffer_Interleaved_00.gltf");
  for (int i = 1; i < 5; ++i)
    EXPECT_EQ(parsed(fmt::format("asset_generator/Buffer_Interleaved/Buffer_Interleaved_{:02}.gltf", i))
                  .meshes[0]
                  .positions,
              whole.meshes[0].positions);
}

TEST_F(EffectFiles, TheFirstSceneIsTakenWhereNoneIsNamed) {
  EXPECT_TRUE(mentions(blender("00_no_scene").report.guessed, "the file names no default"));
  for (const char* name : {"00_empty_scene", "00_no_nodes", "00_no_scenes"}) {
    const auto scene =
        parseScene(scenesFolder() / "gltf_effects/blender_io" / name / (std::string(name) + ".gltf"), {});
    ASSERT_FALSE(scene) << name;
    EXPECT_EQ(scene.error().kind, ErrorKind::unsupported);
  }
  for (const char* name : {"Compatibility_04", "Compatibility_05"})
    EXPECT_FALSE(parseScene(
        scenesFolder() / "gltf_effects/asset_generator/Compatibility" / (std::string(name) + ".gltf"), {}))
        << name;
}

}  // namespace
}  // namespace acentric::test
