// What a capture will be, before any ray: its camera and its key.
#include <algorithm>
#include <cmath>

#include "engine/bake/bake.h"
#include "engine/bake/gathered_light.h"
#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

/// Raised whenever the same input bakes to other pixels.
constexpr std::string_view kBakeVersion = "acentric capture 14";

/// Rows are never wasted on the poles, which local geometry covers.
constexpr double kSteepest = radians(85);
/// So that a surface at eye height has a row.
constexpr double kLeastElevation = radians(0.5);
constexpr int kMaxSide = 65535;

void addTo(Hasher& hasher, const HalfPlane& side) {
  for (const glm::dvec2& p : {side.line.from, side.line.to}) hasher.value(p.x).value(p.y);
  hasher.value(int(side.left));
}

int samplesFor(double angle, double samplesPerDegree) {
  return int(std::clamp(std::ceil(degrees(angle) * samplesPerDegree - 1e-6), 1.0, double(kMaxSide)));
}

/// Of all cameras alike.
KeyParts sharedParts(const Scene& scene, const EffectPlan& plan, const BakeSettings& bake) {
  // Not all settings: what an absent effect would use changes no capture, and must not bake them all again.
  Hasher settings;
  settings.value(bake.samplesPerDegree).value(bake.maxLayers).value(int(bake.pruning));
  if (bake.pruning) settings.value(bake.testEyes).value(bake.pruningLoss).value(bake.eyeRange);
  // Captures of before this could be set are as those of the usual value.
  if (bake.distanceShift != kUsualDistanceShift) settings.value(bake.distanceShift);
  settings.text("colours").value(bake.colourQuality);
  if (bake.silhouettes) settings.text("silhouettes").value(kSilhouetteVersion);
  // Counted on when what mirrors show changes, so that only captures of scenes with mirrors are baked anew.
  if (plan.on(Effect::mirrorReflection)) settings.text("mirrors 3");
  if (gathersLight(plan, bake))
    settings.value(bake.ambientRays).value(bake.ambientRadius).value(bake.surfaceTexel);
  else
    settings.value(0);
  if (plan.on(Effect::diffuseInterreflection)) settings.value(bake.bounces);
  if (plan.on(Effect::softShadows)) settings.value(bake.shadowRays);
  KeyParts parts = sceneKeyParts(kBakeVersion, scene, plan);
  parts.push_back({"settings", settings.finish()});
  return parts;
}

void addCameraParts(KeyParts& parts, const LayoutCamera& camera, const ColumnCamera& columns) {
  Hasher place, regions, image;
  const glm::dvec3& centre = columns.centreOfProjection;
  place.value(centre.x).value(centre.y).value(centre.z).value(columns.lowAzimuth).value(columns.fovRadians);
  regions.value(std::uint64_t(camera.roles.size()));
  for (const Role& role : camera.roles) {
    regions.value(std::uint64_t(role.grown.corners.size()));
    for (const ConvexPolygon* polygon : {&role.polygon, &role.grown})
      for (const glm::dvec2& corner : polygon->corners) regions.value(corner.x).value(corner.y);
    regions.value(int(role.clip.has_value()));
    if (!role.clip) continue;
    addTo(regions, role.clip->side);
    regions.value(int(role.clip->claim.has_value()));
    if (role.clip->claim) addTo(regions, *role.clip->claim);
  }
  columns.addTo(image);
  parts.push_back({"place", place.finish()});
  parts.push_back({"regions", regions.finish()});
  parts.push_back({"image", image.finish()});
}

}  // namespace

double samplesPerDegreeOf(const LayoutCamera& camera, const BakeSettings& settings) {
  return std::clamp(settings.samplesPerDegree * camera.density, kLeastSamplesPerDegree,
                    kMostSamplesPerDegree);
}

ColumnCamera columnCameraFor(const LayoutCamera& camera, double eyeZ, double nearBand,
                             const Bounds& sceneBounds, const BakeSettings& settings) {
  // What is captured lies beyond the near band, so the scene's top and bottom are seen no steeper than across
  // it, from the lowest eye and the highest.
  double top = kLeastElevation, bottom = -kLeastElevation;
  if (!sceneBounds.empty()) {
    const double across = std::max(nearBand, 0.0);
    const double rise = double(sceneBounds.max.z) - (eyeZ - settings.eyeRange);
    const double fall = double(sceneBounds.min.z) - (eyeZ + settings.eyeRange);
    top = std::clamp(std::atan2(rise, across), kLeastElevation, kSteepest);
    bottom = std::clamp(std::atan2(fall, across), -kSteepest, -kLeastElevation);
  }

  ColumnCamera columns;
  columns.centreOfProjection = glm::dvec3(camera.position, eyeZ);
  columns.lowAzimuth = camera.lowAzimuth;
  columns.fovRadians = camera.fovRadians;
  columns.topElevation = top;
  columns.bottomElevation = bottom;
  const double perDegree = samplesPerDegreeOf(camera, settings);
  columns.columns = samplesFor(camera.fovRadians, perDegree);
  columns.rows = samplesFor(top - bottom, perDegree);
  return columns;
}

KeyParts sceneKeyParts(std::string_view version, const Scene& scene, const EffectPlan& plan) {
  Hasher effects;
  plan.addTo(effects);
  return {{"program", Hasher().text(version).finish()},
          {"scene", scene.key},
          {"geometry", scene.parts.geometry},
          {"materials", scene.parts.materials},
          {"lights", scene.parts.lights},
          {"effects", effects.finish()}};
}

KeyParts captureKeyParts(const Scene& scene, const EffectPlan& plan, const BakeSettings& settings,
                         const LayoutCamera& camera, const ColumnCamera& columnCamera) {
  KeyParts parts = sharedParts(scene, plan, settings);
  addCameraParts(parts, camera, columnCamera);
  return parts;
}

ColumnCamera columnCameraFor(const LayoutCamera& camera, const Layout& layout, const Bounds& sceneBounds,
                             const BakeSettings& settings) {
  return columnCameraFor(camera, layout.eyeZ(), layout.spec.nearBand, sceneBounds, settings);
}

ContentKey captureKey(const Scene& scene, const EffectPlan& plan, const BakeSettings& settings,
                      const LayoutCamera& camera, const ColumnCamera& columnCamera) {
  return keyOf(captureKeyParts(scene, plan, settings, camera, columnCamera));
}

std::vector<ContentKey> captureKeys(const Scene& scene, const EffectPlan& plan, const BakeSettings& settings,
                                    const Layout& layout) {
  const KeyParts shared = sharedParts(scene, plan, settings);
  std::vector<ContentKey> keys;
  keys.reserve(layout.cameras.size());
  for (const LayoutCamera& camera : layout.cameras) {
    KeyParts parts = shared;
    addCameraParts(parts, camera, columnCameraFor(camera, layout, scene.bounds, settings));
    keys.push_back(keyOf(parts));
  }
  return keys;
}

}  // namespace acentric
