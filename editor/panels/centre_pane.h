#pragma once
/// The views of a project beside the walk: the plan, the 3D view, and accuracy against time. One at a time,
/// chosen by tabs, or each in a place of its own.

#include "editor/panels/accuracy_panel.h"
#include "editor/panels/plan_panel.h"
#include "editor/panels/scene_panel.h"

namespace acentric::editor {

class CentrePane {
 public:
  /// As ScenePanel.
  CentrePane(int threads, std::function<void()> wake) : scene_(threads, std::move(wake)) {}
  /// The one that EditorState::centreView tells.
  void draw(PanelContext& context);
  /// One of several: keys go to the one that the pointer was over last.
  void drawAlone(PanelContext& context, View view);
  bool takeNews() { return scene_.takeNews(); }

 private:
  void drawView(PanelContext& context, View view);

  PlanPanel plan_;
  ScenePanel scene_;
  AccuracyPanel accuracy_;
};

}  // namespace acentric::editor
