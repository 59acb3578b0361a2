#pragma once
/// Captures with contents like a baked room's: walls, floor and sky, textured, some glass, some hidden
/// surfaces.

#include <cmath>
#include <random>

#include "engine/geometry/conventions.h"
#include "engine/image/capture.h"

namespace acentric {

struct SyntheticOptions {
  int columns = 48;
  int rows = 40;
  bool layered = false;  ///< hidden surfaces behind a quarter of the pixels, glass before an eighth
  bool gaps = true;      ///< some pixels hold nothing
  unsigned seed = 1;
  bool mirrors = false;  ///< a third of the opaque samples belong to mirrors that show something
};

/// A third of the opaque samples become mirrors, which show sky or a wall (with `layered` both, one behind
/// the other).
inline Capture withMirrors(Capture capture, bool layered) {
  CaptureSamples& shown = capture.reflections;
  shown.columnStart.push_back(0);
  capture.mirror.assign(capture.sampleCount(), 0);
  for (std::size_t k = 0; k + 1 < capture.columnStart.size(); ++k) {
    int lastRow = -1;
    for (std::size_t i = capture.columnStart[k]; i < capture.columnStart[k + 1]; ++i) {
      if (i % 3 != 0 || capture.colour[i].a != 0x3c00 || capture.row[i] == lastRow) continue;
      lastRow = capture.row[i];
      capture.mirror[i] = static_cast<std::uint8_t>(1 + i % 255);
      for (int layer = layered ? 0 : 1; layer < 2; ++layer) {
        shown.row.push_back(capture.row[i]);
        shown.inverseDistance.push_back(layer == 0 ? 0.5f * capture.inverseDistance[i] : 0);
        shown.colour.push_back(packColour({0.5f, 0.25f * static_cast<float>(layer), 0.125f, 1}));
        shown.roles.push_back(capture.roles[i]);
        shown.mirror.push_back(capture.mirror[i]);
      }
    }
    shown.columnStart.push_back(static_cast<std::uint32_t>(shown.row.size()));
  }
  return capture;
}

/// Planes and coverage of all samples, those of mirrors too.
inline Capture withSilhouettes(Capture capture) {
  const auto give = [](CaptureSamples& samples) {
    for (std::size_t i = 0; i < samples.sampleCount(); ++i) {
      if (i % 3 == 0)
        samples.planes.push_back(
            {{0.25f * float(i), -0.5f, samples.inverseDistance[i]}, std::uint32_t(i % 2)});
      samples.plane.push_back(std::uint32_t(samples.planes.size() - 1));
      samples.coverage.push_back(i % 5 == 0 ? std::uint16_t(1 + i % 0xffff) : kWholePixel);
    }
  };
  give(capture), give(capture.reflections);
  capture.planeTolerance = 1.0 / (1 << 12);
  return capture;
}

inline Capture syntheticCapture(const SyntheticOptions& options) {
  std::mt19937 random(options.seed);
  std::uniform_real_distribution<float> noise(0.8f, 1.2f);
  Capture capture;
  capture.camera = {{1.25, -3.5, 1.6}, 0.3,         kPi / 3, radians(40), radians(-46),
                    options.columns,   options.rows};
  capture.distanceStep = 1.0 / (1 << 14);
  capture.columnStart.push_back(0);
  BackgroundBuilder background;
  const auto add = [&](int row, double w, float alpha) {
    capture.row.push_back(static_cast<std::uint16_t>(row));
    capture.inverseDistance.push_back(storedInverseDistance(w, capture.distanceStep));
    capture.roles.push_back(static_cast<std::uint8_t>(1 + capture.row.size() % 255));
    const float light = static_cast<float>(0.1 + 0.5 * w) * noise(random);
    capture.colour.push_back(packColour({light, 0.8f * light, 0.6f * light, alpha}));
  };
  for (int k = 0; k < options.columns; ++k) {
    const double azimuth = capture.camera.azimuthAt(k + 0.5);
    const double wall = (1.2 + std::cos(azimuth - 0.8)) / 8;  // one over the distance of a slanted wall
    for (int row = 0; row < options.rows; ++row) {
      const unsigned draw = static_cast<unsigned>(random());
      if (options.gaps && draw % 11 == 0) continue;
      const double tangent = capture.camera.tangentAt(row + 0.5);
      const double floor = -tangent / 1.6;
      const double first = tangent > 0.5 ? 0.0 : std::max(wall, floor);
      if (options.layered && draw % 8 == 1) add(row, first + 0.5, 0.3f);
      if (first > 0)
        add(row, first, 1);
      else
        background.add(row, static_cast<std::uint8_t>(1 + k % 3));
      if (options.layered && draw % 4 == 2 && first > 0) add(row, first * 0.5, 1);
    }
    capture.columnStart.push_back(static_cast<std::uint32_t>(capture.row.size()));
    background.closeColumn();
  }
  capture.background =
      std::move(background).finish({{0.1f, 0.2f, 0.7f}, {0.6f, 0.6f, 0.5f}, {0.2f, 0.1f, 0.1f}});
  return options.mirrors ? withMirrors(std::move(capture), options.layered) : capture;
}

}  // namespace acentric
