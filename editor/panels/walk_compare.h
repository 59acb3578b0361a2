#pragma once
/// The truth over the walk's picture: right of a border that can be dragged, or the difference everywhere.

#include "editor/panels/panel_context.h"
#include "ui/image_view.h"
#include "ui/texture.h"

namespace acentric::editor {

class WalkCompare {
 public:
  /// `frame`: of the view that is wanted, at full size; null where the walk has none now.
  void draw(PanelContext& context, ImDrawList& list, const ui::FittedImage& place,
            const std::shared_ptr<const Frame>& frame);
  /// A press on the border takes hold of it; true for events that are its own.
  bool handle(PanelContext& context, const ui::InputEvent& event);

 private:
  bool onBorder(const PanelContext& context, const glm::dvec2& position) const;
  void drawSplit(PanelContext& context, ImDrawList& list, const Truth* truth);
  void drawDifference(PanelContext& context, ImDrawList& list, const std::shared_ptr<const Truth>& truth,
                      const std::shared_ptr<const Frame>& frame);

  ui::Texture texture_;
  std::shared_ptr<const Truth> shownTruth_;  // in texture_
  std::shared_ptr<const Frame> shownFrame_;  // its difference from shownTruth_, else null
  int shownGain_ = 0;
  ui::FittedImage place_;
  bool dragging_ = false;
};

}  // namespace acentric::editor
