#include <epoxy/gl.h>

#include <algorithm>

#include "engine/view_gl/texture_cache.h"
#include "gl_fixture.h"
#include "tests/view/local_scene.h"

namespace acentric {
namespace {

using test::LocalSceneBuilder;
using test::onCpu;

/// Local geometry in the region around the origin, before the captures of an analytic scene.
class GlLocal : public test::WithGl {
 protected:
  WalkScene walk(LocalSceneBuilder& builder, bool background = true) {
    const auto layout = test::layoutAroundOrigin(Configuration::e, 4);
    const int region = *layout->regionAt({0.1, 0.1});
    WalkScene local = builder.build(20);
    WalkScene scene;
    if (background) {
      scene = test::walkScene(test::randomPatches(4, 30, 5), layout, region, 2);
    } else {
      scene.layout = layout, scene.captures.resize(layout->cameras.size());
    }
    scene.scene = local.scene;
    scene.plan = local.plan;
    scene.local.resize(layout->regions.size());
    scene.local[std::size_t(region)] = local.local[0];
    return scene;
  }

  static PerspectiveView view() {
    PerspectiveView v;
    v.eye = {0.1, 0.1, 1.6};
    v.width = 301, v.height = 203;
    v.fovRadians = radians(70);
    return v;
  }

  /// Both renderers' pictures; `share`: pixels that may differ by more than `codes`.
  void expectLikeCpu(const WalkScene& scene, const PerspectiveView& from, int codes, double share) {
    const Frame cpu = onCpu(scene, from, {}), gl = onGl(scene, from, {});
    ASSERT_EQ(gl.colour.pixels.size(), cpu.colour.pixels.size());
    constexpr double kEdges = 0.001;  // of patches behind: other rays of a pixel meet them
    EXPECT_LE(test::differingShare(cpu.colour, gl.colour, codes), share + kEdges);
    EXPECT_LE(test::differingSources(cpu, gl), 0.002);
    EXPECT_GT(std::count(gl.source.pixels.begin(), gl.source.pixels.end(), kSourceLocal), 1000);
  }

