#pragma once
/// The look of the whole program: fonts, spacing, and ImGui's colours from the palette.

#include <imgui.h>

#include <string>

namespace acentric::ui {

/// Fonts in the atlas; owned by ImGui. Without DejaVu Sans on the machine all are ImGui's built-in font.
struct Fonts {
  ImFont* regular = nullptr;
  ImFont* bold = nullptr;
  ImFont* small = nullptr;  ///< rulers, captions
  ImFont* title = nullptr;  ///< empty states
};

/// Sets style and loads fonts into the current ImGui context; call once, before the first frame.
/// `scale` is the display's content scale (1 = 96 dpi). `missingFont` is set to what was not found, if
/// anything.
Fonts applyTheme(float scale, std::string& missingFont);

}  // namespace acentric::ui
