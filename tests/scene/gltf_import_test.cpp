#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scene/scene_fixtures.h"

namespace acentric::test {
namespace {

using testing::HasSubstr;

class GltfImport : public testing::Test {
 protected:
  Scene parsed(const ImportOptions& options = {}) {
    auto scene = builder.parse(folder, options);
    if (!scene) {
      ADD_FAILURE() << scene.error().describe();
      return {};
    }
    expectSound(*scene);
    return std::move(*scene);
  }
  std::string refusal() {
    const auto scene = builder.parse(folder);
    EXPECT_FALSE(scene);
    if (scene) return "";
    EXPECT_THAT(scene.error().where, HasSubstr("model.gltf"));
    EXPECT_EQ(scene.error().describe().find('\n'), std::string::npos);
    return scene.error().message;
  }

  TemporaryFolder folder{"gltf_import"};
  GltfBuilder builder;
};

TEST_F(GltfImport, YUpBecomesZUpInMetres) {
  builder.triangle();
  builder.json["nodes"][0]["translation"] = {1, 2, 3};
  const Scene scene = parsed();
  ASSERT_EQ(scene.meshes.size(), 1u);
  // (x, y, z) -> (x, -z, y): the triangle that faced +Z faces -Y.
  EXPECT_EQ(scene.bounds.min, glm::vec3(1, -3, 2));
  EXPECT_EQ(scene.bounds.max, glm::vec3(2, -3, 3));
  EXPECT_LT(glm::distance(scene.meshes[0].normals[0], glm::vec3(0, -1, 0)), 1e-6f);
  EXPECT_LT(glm::distance(faceNormal(scene.meshes[0], 0), glm::vec3(0, -1, 0)), 1e-6f);
  EXPECT_EQ(scene.name, "model");
  EXPECT_TRUE(mentions(scene.report.found, "1 triangle in 1 mesh"));
  EXPECT_TRUE(mentions(scene.report.guessed, "unit: metres (glTF)"));
}

TEST_F(GltfImport, UnitAndUpAxisCanBeOverridden) {
  builder.triangle();
  const Scene scene = parsed({0.01, UpAxis::z, true});
  EXPECT_LT(glm::distance(scene.bounds.max, glm::vec3(0.01f, 0.01f, 0)), 1e-8f);
  EXPECT_FALSE(builder.parse(folder, {-1, UpAxis::guess, true}));
  EXPECT_FALSE(builder.parse(folder, {std::nan(""), UpAxis::guess, true}));
}

TEST_F(GltfImport, MirroringNodesTurnTheWindingSoThatFacesStillLookOutwards) {
  builder.triangle();
  builder.primitive()["attributes"]["NORMAL"] = builder.vec3({0, 0, 1, 0, 0, 1, 0, 0, 1});
  for (const auto& scale :
       {std::array{-1, 1, 1}, std::array{1, 1, -1}, std::array{-1, -1, -1}, std::array{-1, -1, 1}}) {
    builder.json["nodes"][0]["scale"] = scale;
    const Scene scene = parsed();
    EXPECT_GT(glm::dot(faceNormal(scene.meshes[0], 0), scene.meshes[0].normals[0]), 0.99f);
  }
}

TEST_F(GltfImport, NodesFiveThousandKilometresAwayKeepTheirDetail) {
  builder.json["meshes"] = {
      {{"primitives",
        {{{"attributes", {{"POSITION", builder.vec3({0, 0, 0, 0.001f, 0, 0, 0, 0.0004f, 0})}}}}}}}};
  builder.json["nodes"][0]["translation"] = {5e6 + 0.125, 2, -5e6};
  const Scene scene = parsed();
  EXPECT_LT(glm::distance(scene.origin, glm::dvec3(5e6 + 0.125, 5e6, 2)), 1e-3) << "amid even a small scene";
  const glm::dvec3 corner = glm::dvec3(scene.bounds.min) + scene.origin;
  EXPECT_NEAR(corner.x, 5e6 + 0.125, 1e-7);
  EXPECT_NEAR(scene.bounds.size().x, 0.001, 1e-7);
  EXPECT_NEAR(scene.bounds.size().z, 0.0004, 1e-7);
  EXPECT_TRUE(mentions(scene.report.guessed, "project origin"));
}

TEST_F(GltfImport, ASceneNearZeroKeepsItsOrigin) {
  builder.triangle();
  builder.json["nodes"][0]["translation"] = {300, 0, 0};
  EXPECT_EQ(parsed().origin, glm::dvec3(0));
}

TEST_F(GltfImport, StripsAndFansBecomeTrianglesOfOneSide) {
  builder.triangle();
  builder.primitive()["attributes"]["POSITION"] = builder.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
  builder.primitive()["mode"] = 5;
  const Scene strip = parsed();
  ASSERT_EQ(strip.triangleCount(), 3u);
  for (std::size_t t = 0; t < 3; ++t)
    EXPECT_LT(glm::distance(faceNormal(strip.meshes[0], t), glm::vec3(0, -1, 0)), 1e-6f);
  builder.primitive()["attributes"]["POSITION"] =
      builder.vec3({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0});
  builder.primitive()["mode"] = 6;
  const Scene fan = parsed();
  ASSERT_EQ(fan.triangleCount(), 3u);
  for (std::size_t t = 0; t < 3; ++t)
    EXPECT_LT(glm::distance(faceNormal(fan.meshes[0], t), glm::vec3(0, -1, 0)), 1e-6f);
  builder.primitive()["mode"] = 1;
  EXPECT_EQ(refusal(), "has no surfaces (lines)");
}

TEST_F(GltfImport, BrokenTrianglesAreDroppedAndCounted) {
  builder.triangle();
  const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
  builder.primitive()["attributes"]["POSITION"] =
      builder.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0, nan, 0, 0, 0, infinity, 0, 2, 0, 0});
  builder.primitive()["indices"] = builder.indices({0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 1, 1, 0, 1, 5, 0, 1, 600});
  const Scene scene = parsed();
  EXPECT_EQ(scene.triangleCount(), 1u);
  EXPECT_TRUE(mentions(scene.report.dropped, "2 triangles without area"));
  EXPECT_TRUE(mentions(scene.report.dropped, "2 triangles with positions that are not finite"));
  EXPECT_TRUE(mentions(scene.report.dropped, "1 triangle with indices out of range"));
  builder.primitive()["indices"] = builder.indices({0, 1, 3});
  EXPECT_THAT(refusal(), HasSubstr("has no surfaces (1 triangle with positions"));
}

