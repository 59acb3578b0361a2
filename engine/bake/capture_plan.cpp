// What a capture will be, before any ray: its camera and its key.
#include <algorithm>
#include <cmath>

#include "engine/bake/bake.h"
#include "engine/bake/gathered_light.h"
#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

/// Raised whenever the same input bakes to other pixels.
constexpr std::string_view kBakeVersion = "acentric capture 2";

constexpr double kSteepest =
    radians(85);  ///< rows are never wasted on the poles, which local geometry covers
constexpr double kFlattest = radians(10);  ///< a view reaches this far up and down even in a flat scene
constexpr double kSkyTop = radians(50);    ///< where sky shows, views look up to it
constexpr int kMaxSide = 65535;

int samplesFor(double angle, double samplesPerDegree) {
  return int(std::clamp(std::ceil(degrees(angle) * samplesPerDegree - 1e-6), 1.0, double(kMaxSide)));
}

}  // namespace

ColumnCamera columnCameraFor(const LayoutCamera& camera, double eyeZ, double nearBand,
                             const Bounds& sceneBounds, bool skyVisible, const BakeSettings& settings) {
  // What is captured lies beyond the near band, so the scene's top and bottom are seen no steeper than across
  // it.
  double top = kFlattest, bottom = -kFlattest;
  if (!sceneBounds.empty()) {
    const double across = std::max(nearBand, 0.0);
    top = std::clamp(std::atan2(double(sceneBounds.max.z) - eyeZ, across), kFlattest, kSteepest);
    bottom = std::clamp(std::atan2(double(sceneBounds.min.z) - eyeZ, across), -kSteepest, -kFlattest);
  }
  if (skyVisible) top = std::max(top, kSkyTop);

  ColumnCamera columns;
  columns.centreOfProjection = glm::dvec3(camera.position, eyeZ);
  columns.lowAzimuth = camera.lowAzimuth;
  columns.fovRadians = camera.fovRadians;
  columns.topElevation = top;
  columns.bottomElevation = bottom;
  columns.columns = samplesFor(camera.fovRadians, settings.samplesPerDegree);
  columns.rows = samplesFor(top - bottom, settings.samplesPerDegree);
  return columns;
}

ContentKey captureKey(const Scene& scene, const EffectPlan& plan, const BakeSettings& settings,
                      const LayoutCamera& camera, const ColumnCamera& columnCamera) {
  Hasher hasher;
  hasher.text(kBakeVersion);
  hasher.value(scene.key.high).value(scene.key.low);
  plan.addTo(hasher);
  // Not all settings: what an absent effect would use changes no capture, and must not bake them all again.
  hasher.value(settings.maxLayers);
  if (gathersLight(plan, settings))
    hasher.value(settings.ambientRays).value(settings.ambientRadius).value(settings.surfaceTexel);
  else
    hasher.value(0);
  if (plan.on(Effect::diffuseInterreflection)) hasher.value(settings.bounces);
  if (plan.on(Effect::softShadows)) hasher.value(settings.shadowRays);
  columnCamera.addTo(hasher);
  hasher.value(std::uint64_t(camera.served.size()));
  for (const ConvexPolygon& polygon : camera.served) {
    hasher.value(std::uint64_t(polygon.corners.size()));
    for (const glm::dvec2& corner : polygon.corners) hasher.value(corner.x).value(corner.y);
  }
  return hasher.finish();
}

std::vector<ContentKey> captureKeys(const Scene& scene, const EffectPlan& plan, const BakeSettings& settings,
                                    const Layout& layout) {
  std::vector<ContentKey> keys;
  keys.reserve(layout.cameras.size());
  for (const LayoutCamera& camera : layout.cameras)
    keys.push_back(captureKey(scene, plan, settings, camera,
                              columnCameraFor(camera, layout.eyeZ(), layout.spec.nearBand, scene.bounds,
                                              plan.on(Effect::sky), settings)));
  return keys;
}

}  // namespace acentric
