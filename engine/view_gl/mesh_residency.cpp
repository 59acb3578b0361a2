#include "engine/view_gl/mesh_residency.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/view_gl/capture_buffers.h"
#include "engine/view_gl/gl_check.h"

namespace acentric {
namespace {

/// Sent to the graphics card by a frame.
constexpr std::size_t kMostBytesSent = std::size_t(16) << 20;

Status checkUpload(const MeshTask& task) {
  return checkGl(fmt::format("uploading the mesh of {}", task.name).c_str());
}

}  // namespace

Status MeshResidency::begin(const WalkScene& scene, const ViewSettings& settings) {
  dropGone(scene);
  if (!builder_) return {};
  const auto useful = [&](const MeshTask& task) {
    const auto capture = task.capture.lock();
    return capture && settings.renderer == Renderer::glMesh && task.isFor(settings) &&
           std::ranges::find(scene.captures, capture) != scene.captures.end();
  };
  builder_->keepOnly(useful);
  std::erase_if(uploads_, [&](const MeshUpload& upload) { return !useful(upload.task()); });
  wanted_.clear();
  const Result<bool> received = receive();
  return received ? Status() : tl::unexpected(received.error());
}

Result<bool> MeshResidency::receive() {
  if (!builder_) return false;
  std::optional<Error> problem;
  for (MeshBuilder::Built& built : builder_->takeBuilt())
    if (built.mesh)
      uploads_.emplace_back(std::move(built.task), std::move(*built.mesh));
    else
      problem = built.mesh.error();
  if (problem) return tl::unexpected(*problem);
  bool ready = false;
  for (std::size_t left = kMostBytesSent; left > 0 && !uploads_.empty();) {
    MeshUpload& upload = uploads_.front();
    left -= upload.send(left);
    if (Status sent = checkUpload(upload.task()); !sent) {
      uploads_.pop_front();
      return tl::unexpected(sent.error());
    }
    if (!upload.done()) break;
    if (const auto capture = upload.task().capture.lock()) {
      put(capture, upload.take());
      ready = true;
    }
    uploads_.pop_front();
  }
  return ready;
}

Result<MeshBuffers*> MeshResidency::get(const std::shared_ptr<const DisplayCapture>& capture,
                                        const std::string& name, const Layout& layout, int camera,
                                        const ViewSettings& settings) {
  MeshBuffers* resident = find(capture);
  if (resident != nullptr && resident->task.isFor(settings)) return resident;
  const MeshTask task{capture,
                      camera,
                      name,
                      eyeReach(layout, camera),
                      settings.meshError,
                      settings.maxMeshTriangles,
                      storageLimit(largestBuffer_)};
  if (builder_) {
    const auto same = [&](const MeshTask& other) { return task.sameAs(other); };
    if (std::ranges::none_of(wanted_, same) && std::ranges::none_of(uploads_, same, &MeshUpload::task))
      wanted_.push_back(task);
    return resident;
  }
  Result<PackedMesh> packed = packMesh(*capture, task, runner_);
  if (!packed) return tl::unexpected(packed.error());
  MeshUpload upload(task, std::move(*packed));
  upload.send(std::numeric_limits<std::size_t>::max());
  if (Status sent = checkUpload(task); !sent) return tl::unexpected(sent.error());
  return &put(capture, upload.take());
}

void MeshResidency::end() {
  if (builder_) builder_->want(std::exchange(wanted_, {}));
}

void MeshResidency::stopBuilding() {
  if (!builder_) return;
  builder_->keepOnly([](const MeshTask&) { return false; });
  uploads_.clear();
}

}  // namespace acentric
