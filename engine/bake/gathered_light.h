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
/// read), and get coarser where that is not enough. Of a scene with more triangles than that has room for,
/// and of instances, only the places that were read lately are kept.

#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <stop_token>
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
  /// `make(rays)` gives a value with alpha > 0, the same whenever it is called, or 0 if it could not; only
  /// the thread whose value is kept adds its rays to `rays`.
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
  const auto bits = std::bit_cast<std::uint64_t>(made);
  std::uint64_t nothing = 0;
  if (bits == 0) return made;
  if (value.compare_exchange_strong(nothing, bits, std::memory_order_relaxed)) {
    own.gathered = own.total();
    rays += own;
  }
  return made;
}

/// The same for places that are too many to lay out: kept by what they are read for, of the many only some.
/// What is forgotten is made again, and is the same.
class ScatteredValuesOnDemand {
 public:
  struct Key {
    std::uint32_t placed = 0, triangle = 0, place = 0;
    bool operator==(const Key&) const = default;
  };
  ScatteredValuesOnDemand();
  ~ScatteredValuesOnDemand();
  ScatteredValuesOnDemand(ScatteredValuesOnDemand&&) noexcept;
  template <class Make>
  HalfColour at(const Key& key, RayCounts& rays, const Make& make) const {
    if (const auto known = find(key)) return *known;
    RayCounts own;
    const HalfColour made = make(own);
    if (std::bit_cast<std::uint64_t>(made) == 0 || !keep(key, made)) return made;
    own.gathered = own.total();
    rays += own;
    return made;
  }

 private:
  struct Shard;
  std::optional<HalfColour> find(const Key& key) const;
  bool keep(const Key& key, const HalfColour& value) const;  ///< false: another thread was quicker
  std::unique_ptr<Shard[]> shards_;
};

class GatheredLight {
 public:
  static constexpr std::uint64_t kMaxPlaces = 64ull << 20;  ///< both sides counted

  static constexpr std::uint32_t kMaxResolution = 2048;  ///< places along an edge
  /// Rays gathered for a cell, and how much larger than places cells are: what a surface sends is seen from
  /// afar, and averaged over many cells.
  static constexpr int kCellRays = 32;
  static constexpr double kCellTexels = 4;

  GatheredLight(const RayScene& scene, const BakeSettings& settings, std::uint64_t mostPlaces = kMaxPlaces);

  struct Gathered {
    glm::vec3 radiance{0};  ///< cosine-weighted mean, i.e. what a white Lambert surface sends back
    float open = 1;         ///< share that no occluder takes, or with bounces, that meets no surface
  };
  /// At a hit, on the side that `toViewer` sees. A stop ends it soon, however many bounces are still to be
  /// followed: what it gives then means nothing, and is not kept.
  Gathered at(const Hit& hit, bool back, RayCounts& rays, const std::stop_token& stop = {}) const;

  /// What light is gathered for: a place that surfaces read, or a cell that bounces read.
  struct Spot {
    std::uint32_t mesh = 0, triangle = 0;  ///< of the placed mesh
    std::uint32_t sceneTriangle = 0;       ///< not of an instance
    bool back = false;
    glm::dvec3 position{0};   ///< amid what reads it, metres
    glm::vec3 normal{0};      ///< of its side, unit
    double squareMetres = 0;  ///< of the surface that reads it
  };
  /// Are the places of a placed mesh laid out? Those of others have no numbers.
  bool isLaidOut(std::uint32_t placed) const { return laidOut_ && placed + 1 < firstTriangles_.size(); }
  /// Of those that are.
  std::size_t placeCount() const { return places_.first.back(); }
  Spot place(std::size_t number) const;
  void gatherPlace(std::size_t number, RayCounts& rays, const std::stop_token& stop = {}) const;
  /// The same cells for each of the bounces; none without interreflection.
  std::size_t cellCount() const { return cellValues_.empty() ? 0 : cells_.first.back(); }
  Spot cell(std::size_t number) const;
  /// With its light after 0..bounces - 1 bounces.
  void gatherCell(std::size_t number, int bounces, RayCounts& rays, const std::stop_token& stop = {}) const;
  /// The middle of one side of a triangle, with all of its area: also of an instance.
  Spot middleOf(std::uint32_t placed, std::uint32_t triangle, bool back) const;
  /// On one side of a triangle.
  double placesPerSquareMetre(std::uint32_t placed, std::uint32_t triangle) const;
  double cellsPerSquareMetre(std::uint32_t placed, std::uint32_t triangle) const;
  /// Is light gathered for what has this material?
  bool lights(int material) const { return !rules_[std::size_t(material)].unlit; }

