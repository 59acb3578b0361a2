#pragma once
/// What one camera bakes of a small scene.

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "engine/bake/bake.h"
#include "engine/image/colour.h"
#include "layout_builder.h"
#include "scene_builder.h"

namespace acentric::test {

inline constexpr double kEyeZ = 1.6;

struct Baked {
  ColumnCamera columns;
  Capture capture;
  RayCounts rays;
  SampleCounts counts;

  struct Sample {
    double w;
    glm::vec4 colour;
    int roles;
  };
  /// Samples of the pixel that looks in a direction, nearest first, and last, without distance, the
  /// background.
  std::vector<Sample> pixel(double azimuth, double elevation) const {
    const int k = int((azimuth - columns.lowAzimuth) / columns.columnPitch());
    const int r = int((columns.topElevation - elevation) / columns.rowPitch());
    return pixelAt(k, r);
  }
  std::vector<Sample> pixelAt(int k, int r) const {
    std::vector<Sample> samples;
    for (auto i = capture.columnStart[std::size_t(k)]; i < capture.columnStart[std::size_t(k) + 1]; ++i)
      if (capture.row[i] == r)
        samples.push_back(
            {double(capture.inverseDistance[i]), unpackColour(capture.colour[i]), capture.roles[i]});
    const CaptureBackground& runs = capture.background;
    if (runs.runCount() == 0) return samples;
    for (auto i = runs.columnStart[std::size_t(k)]; i < runs.columnStart[std::size_t(k) + 1]; ++i)
      if (runs.firstRow[i] <= r && r < runs.endRow[i]) {
        const glm::dvec3 direction(columns.directionAt(k + 0.5), columns.tangentAt(r + 0.5));
        samples.push_back(
            {0, glm::vec4(runs.sky.radiance(glm::vec3(glm::normalize(direction))), 1), runs.roles[i]});
      }
    return samples;
  }
};

inline Baked bakeAsSet(const RayScenePtr& scene, const LayoutCamera& camera, const BakeSettings& settings,
                       int workers = 0) {
  Baked out;
  out.columns = columnCameraFor(camera, kEyeZ, 1, scene->scene().bounds, settings);
  TaskRunner runner(workers);
  CaptureCounts counts;
  auto capture = CameraBaker(*scene, settings).bake(camera, out.columns, runner, counts);
  out.rays = counts.rays;
  out.counts = counts.samples;
  EXPECT_TRUE(capture.has_value()) << (capture ? "" : capture.error().describe());
  if (!capture) return out;
  EXPECT_TRUE(capture->check().has_value()) << capture->check().error().describe();
  out.capture = std::move(*capture);
  return out;
}

/// What the march along the rays of pixels keeps, without what silhouettes add beside it.
inline Baked bakeFrom(const RayScenePtr& scene, const LayoutCamera& camera, BakeSettings settings = {},
                      int workers = 0) {
  if (settings == BakeSettings{})
    settings.samplesPerDegree = 2, settings.ambientRays = 12, settings.surfaceTexel = 0.2;
  settings.silhouettes = false;
  return bakeAsSet(scene, camera, settings, workers);
}

/// A room whose wall in front is at x = 6, lit by a lamp.
inline SceneBuilder room() {
  SceneBuilder builder;
  builder.box(builder.material(matte({0.8f, 0.7f, 0.6f})), {-6, -5, 0}, {6, 5, 3}, true)
      .point({0, 0, 2.5f}, 100);
  return builder;
}

/// Coarse, and one surface a role.
inline BakeSettings firstOnly() {
  BakeSettings settings;
  settings.samplesPerDegree = 2;
  settings.maxLayers = 1;
  return settings;
}

}  // namespace acentric::test
