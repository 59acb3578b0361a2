#pragma once
/// Which captures have meshes on the graphics card. Either frames wait for those that they lack, or these are
/// built in the background and sent piece by piece, and frames are told what there is.

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/view_gl/mesh_buffers.h"
#include "engine/view_gl/mesh_builder.h"
#include "engine/view_gl/residency.h"

namespace acentric {

class MeshResidency : public Residency<MeshBuffers> {
 public:
  /// Without a builder frames wait, and meshes are built with `runner`. `largestBuffer`: bytes, 0 = what the
  /// driver allows.
  explicit MeshResidency(TaskRunner& runner, std::unique_ptr<MeshBuilder> builder = nullptr,
                         std::size_t largestBuffer = 0)
      : runner_(runner), builder_(std::move(builder)), largestBuffer_(largestBuffer) {}

  /// Before a frame: drops what is gone from `scene`, and gives up what is being built for captures that are
  /// gone or for other settings; then receives.
  Status begin(const WalkScene& scene, const ViewSettings& settings);
  /// The mesh of a camera's capture for the error and the triangles that are set. Where frames do not wait:
  /// that of before, or null, until it is ready; the same throughout a frame. Valid until the next call of
  /// begin, receive or trim.
  Result<MeshBuffers*> get(const std::shared_ptr<const DisplayCapture>& capture, const std::string& name,
                           const Layout& layout, int camera, const ViewSettings& settings);
  /// After a frame: what it asked for and did not get is built next.
  void end();

  /// Sends a piece of what is built to the graphics card. True if a mesh is now ready that was not.
  Result<bool> receive();
  /// Is there something for receive() to do?
  bool anyToReceive() const { return !uploads_.empty() || (builder_ && builder_->anyBuilt()); }
  /// Gives up what is being built, until frames ask for it again.
  void stopBuilding();

 private:
  TaskRunner& runner_;
  std::unique_ptr<MeshBuilder> builder_;
  std::size_t largestBuffer_ = 0;
  std::deque<MeshUpload> uploads_;
  std::vector<MeshTask> wanted_;  ///< by this frame
};

}  // namespace acentric
