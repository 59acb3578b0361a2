#pragma once
/// Which captures have meshes on the graphics card.

#include <functional>
#include <memory>
#include <string>

#include "engine/view_gl/built_residency.h"
#include "engine/view_gl/mesh_buffers.h"

namespace acentric {

class MeshResidency : public BuiltResidency<MeshTask, PackedMesh, MeshUpload, MeshBuffers> {
 public:
  /// Without a builder frames wait, and meshes are built with `runner`. `largestBuffer`: bytes, 0 = what the
  /// driver allows.
  explicit MeshResidency(TaskRunner& runner, std::unique_ptr<Builder> builder = nullptr,
                         std::size_t largestBuffer = 0)
      : BuiltResidency(packMesh, runner, std::move(builder)), largestBuffer_(largestBuffer) {}
  static std::unique_ptr<Builder> makeBuilder(int threads, std::function<void()> wake) {
    return std::make_unique<Builder>(packMesh, threads, std::move(wake));
  }

  /// Before a frame: gives up what is on its way for captures that are not among these, or for other
  /// settings.
  void begin(const CaptureSet& inScene, const ViewSettings& settings);
  /// The mesh of a camera's capture for the error and the triangles that are set. Where frames do not wait:
  /// that of before, or null, until it is ready; the same throughout a frame. Valid until the next call of
  /// begin, receive, dropGone or trim.
  Result<MeshBuffers*> get(const std::shared_ptr<const DisplayCapture>& capture, const std::string& name,
                           const Layout& layout, int camera, const ViewSettings& settings);
  /// After a frame: what it asked for and did not get is built next, if it is among these.
  void end(const CaptureSet& inScene);

 private:
  std::size_t largestBuffer_ = 0;
};

}  // namespace acentric
