#pragma once
/// Finds the part of a bundle that tells of a place, a camera or a region: whatever of the index has to be
/// read for it.

#include <span>

#include "engine/export/bundle_place.h"

namespace acentric {

struct CameraFacts {
  glm::dvec2 position{0};
  double lowAzimuth = 0, fovRadians = 0, topElevation = 0, bottomElevation = 0;
  struct Rendition {
    int columns = 0, rows = 0;  ///< 0: there is none
    std::uint64_t samples = 0, reflections = 0, bytes = 0;
  };
  Rendition full, coarse;
};
CameraFacts factsOf(const LayoutCamera& camera, const BundleCamera& renditions);

/// Arrays live as long as what gave them out.
struct RegionFacts {
  RegionKind kind = RegionKind::ring;
  std::span<const glm::dvec2> polygon, grown;
  std::span<const int> neighbours;         ///< numbers in the storey
  std::uint64_t triangles = 0, bytes = 0;  ///< of near geometry
};

/// Numbers of storeys, cameras and regions are the bundle's, and have to be there. Errors are of the index.
class BundlePlaces {
 public:
  virtual ~BundlePlaces() = default;
  /// Storeys may lack their cameras and regions.
  virtual const Bundle& root() const = 0;
  struct Counts {
    std::size_t cameras = 0, regions = 0;
  };
  virtual Counts counts(std::size_t storey) const = 0;

  /// The storey that an eye is drawn from, whose numbers are finite.
  virtual Result<std::size_t> storeyAt(const glm::dvec3& eye) = 0;
  /// Knows the region that holds a point of the plan, all that overlap it, or else the nearest one. The
  /// storey has regions, and the point's numbers are finite.
  virtual Result<BundlePlacePtr> placeAt(std::size_t storey, const glm::dvec2& point) = 0;
  /// From any thread, in which it reads what placeAt would, and lets others go on meanwhile.
  virtual void readAhead(std::size_t storey, const glm::dvec2& point) = 0;
  virtual Result<BundlePlacePtr> placeOfCamera(std::size_t storey, std::size_t camera) = 0;
  virtual Result<BundlePlacePtr> placeOfRegion(std::size_t storey, std::size_t region) = 0;
  virtual Result<CameraFacts> camera(std::size_t storey, std::size_t camera) = 0;
  virtual Result<RegionFacts> region(std::size_t storey, std::size_t region) = 0;
};

/// Reads the whole index.
Result<std::unique_ptr<BundlePlaces>> wholeBundle(std::unique_ptr<BundleFiles> files);

}  // namespace acentric
