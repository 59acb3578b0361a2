#pragma once
/// What the walk's picture is compared with, over it: the truth right of a border that can be dragged, or the
/// difference from it everywhere; or the kept variant left of the border.

#include <string>

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
  /// Of a split picture: what lies over the walk, and the names of both sides.
  struct Sides {
    bool there = false, left = false;  ///< is it there to be shown, and left of the border?
    std::string leftName, rightName;
    const char* shortName = "";  ///< of the right side, where there is little room
  };
  bool onBorder(const PanelContext& context, const glm::dvec2& position) const;
  Sides sidesOf(PanelContext& context, const Truth* truth) const;
  void drawSplit(PanelContext& context, ImDrawList& list, const Sides& sides);
  void drawDifference(PanelContext& context, ImDrawList& list, const std::shared_ptr<const Truth>& truth,
                      const std::shared_ptr<const Frame>& frame);
  void follow(PanelContext& context, const std::shared_ptr<const Truth>& truth,
              const std::shared_ptr<const Frame>& frame);

  ui::Texture texture_;
  std::shared_ptr<const void> shownOther_;   // in texture_: a truth, or the kept variant's frame
  std::shared_ptr<const Frame> shownFrame_;  // its difference from shownOther_, else null
  int shownGain_ = 0;
  ui::FittedImage place_;
  bool dragging_ = false;
};

}  // namespace acentric::editor
