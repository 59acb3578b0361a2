#pragma once
/// Editing in the 3D view: its pointer, as a ray, becomes a place of the plan on the storey's floor (for
/// paths at the height of the key pose or line under it), and the plan's tools do with that what they do on
/// the plan; what is selected has a gizmo. Previews while something is dragged, one step of the history when
/// it is let go. A press that starts on nothing that can be edited is the camera's. Without a window.

#include "editor/actions/action.h"
#include "editor/tools/gizmo_subject.h"
#include "editor/tools/scene_tool.h"

namespace acentric::editor {

/// What the 3D view shows. Pixels of events are of its picture.
struct SceneSight {
  PerspectiveView view;
  glm::dvec3 focus{0};  ///< that the camera is turned about
  double scale = 1;     ///< of the interface
};

class SceneEditing {
 public:
  /// Nothing: the event is the camera's. Else it is taken, and what is returned is left for the view to do.
  std::optional<SceneIntent> handle(ActionContext& c, const ScenePointer& event, const SceneSight& sight);
  /// True if something was afoot: it is undone.
  bool cancel(ActionContext& c);
  /// A button is down: events belong to the view wherever the pointer is.
  bool capturing(const ActionContext& c) const;

  /// A click: what has a handle near the pixel, else the cell, else nothing is selected.
  void select(ActionContext& c, const SelectAtIntent& at, const std::optional<CellId>& cell,
              const SceneSight& sight) const;
  /// What the gizmo is at, where it is now.
  std::optional<Gizmo> gizmo(const ActionContext& c);
  const GizmoTool& gizmoTool() const { return gizmoTool_; }

  /// Cells that the gizmo drags, and where they would land.
  struct CellsOnTheirWay {
    CellGroup group;
    LatticeStep step;
  };
  const CellsOnTheirWay* cellsOnTheirWay() const { return cells_ ? &*cells_ : nullptr; }
  /// The place under a pixel, at the height that the tool in hand works on there.
  std::optional<glm::dvec3> placeUnder(const ActionContext& c, const glm::dvec2& pixel,
                                       const SceneSight& sight) const;
  /// What a tool in hand knows of the plan around a place.
  PlanSituation situation(const ActionContext& c, const glm::dvec3& place, const SceneSight& sight);
  /// Of what is being dragged, in words; else empty.
  std::string text(const ActionContext& c) const;

 private:
  std::optional<SceneIntent> press(ActionContext& c, const ScenePointer& event, const SceneSight& sight);
  std::optional<SceneIntent> tell(ActionContext& c, PointerEvent::Kind kind, const ScenePointer& event,
                                  const SceneSight& sight);
  std::optional<GizmoSubject> subject(const ActionContext& c);
  void takeHold(ActionContext& c, const GizmoSubject& subject, const Gizmo& gizmo);
  void dragGizmo(ActionContext& c, const ScenePointer& event, const SceneSight& sight);
  void letGo(ActionContext& c);
  SnapTargets targets(const ActionContext& c, double pixelsPerMetre);

  GizmoTool gizmoTool_;
  std::optional<GizmoSubject> subject_;  // that the gizmo has hold of, as it was
  Gizmo held_;
  std::optional<CellsOnTheirWay> cells_;
  double level_ = 0;                 // that the tool in hand works on, from its press on
  glm::dvec2 lastPlace_{0};          // where its ray met that
  std::vector<glm::dvec2> corners_;  // to snap to
  // Cells that were asked about last: their middle takes a while where there are many.
  std::optional<GizmoSubject> cellsFound_;
  std::set<CellId> cellsAsked_;
  std::optional<LayoutSpec> specAsked_;
};

}  // namespace acentric::editor
