#include "engine/view_gl/mesh_residency.h"

#include <algorithm>

namespace acentric {

void MeshResidency::begin(const CaptureSet& inScene, const ViewSettings& settings) {
  keepOnly([&](const MeshTask& task) {
    const auto capture = task.capture.lock();
    return capture && settings.renderer == Renderer::glMesh && task.isFor(settings) &&
           inScene.contains(capture.get());
  });
}

Result<MeshBuffers*> MeshResidency::get(const std::shared_ptr<const DisplayCapture>& capture,
                                        const std::string& name, const Layout& layout, int camera,
                                        const ViewSettings& settings) {
  MeshBuffers* const resident = find(capture);
  if (resident != nullptr && resident->task.isFor(settings)) return resident;
  const MeshTask task{capture,
                      camera,
                      name,
                      eyeReach(layout, camera),
                      settings.meshError,
                      settings.maxMeshTriangles,
                      std::min(kUsualBuffer, storageLimit(largestBuffer_))};
  if (waits()) return build(capture, task);
  if (Status wanted = want(task); !wanted) return tl::unexpected(wanted.error());
  return resident;
}

void MeshResidency::end(const CaptureSet& inScene) {
  std::erase_if(wanted_, [&](const MeshTask& task) {
    const auto capture = task.capture.lock();
    return !capture || !inScene.contains(capture.get());
  });
  beginWanted();
}

}  // namespace acentric
