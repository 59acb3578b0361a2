#include "engine/pipeline/simplified_regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace acentric {
namespace {

/// A change of the method makes what is stored stale.
constexpr std::uint32_t kMethodVersion = 1;
constexpr int kEyes = 3, kDirections = 4;

SimplifyOptions optionsOf(const OpenProject& open) {
  SimplifyOptions options;
  options.mostTriangles = std::size_t(open.project.budget.trianglesPerRegion);
  options.maxError = open.project.budget.maxErrorMetres;
  options.lightTexel = open.project.bake.surfaceTexel;
  return options;
}

LocalGeometry drawable(const SimplifiedLocal& simplified, const OpenProject& open, const Region& region,
                       const std::shared_ptr<const SurfaceLight>& light) {
  return localGeometryOf(simplified, open.drawn->scene(), region.grown, light.get());
}

/// The middle of the region, and halfway from it to some of its corners.
std::vector<glm::dvec2> eyesIn(const ConvexPolygon& polygon) {
  const glm::dvec2 middle = polygon.centroid();
  std::vector<glm::dvec2> eyes{middle};
  for (int n = 1; n < kEyes; ++n)
    eyes.push_back(glm::mix(middle, polygon.corners[std::size_t(n) * polygon.size() / kEyes], 0.5));
  return eyes;
}

}  // namespace

ContentKey simplifiedKey(const OpenProject& open, const Region& region) {
  Hasher hasher;
  hasher.text("simplified local geometry")
      .value(kMethodVersion)
      .value(open.scene->key.high)
      .value(open.scene->key.low)
      .array(std::span<const glm::dvec2>(region.grown.corners))
      .value(open.project.budget.trianglesPerRegion)
      .value(open.project.budget.maxErrorMetres)
      .value(open.project.bake.surfaceTexel);
  if (open.near.any())  // its triangles are numbered as those that are drawn
    hasher.value(open.near.key.high).value(open.near.key.low);
  return hasher.finish();
}

std::vector<ContentKey> simplifiedKeys(const OpenProject& open) {
  std::vector<ContentKey> keys;
  if (open.project.budget.simplifies())
    for (const Region& region : open.layout->regions) keys.push_back(simplifiedKey(open, region));
  return keys;
}

Result<SimplifiedRegion> simplifiedRegion(const OpenProject& open, int region,
                                          const std::shared_ptr<const LocalGeometry>& full,
                                          const std::shared_ptr<const SurfaceLight>& light,
                                          const CaptureStore& store, std::stop_token stop) {
  const Region& place = open.layout->regions[std::size_t(region)];
  const ContentKey key = simplifiedKey(open, place);
  SimplifiedRegion out;
  if (store.hasSimplified(key)) {
    auto kept = store.getSimplified(key);
    if (kept)
      if (Status fits = kept->check(open.drawn->scene()); !fits) kept = tl::unexpected(fits.error());
    if (kept) {
      out.geometry = std::make_shared<const LocalGeometry>(drawable(*kept, open, place, light));
      out.report = kept->report;
      out.fromStore = true;
      return out;
    }
    out.notKept = kept.error();
  }
  const auto whole =
      full ? full : std::make_shared<const LocalGeometry>(clipToPolygon(*open.drawn, place.grown));
  auto made = simplify(open.drawn->scene(), *whole, optionsOf(open), stop);
  if (!made) return tl::unexpected(made.error());
  out.geometry = std::make_shared<const LocalGeometry>(drawable(*made, open, place, light));
  measureCost(open, region, whole, out.geometry, light, made->report);
  out.report = made->report;
  if (Status put = store.putSimplified(key, *made); !put) out.notKept = put.error();
  return out;
}

void measureCost(const OpenProject& open, int region, const std::shared_ptr<const LocalGeometry>& full,
                 const std::shared_ptr<const LocalGeometry>& simplified,
                 const std::shared_ptr<const SurfaceLight>& light, SimplifyReport& report) {
  WalkScene walk;
  walk.scene = open.drawn->sharedScene();
  walk.layout = open.layout;
  walk.plan = open.plan;
  walk.exposure = open.project.exposure;
  walk.surfaceLight = light;
  walk.captures.resize(open.layout->cameras.size());
  walk.local.resize(open.layout->regions.size());
  ViewSettings settings;
  settings.renderer = Renderer::list;
  settings.fillHoles = false;
  TaskRunner inlineRunner(0);
  const auto pictureOf = [&](const std::shared_ptr<const LocalGeometry>& local, const PerspectiveView& view) {
    walk.local[std::size_t(region)] = local;
    return renderFrame(walk, view, settings, inlineRunner);
  };
  double squares = 0, differences = 0, values = 0;
  report.comparedFrames = 0;
  for (const glm::dvec2& eye : eyesIn(open.layout->regions[std::size_t(region)].polygon))
    for (int direction = 0; direction < kDirections; ++direction) {
      PerspectiveView view;
      view.eye = glm::dvec3(eye, open.layout->eyeZ());
      view.yawRadians = kTwoPi * direction / kDirections;
      view.pitchRadians = radians(-15);
      view.fovRadians = radians(90);
      view.width = 320, view.height = 240;
      const auto a = pictureOf(full, view), b = pictureOf(simplified, view);
      if (!a || !b) continue;
      ++report.comparedFrames;
      for (std::size_t n = 0; n < a->colour.pixels.size(); ++n) {
        if (a->source.pixels[n] != kSourceLocal && b->source.pixels[n] != kSourceLocal) continue;
        for (int c = 0; c < 3; ++c) {
          const double d = double(a->colour.pixels[n][c]) - b->colour.pixels[n][c];
          squares += d * d, differences += std::abs(d), values += 1;
        }
      }
    }
  report.psnr = squares > 0 ? std::min(99.0, 10 * std::log10(255.0 * 255.0 * values / squares)) : 99;
  report.meanDifference = values > 0 ? differences / values : 0;
}

}  // namespace acentric