TEST_F(GltfImport, SparseAccessorsReplaceRows) {
  builder.triangle();
  const int indices = builder.indices({1});
  const int values = builder.vec3({5, 0, 0});
  const auto view = [&](int accessor) {
    return builder.json["accessors"][std::size_t(accessor)]["bufferView"];
  };
  builder.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", view(indices)}, {"componentType", 5123}}},
      {"values", {{"bufferView", view(values)}}}};
  EXPECT_EQ(parsed().bounds.max.x, 5);
  builder.json["accessors"][0]["sparse"]["count"] = 2;
  EXPECT_THAT(refusal(), HasSubstr("reaches past the end"));
}

TEST_F(GltfImport, AccessorsThatLieAboutTheirSizeAreRefused) {
  builder.triangle();
  for (const double count : {4.0, 1e9, 1e18}) {
    builder.json["accessors"][0]["count"] = std::uint64_t(count);
    EXPECT_THAT(refusal(), testing::AnyOf(HasSubstr("reaches past the end"), HasSubstr("the limit is 2^31")));
  }
  builder.json["accessors"][0]["count"] = 3;
  builder.json["accessors"][0]["byteOffset"] = std::uint64_t(1) << 62;
  EXPECT_THAT(refusal(), HasSubstr("reaches past the end"));
}

