#include "engine/bake/shading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/geometry/conventions.h"
#include "scene_builder.h"

namespace acentric {
namespace {

using test::expectNear;
using test::matte;
using test::SceneBuilder;

constexpr float kInversePi = std::numbers::inv_pi_v<float>;
const glm::vec3 kDownwards(0, 0, -1);

struct Probe {
  Shaded shaded;
  RayCounts rays;
};

/// Shades what a ray from `from` towards `to` hits first.
Probe probe(const RayScenePtr& scene, glm::vec3 from, glm::vec3 to, const BakeSettings& settings = {}) {
  const Shader shader(*scene, settings);
  const glm::vec3 direction = glm::normalize(to - from);
  const Hit hit = scene->trace({from, direction});
  EXPECT_TRUE(hit.found());
  Probe out;
  if (hit.found()) out.shaded = shader.shade(hit, -direction, out.rays);
  return out;
}

/// Light on the floor less the stand-in for bounced light, which tests of direct light leave aside.
glm::vec3 directAt(const SceneBuilder& builder, glm::vec3 at) {
  const auto scene = builder.rays({Effect::diffuseInterreflection});
  const Probe p = probe(scene, at + glm::vec3(0.01f, 0.02f, 0.5f), at);
  const glm::vec3 standIn =
      bouncedLightStandIn(lightSet(scene->scene(), scene->plan()), scene->scene().bounds);
  return p.shaded.radiance() - standIn;
}

TEST(Shading, ADirectionalLightFollowsLambertsCosine) {
  for (const double angle : {0.0, 30.0, 60.0, 85.0}) {
    SceneBuilder builder;
    const glm::vec3 colour(0.8f, 0.5f, 0.2f);
    builder.floor(builder.material(matte(colour)), 10)
        .sun({std::sin(radians(angle)), 0, -std::cos(radians(angle))}, 100)
        .sky(glm::vec3(1e-6f));  // so dim that only the sun counts
    const Probe p = probe(builder.rays(), {0, 0, 2}, {0.3f, 0.4f, 0});
    expectNear(p.shaded.radiance(), colour * (100 * float(std::cos(radians(angle))) * kInversePi), 1e-4f);
    EXPECT_EQ(p.rays.shadow, 1u);
  }
}

TEST(Shading, LightFromBelowTheSurfaceDoesNotReachIt) {
  SceneBuilder builder;
  builder.floor(builder.material(matte()), 10).sun({0, 0, 1}, 100).sky(glm::vec3(1e-3f));
  const Probe p = probe(builder.rays(), {0, 0, 2}, {0.3f, 0.4f, 0});
  EXPECT_LT(p.shaded.radiance().x, 1.1e-3f);
  EXPECT_EQ(p.rays.shadow, 0u) << "no ray where the light is behind the surface";
  EXPECT_NEAR(probe(builder.rays(), {0, 0, -2}, {0.3f, 0.4f, 0}).shaded.radiance().x, 100 * kInversePi, 0.1f)
      << "seen from below, the lit side shows";
}

TEST(Shading, APointLightFallsOffWithTheSquareOfTheDistance) {
  for (const float height : {0.5f, 1.0f, 2.0f, 4.0f}) {
    SceneBuilder builder;
    builder.floor(builder.material(matte()), 10).point({0, 0, height}, 50);
    const glm::vec3 at(1, 0, 0);
    const float d2 = height * height + 1, cosine = height / std::sqrt(d2);
    expectNear(directAt(builder, at), glm::vec3(50 / d2 * cosine * kInversePi), 1e-3f);
  }
}

TEST(Shading, ARangeEndsAPointLightSmoothly) {
  SceneBuilder builder;
  builder.floor(builder.material(matte()), 10).point({0, 0, 2}, 50, 4);
  const float window = 1 - std::pow(2.0f / 4.0f, 4.0f);
  expectNear(directAt(builder, {0, 0, 0}), glm::vec3(50.0f / 4 * window * kInversePi), 1e-3f);
  EXPECT_NEAR(directAt(builder, {5, 0, 0}).x, 0, 1e-6f);
}

TEST(Shading, ASpotIsFullInsideTheInnerConeAndDarkOutsideTheOuter) {
  SceneBuilder builder;
  const float inner = 0.3f, outer = 0.6f, height = 2;
  builder.floor(builder.material(matte()), 10).spot({0, 0, height}, kDownwards, 50, inner, outer);
  const auto expected = [&](float angle) {
    const float d = height / std::cos(angle);
    const float t =
        std::clamp((std::cos(angle) - std::cos(outer)) / (std::cos(inner) - std::cos(outer)), 0.0f, 1.0f);
    return 50 / (d * d) * std::cos(angle) * t * t * kInversePi;
  };
  for (const float angle : {0.0f, 0.25f, 0.45f, 0.55f, 0.65f, 1.0f})
    EXPECT_NEAR(directAt(builder, {height * std::tan(angle), 0, 0}).x, expected(angle),
                2e-3f * 50 / 4 * kInversePi)
        << "angle " << angle;
}

TEST(Shading, AQuadCastsAShadowWithASharpBorder) {
  SceneBuilder builder;
  const int white = builder.material(matte());
  builder.floor(white, 10).floor(white, 1, 2).sun({1, 0, -1}, 100).sky(glm::vec3(1e-6f));
  const auto scene = builder.rays();
  // Light comes from -x at 45 degrees: the shadow of [-1,1] at height 2 falls on [1,3].
  for (const auto& [x, lit] : {std::pair{0.98f, true}, {1.02f, false}, {2.98f, false}, {3.02f, true}}) {
    const float light = probe(scene, {x, 0.5f, 1}, {x, 0.5f, 0}).shaded.radiance().x;
    EXPECT_NEAR(light, lit ? 100 * std::cos(radians(45)) * kInversePi : 0, 0.01) << "x " << x;
  }
  const Probe open = probe(builder.rays({Effect::hardShadows}), {2, 0.5f, 1}, {2, 0.5f, 0});
  EXPECT_GT(open.shaded.radiance().x, 20) << "shadows off: light everywhere";
  EXPECT_EQ(open.rays.shadow, 0u);
}

TEST(Shading, SunThroughColouredGlassIsTinted) {
  SceneBuilder builder;
  Material glass = matte({1, 0.5f, 0.25f});
  glass.transmission = 1;
  builder.floor(builder.material(matte()), 10)
      .floor(builder.material(glass), 1, 2)
      .sun(kDownwards, 100)
      .sky(glm::vec3(1e-6f));
  const Probe p = probe(builder.rays(), {0.3f, 0.4f, 1}, {0.3f, 0.4f, 0});
  expectNear(p.shaded.radiance(), 100 * kInversePi * 0.92f * glm::vec3(1, 0.5f, 0.25f), 1e-4f);
}

TEST(Shading, EmissionAddsToLightAndUnlitIgnoresIt) {
  SceneBuilder builder;
  Material lamp = matte({0.5f, 0.5f, 0.5f});
  lamp.emissive = {3, 2, 1};
  Material sign = matte({0.25f, 0.5f, 0.75f});
  sign.unlit = true;
  builder.floor(builder.material(lamp), 1)
      .floor(builder.material(sign), 1, 0, {5, 0})
      .sun(kDownwards, 10)
      .sky(glm::vec3(1e-6f));
  const auto scene = builder.rays();
  expectNear(probe(scene, {0.1f, 0.2f, 1}, {0.1f, 0.2f, 0}).shaded.radiance(),
             glm::vec3(5 * kInversePi) + glm::vec3(3, 2, 1), 1e-4f);
  const Probe unlit = probe(scene, {5.1f, 0.2f, 1}, {5.1f, 0.2f, 0});
  EXPECT_EQ(unlit.shaded.radiance(), glm::vec3(0.25f, 0.5f, 0.75f));
  EXPECT_EQ(unlit.rays.shadow + unlit.rays.ambient + unlit.rays.mirror, 0u);
  expectNear(probe(builder.rays({Effect::emission}), {0.1f, 0.2f, 1}, {0.1f, 0.2f, 0}).shaded.radiance(),
             glm::vec3(5 * kInversePi), 1e-4f);
}

TEST(Shading, AnOpenSkyLightsAnySurfaceByItsRadianceAndCornersLess) {
  SceneBuilder builder;
  const int white = builder.material(matte());
  builder.floor(white, 20)
      .quad(white, {10, -20, 0}, {10, 20, 0}, {10, 20, 20}, {10, -20, 20})
      .sky(glm::vec3(2));
  const auto scene = builder.rays();
  BakeSettings settings;
  settings.ambientRays = 256;
  settings.ambientRadius = 1;
  const Probe open = probe(scene, {0, 0, 1}, {0.1f, 0.2f, 0}, settings);
  expectNear(open.shaded.radiance(), glm::vec3(2), 1e-5f);
  EXPECT_NEAR(double(open.rays.ambient), 3 * 256, 3)
      << "for three places around it, one of each pair of opposite directions";
  EXPECT_EQ(probe(scene, {0, 0, 1}, {0.1f, 0.2f, 0}, settings).rays.ambient, 0u) << "once";
  const float corner = probe(scene, {9.9f, 0, 1}, {9.999f, 0.1f, 0}, settings).shaded.radiance().x;
  EXPECT_NEAR(corner, 1, 0.04) << "at the foot of a wall half the light is gone";
  const float near = probe(scene, {9.5f, 0, 1}, {9.6f, 0.1f, 0}, settings).shaded.radiance().x;
  EXPECT_GT(near, corner);
  EXPECT_LT(near, 2);
  EXPECT_FLOAT_EQ(probe(scene, {8, 0, 1}, {8.9f, 0.1f, 0}, settings).shaded.radiance().x, 2)
      << "beyond the radius nothing occludes";
}

TEST(Shading, AmbientVisibilityRisesSmoothlyFromTouchingToTheRadius) {
  SceneBuilder builder;
  builder.floor(builder.material(matte()), 1).sky(glm::vec3(1));
  const auto scene = builder.rays();
  const Ambient ambient(*scene, {}, {});  // radius 2 m
  EXPECT_EQ(ambient.visibility(0), 0);
  EXPECT_EQ(ambient.visibility(2), 1);
  EXPECT_EQ(ambient.visibility(std::numeric_limits<float>::infinity()), 1);
  for (float d = 0; d < 2; d += 0.05f) EXPECT_LE(ambient.visibility(d), ambient.visibility(d + 0.05f));
  EXPECT_LT(ambient.visibility(0.01f), 1e-3f) << "flat at the start";
  EXPECT_GT(ambient.visibility(1.99f), 1 - 1e-3f) << "flat at the end";
}

TEST(Shading, TexturesAndVertexColoursMultiplyTheBaseColour) {
  SceneBuilder builder;
  ColourImage image(1, 1, Rgba8(188, 255, 0, 255));
  Material m = matte({0.5f, 0.5f, 0.5f});
  m.baseColourTexture = builder.texture(std::move(image));
  builder.floor(builder.material(m), 1).sky(glm::vec3(1));
  builder.lastMesh().colours.assign(4, glm::u8vec4(255, 51, 255, 255));
  const auto base = [&](std::initializer_list<Effect> off) {
    return probe(builder.rays(off), {0.1f, 0.2f, 1}, {0.1f, 0.2f, 0}).shaded.baseColour;
  };
  const float linear = std::pow((188 / 255.0f + 0.055f) / 1.055f, 2.4f);
  expectNear(base({}), {0.5f * linear, 0.1f, 0}, 1e-4f);
  expectNear(base({Effect::vertexColours}), {0.5f * linear, 0.5f, 0}, 1e-4f);
  expectNear(base({Effect::textures, Effect::vertexColours}), glm::vec3(0.5f), 1e-6f);
}

TEST(Shading, ANormalMapTurnsTheNormalByItsTangentFrame) {
  SceneBuilder builder;
  Material m = matte();
  // (0.6, 0, 0.8) in tangent space.
  m.normalTexture = builder.texture(ColourImage(1, 1, Rgba8(204, 128, 230, 255)));
  builder.floor(builder.material(m), 1).sun({-1, 0, 0}, 100).sky(glm::vec3(1e-6f));
  builder.lastMesh().tangents.assign(4, glm::vec4(1, 0, 0, 1));
  // The sun grazes the true surface from +x, so lift it a little: its cosine to the mapped normal is what
  // counts.
  SceneBuilder lifted = builder;
  lifted.sun({-1, 0, -0.1f}, 100);
  const glm::vec3 towards = glm::normalize(glm::vec3(1, 0, 0.1f));
  const float expected = 100 * kInversePi * glm::dot(towards, glm::vec3(0.6f, 0, 0.8f));
  EXPECT_NEAR(probe(lifted.rays(), {0.1f, 0.2f, 1}, {0.1f, 0.2f, 0}).shaded.radiance().x, expected,
              0.01f * expected);
  EXPECT_NEAR(probe(lifted.rays({Effect::normalMaps}), {0.1f, 0.2f, 1}, {0.1f, 0.2f, 0}).shaded.radiance().x,
              100 * kInversePi * towards.z, 0.01f);
}

TEST(Shading, AMirrorShowsWhatLiesInTheMirroredDirectionWithOneRay) {
  SceneBuilder builder;
  Material silver;
  silver.baseColour = {0.9f, 0.8f, 0.7f, 1};
  silver.roughness = 0;
  Material picture = matte();
  picture.unlit = true;
  picture.baseColour = {0.2f, 0.4f, 0.6f, 1};
  builder.floor(builder.material(silver), 5).floor(builder.material(picture), 5, 3).sky(glm::vec3(1));
  const Probe p = probe(builder.rays(), {0, 0, 1}, {0.5f, 0, 0});
  expectNear(p.shaded.radiance(), glm::vec3(0.9f, 0.8f, 0.7f) * glm::vec3(0.2f, 0.4f, 0.6f), 1e-5f);
  EXPECT_EQ(p.rays.mirror, 1u);
  const Probe off = probe(builder.rays({Effect::mirrorReflection}), {0, 0, 1}, {0.5f, 0, 0});
  EXPECT_EQ(off.rays.mirror, 0u);
  EXPECT_GT(off.shaded.radiance().x, 0.1f) << "metal without reflections is not black";
}

TEST(Shading, TwoFacingMirrorsEndAfterOneReflection) {
  SceneBuilder builder;
  Material silver;
  silver.roughness = 0;
  const int m = builder.material(silver);
  builder.floor(m, 5).floor(m, 5, 3).sky(glm::vec3(1));
  const Probe p = probe(builder.rays(), {0, 0, 1}, {0.5f, 0, 0});
  EXPECT_EQ(p.rays.mirror, 1u);
  EXPECT_GT(p.shaded.radiance().x, 0);
}

TEST(Shading, GlassIsAFilmThatGrowsTowardsGrazingAngles) {
  SceneBuilder builder;
  Material glass = matte();
  glass.transmission = 1;
  glass.roughness = 0;
  builder.floor(builder.material(glass), 50).sky(glm::vec3(1));
  const auto scene = builder.rays();
  EXPECT_NEAR(probe(scene, {0, 0, 1}, {0, 0.01f, 0}).shaded.alpha, 0.12f, 1e-3f);
  const float grazing = probe(scene, {0, 0, 1}, {0, 20, 0}).shaded.alpha;
  EXPECT_GT(grazing, 0.7f);
  EXPECT_LE(grazing, 1);
  expectNear(probe(scene, {0, 0, 1}, {0, 0.01f, 0}).shaded.radiance(), glm::vec3(1), 0.02f);
}

TEST(Shading, DarkGlassHidesMoreOfWhatIsBehind) {
  SceneBuilder builder;
  Material glass = matte(glm::vec3(0.1f));
  glass.transmission = 1;
  builder.floor(builder.material(glass), 1).sky(glm::vec3(1));
  EXPECT_NEAR(probe(builder.rays(), {0, 0, 1}, {0, 0.01f, 0}).shaded.alpha, 0.12f + 0.88f * 0.9f, 1e-3f);
}

TEST(Shading, WithoutASkyUnlitSidesGetAFixedShareOfTheTypicalLight) {
  SceneBuilder builder;
  builder.box(builder.material(matte()), {-2, -2, 0}, {2, 2, 3}, true).sun({0, 0, -1}, 100);
  // The room is closed: no sun inside, and no sky.
  const Probe p = probe(builder.rays(), {0, 0, 1}, {0.5f, 0.2f, 0});
  expectNear(p.shaded.radiance(), glm::vec3(0.08f * 100 * kInversePi), 1e-4f);
}

TEST(Shading, EffectsThatAreOffTraceNoRayOfTheirKind) {
  SceneBuilder builder;
  builder.floor(builder.material(matte()), 10).sun(kDownwards, 10).point({0, 0, 3}, 10).sky(glm::vec3(1));
  const auto counts = [&](std::initializer_list<Effect> off) {
    return probe(builder.rays(off), {0, 0, 2}, {0.3f, 0.4f, 0}).rays;
  };
  EXPECT_EQ(counts({}).shadow, 2u);
  EXPECT_GT(counts({}).ambient, 0u);
  EXPECT_EQ(counts({Effect::pointLights}).shadow, 1u);
  EXPECT_EQ(counts({Effect::hardShadows}).shadow, 0u);
  EXPECT_EQ(counts({Effect::directionalLights, Effect::pointLights}).shadow, 0u);
  EXPECT_EQ(counts({Effect::ambientOcclusion}).ambient, 0u);
  EXPECT_EQ(counts({}).mirror, 0u);
}

TEST(Shading, PicksTheInstantiationByThePlan) {
  SceneBuilder builder;
  builder.floor(builder.material(matte()), 1);
  const auto bare = builder.rays();
  const Shader plain(*bare, {});
  EXPECT_EQ(plain.switches().direct, Shader::DirectLight::none);
  EXPECT_EQ(plain.switches().around, Shader::Around::even);
  EXPECT_FALSE(plain.switches().detail || plain.switches().special);
  builder.sun(kDownwards, 1).sky(glm::vec3(1));
  builder.lastMesh().colours.assign(4, glm::u8vec4(9));
  const auto rays = builder.rays();
  const Shader full(*rays, {});
  EXPECT_EQ(full.switches().direct, Shader::DirectLight::shadowed);
  EXPECT_EQ(full.switches().around, Shader::Around::occluded);
  EXPECT_TRUE(full.switches().detail);
  EXPECT_FALSE(full.switches().special);
}

}  // namespace
}  // namespace acentric
