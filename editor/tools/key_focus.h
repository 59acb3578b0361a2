#pragma once
/// Decides whether arrows and Space belong to widgets or to the walk: to the walk until Tab is pressed, to
/// widgets until a click or Esc. Also sees when Alt is pressed alone. Pure.

#include "ui/input_queue.h"

namespace acentric::editor {

class KeyFocus {
 public:
  /// Every event, in order. `popupOpen`: a menu or dialog is open, Esc is for that.
  void handle(const ui::InputEvent& event, bool popupOpen);
  bool onWidgets() const { return onWidgets_; }
  /// True once after Alt went down and up with nothing between.
  bool takeAltTap();

 private:
  bool onWidgets_ = false;
  bool altAlone_ = false;
  bool altTapped_ = false;
};

}  // namespace acentric::editor
