#pragma once
/// The 3D view: the scene ray-traced from an eye that is turned about it, with the layout over it.

#include <atomic>

#include "editor/actions/scene_editing.h"
#include "editor/overlays/scene_layers.h"
#include "editor/panels/look_through.h"
#include "editor/session/preview_stream.h"
#include "editor/tools/orbit_camera.h"
#include "editor/tools/scene_tool.h"
#include "ui/texture.h"

namespace acentric::editor {

class SceneInk;

class ScenePanel {
 public:
  /// `wake` is called from other threads when there is something new to be shown.
  ScenePanel(int threads, std::function<void()> wake);

  void draw(PanelContext& context);
  /// Was there a wake since the last call?
  bool takeNews() { return news_.exchange(false); }

 private:
  struct Area {
    glm::dvec2 min{0}, size{1};  ///< window pixels
    bool holds(const glm::dvec2& at) const;
  };
  void drawToolbar(PanelContext& context) const;
  void followProject(PanelContext& context);
  double cutHeight(const PanelContext& context) const;
  void handleEvents(PanelContext& context);
  void handleKey(PanelContext& context, int code);
  void act(PanelContext& context, const SceneIntent& intent);
  void open(PanelContext& context, const glm::dvec2& pixel);
  PreviewSeen seenAt(const PanelContext& context, const glm::dvec2& pixel) const;
  /// What to hold on to under a pixel: the surface, or beside the target.
  glm::dvec3 holdAt(const PanelContext& context, const glm::dvec2& pixel) const;
  bool pointing(const PanelContext& context) const;
  SceneSight sight() const;
  GizmoGrip litGrip(const PanelContext& context, const Gizmo& gizmo) const;

  void drawPicture(PanelContext& context, ImDrawList& list);
  void takePicture(PanelContext& context);
  void tellFirst(PanelContext& context);
  void drawLayers(PanelContext& context, ImDrawList& list);
  /// Tools and gizmo, over the picture as it is shown.
  void drawEditing(PanelContext& context, ImDrawList& list, const PerspectiveView& view);
  void drawTool(PanelContext& context, const SceneInk& ink, const std::optional<glm::dvec3>& under);
  void logHandles(PanelContext& context, const SceneInk& ink, const std::optional<Gizmo>& gizmo) const;
  void drawTexts(PanelContext& context, ImDrawList& list) const;
  void drawPanels(PanelContext& context);
  void logPlaces(PanelContext& context) const;

  std::atomic<bool> news_ = false;
  std::function<void()> wake_;
  OrbitCamera camera_;
  SceneTool tool_;
  SceneEditing editing_;
  PreviewStream stream_;
  LookThrough look_;
  SceneLayers layers_;
  ui::Texture texture_;
  PreviewTracerPtr tracer_;
  std::shared_ptr<const Layout> asked_;  ///< whether it lies under a ceiling
  Area area_;
  std::vector<Area> panels_;  ///< over the view, as they were drawn last
  ScenePickPtr toldPick_;
  glm::dvec2 pointer_{0};
  glm::dvec3 held_{0};
  int generation_ = -1;
  int storey_ = -1;
  double openedAt_ = -1;  ///< < 0: the first picture has been told
  bool problemTold_ = false;
};

}  // namespace acentric::editor
