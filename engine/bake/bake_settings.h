#pragma once
/// What the designer trades: quality against bake time and bytes. Part of every capture's key.

#include <cstdint>

#include "engine/base/hash.h"
#include "engine/base/result.h"
#include "engine/image/colour_quality.h"

namespace acentric {

/// Metres, of the settings' lengths; a project may be drawn in any unit.
inline constexpr double kLeastBakeLength = 1e-6, kLargestBakeLength = 1e6;

inline constexpr int kMostTestEyes = 64;
inline constexpr double kLeastPruningLoss = 1e-5;

/// Of what silhouettes, and colours with them, are baked as.
inline constexpr int kSilhouetteVersion = 6;
inline constexpr double kUsualDistanceShift = 0.1, kLargestDistanceShift = 16;

/// How much of the settings a bake spends: a preview is there at once, a draft shows the layout's faults.
enum class Quality : std::uint8_t { preview, draft, full };
inline constexpr Quality kQualities[] = {Quality::preview, Quality::draft, Quality::full};
const char* nameOf(Quality quality);  ///< preview, draft, final

inline constexpr double kLeastSamplesPerDegree = 0.5, kMostSamplesPerDegree = 64;

struct BakeSettings {
  double samplesPerDegree = 16;  ///< columns and rows per degree, 0.5..64
  int ambientRays = 32;          ///< per place that light is gathered for, 0..1024; for occlusion and bounces
  double ambientRadius = 2.0;    ///< metres; occluders beyond fade out
  int shadowRays = 16;           ///< per sample towards each light with a size, 1..1024
  int bounces = 2;               ///< of light between surfaces, 1..8; used where the plan has interreflection
  double surfaceTexel = 0.04;    ///< metres between light samples on local geometry, and of gathered light
  int maxLayers = 8;             ///< samples kept per pixel for one region at most, 1..64
  bool pruning = true;           ///< keep only what a served region sees from one of its test eyes
  int testEyes = 8;              ///< placed evenly in each served region, 1..64
  /// Of what eyes in a region see, the share that pruning may lose: until no more is lost, eyes are added to
  /// the region, up to 64. kLeastPruningLoss..1; 0 = ask those placed evenly alone, whatever is lost.
  double pruningLoss = 0.0005;
  double eyeRange = 0.15;  ///< metres: how far above and below eye height the eye may stand, 0..1e6
  /// Of a sample's spacing: by how much the picture may shift because inverse distances are rounded, 0..16.
  /// 0 = only to the 16 significant bits that captures keep.
  double distanceShift = kUsualDistanceShift;
  /// How true colours are to what was baked (colour_quality.h): 0..99 as pictures, 100 = every bit.
  int colourQuality = kUsualColourQuality;
  /// Samples tell the plane of their surface, and how much of their pixel it covers (capture.h). Always, but
  /// where a benchmark times what else a bake does.
  bool silhouettes = true;

  /// Those that a quality is baked with: an eighth or half of the resolution, fewer rays, layers and eyes.
  BakeSettings at(Quality quality) const;
  Status check() const;
  void addTo(Hasher& hasher) const;
  bool operator==(const BakeSettings&) const = default;
};

}  // namespace acentric
