#pragma once
/// A part of a bundle: one storey's regions and cameras, all of them or those around a place, with the files
/// that they name. What is read of it.

#include <memory>
#include <optional>
#include <vector>

#include "engine/export/bundle_read.h"

namespace acentric {

/// As in acentric_runtime.h.
enum class Loaded { absent = 0, coarse = 1, full = 2 };

struct BundlePlace {
  std::uint64_t page = 0;  ///< of a walk's index; tells it from the places of other pages
  std::size_t storey = 0;
  /// Of that storey the regions and cameras of this place, numbered within it. All of the bundle but regions
  /// and cameras of other storeys, which it may lack.
  std::shared_ptr<const Bundle> bundle;
  std::vector<std::uint64_t> cameras, regions;  ///< theirs in the storey; regions rising
  std::vector<char> own;                        ///< by region: is no other page needed there?
  std::shared_ptr<const BundleFiles> files;

  const BundleStorey& here() const { return bundle->storeys[storey]; }
  /// Within the place, by the number in the storey.
  std::optional<std::size_t> cameraIn(std::uint64_t number) const;
  std::optional<std::size_t> regionIn(std::uint64_t number) const;
};
using BundlePlacePtr = std::shared_ptr<const BundlePlace>;

using CapturePtr = std::shared_ptr<const DisplayCapture>;
using Images = std::vector<std::shared_ptr<const ColourImage>>;  ///< by texture; null: not there

/// Near geometry as it was read, with the textures that its surfaces need.
struct ReadRegion {
  glm::dvec2 middle{0};
  LocalGeometry local;
  Images images;
};

/// The rendition of a camera that there is and that comes nearest to `detail`; absent: it was not baked.
Loaded renditionOf(const BundleCamera& camera, Loaded detail);

/// `camera` and `region` are numbers within the place.
Result<CapturePtr> readCapture(const BundlePlace& place, std::size_t camera, Loaded detail);
/// `known`: textures that need not be read.
Result<ReadRegion> readRegion(const BundlePlace& place, std::size_t region, Images known);
/// To be rendered, with nothing loaded.
WalkScene walkSceneOf(const BundlePlacePtr& place, ScenePtr scene);

}  // namespace acentric
