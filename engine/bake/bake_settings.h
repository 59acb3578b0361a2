#pragma once
/// What the designer trades: quality against bake time and bytes. Part of every capture's key.

#include "engine/base/hash.h"
#include "engine/base/result.h"

namespace acentric {

/// Metres, of the settings' lengths; a project may be drawn in any unit.
inline constexpr double kLeastBakeLength = 1e-6, kLargestBakeLength = 1e6;

struct BakeSettings {
  double samplesPerDegree = 8;  ///< columns and rows per degree, 0.5..64
  int ambientRays = 12;         ///< per sample, 0..1024; used where the plan has ambient occlusion
  double ambientRadius = 2.0;   ///< metres; occluders beyond fade out
  int shadowRays = 16;          ///< per sample towards each light with a size, 1..1024
  double surfaceTexel = 0.04;   ///< metres between light samples on local geometry
  int maxLayers = 8;            ///< samples kept per pixel at most, 1..64

  Status check() const;
  void addTo(Hasher& hasher) const;
  bool operator==(const BakeSettings&) const = default;
};

}  // namespace acentric
