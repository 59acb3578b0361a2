#pragma once
/// What the test eyes of regions see: around each of them a cube map of the nearest opaque surfaces, traced
/// once and shared by all cameras that serve the region, and by regions that meet at a corner.
///
/// A bake asks millions of times whether an eye sees a point. The map answers nearly all of it by a look at
/// four neighbouring rays; where they disagree, along edges, the point itself is traced. The map itself is
/// traced coarsely first, and finer where neighbours do not show one plane.

#include <bit>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <stop_token>
#include <vector>

#include "engine/bake/bake_settings.h"
#include "engine/bake/cube_lattice.h"
#include "engine/bake/ray_scene.h"
#include "engine/base/memory_budget.h"
#include "engine/base/task_runner.h"

namespace acentric {

/// Of a distance: what lies nearer behind a surface than this passes for the surface itself, since maps do
/// not tell them apart.
inline constexpr double kSameSurface = 2e-3;

/// Of an inverse distance: what is farther than this behind the surface of a map is behind it, wherever
/// between four rays the point lies.
inline constexpr double kBehind = 1e-2;

/// Elevations, radians.
struct ElevationRange {
  double bottom = 0, top = 0;
};

/// A map made to tell quickly what lies hidden: by texel below which inverse distance all does, in 16 bits,
/// rounded down.
class HiddenMap {
 public:
  HiddenMap() = default;
  /// Of a map (EyeView).
  HiddenMap(const CubeLattice& lattice, const std::vector<float>& inverseZ);

  static std::size_t sizeOf(int side) {
    return std::size_t(CubeLattice::kFaces * tilesAcross(side) * tilesDown(side)) * kTileColumns * kTileRows;
  }
  /// Where the value of a texel is, `side` of them to an edge: of whole numbers, or of vectors of them.
  template <class Whole>
  static Whole indexOf(int side, const Whole& face, const Whole& column, const Whole& row) {
    const Whole tile =
        (face * tilesDown(side) + (row >> kRowBits)) * tilesAcross(side) + (column >> kColumnBits);
    return (tile << (kRowBits + kColumnBits)) + ((row & (kTileRows - 1)) << kColumnBits) +
           (column & (kTileColumns - 1));
  }
  bool empty() const { return below_.empty(); }
  const std::uint16_t* data() const { return below_.data(); }
  static float valueOf(std::uint16_t below) { return std::bit_cast<float>(std::uint32_t(below) << 16); }

 private:
  /// Texels lie in tiles as large as a cache line, since one point after the other is asked about.
  static constexpr int kColumnBits = 3, kTileColumns = 1 << kColumnBits, kRowBits = 2,
                       kTileRows = 1 << kRowBits;
  static int tilesAcross(int side) { return (side + kTileColumns - 1) / kTileColumns; }
  static int tilesDown(int side) { return (side + kTileRows - 1) / kTileRows; }

  std::vector<std::uint16_t> below_;  ///< the upper halves of floats
};

class EyeView {
 public:
  /// Corners apart that are traced whatever is around them.
  static constexpr int kCoarsest = 4;

  /// Traces the map, `texelsPerEdge` to a face's edge: every kCoarsest-th corner both ways (or second, or
  /// each, as the edge divides), then halfway between them where those around show no plane; where they do,
  /// corners are taken to lie on it. What is narrower than the first spacing may be missed in the midst of a
  /// plane, and nowhere else. Directions outside the elevations are not looked at. Null when stopped. `held`:
  /// what counts its bytes, as long as it lives.
  static std::shared_ptr<const EyeView> trace(const RayScene& scene, const glm::dvec3& eye, int texelsPerEdge,
                                              const ElevationRange& elevations, TaskRunner& runner,
                                              RayCounts& rays, const std::stop_token& stop,
                                              MemoryBudget::Share held = {});

  /// Without a map: every point is asked of a ray.
  static std::shared_ptr<const EyeView> untraced(const glm::dvec3& eye) {
    return std::shared_ptr<const EyeView>(new EyeView(eye, 1));
  }

  enum class Sees : std::uint8_t { no, yes, unsure };
  /// Does the map show the point? Unsure along edges, and in directions that were not looked at.
  Sees looksAt(const glm::dvec3& point) const;
  /// Is nothing but the background along the direction of a corner of the lattice? Unsure where it was not
  /// looked at.
  Sees backgroundAt(std::size_t corner) const {
    return inverseZ_[corner] < 0 ? Sees::unsure : inverseZ_[corner] > 0 ? Sees::no : Sees::yes;
  }

  const glm::dvec3& eye() const { return eye_; }
  bool isUntraced() const { return hiddenBelow_.empty(); }
  /// By texel, see HiddenMap: 0 where nothing is known.
  const HiddenMap& hiddenBelow() const { return hiddenBelow_; }
  const CubeLattice& lattice() const { return lattice_; }
  std::size_t bytes() const { return bytesOf(lattice_.side()); }
  static std::size_t bytesOf(int texelsPerEdge);

 private:
  EyeView(const glm::dvec3& eye, int texelsPerEdge);

  glm::dvec3 eye_;
  CubeLattice lattice_;
  /// By corner: one over the distance along the face's axis; 0: nothing there; < 0: not looked at.
  std::vector<float> inverseZ_;
  HiddenMap hiddenBelow_;
  MemoryBudget::Share held_;
};

/// By a ray: is nothing opaque on the way from an eye to a point but in the last `tolerance` metres?
bool nothingBefore(const RayScene& scene, const glm::dvec3& eye, const glm::dvec3& point, double tolerance,
                   RayCounts& rays);
/// Does an eye see a point? The map's answer, or else a ray's.
bool seesPoint(const RayScene& scene, const EyeView& view, const glm::dvec3& point, double tolerance,
               RayCounts& rays);
/// The same, but what the map shows is asked of a ray too.
bool seesByRay(const RayScene& scene, const EyeView& view, const glm::dvec3& point, double tolerance,
               RayCounts& rays);
/// The same, with no more tolerance than rounding takes.
bool seesClosely(const RayScene& scene, const EyeView& view, const glm::dvec3& point, RayCounts& rays);
/// Parts of a distance that rounding may take.
inline constexpr double kRounding = 3e-5;

/// Views by eye. Before they take more than a third of the budget's limit, those used longest ago are
/// dropped; they are counted until nobody uses them any more. Not safe from several threads.
class EyeViews {
 public:
  EyeViews(const RayScene& scene, const ElevationRange& elevations, const BakeSettings& settings,
           MemoryBudget& budget);

  /// Null when stopped.
  std::shared_ptr<const EyeView> at(const glm::dvec3& eye, TaskRunner& runner, RayCounts& rays,
                                    const std::stop_token& stop);
  std::size_t bytes() const { return bytes_; }
  int traced() const { return traced_; }  ///< so far

 private:
  struct Kept {
    std::shared_ptr<const EyeView> view;
    std::uint64_t lastUse = 0;
  };
  void dropOldest();

  const RayScene& scene_;
  ElevationRange elevations_;
  int texelsPerEdge_;
  MemoryBudget& budget_;
  std::size_t bytes_ = 0;
  std::uint64_t uses_ = 0;
  int traced_ = 0;
  std::map<std::array<double, 3>, Kept> views_;
};

}  // namespace acentric
