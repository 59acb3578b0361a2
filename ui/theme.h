#pragma once
/// The look of the whole program: fonts, spacing, and ImGui's colours from the palette.

#include <imgui.h>

#include <string>
#include <vector>

namespace acentric::ui {

/// Fonts in the atlas; owned by ImGui. Without DejaVu Sans on the machine all are ImGui's built-in font.
struct Fonts {
  ImFont* regular = nullptr;
  ImFont* bold = nullptr;
  ImFont* small = nullptr;  ///< rulers, captions
  ImFont* title = nullptr;  ///< empty states
  ImFont* icons = nullptr;  ///< ui/icons.h; null: they are not on the machine, and words stand in their place
};

/// Where Debian puts them.
struct FontFiles {
  const char* regular = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
  const char* bold = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";
  const char* icons = "/usr/share/fonts/truetype/fork-awesome/forkawesome-webfont.ttf";
  const char* japanese = "/usr/share/fonts/truetype/vlgothic/VL-Gothic-Regular.ttf";
};

/// What the user chose of the look, or the display asks for.
struct Look {
  bool light = false;
  float scale = 1;  ///< of texts, paddings, marks and reach; 1 = 96 dpi
  /// The letters of the language's own name and of its catalogue are always there; Japanese ones, which cost
  /// some thousand glyphs, where texts or names may need them.
  bool japanese = false;
  std::string language = "en";  ///< of ui/translate.h: which letters its catalogue has
  bool operator==(const Look&) const = default;
};

/// Sets style and fonts of the current ImGui context, anew at any time between two frames; `look` must live
/// as long as the context. `missingFonts`: a sentence for each that is not there, with the package to
/// install.
Fonts applyTheme(const Look& look, std::vector<std::string>& missingFonts, const FontFiles& files = {});
/// The one that was applied last; null without a window.
const Look* currentLook();
/// Of the look that was applied last; 1 without a window.
float interfaceScale();
/// Lengths in the code are of a display with 96 dpi: as many pixels on this one.
float scaled(float pixels);
ImVec2 scaled(const ImVec2& pixels);

}  // namespace acentric::ui
