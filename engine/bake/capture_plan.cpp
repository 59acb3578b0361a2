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

/// Rows are never wasted on the poles, which local geometry covers.
constexpr double kSteepest = radians(85);
/// So that a surface at eye height has a row.
constexpr double kFlattest = radians(0.5);
constexpr int kMaxSide = 65535;

void addTo(Hasher& hasher, const HalfPlane& side) {
  for (const glm::dvec2& p : {side.line.from, side.line.to}) hasher.value(p.x).value(p.y);
  hasher.value(int(side.left));
}

int samplesFor(double angle, double samplesPerDegree) {
  return int(std::clamp(std::ceil(degrees(angle) * samplesPerDegree - 1e-6), 1.0, double(kMaxSide)));
}

}  // namespace

ColumnCamera columnCameraFor(const LayoutCamera& camera, double eyeZ, double nearBand,
                             const Bounds& sceneBounds, const BakeSettings& settings) {
  // What is captured lies beyond the near band, so the scene's top and bottom are seen no steeper than across
  // it, from the lowest eye and the highest.
  double top = kFlattest, bottom = -kFlattest;
  if (!sceneBounds.empty()) {
    const double across = std::max(nearBand, 0.0);
    const double rise = double(sceneBounds.max.z) - (eyeZ - settings.eyeRange);
    const double fall = double(sceneBounds.min.z) - (eyeZ + settings.eyeRange);
    top = std::clamp(std::atan2(rise, across), kFlattest, kSteepest);
    bottom = std::clamp(std::atan2(fall, across), -kSteepest, -kFlattest);
  }

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
  hasher.value(settings.maxLayers).value(int(settings.pruning));
  if (settings.pruning) hasher.value(settings.testEyes).value(settings.eyeRange);
  if (gathersLight(plan, settings))
    hasher.value(settings.ambientRays).value(settings.ambientRadius).value(settings.surfaceTexel);
  else
    hasher.value(0);
  if (plan.on(Effect::diffuseInterreflection)) hasher.value(settings.bounces);
  if (plan.on(Effect::softShadows)) hasher.value(settings.shadowRays);
  columnCamera.addTo(hasher);
  hasher.value(std::uint64_t(camera.roles.size()));
  for (const Role& role : camera.roles) {
    hasher.value(std::uint64_t(role.grown.corners.size()));
    for (const ConvexPolygon* polygon : {&role.polygon, &role.grown})
      for (const glm::dvec2& corner : polygon->corners) hasher.value(corner.x).value(corner.y);
    hasher.value(int(role.clip.has_value()));
    if (!role.clip) continue;
    addTo(hasher, role.clip->side);
    hasher.value(int(role.clip->claim.has_value()));
    if (role.clip->claim) addTo(hasher, *role.clip->claim);
  }
  return hasher.finish();
}

std::vector<ContentKey> captureKeys(const Scene& scene, const EffectPlan& plan, const BakeSettings& settings,
                                    const Layout& layout) {
  std::vector<ContentKey> keys;
  keys.reserve(layout.cameras.size());
  for (const LayoutCamera& camera : layout.cameras)
    keys.push_back(
        captureKey(scene, plan, settings, camera,
                   columnCameraFor(camera, layout.eyeZ(), layout.spec.nearBand, scene.bounds, settings)));
  return keys;
}

}  // namespace acentric
