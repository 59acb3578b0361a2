#pragma once
/// The middle of the window: the plan, the 3D view, or accuracy against time, chosen by the tabs at its top.

#include "editor/panels/accuracy_panel.h"
#include "editor/panels/plan_panel.h"
#include "editor/panels/scene_panel.h"

namespace acentric::editor {

class CentrePane {
 public:
  /// As ScenePanel.
  CentrePane(int threads, std::function<void()> wake) : scene_(threads, std::move(wake)) {}
  void draw(PanelContext& context);
  bool takeNews() { return scene_.takeNews(); }

 private:
  PlanPanel plan_;
  ScenePanel scene_;
  AccuracyPanel accuracy_;
};

}  // namespace acentric::editor
