#pragma once
/// The guided start: a card beside the widget that its step is about, and a frame around that.

#include "editor/panels/panel_context.h"

namespace acentric::editor {

class GuideCard {
 public:
  /// After everything else of the frame: it needs to know where the widget is.
  void draw(PanelContext& context);
  /// Does it cover this place (window pixels)?
  bool covers(const ImVec2& place) const;

 private:
  ImVec2 low_{0, 0}, high_{0, 0};
};

}  // namespace acentric::editor