TEST_F(GltfImport, VertexColoursOfEveryTypeAreLinearBytes) {
  builder.triangle();
  const glm::u8vec4 expected(255, 128, 0, 255);
  auto& attributes = builder.primitive()["attributes"];
  attributes["COLOR_0"] = builder.vec3({1, 0.501f, 0, 1, 0.501f, 0, 1, 0.501f, 0});
  EXPECT_EQ(parsed().meshes[0].colours[1], expected);
  std::vector<std::uint8_t> bytes;
  std::vector<std::uint16_t> words;
  for (int i = 0; i < 3; ++i) {
    for (const int v : {255, 128, 0, 64}) bytes.push_back(std::uint8_t(v));
    for (const int v : {65535, 32896, 0, 16448}) words.push_back(std::uint16_t(v));
  }
  builder.primitive()["attributes"]["COLOR_0"] = builder.accessor(bytes, "VEC4", 5121, 4);
  EXPECT_EQ(parsed().meshes[0].colours[1], glm::u8vec4(255, 128, 0, 64));
  builder.primitive()["attributes"]["COLOR_0"] = builder.accessor(words, "VEC4", 5123, 4);
  EXPECT_EQ(parsed().meshes[0].colours[1], glm::u8vec4(255, 128, 0, 64));
}

TEST_F(GltfImport, ComputedTangentsFollowUAndBitangentsPointUpInTheTexture) {
  ColourImage image(2, 2, {128, 128, 255, 255});
  ASSERT_TRUE(writeColourImage(image, folder.path() / "flat.png"));
  builder.triangle();
  // u runs along +x, v runs down: v = 1 - y.
  builder.primitive()["attributes"]["TEXCOORD_0"] = builder.vec2({0, 1, 1, 1, 0, 0});
  builder.primitive()["material"] = 0;
  builder.json["images"] = {{{"uri", "flat.png"}}};
  builder.json["textures"] = {{{"source", 0}}};
  builder.json["materials"] = {{{"normalTexture", {{"index", 0}, {"scale", 0.5}}}}};
  const Scene scene = parsed();
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(scene.materials[0].normalScale, 0.5f);
  ASSERT_EQ(mesh.tangents.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec3 tangent(mesh.tangents[i]);
    EXPECT_LT(glm::distance(tangent, glm::vec3(1, 0, 0)), 1e-5f);
    // The file's +y is our +z.
    EXPECT_LT(glm::distance(glm::cross(mesh.normals[i], tangent) * mesh.tangents[i].w, glm::vec3(0, 0, 1)),
              1e-5f);
  }
}

TEST_F(GltfImport, SpotLightsKeepPlaceDirectionAndCone) {
  builder.triangle();
  builder.json["extensionsUsed"] = {"KHR_lights_punctual"};
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"},
       {"name", "torch"},
       {"color", {1, 0.5, 0}},
       {"intensity", 40},
       {"range", 9},
       {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.4}}}}};
  builder.json["nodes"].push_back(
      {{"translation", {1, 2, 3}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  builder.json["scenes"][0]["nodes"] = {0, 1};
  const Scene scene = parsed();
  ASSERT_EQ(scene.lights.size(), 1u);
  const Light& light = scene.lights[0];
  EXPECT_EQ(light.kind, LightKind::spot);
  EXPECT_EQ(light.position, glm::vec3(1, -3, 2));
  EXPECT_LT(glm::distance(light.direction, glm::vec3(0, 1, 0)), 1e-6f);  // -Z of the node
  EXPECT_FLOAT_EQ(light.intensity, 40);
  EXPECT_FLOAT_EQ(light.range, 9);
  EXPECT_FLOAT_EQ(light.outerCone, 0.4f);
  EXPECT_FLOAT_EQ(light.colour.g, 0.5f);
  EXPECT_FALSE(scene.sky.present());  // only local lights: no sky
}

TEST_F(GltfImport, SizesOfLightsComeFromTheirExtras) {
  builder.triangle();
  builder.json["extensionsUsed"] = {"KHR_lights_punctual"};
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"extras", {{"radius", 0.25}}}},
      {{"type", "spot"}, {"spot", {{"outerConeAngle", 0.4}}}, {"extras", {{"shadow_soft_size", 0.1}}}},
      {{"type", "directional"}, {"extras", {{"angle", 0.02}}}},
      {{"type", "point"}, {"extras", {{"radius", -3}}}}};
  builder.json["scenes"][0]["nodes"] = {0};
  for (int i = 0; i < 4; ++i) {
    builder.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    builder.json["scenes"][0]["nodes"].push_back(i + 1);
  }
  const Scene scene = parsed({0.5, UpAxis::guess, true});  // metres per unit
  ASSERT_EQ(scene.lights.size(), 4u);
  EXPECT_FLOAT_EQ(scene.lights[0].radius, 0.125f);
  EXPECT_FLOAT_EQ(scene.lights[1].radius, 0.05f);
  EXPECT_FLOAT_EQ(scene.lights[2].angularRadius, 0.01f);
  EXPECT_EQ(scene.lights[3].radius, 0);
}