  const GatherSettings& settings() const { return settings_; }
  /// Metres between places: as set, or more to stay within kMaxPlaces.
  double texel() const { return texel_; }

 private:
  /// One grid per triangle and side: the finest reads between corners of cells, bounces read whole cells.
  struct Grids {
    std::vector<std::uint32_t> first{0};  ///< by scene triangle, + 1 sentinel
    std::vector<std::uint16_t> resolution;
  };
  Grids layOut(double texel, bool corners) const;
  /// One side of a triangle.
  struct Side {
    std::uint32_t mesh = 0, triangle = 0;  ///< of the placed mesh
    std::uint32_t sceneTriangle = 0;       ///< of an instance a number that tells rays apart
    bool back = false;
  };
  Side sideOf(const Hit& hit, bool back) const;
  Side sideAt(const Grids& grids, std::size_t number, std::uint32_t& within) const;
  struct Place;
  Place placeNumbered(std::size_t number) const;
  std::uint32_t resolutionOf(const Grids& grids, const Side& side, double texel) const;
  double areaOf(std::uint32_t placed, std::uint32_t triangle) const;
  Spot spotOn(const Side& side, const glm::vec2& barycentric, double share) const;
  Surface surfaceOf(const Side& side, const glm::vec2& barycentric) const;
  HalfColour placeLight(const Side& side, std::uint32_t i, std::uint32_t j, RayCounts& rays,
                        const std::stop_token& stop) const;
  Gathered gather(const Surface& surface, std::uint32_t triangle, std::uint32_t place, RayCounts& own,
                  RayCounts& kept, const std::stop_token& stop) const;
  Gathered gatherBounced(const Surface& surface, int bounces, int count,
                         const PositionSamples::Points& points, RayCounts& own, RayCounts& kept,
                         const std::stop_token& stop) const;
  glm::vec3 sentBy(const Hit& hit, const glm::vec3& direction, int bounces, RayCounts& rays,
                   const std::stop_token& stop) const;
  struct Cell;
  /// Light of a white surface in a cell, from its sources and `bounces` bounces.
  glm::vec3 cellLight(const Side& side, const Cell& cell, int bounces, RayCounts& rays,
                      const std::stop_token& stop) const;

  const RayScene* scene_;
  GatherSettings settings_;
  DirectLights lights_;
  Ambient ambient_;
  bool bounced_ = false, emission_ = false;
  std::vector<MaterialRules> rules_;
  DetailRules detail_;
  double texel_ = 0;
  std::vector<std::uint32_t> firstTriangles_;
  bool laidOut_ = true;  ///< the meshes' places
  Grids places_, cells_;
  ValuesOnDemand values_;
  std::vector<ValuesOnDemand> cellValues_;  ///< by bounces before
  ScatteredValuesOnDemand scatteredValues_;
  std::vector<ScatteredValuesOnDemand> scatteredCells_;  ///< by bounces before
};

/// Is light from all around gathered with rays, rather than taken as if nothing were in the way?
bool gathersLight(const EffectPlan& plan, const BakeSettings& settings);

/// Samples per edge of a triangle: the longest edge by the texel, but not more samples than a few per texel
/// of area (needles).
std::uint32_t resolutionFor(const std::array<glm::vec3, 3>& corners, double texel, std::uint32_t most);
std::uint32_t resolutionFor(const Mesh& mesh, std::uint32_t triangle, double texel, std::uint32_t most);

}  // namespace acentric
