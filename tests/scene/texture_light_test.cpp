/// Which scenes are taken for scans, whose light is in their colours already, and what follows.

#include <cmath>

#include "engine/scene/effect_plan.h"
#include "engine/scene/finish_scene.h"
#include "tests/scene/scene_fixtures.h"

namespace acentric::test {
namespace {

constexpr int kCells = 24;  // along a side: 1152 triangles

/// A bumpy open sheet of even triangles, metres, Z up. Its corners' colours vary; its texture coordinates use
/// the unit square `times` over.
SourceScene sheet(bool coloured, bool textured, double times = 1) {
  SourceScene source;
  source.metresPerUnit = 1;
  source.unitSource = source.upSource = "test";
  source.up = UpAxis::z;
  Material& material = source.materials.emplace_back();
  material.name = "scan";
  if (textured) {
    ColourImage photograph(64, 64, {90, 120, 60, 255});
    source.images.push_back(std::make_shared<const ColourImage>(std::move(photograph)));
    source.textures.push_back({.name = "photograph", .image = 0});
    material.baseColourTexture.texture = 0;
  }
  SourceMesh& mesh = source.meshes.emplace_back();
  for (int y = 0; y <= kCells; ++y)
    for (int x = 0; x <= kCells; ++x) {
      mesh.positions.emplace_back(0.2 * x, 0.2 * y, 0.03 * std::sin(1.7 * x + 2.3 * y));
      if (coloured) mesh.colours.emplace_back(10 * x, 10 * y, 100, 255);
      if (textured) mesh.uv[0].emplace_back(times * x / kCells, times * y / kCells);
    }
  const auto corner = [](int x, int y) { return std::uint32_t(y * (kCells + 1) + x); };
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) {
      mesh.triangles.emplace_back(corner(x, y), corner(x + 1, y), corner(x + 1, y + 1));
      mesh.triangles.emplace_back(corner(x, y), corner(x + 1, y + 1), corner(x, y + 1));
    }
  return source;
}

Scene finished(SourceScene source, Lighting lighting = Lighting::guess) {
  ImportOptions options;
  options.lighting = lighting;
  auto scene = finishScene(std::move(source), "scan", options, {});
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().describe());
  return scene ? std::move(*scene) : Scene{};
}

bool saysScan(const Scene& scene) {
  return mentions(scene.report.guessed, "light: in the textures already") &&
         mentions(scene.report.guessed, "as in a scan");
}

TEST(TextureLight, OfAScanWithOnePictureIsNotComputedOnceMore) {
  const Scene scene = finished(sheet(false, true));
  EXPECT_TRUE(saysScan(scene));
  EXPECT_TRUE(mentions(scene.report.guessed, "one picture, each part used once"));
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_FALSE(scene.sky.present());
  const EffectPlan plan = planEffects(scene);
  for (int i = 0; i < kEffectCount; ++i) {
    const bool expected = Effect(i) == Effect::textures || Effect(i) == Effect::unlit;
    EXPECT_EQ(plan.on(Effect(i)), expected) << nameOf(Effect(i)) << ": " << plan[Effect(i)].reason;
  }
}

TEST(TextureLight, OfAScanWithVertexColoursIsNotComputedOnceMore) {
  const Scene scene = finished(sheet(true, false));
  EXPECT_TRUE(saysScan(scene));
  const EffectPlan plan = planEffects(scene);
  EXPECT_TRUE(plan.on(Effect::vertexColours));
  EXPECT_TRUE(plan.on(Effect::unlit));
  EXPECT_FALSE(plan.on(Effect::sky));
  EXPECT_FALSE(plan.on(Effect::ambientOcclusion));
}

TEST(TextureLight, IsComputedWhereThatIsChosen) {
  const Scene scene = finished(sheet(false, true), Lighting::computed);
  EXPECT_FALSE(mentions(scene.report.guessed, "in the textures"));
  EXPECT_FALSE(scene.lights.empty());
  EXPECT_TRUE(planEffects(scene).on(Effect::directionalLights));
  SourceScene declared = sheet(false, true);
  declared.materials[0].unlit = true;
  EXPECT_FALSE(planEffects(finished(declared)).on(Effect::directionalLights));
  EXPECT_TRUE(planEffects(finished(std::move(declared), Lighting::computed)).on(Effect::directionalLights));
}

TEST(TextureLight, IsLeftAloneWhereThatIsChosen) {
  SourceScene source = sheet(false, true, 4);
  source.lights.push_back({});
  EXPECT_TRUE(planEffects(finished(source)).on(Effect::directionalLights));
  const EffectPlan plan = planEffects(finished(std::move(source), Lighting::inTextures));
  EXPECT_TRUE(plan.on(Effect::unlit));
  EXPECT_FALSE(plan.on(Effect::directionalLights));
  EXPECT_FALSE(plan.on(Effect::sky));
}

TEST(TextureLight, IsComputedWhereAnythingSpeaksAgainstAScan) {
  const auto expectLit = [](SourceScene source, const char* why) {
    EXPECT_TRUE(planEffects(finished(std::move(source))).on(Effect::directionalLights)) << why;
  };
  expectLit(sheet(false, false), "no colours at all");
  expectLit(sheet(false, true, 4), "the picture is a pattern");
  SourceScene twice = sheet(false, true);
  twice.meshes.push_back(twice.meshes.front());
  for (glm::dvec3& p : twice.meshes.back().positions) p.x += 10;
  expectLit(std::move(twice), "the picture is used twice");
  SourceScene shiny = sheet(false, true);
  shiny.materials[0].metallicRoughnessTexture.texture = 0;
  expectLit(std::move(shiny), "the material has more than a colour");
  SourceScene lamp = sheet(false, true);
  lamp.lights.push_back({});
  expectLit(std::move(lamp), "there is a lamp");
  SourceScene modelled = sheet(false, true);
  for (glm::dvec3& p : modelled.meshes[0].positions) p.x = std::pow(1.7, p.x / 0.2);
  expectLit(std::move(modelled), "triangles of all sizes");
  SourceScene palette = sheet(true, false);
  for (glm::u8vec4& c : palette.meshes[0].colours) c = {200, c.g > 100 ? 10 : 90, 30, 255};
  expectLit(std::move(palette), "colours of a palette");
}

}  // namespace
}  // namespace acentric::test