TEST_F(GltfImport, LightIsAddedOnlyWhereItIsMissing) {
  builder.triangle();
  const Scene dark = parsed();
  ASSERT_EQ(dark.lights.size(), 1u);
  EXPECT_FLOAT_EQ(dark.lights[0].intensity, 3);
  EXPECT_LT(dark.lights[0].direction.z, -0.5f);
  EXPECT_GT(dark.sky.zenith.b, dark.sky.zenith.r);
  EXPECT_TRUE(mentions(dark.report.guessed, "no lights: a sun and sky were added"));
  const Scene bare = parsed({0, UpAxis::guess, false});
  EXPECT_TRUE(bare.lights.empty());
  EXPECT_FALSE(bare.sky.present());

  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"}, {"intensity", 10}}};
  builder.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  const Scene sunny = parsed();
  ASSERT_EQ(sunny.lights.size(), 1u);
  EXPECT_NEAR(sunny.sky.horizon.g, 1.7f, 0.3f);  // 15 to 20 % of the sun
  EXPECT_TRUE(mentions(sunny.report.guessed, "no sky"));
}

TEST_F(GltfImport, CyclesMissingNodesAndUnknownRequirementsAreRefused) {
  builder.triangle();
  builder.json["nodes"].push_back({{"children", {0}}});
  builder.json["nodes"][0]["children"] = {1};
  EXPECT_EQ(refusal(), "node 0 is its own ancestor");
  builder.json["nodes"][0]["children"] = {7};
  EXPECT_EQ(refusal(), "node 7 does not exist");
  builder.json["nodes"][0].erase("children");
  builder.json["extensionsUsed"] = {"MSFT_texture_dds"};
  EXPECT_TRUE(mentions(parsed().report.ignored, "extension MSFT_texture_dds"));
  builder.json["extensionsRequired"] = {"MSFT_texture_dds"};
  EXPECT_THAT(refusal(), HasSubstr("MSFT_texture_dds"));
}

TEST_F(GltfImport, MorphTargetsStandByTheirDefaultWeights) {
  builder.triangle();
  builder.primitive()["targets"] = {{{"POSITION", builder.vec3({0, 0, 4, 0, 0, 4, 0, 0, 4})}},
                                    {{"POSITION", builder.vec3({9, 9, 9, 9, 9, 9, 9, 9, 9})}}};
  EXPECT_EQ(parsed().bounds.min.y, 0) << "without weights nothing moves";
  builder.json["meshes"][0]["weights"] = {0.5, 0};
  EXPECT_EQ(parsed().bounds.min.y, -2);
  builder.json["nodes"][0]["weights"] = {0.25, 0};
  EXPECT_EQ(parsed().bounds.min.y, -1) << "the node's weights come before the mesh's";
  builder.primitive()["targets"][0]["POSITION"] = builder.vec3({0, 0, 4});
  EXPECT_THAT(refusal(), HasSubstr("morph target 0"));
}

