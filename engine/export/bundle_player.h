#pragma once
/// A bundle, and what of it is in memory to be drawn. A handle of the C library is one: acentric_runtime.h
/// has the meaning of each call.
///
/// Numbers of cameras and regions are the storey's, whatever the place that they were read from; what is
/// loaded stays when the eye comes to another one.

#include <map>

#include "engine/base/task_runner.h"
#include "engine/export/bundle_places.h"
#include "engine/view/render.h"

namespace acentric {

class BundlePlayer {
 public:
  /// Nothing else may be called before.
  void open(std::unique_ptr<BundlePlaces> places);

  BundlePlaces& places() const { return *places_; }
  /// Storeys may lack their cameras and regions.
  const Bundle& bundle() const { return places_->root(); }
  void setThreads(int threads);
  int threads() const { return runner_->threads(); }

  Result<std::size_t> storeyAt(const glm::dvec3& eye) const;
  /// Null where the storey has no region, or a number is not finite.
  Result<BundlePlacePtr> placeAt(std::size_t storey, const glm::dvec2& point) const;
  /// Numbers are those within the place.
  struct Needs {
    BundlePlacePtr place;
    int region = -1;
    std::vector<int> cameras;  ///< in drawing order
  };
  /// Fails where the eye stands in no region, as notFound.
  Result<Needs> needsOf(const PerspectiveView& view, const ViewSettings& settings) const;

  std::uint64_t memory() const { return memory_; }
  void setLimit(std::uint64_t bytes) { limit_ = bytes; }
  Loaded loaded(std::size_t storey, std::size_t camera) const;
  bool regionLoaded(std::size_t storey, std::size_t region) const {
    return this->region(storey, region) != nullptr;
  }

  /// Takes what was read; what is loaded already stays.
  Status keepCapture(std::size_t storey, std::size_t camera, Loaded detail, CapturePtr capture);
  Status keepRegion(std::size_t storey, std::size_t region, ReadRegion read);

  Status loadCapture(std::size_t storey, std::size_t camera, Loaded detail);
  void unloadCapture(std::size_t storey, std::size_t camera, Loaded detail);
  Status loadRegion(std::size_t storey, std::size_t region);
  void unloadRegion(std::size_t storey, std::size_t region);
  void unloadTextures();
  /// Of captures those that renditionOf says, coarse ones where nothing is loaded yet; `regions`: the near
  /// geometry too.
  Status loadView(const Needs& needs, Loaded detail, bool regions);

  Result<Frame> render(const PerspectiveView& view, const ViewSettings& settings);
  /// Of the last frame, 1/m along the viewing direction.
  const FloatImage& inverseZDepth() const { return frames_.inverseZDepth; }
  /// The next frame is made in its memory.
  void recycle(Frame frame) { frames_.frame = std::move(frame); }

  struct Camera {
    CapturePtr full, coarse;
    const CapturePtr& best() const { return full ? full : coarse; }
    CapturePtr& of(Loaded detail) { return detail == Loaded::full ? full : coarse; }
  };
  struct NearRegion {
    glm::dvec2 middle{0};
    std::shared_ptr<const LocalGeometry> local;
  };
  /// What is loaded of a storey, by number.
  struct Parts {
    std::map<std::size_t, Camera> cameras;
    std::map<std::size_t, NearRegion> regions;
  };
  const Parts& parts(std::size_t storey) const { return parts_[storey]; }
  /// Null unless loaded.
  const DisplayCapture* capture(std::size_t storey, std::size_t camera, Loaded detail) const;
  const LocalGeometry* region(std::size_t storey, std::size_t region) const;
  const ColourImage* texture(std::size_t texture) const { return images_[texture].get(); }
  const Images& images() const { return images_; }

 private:
  struct Eye {
    BundlePlacePtr place;
    int region = -1;
  };
  Result<Eye> stand(const PerspectiveView& view, const ViewSettings& settings) const;
  void enter(const BundlePlacePtr& place);
  Status loadCapture(const BundlePlace& place, std::size_t camera, Loaded detail);
  Status loadRegion(const BundlePlace& place, std::size_t region);
  void showCamera(std::size_t storey, std::size_t camera);
  void showRegion(std::size_t storey, std::size_t region);
  Status takeRoom(std::uint64_t bytes, const std::string& what);
  Status keepTexture(std::size_t texture, std::shared_ptr<const ColourImage> image);

  std::unique_ptr<BundlePlaces> places_;
  std::vector<Parts> parts_;  ///< by storey
  Images images_;             ///< by texture
  BundlePlacePtr place_;      ///< that was drawn last
  WalkScene walk_;            ///< of it what is loaded
  std::unique_ptr<TaskRunner> runner_ = std::make_unique<TaskRunner>(0);
  FrameMemory frames_;
  std::uint64_t memory_ = 0, limit_ = 0;
};

}  // namespace acentric
