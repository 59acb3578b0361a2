#pragma once
/// The layout in the 3D view: cells on the floor, the outline, cameras and their sectors, resident on the
/// graphics card and sent anew only when they change; over them what follows the pointer and the walk.

#include <imgui.h>

#include <memory>
#include <set>

#include "editor/session/capture_status.h"
#include "editor/session/scene_pick.h"
#include "editor/tools/walker.h"
#include "ui/space_mesh.h"

namespace acentric::editor {

/// What stays. What is pointed to never changes.
struct SceneContents {
  std::shared_ptr<const OpenProject> open;
  std::shared_ptr<const CaptureStatus> captures;
  std::set<CellId> selection;
  bool cameras = true;
  bool allFrusta = false;  ///< else of the cameras of the selected cells
  bool operator==(const SceneContents&) const = default;
};

/// What comes and goes.
struct ScenePassing {
  WalkPose walk;
  double walkFovRadians = 1;
  double walkAspect = 1;  ///< height by width
  std::optional<CellId> hovered;
  std::optional<int> camera;  ///< that is looked through
  std::optional<SurfacePoint> picked;
  ScenePickPtr pick;  ///< of `picked`; null while the cameras are asked
};

class SceneLayers {
 public:
  /// Sends what differs from the last call.
  void update(const SceneContents& contents);
  void updatePassing(const ScenePassing& passing);
  void setDistances(const FloatImage& rayDistance) {
    mesh_.setDistances(rayDistance.width, rayDistance.height, rayDistance.pixels);
  }
  void clearDistances() { mesh_.clearDistances(); }
  void draw(ImDrawList& list, const PerspectiveView& view, const glm::dvec2& areaMin,
            const glm::dvec2& areaSize);
  /// Why nothing is drawn; empty if it is.
  const std::string& problem() const { return mesh_.problem(); }
  std::size_t lineCount() const { return mesh_.lineCount(); }

 private:
  SceneContents shown_;
  ui::SpaceMesh mesh_;
};

}  // namespace acentric::editor
