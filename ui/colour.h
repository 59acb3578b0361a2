#pragma once
/// Colours of the interface, written as on paper: 0xRRGGBB and an opacity. sRGB, straight alpha.

#include <imgui.h>

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

/// The one palette: dark neutral, one accent, four meanings.
namespace palette {
inline constexpr Colour backdrop = Colour::hex(0x121417);
inline constexpr Colour panel = Colour::hex(0x1b1e23);
inline constexpr Colour raised = Colour::hex(0x272b32);
inline constexpr Colour hovered = Colour::hex(0x333841);
inline constexpr Colour pressed = Colour::hex(0x3d444f);
inline constexpr Colour border = Colour::hex(0x343a43);
inline constexpr Colour text = Colour::hex(0xe7e9ec);
inline constexpr Colour muted = Colour::hex(0xa0a8b3);
inline constexpr Colour faint = Colour::hex(0x6c7581);
inline constexpr Colour accent = Colour::hex(0x4f9dff);
inline constexpr Colour accentDeep = Colour::hex(0x2568c4);
inline constexpr Colour good = Colour::hex(0x45c08f);
inline constexpr Colour warning = Colour::hex(0xe6ad4c);
inline constexpr Colour danger = Colour::hex(0xec6a62);
}  // namespace palette

}  // namespace acentric::ui
