#pragma once
/// Colours of the interface, written as on paper: 0xRRGGBB and an opacity. sRGB, straight alpha.

#include <imgui.h>

#include <array>
#include <cstdint>

namespace acentric::ui {

struct Colour {
  float r = 0, g = 0, b = 0, a = 1;

  static constexpr Colour hex(std::uint32_t rgb, float opacity = 1) {
    return {float((rgb >> 16) & 255U) / 255.0F, float((rgb >> 8) & 255U) / 255.0F, float(rgb & 255U) / 255.0F,
            opacity};
  }
  constexpr Colour withOpacity(float opacity) const { return {r, g, b, opacity}; }
  /// `t` = 0: this, 1: `other`.
  constexpr Colour mixed(const Colour& other, float t) const {
    return {r + (other.r - r) * t, g + (other.g - g) * t, b + (other.b - b) * t, a + (other.a - a) * t};
  }
  ImVec4 vec() const { return {r, g, b, a}; }
  /// For draw lists.
  ImU32 packed() const { return ImGui::ColorConvertFloat4ToU32(vec()); }
};

/// All colours of the interface: neutrals, one accent, four meanings. Every ink reads on every surface with a
/// contrast of at least 4.5 : 1 (WCAG 2), and classes that stand beside each other in legends stay apart for
/// eyes that miss one kind of cone.
struct Palette {
  bool light = false;
  // Surfaces
  Colour backdrop, panel, popup, raised, hovered, pressed, border, selected;
  // Inks
  Colour text, muted, faint;
  Colour accent, accentDeep, accentHover, onAccent;  ///< deep: filled buttons; onAccent: their text
  Colour good, warning, danger;
  // Classes on plans and in legends
  Colour done, partly, missing, outdated;
  Colour alarm;                 ///< outside of a scale, and bad
  Colour plain;                 ///< outside of a scale, and of no concern
  std::array<Colour, 4> scale;  ///< of quantities, from little to much
};

extern const Palette kDarkPalette, kLightPalette;

/// The one in force: that of the window's look (ui/theme.h); without a window the dark one.
const Palette& currentPalette();

/// A colour of the palette in force, by name: palette::text, ...
struct PaletteEntry {
  Colour Palette::*member;
  const Colour& get() const { return currentPalette().*member; }
  operator const Colour&() const { return get(); }
  Colour withOpacity(float opacity) const { return get().withOpacity(opacity); }
  Colour mixed(const Colour& other, float t) const { return get().mixed(other, t); }
  ImVec4 vec() const { return get().vec(); }
  ImU32 packed() const { return get().packed(); }
};

namespace palette {
inline constexpr PaletteEntry backdrop{&Palette::backdrop};
inline constexpr PaletteEntry panel{&Palette::panel};
inline constexpr PaletteEntry popup{&Palette::popup};
inline constexpr PaletteEntry raised{&Palette::raised};
inline constexpr PaletteEntry hovered{&Palette::hovered};
inline constexpr PaletteEntry pressed{&Palette::pressed};
inline constexpr PaletteEntry border{&Palette::border};
inline constexpr PaletteEntry selected{&Palette::selected};
inline constexpr PaletteEntry text{&Palette::text};
inline constexpr PaletteEntry muted{&Palette::muted};
inline constexpr PaletteEntry faint{&Palette::faint};
inline constexpr PaletteEntry accent{&Palette::accent};
inline constexpr PaletteEntry accentDeep{&Palette::accentDeep};
inline constexpr PaletteEntry accentHover{&Palette::accentHover};
inline constexpr PaletteEntry onAccent{&Palette::onAccent};
inline constexpr PaletteEntry good{&Palette::good};
inline constexpr PaletteEntry warning{&Palette::warning};
inline constexpr PaletteEntry danger{&Palette::danger};
inline constexpr PaletteEntry done{&Palette::done};
inline constexpr PaletteEntry partly{&Palette::partly};
inline constexpr PaletteEntry missing{&Palette::missing};
inline constexpr PaletteEntry outdated{&Palette::outdated};
inline constexpr PaletteEntry alarm{&Palette::alarm};
inline constexpr PaletteEntry plain{&Palette::plain};
}  // namespace palette

}  // namespace acentric::ui