TEST_F(GltfImport, SkinsStandInThePoseOfTheirJointsAndNotWhereTheirNodeIs) {
  builder.triangle();
  builder.primitive()["attributes"]["JOINTS_0"] =
      builder.accessor(std::vector<std::uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4", 5121, 4);
  builder.primitive()["attributes"]["WEIGHTS_0"] = builder.vec4({1, 0, 0, 0, 0.5, 0.5, 0, 0, 0, 1, 0, 0});
  // Bound at x = 10; the joints stand at (0, 0, 0) and, below a parent, at (0, 0, 2) of the file.
  const auto bind = [](std::vector<float>& out) {
    out.insert(out.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -10, 0, 0, 1});
  };
  std::vector<float> inverse;
  bind(inverse), bind(inverse);
  builder.json["skins"] = {
      {{"joints", {1, 3}}, {"inverseBindMatrices", builder.accessor(inverse, "MAT4", 5126, 16)}}};
  builder.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {50, 50, 50}}},
                           {{"translation", {10, 0, 0}}},
                           {{"translation", {10, 0, 0}}, {"children", {3}}},
                           {{"translation", {0, 0, 2}}}};
  builder.json["scenes"][0]["nodes"] = {0, 1, 2};
  const Scene scene = parsed();
  ASSERT_EQ(scene.meshes.size(), 1u);
  MeshArray<glm::vec3> corners = scene.meshes[0].positions;
  std::ranges::sort(corners, {}, [](const glm::vec3& p) { return -p.y; });
  EXPECT_EQ(corners, (MeshArray<glm::vec3>{{0, 0, 0}, {1, -1, 0}, {0, -2, 1}}));
  builder.json["skins"][0]["joints"] = {1, 77};
  EXPECT_THAT(refusal(), HasSubstr("joint 77"));
  builder.json["skins"][0]["joints"] = {1};
  EXPECT_THAT(refusal(), HasSubstr("no joint 1"));
}

TEST_F(GltfImport, ADiamondOfNodesDoesNotMultiply) {
  builder.triangle();
  // Node k has node k-1 as a child twice: 2^40 paths.
  for (int k = 1; k <= 40; ++k) builder.json["nodes"].push_back({{"children", {k - 1, k - 1}}});
  builder.json["scenes"][0]["nodes"] = {40};
  const Scene scene = parsed();
  EXPECT_EQ(scene.triangleCount(), 1u);
  EXPECT_TRUE(mentions(scene.report.ignored, "a second parent of node"));
}

TEST_F(GltfImport, TexturesAreReadOnlyFromTheModelsSurroundings) {
  const auto image = ColourImage(1, 1, {10, 20, 30, 255});
  std::filesystem::create_directories(folder.path() / "a/b");
  ASSERT_TRUE(writeColourImage(image, folder.path() / "outside.png"));
  ASSERT_TRUE(writeColourImage(image, folder.path() / "a/b/Maps/Wood.PNG"));
  builder.triangle();
  builder.primitive()["material"] = 0;
  builder.primitive()["attributes"]["TEXCOORD_0"] = builder.vec2({0, 0, 1, 0, 0, 1});
  builder.json["textures"] = {{{"source", 0}}};
  builder.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  const auto texturesWith = [&](const std::string& uri) {
    builder.json["images"] = {{{"uri", uri}}};
    auto scene = parseScene(builder.write(folder.path() / "a/b/model.gltf"), {});
    EXPECT_TRUE(scene) << scene.error().describe();
    if (scene) expectSound(*scene);
    if (scene && scene->textures.empty()) {
      EXPECT_TRUE(mentions(scene->report.ignored, "png") || mentions(scene->report.ignored, "PNG"));
    }
    return scene ? scene->textures.size() : 99;
  };
  EXPECT_EQ(texturesWith("Maps/Wood.PNG"), 1u);
  EXPECT_EQ(texturesWith("maps\\wood.png"), 1u);
  EXPECT_EQ(texturesWith("../../outside.png"), 0u);
  EXPECT_EQ(texturesWith("missing.png"), 0u);
}

TEST_F(GltfImport, TheKeyFollowsWhatCanBeSeenAndNothingElse) {
  builder.triangle();
  const ContentKey plain = parsed().key;
  builder.json["nodes"][0]["name"] = "renamed";
  EXPECT_EQ(parsed().key, plain);
  builder.json["nodes"][0]["translation"] = {0, 0.001, 0};
  EXPECT_NE(parsed().key, plain);
  builder.json["nodes"][0].erase("translation");
  builder.primitive()["material"] = 0;
  builder.json["materials"] = {{{"pbrMetallicRoughness", {{"roughnessFactor", 0.9}}}}};
  EXPECT_NE(parsed().key, plain);
}

}  // namespace
}  // namespace acentric::test