  bool hasVariant(const std::string& words) {
    const auto variants = renderer_->variants();
    return std::any_of(variants.begin(), variants.end(),
                       [&](const std::string& v) { return v.find(words) != std::string::npos; });
  }
};

ColourImage chequers(int size) {
  ColourImage image(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      image.at(x, y) =
          (x / 2 + y / 2) % 2 == 0 ? Rgba8(230, 60, 20, 255) : Rgba8(10, 90, 200, x < size / 2 ? 255 : 40);
  return image;
}

int addTexture(Scene& scene, const ColourImage& image, Wrap u, Wrap v, bool nearest) {
  scene.images.push_back(std::make_shared<const ColourImage>(image));
  scene.textures.push_back({"chequers", int(scene.images.size()) - 1, u, v, nearest});
  return int(scene.textures.size()) - 1;
}

/// A wall of the given material across the view, and a floor through the eye's foot that reaches behind it.
void wallAndFloor(LocalSceneBuilder& builder, int wall, int floor) {
  builder.quad(wall, {3, 1.4f, 0.4f}, {3.5f, -1.3f, 0.5f}, {3.2f, -1.5f, 2.8f}, {2.8f, 1.2f, 2.5f});
  builder.quad(floor, {-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0});
}

TEST_F(GlLocal, ShadesPlainSurfacesToTheCpusCodes) {
  LocalSceneBuilder builder;
  wallAndFloor(builder, builder.material({0.6f, 0.3f, 0.1f, 1}), builder.material({0.2f, 0.5f, 2.5f, 1}));
  WalkScene scene = walk(builder);
  expectLikeCpu(scene, view(), 0, 0.002);
  scene.exposure = 3;  // into the shoulder of the tone curve
  expectLikeCpu(scene, view(), 1, 0.002);
  EXPECT_FALSE(hasVariant("TEXTURE")) << "nothing here has a texture";
  EXPECT_FALSE(hasVariant("SURFACE_LIGHT"));
}

TEST_F(GlLocal, ReadsTexturesByTheirWrapModesFiltersAndTransforms) {
  for (Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror})
    for (bool nearest : {false, true}) {
      LocalSceneBuilder builder;
      const int wall = builder.material({0.9f, 0.8f, 0.7f, 1});
      TextureUse& use = builder.at(wall).baseColourTexture;
      use.texture = addTexture(builder.scene(), chequers(16), wrap, Wrap::repeat, nearest);
      use.transform = glm::mat3x2(1.7f, 0.3f, -0.2f, 2.1f, -0.4f, 0.3f);
      wallAndFloor(builder, wall, builder.material({0.3f, 0.3f, 0.3f, 1}));
      // Four codes: graphics cards filter with eight bits of weight. Nearest: a texel's border may fall
      // either way.
      expectLikeCpu(walk(builder), view(), 4, nearest ? 0.01 : 0.004);
    }
  EXPECT_TRUE(hasVariant("TEXTURE"));
}

TEST_F(GlLocal, CutsMasksOutWhereTheCpuDoes) {
  LocalSceneBuilder builder;
  const int wall = builder.material({1, 1, 1, 1});
  builder.at(wall).alphaMode = AlphaMode::mask;
  builder.at(wall).baseColourTexture.texture =
      addTexture(builder.scene(), chequers(16), Wrap::repeat, Wrap::repeat, true);
  wallAndFloor(builder, wall, builder.material({0.3f, 0.3f, 0.3f, 1}));
  expectLikeCpu(walk(builder), view(), 4, 0.01);
  EXPECT_TRUE(hasVariant("ALPHA_TEST"));
}

TEST_F(GlLocal, BlendsGlassFarToNearInLinearLight) {
  LocalSceneBuilder builder;
  const int glass = builder.material({0.2f, 0.9f, 0.3f, 0.4f}),
            pane = builder.material({0.9f, 0.9f, 0.95f, 1});
  builder.at(glass).alphaMode = AlphaMode::blend;
  builder.at(pane).transmission = 0.8f;
  wallAndFloor(builder, builder.material({0.6f, 0.3f, 0.1f, 1}), builder.material({0.3f, 0.3f, 0.3f, 1}));
  builder.quad(pane, {2.0f, 0.9f, 0.9f}, {2.1f, -0.5f, 0.8f}, {2.1f, -0.5f, 2.0f}, {2.0f, 0.9f, 2.2f});
  builder.quad(glass, {2.5f, 1.9f, 0.7f}, {2.5f, -0.2f, 0.7f}, {2.5f, -0.2f, 2.4f}, {2.5f, 1.9f, 2.4f});
  // Behind the wall: hidden.
  builder.quad(glass, {4, 1, 1}, {4, -1, 1}, {4, -1, 2}, {4, 1, 2});
  expectLikeCpu(walk(builder), view(), 2, 0.002);
  EXPECT_TRUE(hasVariant("FRESNEL"));
  EXPECT_TRUE(hasVariant("ALPHA_BLEND"));
}

TEST_F(GlLocal, DrawsNoGlassOverAHole) {
  LocalSceneBuilder builder;
  const int glass = builder.material({0.2f, 0.9f, 0.3f, 0.4f});
  builder.at(glass).alphaMode = AlphaMode::blend;
  builder.quad(builder.material({0.6f, 0.3f, 0.1f, 1}), {3, 1, 1}, {3, 0, 1}, {3, 0, 2}, {3, 1, 2});
  builder.quad(glass, {2, 2, 0}, {2, -2, 0}, {2, -2, 3}, {2, 2, 3});
  const WalkScene scene = walk(builder, false);
  ViewSettings settings;
  settings.fillHoles = false;
  const Frame cpu = onCpu(scene, view(), settings), gl = onGl(scene, view(), settings);
  EXPECT_EQ(gl.holeCount(), cpu.holeCount());
  EXPECT_GT(gl.holeCount(), 10000u);
  EXPECT_LE(test::differingShare(cpu.colour, gl.colour, 2), 0.002);
}

TEST_F(GlLocal, AddsEmissionAndVertexColours) {
  LocalSceneBuilder builder;
  const int wall = builder.material({0.4f, 0.4f, 0.4f, 1}), floor = builder.material({0.8f, 0.8f, 0.8f, 1});
  builder.at(wall).emissive = {0.3f, 0.1f, 0.02f};
  builder.at(wall).emissiveTexture.texture =
      addTexture(builder.scene(), chequers(8), Wrap::repeat, Wrap::repeat, false);
  wallAndFloor(builder, wall, floor);
  builder.scene().meshes.back().colours = {
      {255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {90, 90, 90, 255}};
  WalkScene scene = walk(builder);
  expectLikeCpu(scene, view(), 4, 0.004);
  EXPECT_TRUE(hasVariant("EMISSION EMISSION_TEXTURE"));
  EXPECT_TRUE(hasVariant("VERTEX_COLOURS"));
  scene.plan[Effect::emission].on = false;
  scene.plan[Effect::vertexColours].on = false;
  expectLikeCpu(scene, view(), 1, 0.002);
}

/// Surface light that grows along each triangle's second corner, other on the back.
std::shared_ptr<const SurfaceLight> slopedLight(const Scene& scene, std::uint16_t resolution) {
  SurfaceLight light;
  light.firstSample.push_back(0);
  for (std::size_t t = 0; t < scene.triangleCount(); ++t) {
    light.resolution.push_back(t == 3 ? 0 : resolution);  // one triangle without light: black
    light.hasBack.push_back(1);
    for (float side : {0.0f, 0.4f})
      for (std::uint32_t i = 0; resolution > 0 && t != 3 && i <= resolution; ++i)
        for (std::uint32_t j = 0; i + j <= resolution; ++j)
          light.light.push_back(
              packColour({0.1f + 0.8f * float(i) / float(resolution), 0.2f + side, float(j % 2), 1}));
    light.firstSample.push_back(std::uint32_t(light.light.size()));
  }
  return std::make_shared<const SurfaceLight>(std::move(light));
}

TEST_F(GlLocal, InterpolatesSurfaceLightAsTheCpuDoesOnBothSides) {
  for (std::uint16_t resolution : {std::uint16_t(1), std::uint16_t(7)})
    for (bool fromBehind : {false, true}) {
      LocalSceneBuilder builder;
      wallAndFloor(builder, builder.material({0.6f, 0.5f, 0.4f, 1}), builder.material({0.3f, 0.3f, 0.3f, 1}));
      if (fromBehind)
        for (glm::uvec3& triangle : builder.scene().meshes[0].triangles) std::swap(triangle.y, triangle.z);
      WalkScene scene = walk(builder);
      scene.surfaceLight = slopedLight(*scene.scene, resolution);
      expectLikeCpu(scene, view(), 1, 0.002);
    }
  EXPECT_TRUE(hasVariant("SURFACE_LIGHT"));
}

TEST_F(GlLocal, HidesWhatLiesBehindAndCoversTheBackgroundHoweverNear) {
  LocalSceneBuilder builder;
  const int red = builder.material({0.5f, 0, 0, 1}), green = builder.material({0, 0.5f, 0, 1});
  // One millimetre apart, ten metres away.
  builder.quad(red, {10.001f, 2, 0.6f}, {10.001f, -2, 0.6f}, {10.001f, -2, 2.6f}, {10.001f, 2, 2.6f});
  builder.quad(green, {10, 2, 0.6f}, {10, -2, 0.6f}, {10, -2, 2.6f}, {10, 2, 2.6f});
  const WalkScene scene = walk(builder);
  const Frame gl = onGl(scene, view(), {});
  for (std::size_t p = 0; p < gl.source.pixels.size(); ++p)
    if (gl.source.pixels[p] == kSourceLocal) {
      ASSERT_EQ(gl.colour.pixels[p], Rgba8(0, 188, 0, 255));
    }
  EXPECT_LE(test::differingSources(onCpu(scene, view(), {}), gl), 0.002);
}

TEST_F(GlLocal, DrawsSurfacesOfARegionsOwnAsTheCpuDoes) {
  LocalSceneBuilder builder;
  const int wall = builder.material({0.9f, 0.6f, 0.3f, 1}), floor = builder.material({0.2f, 0.5f, 0.8f, 1});
  wallAndFloor(builder, wall, floor);
  WalkScene scene = walk(builder);
  for (auto& local : scene.local) {
    if (!local) continue;
    LocalGeometry own = *local;
    auto surfaces = std::make_shared<LocalSurfaces>();
    surfaces->meshes = {scene.scene->meshes[1], scene.scene->meshes[0]};  // numbered in another way
    for (LocalTriangle& triangle : own.triangles) triangle.mesh = 1 - triangle.mesh;
    for (std::uint32_t t = 0; t < 4; ++t) {
      surfaces->light.firstSample.push_back(3 * t);
      surfaces->light.resolution.push_back(1);
      surfaces->light.hasBack.push_back(0);
      for (int n = 0; n < 3; ++n)
        surfaces->light.light.push_back(
            packColour(glm::vec4(0.1f + 0.2f * float(t), 0.3f * float(n), 0.5f, 1)));
    }
    surfaces->light.firstSample.push_back(12);
    own.surfaces = std::move(surfaces);
    local = std::make_shared<const LocalGeometry>(std::move(own));
  }
  expectLikeCpu(scene, view(), 2, 0.01);
  EXPECT_TRUE(hasVariant("SURFACE_LIGHT"));
  expectLikeCpu(scene, view(), 2, 0.01);  // and once more from what is resident
  auto bare = std::make_shared<Scene>(*scene.scene);
  bare->meshes.clear();  // as in a walk that was shipped
  scene.scene = std::move(bare);
  expectLikeCpu(scene, view(), 2, 0.01);
}

TEST_F(GlLocal, FollowsAnExchangedLight) {
  LocalSceneBuilder builder;
  wallAndFloor(builder, builder.material({0.6f, 0.5f, 0.4f, 1}), builder.material({0.3f, 0.3f, 0.3f, 1}));
  WalkScene scene = walk(builder);
  const Frame unlit = onGl(scene, view(), {});
  scene.surfaceLight = slopedLight(*scene.scene, 3);
  const Frame lit = onGl(scene, view(), {});
  EXPECT_GT(test::differingShare(unlit.colour, lit.colour), 0.05);
  scene.surfaceLight = nullptr;
  EXPECT_EQ(onGl(scene, view(), {}).colour.pixels, unlit.colour.pixels);
}

TEST(DownscaledTo, HalvesInLinearLightUntilItFits) {
  ColourImage image(5, 3, Rgba8(0, 0, 0, 255));
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; x += 2) image.at(x, y) = Rgba8(255, 255, 255, 0);
  const ColourImage half = downscaledTo(image, 4);
  ASSERT_EQ(half.width, 2);
  ASSERT_EQ(half.height, 1);
  EXPECT_EQ(half.at(0, 0), Rgba8(188, 188, 188, 128));  // half the light is code 188, not 128
  EXPECT_EQ(downscaledTo(image, 5).pixels, image.pixels);
  EXPECT_EQ(downscaledTo(image, 1).width, 1);
}

}  // namespace
}  // namespace acentric
