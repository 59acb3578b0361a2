#pragma once
/// A row of tabs in the look of a panel's title: names over a thin line, the open one underlined.

#include <imgui.h>

#include <span>
#include <string>

#include "ui/colour.h"

namespace acentric::ui {

struct Tab {
  const char* label = "";
  bool open = false;
  std::string mark = {};  ///< a short text behind the label: a count; empty = none
  Colour markColour = palette::muted;
};

/// Pixels between tabs: less where they would not fit.
float tabGap(ImFont* bold, std::span<const Tab> tabs);
/// True when it is clicked; call for each tab in turn, from left to right, then endTabs(). `gap` to the tab
/// before; 0 for the first.
bool tab(ImFont* bold, const Tab& tab, float gap);
void endTabs();

}  // namespace acentric::ui
