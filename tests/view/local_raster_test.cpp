#include "engine/view/local_raster.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/scene/simplify.h"
#include "local_scene.h"

namespace acentric {
namespace {

using test::drawLocal;
using test::LocalSceneBuilder;

PerspectiveView viewFrom(const glm::dvec3& eye, double yawDegrees = 0, double pitchDegrees = 0) {
  PerspectiveView view;
  view.eye = eye;
  view.yawRadians = radians(yawDegrees);
  view.pitchRadians = radians(pitchDegrees);
  view.width = 200;
  view.height = 150;
  return view;
}

const Rgba8 kRed = encodeForDisplay({0.5f, 0.02f, 0.02f}, 1),
            kGreen = encodeForDisplay({0.02f, 0.5f, 0.02f}, 1);

/// A wall x = `at` for y, z in [-1, 1], its front towards -x (where the eye is).
void addWall(LocalSceneBuilder& builder, int material, float at) {
  builder.quad(material, {at, 1, -1}, {at, -1, -1}, {at, -1, 1}, {at, 1, 1});
}

TEST(LocalRaster, CoversExactlyThePixelsOfAPlaneAndKnowsTheirDepth) {
  LocalSceneBuilder builder;
  addWall(builder, builder.material({0.5f, 0.02f, 0.02f, 1}), 2);
  const WalkScene walk = builder.build();
  for (double yaw : {0.0, 25.0, -40.0})
    for (double pitch : {0.0, 20.0}) {
      const PerspectiveView view = viewFrom({-0.3, 0.2, 0.1}, yaw, pitch);
      const auto picture = drawLocal(walk, view);
      for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
          const glm::dvec3 ray = view.rayThrough(x + 0.5, y + 0.5);
          const double t = (2 - view.eye.x) / ray.x;
          const glm::dvec3 at = view.eye + t * ray;
          const double outside = std::max(std::abs(at.y), std::abs(at.z)) - 1;
          if (std::abs(outside) < 1e-6) continue;
          const bool hit = t > 0 && outside < 0;
          ASSERT_EQ(picture.frame.source.at(x, y) == kSourceLocal, hit) << x << " " << y;
          if (!hit) continue;
          EXPECT_EQ(picture.frame.colour.at(x, y), kRed);
          const double zDepth = (view.viewFromWorld() * (at - view.eye)).z;
          EXPECT_NEAR(picture.inverseZDepth.at(x, y) * zDepth, 1, 1e-5);
        }
    }
}

TEST(LocalRaster, ShowsTheNearerSurfaceWhateverTheOrder) {
  for (bool nearFirst : {false, true}) {
    LocalSceneBuilder builder;
    const int red = builder.material({0.5f, 0.02f, 0.02f, 1}),
              green = builder.material({0.02f, 0.5f, 0.02f, 1});
    addWall(builder, nearFirst ? red : green, nearFirst ? 1.5f : 2.0f);
    addWall(builder, nearFirst ? green : red, nearFirst ? 2.0f : 1.5f);
    const auto picture = drawLocal(builder.build(), viewFrom({0, 0, 0}));
    EXPECT_EQ(picture.frame.colour.at(100, 75), kRed);
  }
}

TEST(LocalRaster, IsDrawnFromBothSides) {
  LocalSceneBuilder builder;
  addWall(builder, builder.material({0.5f, 0.02f, 0.02f, 1}), 2);
  EXPECT_EQ(drawLocal(builder.build(), viewFrom({4, 0, 0}, 180)).frame.colour.at(100, 75), kRed);
}

TEST(LocalRaster, HasNoCracksAndNoDoublePixelsOnSharedEdges) {
  // A floor of many thin triangles around and under the eye: every pixel below the horizon is covered, and
  // glass on it is blended once (twice would be darker).
  LocalSceneBuilder builder;
  const int glass = builder.material({0.5f, 0.5f, 0.5f, 0.5f});
  builder.at(glass).alphaMode = AlphaMode::blend;
  std::mt19937 random(4);
  std::uniform_real_distribution<float> jitter(-0.2f, 0.2f);
  Mesh mesh;
  mesh.material = glass;
  constexpr int kSide = 24;
  for (int i = 0; i <= kSide; ++i)
    for (int j = 0; j <= kSide; ++j)
      mesh.positions.push_back({3.0f * static_cast<float>(i - kSide / 2) + jitter(random),
                                3.0f * static_cast<float>(j - kSide / 2) + jitter(random), 0});
  for (unsigned i = 0; i < kSide; ++i)
    for (unsigned j = 0; j < kSide; ++j) {
      const unsigned a = i * (kSide + 1) + j, b = a + kSide + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
  builder.scene().meshes.push_back(mesh);
  const WalkScene walk = builder.build(30);
  for (double pitch : {-85.0, -50.0, -38.0}) {
    const PerspectiveView view = viewFrom({0.37, 0.11, 1.6}, 17, pitch);
    const auto picture = drawLocal(walk, view, 0, Rgba8(0, 0, 0, 255));
    const Rgba8 once = blendOver(encodeForDisplay({0.5f, 0.5f, 0.5f}, 1, 0.5f), Rgba8(0, 0, 0, 255));
    for (const Rgba8& pixel : picture.frame.colour.pixels) ASSERT_EQ(pixel, once) << pitch;
  }
}

TEST(LocalRaster, DrawsWhatReachesBehindTheEye) {
  // A floor from far ahead to far behind: everything below the horizon, nothing above it.
  LocalSceneBuilder builder;
  builder.quad(builder.material({0.02f, 0.5f, 0.02f, 1}), {-40, -40, 0}, {40, -40, 0}, {40, 40, 0},
               {-40, 40, 0});
  const PerspectiveView view = viewFrom({0, 0, 1.6});
  const auto picture = drawLocal(builder.build(), view);
  const int horizon = static_cast<int>(75 + view.focalPixels() * 1.6 / 40) + 2;
  for (int x = 0; x < view.width; ++x) {
    for (int y = 0; y <= 75; ++y) ASSERT_EQ(picture.frame.source.at(x, y), kSourceHole);
    for (int y = horizon; y < view.height; ++y) ASSERT_EQ(picture.frame.colour.at(x, y), kGreen);
  }
}

TEST(LocalRaster, PutsTexturesTheRightWayRound) {
  // Left half red, right half green; above the middle row darker: u runs from the quad's first corner to its
  // second.
  LocalSceneBuilder builder;
  const int textured = builder.material(glm::vec4(1));
  ColourImage image(2, 2, Rgba8(255, 0, 0, 255));
  image.at(1, 0) = Rgba8(0, 255, 0, 255);
  image.at(0, 1) = Rgba8(0, 0, 255, 255);
  image.at(1, 1) = Rgba8(255, 255, 255, 255);
  builder.scene().images.push_back(std::make_shared<const ColourImage>(image));
  Texture texture;
  texture.image = 0;
  texture.nearest = true;
  builder.scene().textures.push_back(texture);
  builder.at(textured).baseColourTexture.texture = 0;
  addWall(builder, textured, 2);  // seen from -x: its first corner is below on the left
  WalkScene walk = builder.build();
  const auto at = [&](int x, int y) { return drawLocal(walk, viewFrom({0, 0, 0})).frame.colour.at(x, y); };
  EXPECT_EQ(at(70, 100), encodeForDisplay({1, 0, 0}, 1));   // uv (0,0): lower left
  EXPECT_EQ(at(130, 100), encodeForDisplay({0, 1, 0}, 1));  // uv (1,0)
  EXPECT_EQ(at(70, 50), encodeForDisplay({0, 0, 1}, 1));    // uv (0,1)
  EXPECT_EQ(at(130, 50), encodeForDisplay({1, 1, 1}, 1));
  // Perspective: seen at a slant, the colours still meet on the plane's middle line.
  const PerspectiveView slanted = viewFrom({1, 0.9, 0}, -45);
  const auto picture = drawLocal(walk, slanted);
  for (int x = 0; x < slanted.width; ++x) {
    const glm::dvec3 ray = slanted.rayThrough(x + 0.5, 100.5);
    const glm::dvec3 p = slanted.eye + (1 / ray.x) * ray;
    if (ray.x <= 0 || std::abs(p.y) > 0.95 || p.z < -0.95 || std::abs(p.y) < 0.01) continue;
    EXPECT_EQ(picture.frame.colour.at(x, 100),
              encodeForDisplay(p.y > 0 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0), 1))
        << x;
  }
  walk.plan[Effect::textures].on = false;
  EXPECT_EQ(at(70, 100), encodeForDisplay({1, 1, 1}, 1));
}

TEST(LocalRaster, CutsMasksOutAndLightsWhatIsLeft) {
  LocalSceneBuilder builder;
  const int masked = builder.material(glm::vec4(1, 1, 1, 0.3f));
  builder.at(masked).alphaMode = AlphaMode::mask;
  const int lit = builder.material({0.5f, 0.02f, 0.02f, 1});
  const int unlit = builder.material({0.02f, 0.5f, 0.02f, 1});
  builder.at(unlit).unlit = true;
  addWall(builder, masked, 1);
  addWall(builder, lit, 2);
  builder.quad(unlit, {3, 5, -5}, {3, -5, -5}, {3, -5, 5}, {3, 5, 5});
  WalkScene walk = builder.build();
  auto light = std::make_shared<SurfaceLight>();
  for (std::uint32_t t = 0; t <= 6; ++t) light->firstSample.push_back(3 * t);
  light->resolution.assign(6, 1);
  light->hasBack.assign(6, 0);
  light->light.assign(18, packColour({0.5f, 0.5f, 0.5f, 1}));
  walk.surfaceLight = light;
  const auto picture = drawLocal(walk, viewFrom({0, 0, 0}));
  EXPECT_EQ(picture.frame.colour.at(100, 75), encodeForDisplay(0.5f * glm::vec3(0.5f, 0.02f, 0.02f), 1));
  EXPECT_EQ(picture.frame.colour.at(5, 75), kGreen);
}

TEST(LocalRaster, BlendsGlassFarToNearAndOnlyInFrontOfWhatIsOpaque) {
  LocalSceneBuilder builder;
  const int red = builder.material({0.5f, 0.02f, 0.02f, 0.5f}),
            green = builder.material({0.02f, 0.5f, 0.02f, 0.25f});
  const int wall = builder.material({0.3f, 0.3f, 0.3f, 1});
  builder.at(red).alphaMode = builder.at(green).alphaMode = AlphaMode::blend;
  addWall(builder, red, 1.2f);
  addWall(builder, green, 1.6f);
  addWall(builder, wall, 2);
  addWall(builder, green, 2.5f);  // hidden
  const auto picture = drawLocal(builder.build(), viewFrom({0, 0, 0}));
  const Rgba8 grey = encodeForDisplay(glm::vec3(0.3f), 1);
  const Rgba8 behind = blendOver(encodeForDisplay({0.02f, 0.5f, 0.02f}, 1, 0.25f), grey);
  EXPECT_EQ(picture.frame.colour.at(110, 75),
            blendOver(encodeForDisplay({0.5f, 0.02f, 0.02f}, 1, 0.5f), behind));
  EXPECT_EQ(picture.frame.source.at(110, 75), kSourceLocal);
}

/// A wavy textured sheet under the eye's view, with light that varies along it.
WalkScene wavySheet() {
  LocalSceneBuilder builder;
  const int material = builder.material({1, 1, 1, 1});
  ColourImage image(16, 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) image.at(x, y) = {40 + 12 * x, 30 + 10 * y, 120, 255};
  builder.scene().images.push_back(std::make_shared<const ColourImage>(image));
  builder.scene().textures.push_back({"slopes", 0});
  builder.at(material).baseColourTexture.texture = 0;
  Mesh mesh;
  mesh.material = material;
  constexpr int kQuads = 60;
  for (int y = 0; y <= kQuads; ++y)
    for (int x = 0; x <= kQuads; ++x) {
      const float u = float(x) / kQuads, v = float(y) / kQuads;
      mesh.positions.emplace_back(1 + 3 * u, 3 * v - 1.5f, 0.1f * std::sin(5 * u) * std::cos(4 * v));
      mesh.normals.emplace_back(0, 0, 1);
      mesh.uv[0].emplace_back(0.1f + 0.8f * u, 0.1f + 0.8f * v);
    }
  for (std::uint32_t y = 0; y < kQuads; ++y)
    for (std::uint32_t x = 0; x < kQuads; ++x) {
      const std::uint32_t a = y * (kQuads + 1) + x, b = a + kQuads + 1;
      mesh.triangles.emplace_back(a, a + 1, b + 1);
      mesh.triangles.emplace_back(a, b + 1, b);
    }
  builder.scene().meshes.push_back(mesh);
  WalkScene walk = builder.build(2.7);
  SurfaceLight light;
  for (const glm::uvec3& t : mesh.triangles) {
    light.firstSample.push_back(std::uint32_t(light.light.size()));
    light.resolution.push_back(1);
    light.hasBack.push_back(0);
    for (const int corner : {0, 2, 1})
      light.light.push_back(packColour(glm::vec4(glm::vec3(0.3f + 0.2f * mesh.positions[t[corner]].x), 1)));
  }
  light.firstSample.push_back(std::uint32_t(light.light.size()));
  walk.surfaceLight = std::make_shared<const SurfaceLight>(std::move(light));
  return walk;
}

PerspectiveView overTheSheet() {
  PerspectiveView view;
  view.eye = {0, 0.2, 1.2};
  view.pitchRadians = -0.45;
  view.width = 320, view.height = 200;
  return view;
}

TEST(LocalRaster, DrawsSurfacesOfARegionsOwnExactlyAsTheScenesWhereTheyAreTheSame) {
  WalkScene walk = wavySheet();
  const auto full = drawLocal(walk, overTheSheet());
  const auto kept = simplify(*walk.scene, *walk.local[0], {.mostTriangles = 1 << 20, .maxError = 0.01});
  ASSERT_TRUE(kept.has_value());
  ASSERT_EQ(kept->report.after, kept->report.before);
  walk.local[0] =
      std::make_shared<const LocalGeometry>(localGeometryOf(*kept, *walk.scene, {}, walk.surfaceLight.get()));
  const auto own = drawLocal(walk, overTheSheet());
  EXPECT_EQ(own.frame.colour.pixels, full.frame.colour.pixels);
  EXPECT_EQ(own.inverseZDepth.pixels, full.inverseZDepth.pixels);
}

TEST(LocalRaster, DrawsSimplifiedSurfacesWithTheirTextureAndLight) {
  WalkScene walk = wavySheet();
  const auto full = drawLocal(walk, overTheSheet());
  const auto simplified = simplify(*walk.scene, *walk.local[0], {.mostTriangles = 0, .maxError = 0.004});
  ASSERT_TRUE(simplified.has_value());
  ASSERT_LT(simplified->report.after, simplified->report.before / 3);
  walk.local[0] = std::make_shared<const LocalGeometry>(
      localGeometryOf(*simplified, *walk.scene, {}, walk.surfaceLight.get()));
  const auto own = drawLocal(walk, overTheSheet());
  double sum = 0;
  std::size_t seen = 0;
  for (std::size_t n = 0; n < full.frame.colour.pixels.size(); ++n) {
    if (full.frame.source.pixels[n] != kSourceLocal) continue;
    ++seen;
    EXPECT_EQ(own.frame.source.pixels[n], kSourceLocal);
    const glm::vec3 change = glm::vec3(own.frame.colour.pixels[n]) - glm::vec3(full.frame.colour.pixels[n]);
    sum += (std::abs(change.x) + std::abs(change.y) + std::abs(change.z)) / 3;
  }
  ASSERT_GT(seen, 5000u);
  EXPECT_LT(sum / double(seen), 2.0) << "8-bit codes, mean";
}

TEST(LocalRaster, IsTheSameForAnyThreadCount) {
  LocalSceneBuilder builder;
  std::mt19937 random(8);
  std::uniform_real_distribution<float> unit(-3, 3);
  for (int i = 0; i < 60; ++i) {
    const int material =
        builder.material({0.1f + 0.01f * static_cast<float>(i), 0.3f, 0.2f, i % 4 == 0 ? 0.5f : 1.0f});
    if (i % 4 == 0) builder.at(material).alphaMode = AlphaMode::blend;
    const glm::vec3 a(unit(random), unit(random), unit(random)), b(unit(random), unit(random), unit(random)),
        c(unit(random), unit(random), unit(random));
    builder.quad(material, a, b, c, a + c - b);
  }
  const WalkScene walk = builder.build(4);
  const PerspectiveView view = viewFrom({0.1, 0.2, 0.3}, 33, 10);
  const auto one = drawLocal(walk, view, 0, Rgba8(9, 9, 9, 255));
  for (int workers : {1, 3}) {
    const auto many = drawLocal(walk, view, workers, Rgba8(9, 9, 9, 255));
    EXPECT_EQ(many.frame.colour.pixels, one.frame.colour.pixels);
    EXPECT_EQ(many.inverseZDepth.pixels, one.inverseZDepth.pixels);
  }
}

}  // namespace
}  // namespace acentric
