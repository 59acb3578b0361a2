#pragma once
/// A room with a mirror, and how well a frame shows what is seen in it.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/view/capture_fixtures.h"
#include "tests/view/mirror_scene.h"

namespace acentric::test {

/// A wall of coloured blocks behind the viewer, and a mirror of 4 x 2 m before him at x = 4.
inline MirrorScene roomWithMirror() {
  MirrorScene scene;
  for (int i = 0; i < 24; ++i) {
    const double y = -9 + 0.75 * i;
    const glm::vec4 colour(i % 3 == 0 ? 0.7f : 0.1f, i % 2 == 0 ? 0.6f : 0.15f, float(i) / 24, 1);
    scene.surfaces.boxes.push_back({{-4.2, y, 0}, {-4, y + 0.75, 0.8 + 0.1 * (i % 7)}, colour});
  }
  scene.surfaces.boxes.push_back({{-2.9, -1, 0}, {-2.6, -0.4, 1.9}, {0.8f, 0.8f, 0.1f, 1}});
  scene.mirrors.push_back({0, 4, {-2, 0.6}, {2, 2.6}, {0.9f, 0.9f, 0.9f}, 1});
  return scene;
}

/// Towards that mirror.
inline PerspectiveView viewIntoMirror(const Layout& layout, const glm::dvec3& offset, int width = 320,
                                      int height = 200) {
  PerspectiveView view;
  view.eye = glm::dvec3(0.05, 0.05, layout.eyeZ()) + offset;
  view.fovRadians = radians(70);
  view.width = width;
  view.height = height;
  return view;
}

/// Peak signal to noise of the pixels that look into a mirror, dB; the error of each channel is in codes.
inline double psnrInMirrors(const MirrorScene& scene, const PerspectiveView& view, const Frame& frame) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const auto seen = scene.along(view.eye, view.rayThrough(x + 0.5, y + 0.5), 0);
      if (seen.size() != 1 || seen.front().mirror == 0) continue;
      const glm::vec3 truth(encodeForDisplay(glm::vec3(seen.front().colour), 1));
      const glm::vec3 off = truth - glm::vec3(frame.colour.at(x, y));
      sum += double(glm::dot(off, off)) / 3;
      ++count;
    }
  EXPECT_GT(count, 500);
  return 10 * std::log10(255 * 255 * count / sum);
}

}  // namespace acentric::test
