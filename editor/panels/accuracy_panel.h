#pragma once
/// What accuracy costs: the settings that a sweep measured, error against time or bytes; each with its worst
/// frame, and to be had by a click.

#include "editor/panels/panel_context.h"
#include "ui/texture.h"

namespace acentric::editor {

class AccuracyPanel {
 public:
  void draw(PanelContext& context);

 private:
  void drawPlot(PanelContext& context, const Sweep& sweep, const ImVec2& low, const ImVec2& high);
  void drawPoint(PanelContext& context, const Sweep& sweep, const SweepPoint& point);
  void drawPicture(PanelContext& context, const SweepPoint& point);

  SweepSetting shown_;  ///< under the pointer, else selected
  ui::Texture picture_;
  std::filesystem::path pictureFile_;
  std::filesystem::path goalsOf_;  ///< the folder of the search whose goals are those of the toolbar
  std::shared_ptr<const Sweep> pictureOf_;
};

}  // namespace acentric::editor
