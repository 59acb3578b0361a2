#include "engine/bake/texture_area.h"

#include <algorithm>
#include <cmath>

#include "engine/image/colour.h"
#include "engine/scene/placed_mesh.h"
#include "engine/scene/texture_lookup.h"

namespace acentric {
namespace {

/// Of the angle between a ray and a surface: below it areas grow no longer.
constexpr float kLeastCosine = 1e-3f;

struct Range {
  float from = -0.5f, to = 0.5f;
};

/// That part of middle + s * side, |s| <= 1/2, that lies in the triangle.
Range insideTriangle(const glm::vec2& middle, const glm::vec2& side) {
  Range range;
  const auto cut = [&range](float at, float slope) {  // where at + s * slope >= 0
    if (slope > 0) range.from = std::max(range.from, -at / slope);
    if (slope < 0) range.to = std::min(range.to, -at / slope);
  };
  cut(middle.x, side.x);
  cut(middle.y, side.y);
  cut(1 - middle.x - middle.y, -side.x - side.y);
  return {std::min(range.from, 0.0f), std::max(range.to, 0.0f)};
}

bool inTriangle(const glm::vec2& b) { return b.x >= 0 && b.y >= 0 && b.x + b.y <= 1; }

}  // namespace

TextureArea::TextureArea(const TexturePyramids& pyramids, const Scene& scene, const Hit& hit,
                         const glm::vec3& direction, const SampleSpread& spread)
    : pyramids_(pyramids), middle_(hit.barycentric) {
  const auto corners = PlacedMesh(scene, hit.mesh).corners(hit.triangle);
  const glm::vec3 first = corners[1] - corners[0];
  const glm::vec3 second = corners[2] - corners[0];
  const glm::vec3 normal = glm::cross(first, second);
  const float square = glm::dot(normal, normal);
  const float facing = glm::dot(normal, direction), least = kLeastCosine * std::sqrt(square);
  const auto onTriangle = [&](const glm::vec3& change) {
    if (!(square > 0)) return glm::vec2(0);
    const float cosine = std::abs(facing) > least ? facing : std::copysign(least, facing);
    const glm::vec3 step =
        (spread.before + hit.distance) * (change - direction * (glm::dot(normal, change) / cosine));
    return glm::vec2(glm::dot(glm::cross(step, second), normal), glm::dot(glm::cross(first, step), normal)) /
           square;
  };
  across_ = onTriangle(spread.across);
  along_ = onTriangle(spread.along);
}

glm::vec4 TextureArea::mean(const Scene& scene, const TextureUse& use, TexelKind kind,
                            const glm::mat3x2& corners) const {
  const TextureSampler sampler(scene, use);
  if (!sampler.used()) return glm::vec4(1);
  const ColourImage& image = *sampler.image();
  const auto read = [&](const ColourImage& level, const glm::vec2& b) {
    const glm::vec2 uv = corners * glm::vec3(1 - b.x - b.y, b.x, b.y);
    const glm::vec2 at = use.transform * glm::vec3(uv, 1);
    const TextureSampler of = sampler.ofLevel(level);
    return kind == TexelKind::data ? of.stored(at) : of.colour(at, linearFromSrgbTable());
  };
  const glm::mat2 texels = glm::mat2(image.width, 0, 0, image.height) * glm::mat2(use.transform) *
                           glm::mat2(corners[1] - corners[0], corners[2] - corners[0]);
  glm::vec2 longer = across_, shorter = along_;
  float most = glm::length(texels * longer), least = glm::length(texels * shorter);
  if (most < least) std::swap(longer, shorter), std::swap(most, least);
  if (!(most > 1)) return read(image, middle_);

  const Range range = insideTriangle(middle_, longer);
  most = std::max(most * (range.to - range.from), 1.0f);
  const int rows = least > 1 ? 2 : 1;
  const float high = std::max(least / static_cast<float>(rows), 1.0f);
  const int reads =
      static_cast<int>(std::clamp(std::ceil(most / high), 1.0f, static_cast<float>(kMostReads)));
  const float wide = std::max(most / static_cast<float>(reads), high);
  const ColourImage& level =
      pyramids_.level(image, kind, static_cast<int>(std::lround(std::min(std::log2(wide), 30.0f))));
  glm::vec4 sum(0);
  float weights = 0, count = 0;
  for (int row = 0; row < rows; ++row)
    for (int n = 0; n < reads; ++n) {
      const float s =
          range.from + (static_cast<float>(n) + 0.5f) / static_cast<float>(reads) * (range.to - range.from);
      const float t = (static_cast<float>(row) + 0.5f) / static_cast<float>(rows) - 0.5f;
      const glm::vec2 b = middle_ + s * longer + t * shorter;
      if (!inTriangle(b)) continue;
      const glm::vec4 value = read(level, b);
      const float weight = kind == TexelKind::cutColour ? value.a : 1;
      sum += glm::vec4(weight * glm::vec3(value), value.a);
      weights += weight, count += 1;
    }
  if (!(weights > 0)) return read(image, middle_);
  return {glm::vec3(sum) / weights, sum.a / count};
}

}  // namespace acentric
