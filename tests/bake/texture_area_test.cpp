#include "engine/bake/texture_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "baked_camera.h"
#include "engine/scene/texture_lookup.h"

namespace acentric {
namespace {

using test::SceneBuilder;

/// Noise with detail in every texel.
ColourImage noise(int size) {
  ColourImage image(size, size);
  std::mt19937 random(7);
  for (Rgba8& texel : image.pixels) {
    const auto value = static_cast<std::uint8_t>(random() & 255);
    texel = {value, value, value, 255};
  }
  return image;
}

/// A textured floor of 20 x 20 m, its two triangles hit from an eye.
class TexturedFloor {
 public:
  explicit TexturedFloor(ColourImage image) {
    SceneBuilder builder;
    Material tiles = test::matte();
    tiles.baseColourTexture = builder.texture(std::move(image));
    builder.floor(builder.material(tiles), 10);
    scene_ = builder.rays();
    textures_.emplace(scene_->scene(), DetailRules{.textures = true}, runner_);
  }
  const Scene& scene() const { return scene_->scene(); }
  const TextureUse& use() const { return scene().materials.front().baseColourTexture; }

  struct Looked {
    glm::vec4 point, mean, dense;
  };
  /// A sample's view of it by a spread of `angle` (radians): as one read, as the mean over its area, and as
  /// the mean of many rays.
  Looked look(const glm::vec3& eye, const glm::vec3& direction, float angle) const {
    const glm::vec3 across = glm::normalize(glm::cross(direction, glm::vec3(0, 0, 1)));
    const SampleSpread spread{angle * across, angle * glm::cross(across, direction)};
    const Hit hit = scene_->trace({eye, direction});
    EXPECT_TRUE(hit.found());
    Looked looked;
    looked.point = read(hit);
    looked.mean = TextureArea(*textures_, scene(), hit, direction, spread)
                      .mean(scene(), use(), TexelKind::colour, corners(hit));
    constexpr int kRays = 48;
    int counted = 0;
    for (int j = 0; j < kRays; ++j)
      for (int i = 0; i < kRays; ++i) {
        const float x = (float(i) + 0.5f) / kRays - 0.5f, y = (float(j) + 0.5f) / kRays - 0.5f;
        const Hit near =
            scene_->trace({eye, glm::normalize(direction + x * spread.across + y * spread.along)});
        if (!near.found() || near.triangle != hit.triangle) continue;
        looked.dense += read(near);
        ++counted;
      }
    looked.dense /= float(counted);
    return looked;
  }

 private:
  glm::mat3x2 corners(const Hit& hit) const {
    const Mesh& mesh = scene().meshes[hit.mesh];
    const glm::uvec3& t = mesh.triangles[hit.triangle];
    return {mesh.uv[0][t.x], mesh.uv[0][t.y], mesh.uv[0][t.z]};
  }
  glm::vec4 read(const Hit& hit) const {
    const glm::vec2& b = hit.barycentric;
    return sampleColour(scene(), use(), corners(hit) * glm::vec3(1 - b.x - b.y, b.x, b.y));
  }
  TaskRunner runner_{0};
  RayScenePtr scene_;
  std::optional<TexturePyramids> textures_;
};

TEST(TextureArea, IsTheMeanOfWhatManyRaysRead) {
  const TexturedFloor floor(noise(512));  // 4 cm a texel
  std::mt19937 random(3);
  std::uniform_real_distribution<float> one(-1, 1);
  double pointError = 0, meanError = 0;
  int looks = 0;
  while (looks < 300) {
    const glm::vec3 eye(6 * one(random), 6 * one(random), 1.5f + one(random));
    const glm::vec3 target(9 * one(random), 9 * one(random), 0);
    if (glm::distance(eye, target) < 2) continue;
    const auto seen = floor.look(eye, glm::normalize(target - eye), 0.03f);
    pointError += std::pow(seen.point.g - seen.dense.g, 2);
    meanError += std::pow(seen.mean.g - seen.dense.g, 2);
    ++looks;
  }
  EXPECT_GT(std::sqrt(pointError / looks), 0.15);
  EXPECT_LT(std::sqrt(meanError / looks), 0.25 * std::sqrt(pointError / looks));
}

TEST(TextureArea, IsOneReadWhereItIsNoLargerThanATexel) {
  const TexturedFloor floor(noise(16));
  const auto seen = floor.look({0.3f, 0.2f, 1.5f}, glm::normalize(glm::vec3(0.4f, 0.3f, -1)), 0.01f);
  EXPECT_EQ(seen.mean, seen.point);
}

TEST(TextureArea, StaysInTheTriangleHoweverFlatTheRay) {
  // Black and white halves, so that any read from beyond the quad's border would wrap to the other colour.
  ColourImage halves(64, 64, {0, 0, 0, 255});
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 32; ++x) halves.at(x, y) = {255, 255, 255, 255};
  const TexturedFloor floor(halves);
  for (const float height : {1e-1f, 1e-2f, 1e-4f}) {
    const auto seen =
        floor.look({-9.0f, 0.5f, height}, glm::normalize(glm::vec3(-0.9f, 0.01f, -height)), 0.02f);
    EXPECT_TRUE(std::isfinite(seen.mean.g));
    EXPECT_GE(seen.mean.g, 0);
    EXPECT_LE(seen.mean.g, 1);
  }
  // Towards the middle, but ending far before it: white alone.
  const auto seen = floor.look({-8.0f, 0.5f, 0.5f}, glm::normalize(glm::vec3(1, 0.01f, -0.5f)), 0.05f);
  EXPECT_NEAR(seen.mean.g, 1, 0.01);
}

TEST(TextureArea, MakesFarTilesOfACaptureGrey) {
  SceneBuilder builder;
  Material material = test::matte();
  material.unlit = true;
  material.baseColourTexture = builder.texture(test::chequers(1024));
  builder.floor(builder.material(material), 20);
  const RayScenePtr scene = builder.rays();
  int far = 0;
  double worst = 0, sum = 0;
  const test::Baked baked = test::bakeFrom(scene, test::cameraAt({0, 0}, {test::square(1)}));
  for (int k = 0; k < baked.columns.columns; ++k)
    for (int r = 0; r < baked.columns.rows; ++r)
      for (const auto& sample : baked.pixelAt(k, r)) {
        if (sample.w == 0 || 1 / sample.w < 8 || 1 / sample.w > 12) continue;  // metres: tiles of 4 cm
        ++far;
        const double off = std::abs(double(sample.colour.g) - 0.5);  // 0.5 where one tile is read
        worst = std::max(worst, off), sum += off;
      }
  EXPECT_GT(far, 50);
  EXPECT_LT(worst, 0.3);
  EXPECT_LT(sum / far, 0.1);
}

}  // namespace
}  // namespace acentric
