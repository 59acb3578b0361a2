#include "engine/bake/truth.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/bake/flush_denormals.h"
#include "engine/bake/shading.h"
#include "engine/bake/surface.h"
#include "engine/base/contract.h"
#include "engine/geometry/conventions.h"
#include "engine/image/colour.h"

namespace acentric {
namespace {

/// Camera rays of a view with its matrices made once.
class ViewRays {
 public:
  explicit ViewRays(const PerspectiveView& view)
      : origin_(view.eye),
        worldFromView_(glm::transpose(view.viewFromWorld())),
        focal_(view.focalPixels()),
        centre_(0.5 * view.width, 0.5 * view.height) {}
  Ray through(double u, double v) const {
    return {origin_, glm::vec3(glm::normalize(worldFromView_ * glm::dvec3((u - centre_.x) / focal_,
                                                                          (v - centre_.y) / focal_, 1)))};
  }

 private:
  glm::vec3 origin_;
  glm::dmat3 worldFromView_;
  double focal_;
  glm::dvec2 centre_;
};

}  // namespace

TruthFrame renderTruth(const RayScene& scene, const PerspectiveView& view, const BakeSettings& settings,
                       float exposure, int samplesPerPixel, TaskRunner& runner, const std::stop_token& stop) {
  return renderTruth(scene, view, view.pixels(), settings, exposure, samplesPerPixel, runner, stop);
}

TruthFrame renderTruth(const RayScene& scene, const PerspectiveView& view, const PixelRect& part,
                       const BakeSettings& settings, float exposure, int samplesPerPixel, TaskRunner& runner,
                       const std::stop_token& stop) {
  require(view.check().has_value(), "a view to render is sound");
  require(settings.check().has_value(), "bake settings are checked before they are used");
  const int grid = int(std::lround(std::sqrt(double(samplesPerPixel))));
  require(grid >= 1 && grid * grid == samplesPerPixel, "samples per pixel are a square number");

  TruthFrame frame{ColourImage(part.width(), part.height()), FloatImage(part.width(), part.height()), {}};
  const Shader shader(scene, settings, stop);
  const ViewRays camera(view);
  std::vector<RayCounts> counts(std::size_t(part.height()));
  runner.parallelFor(counts.size(), [&](std::size_t row) {
    if (stop.stop_requested()) return;
    const FlushDenormals flush;
    RayCounts& rays = counts[row];
    const int y = part.y0 + int(row);
    for (int x = part.x0; x < part.x1; ++x) {
      glm::vec3 sum(0);
      float distance = std::numeric_limits<float>::infinity();
      bool centred = false;
      for (int j = 0; j < grid; ++j)
        for (int i = 0; i < grid; ++i) {
          const auto seen = shader.seenAlong(camera.through(x + (i + 0.5) / grid, y + (j + 0.5) / grid),
                                             &RayCounts::primary, rays);
          sum += seen.radiance;
          if (grid % 2 == 1 && i == grid / 2 && j == grid / 2)
            distance = seen.opaque.distance, centred = true;
        }
      if (!centred)
        distance =
            shader.seenAlong(camera.through(x + 0.5, y + 0.5), &RayCounts::primary, rays).opaque.distance;
      frame.colour.at(x - part.x0, int(row)) = encodeForDisplay(sum / float(samplesPerPixel), exposure);
      frame.rayDistance.at(x - part.x0, int(row)) = distance;
    }
  });
  for (const RayCounts& c : counts) frame.rays += c;
  return frame;
}

Panorama tracePanorama(const RayScene& scene, const glm::dvec3& eye, int height, const BakeSettings& settings,
                       TaskRunner& runner, const std::stop_token& stop) {
  require(height >= 1, "a panorama has rows");
  require(settings.check().has_value(), "bake settings are checked before they are used");
  const int width = 2 * height;
  Panorama panorama{LinearImage(width, height), FloatImage(width, height)};
  const Shader shader(scene, settings, stop);
  runner.parallelFor(std::size_t(height), [&](std::size_t row) {
    if (stop.stop_requested()) return;
    const FlushDenormals flush;
    RayCounts rays;
    const int y = int(row);
    const double elevation = kPi * (0.5 - (y + 0.5) / height);
    for (int x = 0; x < width; ++x) {
      const glm::dvec2 plan = std::cos(elevation) * directionOf(kPi * (1 - 2 * (x + 0.5) / width));
      const auto seen = shader.seenAlong({glm::vec3(eye), glm::vec3(plan.x, plan.y, std::sin(elevation))},
                                         &RayCounts::primary, rays);
      panorama.radiance.at(x, y) = seen.radiance;
      panorama.rayDistance.at(x, y) = seen.opaque.distance;
    }
  });
  return panorama;
}

Image<std::uint8_t> viewDependentPixels(const RayScene& scene, const PerspectiveView& view,
                                        const PixelRect& part, TaskRunner& runner) {
  require(view.check().has_value(), "a view to render is sound");
  const std::vector<MaterialRules> rules = materialRules(scene.scene(), scene.plan());
  const DetailRules detail = detailRules(scene.plan());
  const ViewRays camera(view);
  const auto depends = [&](Ray ray) {
    for (int layer = 0; layer < kMaxBlendedLayers; ++layer) {
      const Hit hit = scene.trace(ray);
      if (!hit.found()) return false;
      const MaterialRules& rule = rules[std::size_t(scene.scene().meshOf(hit.mesh).material)];
      const Surface surface = surfaceAt<true>(scene.scene(), hit, -ray.direction, detail, false);
      const bool clear = rule.blended && surface.baseColour.a < kInvisibleAlpha;
      if (!clear && !rule.unlit && (rule.mirror || rule.transmissive || surface.metallic > kFaintlyMetallic))
        return true;
      if (!rule.blended || surface.baseColour.a >= kOpaqueAlpha) return false;
      ray.nearest = justBehind(hit.distance);
    }
    return false;
  };
  Image<std::uint8_t> out(part.width(), part.height());
  runner.parallelFor(std::size_t(part.height()), [&](std::size_t row) {
    const FlushDenormals flush;
    for (int x = part.x0; x < part.x1; ++x)
      out.at(x - part.x0, int(row)) = depends(camera.through(x + 0.5, part.y0 + double(row) + 0.5)) ? 1 : 0;
  });
  return out;
}

float estimateExposure(const RayScene& scene, const std::vector<glm::dvec3>& eyes,
                       const BakeSettings& settings, TaskRunner& runner) {
  require(settings.check().has_value(), "bake settings are checked before they are used");
  constexpr int kColumns = 48, kRows = 24;
  constexpr float kMiddleGrey = 0.18f, kBlack = 1e-7f;
  const Shader shader(scene, settings);
  std::vector<std::array<float, kColumns * kRows>> seen(eyes.size());
  runner.parallelFor(eyes.size(), [&](std::size_t e) {
    const FlushDenormals flush;
    RayCounts rays;
    for (int r = 0; r < kRows; ++r)
      for (int c = 0; c < kColumns; ++c) {
        // Equal areas of the sphere: rows evenly spaced in z.
        const double z = 1 - (r + 0.5) * 2 / kRows, flat = std::sqrt(1 - z * z);
        const glm::dvec2 plan = directionOf(kTwoPi * (c + 0.5) / kColumns);
        const Ray ray{glm::vec3(eyes[e]), glm::vec3(plan.x * flat, plan.y * flat, z)};
        seen[e][std::size_t(r * kColumns + c)] =
            luminance(shader.seenAlong(ray, &RayCounts::primary, rays).radiance);
      }
  });
  std::vector<float> logs;
  for (const auto& eye : seen)
    for (const float value : eye)
      if (value > kBlack && std::isfinite(value)) logs.push_back(std::log(value));
  if (logs.empty()) return 1;
  // The darkest and brightest fifths are left out, so that a lamp, a window or a black corner does not
  // decide.
  std::sort(logs.begin(), logs.end());
  const std::size_t cut = logs.size() / 5;
  double sum = 0;
  for (std::size_t i = cut; i < logs.size() - cut; ++i) sum += logs[i];
  const double average = std::exp(sum / double(logs.size() - 2 * cut));
  return float(std::clamp(kMiddleGrey / average, 1e-4, 1e4));
}

}  // namespace acentric
