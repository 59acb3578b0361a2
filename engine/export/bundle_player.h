#pragma once
/// A bundle, and what of it is in memory to be drawn. A handle of the C library is one: acentric_runtime.h
/// has the meaning of each call.

#include "engine/base/task_runner.h"
#include "engine/export/bundle_read.h"
#include "engine/view/render.h"

namespace acentric {

/// As in acentric_runtime.h.
enum class Loaded { absent = 0, coarse = 1, full = 2 };

/// Near geometry as it was read, with the textures that its surfaces need.
struct ReadRegion {
  LocalGeometry local;
  std::vector<std::shared_ptr<const ColourImage>> images;  ///< by texture; null: not needed
};

class BundlePlayer {
 public:
  /// Reads the index. Nothing else may be called where this failed.
  Status open(std::unique_ptr<BundleFiles> files);
  /// With an index that was read already.
  void open(std::shared_ptr<const BundleFiles> files, Bundle bundle);

  const Bundle& bundle() const { return bundle_; }
  void setThreads(int threads);
  int threads() const { return runner_->threads(); }

  std::size_t storeyAt(const glm::dvec3& eye) const;
  struct Needs {
    std::size_t storey = 0;
    int region = -1;
    std::vector<int> cameras;  ///< in drawing order
  };
  /// Fails where the eye stands in no region.
  Result<Needs> needsOf(const PerspectiveView& view, const ViewSettings& settings) const;

  std::uint64_t memory() const { return memory_; }
  void setLimit(std::uint64_t bytes) { limit_ = bytes; }
  Loaded loaded(std::size_t storey, std::size_t camera) const;
  bool regionLoaded(std::size_t storey, std::size_t region) const;

  /// What loading reads, from any thread, and several at once where the files may be. `known`: textures that
  /// need not be read.
  Result<std::shared_ptr<const DisplayCapture>> readCapture(std::size_t storey, std::size_t camera,
                                                            Loaded detail) const;
  using Images = std::vector<std::shared_ptr<const ColourImage>>;
  Result<ReadRegion> readRegion(std::size_t storey, std::size_t region, Images known) const;
  /// The storey with nothing loaded, and surfaces of these images.
  WalkScene bareWalk(std::size_t storey, Images images) const;
  /// Takes what was read; what is loaded already stays.
  Status keepCapture(std::size_t storey, std::size_t camera, Loaded detail,
                     std::shared_ptr<const DisplayCapture> capture);
  Status keepRegion(std::size_t storey, std::size_t region, ReadRegion read);

  Status loadCapture(std::size_t storey, std::size_t camera, Loaded detail);
  void unloadCapture(std::size_t storey, std::size_t camera, Loaded detail);
  Status loadRegion(std::size_t storey, std::size_t region);
  void unloadRegion(std::size_t storey, std::size_t region);
  void unloadTextures();

  Result<Frame> render(const PerspectiveView& view, const ViewSettings& settings);
  /// Of the last frame, 1/m along the viewing direction.
  const FloatImage& inverseZDepth() const { return frames_.inverseZDepth; }
  /// The next frame is made in its memory.
  void recycle(Frame frame) { frames_.frame = std::move(frame); }

  /// Null unless loaded.
  const DisplayCapture* capture(std::size_t storey, std::size_t camera, Loaded detail) const;
  const LocalGeometry* region(std::size_t storey, std::size_t region) const;
  const ColourImage* texture(std::size_t texture) const;
  const Images& images() const { return images_; }

 private:
  struct Camera {
    std::shared_ptr<const DisplayCapture> full, coarse;
  };
  struct StoreyState {
    std::vector<Camera> cameras;
    std::vector<std::shared_ptr<const LocalGeometry>> regions;
    WalkScene walk;
  };
  std::shared_ptr<const DisplayCapture>& slot(std::size_t storey, std::size_t camera, Loaded detail);
  void show(std::size_t storey, std::size_t camera);
  Status takeRoom(std::uint64_t bytes, const std::string& what);
  Status keepTexture(std::size_t texture, std::shared_ptr<const ColourImage> image);
  void showTextures();

  std::shared_ptr<const BundleFiles> files_;
  Bundle bundle_;
  std::vector<StoreyState> storeys_;
  Images images_;  ///< by texture
  std::unique_ptr<TaskRunner> runner_ = std::make_unique<TaskRunner>(0);
  FrameMemory frames_;
  std::uint64_t memory_ = 0, limit_ = 0;
};

}  // namespace acentric
