#pragma once
/// Light that reaches surfaces from all around: the sky less what occluders take (ambient occlusion), or,
/// with diffuse interreflection, the sky and everything that surfaces send on, over n bounces. It changes
/// slowly from place to place, so it is gathered once per place of a grid over each triangle and read
/// between: every camera, the surfaces' own light and the reference read the same values, and share their
/// cost.
///
/// A place is gathered when it is first read, whoever reads it; its value depends on the place alone, so the
/// order and the number of threads change nothing. Grids have 8 bytes a place and side, are bounded by
/// kMaxPlaces for all triangles of the scene (512 MiB, of which memory is taken only where something is
/// read), and get coarser where that is not enough.

#include <atomic>
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "engine/bake/ambient.h"
#include "engine/bake/bake_settings.h"
#include "engine/bake/direct_light.h"
#include "engine/bake/ray_scene.h"
#include "engine/image/capture.h"

namespace acentric {

/// What depends on the settings; a change of any other keeps what is gathered.
struct GatherSettings {
  int ambientRays = 0, shadowRays = 0, bounces = 0;
  double ambientRadius = 0, texel = 0;
  static GatherSettings of(const BakeSettings& settings);
  bool operator==(const GatherSettings&) const = default;
};

/// Values that are made when they are first asked for, by any thread. Zero memory that nobody touched costs
/// nothing.
class ValuesOnDemand {
 public:
  explicit ValuesOnDemand(std::size_t count);
  /// `make(rays)` gives a value with alpha > 0, the same whenever it is called; only the thread whose value
  /// is kept adds its rays to `rays`.
  template <class Make>
  HalfColour at(std::size_t index, RayCounts& rays, const Make& make) const;

 private:
  struct Free {
    void operator()(std::uint64_t* values) const;
  };
  std::unique_ptr<std::uint64_t[], Free> values_;
};

template <class Make>
HalfColour ValuesOnDemand::at(std::size_t index, RayCounts& rays, const Make& make) const {
  const std::atomic_ref<std::uint64_t> value(values_[index]);
  if (const std::uint64_t known = value.load(std::memory_order_relaxed); known != 0)
    return std::bit_cast<HalfColour>(known);
  RayCounts own;
  const HalfColour made = make(own);
  std::uint64_t nothing = 0;
  if (value.compare_exchange_strong(nothing, std::bit_cast<std::uint64_t>(made), std::memory_order_relaxed))
    rays += own;
  return made;
}

class GatheredLight {
 public:
  static constexpr std::uint64_t kMaxPlaces = 64ull << 20;  ///< both sides counted

  static constexpr std::uint32_t kMaxResolution = 2048;  ///< places along an edge

  GatheredLight(const RayScene& scene, const BakeSettings& settings);

  struct Gathered {
    glm::vec3 radiance{0};  ///< cosine-weighted mean, i.e. what a white Lambert surface sends back
    float open = 1;         ///< share that no occluder takes, or with bounces, that meets no surface
  };
  /// At a hit, on the side that `toViewer` sees.
  Gathered at(const Hit& hit, bool back, RayCounts& rays) const;

  const GatherSettings& settings() const { return settings_; }
  /// Metres between places: as set, or more to stay within kMaxPlaces.
  double texel() const { return texel_; }

 private:
  Hit placeOn(const Hit& hit, const glm::vec2& barycentric) const;
  /// One grid per triangle and side: the finest reads between corners of cells, bounces read whole cells.
  struct Grids {
    std::vector<std::uint32_t> first;  ///< by scene triangle, + 1 sentinel
    std::vector<std::uint16_t> resolution;
  };
  Grids layOut(double texel, bool corners) const;
  Gathered gather(const Surface& surface, std::uint32_t triangle, std::uint32_t place, RayCounts& own,
                  RayCounts& kept) const;
  Gathered gatherBounced(const Surface& surface, int bounces, int count,
                         const PositionSamples::Points& points, RayCounts& own, RayCounts& kept) const;
  glm::vec3 sentBy(const Hit& hit, const glm::vec3& direction, int bounces, RayCounts& rays) const;
  /// Light of a white surface in the cell of a hit, from its sources and `bounces` bounces.
  glm::vec3 cellLight(const Hit& hit, bool back, int bounces, RayCounts& rays) const;

  const RayScene* scene_;
  GatherSettings settings_;
  DirectLights lights_;
  Ambient ambient_;
  bool bounced_ = false, emission_ = false;
  std::vector<MaterialRules> rules_;
  DetailRules detail_;
  double texel_ = 0;
  std::vector<std::uint32_t> firstTriangles_;
  Grids places_, cells_;
  ValuesOnDemand values_;
  std::vector<ValuesOnDemand> cellValues_;  ///< by bounces before
};

/// Is light from all around gathered with rays, rather than taken as if nothing were in the way?
bool gathersLight(const EffectPlan& plan, const BakeSettings& settings);

/// Samples per edge of a triangle: the longest edge by the texel, but not more samples than a few per texel
/// of area (needles).
std::uint32_t resolutionFor(const Mesh& mesh, std::uint32_t triangle, double texel, std::uint32_t most);

}  // namespace acentric
