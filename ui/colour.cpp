#include "ui/colour.h"

#include "ui/theme.h"

namespace acentric::ui {
namespace {

/// Dark blue to yellow, of even steps in lightness: after viridis, of Smith and van der Walt (CC0).
constexpr std::array<Colour, 4> kScale = {Colour::hex(0x3b528b), Colour::hex(0x21918c), Colour::hex(0x5ec962),
                                          Colour::hex(0xfde725)};

}  // namespace

const Palette kDarkPalette = {
    .light = false,
    .backdrop = Colour::hex(0x121417),
    .panel = Colour::hex(0x1b1e23),
    .popup = Colour::hex(0x22262c),
    .raised = Colour::hex(0x272b32),
    .hovered = Colour::hex(0x333841),
    .pressed = Colour::hex(0x3d444f),
    .border = Colour::hex(0x343a43),
    .selected = Colour::hex(0x203d66),
    .text = Colour::hex(0xe7e9ec),
    .muted = Colour::hex(0xa6aeb9),
    .faint = Colour::hex(0x8a94a3),
    .accent = Colour::hex(0x4f9dff),
    .accentDeep = Colour::hex(0x2568c4),
    .accentHover = Colour::hex(0x2f72cf),
    .onAccent = Colour::hex(0xffffff),
    .good = Colour::hex(0x45c08f),
    .warning = Colour::hex(0xe6ad4c),
    .danger = Colour::hex(0xf0776f),
    .done = Colour::hex(0x45c08f),
    .partly = Colour::hex(0xe6ad4c),
    .missing = Colour::hex(0x9aa6b8),
    .outdated = Colour::hex(0xc9a4f0),
    .alarm = Colour::hex(0xff5cf0),
    .plain = Colour::hex(0xc9d0da),
    .scale = kScale,
};

const Palette kLightPalette = {
    .light = true,
    .backdrop = Colour::hex(0xe6e9ed),
    .panel = Colour::hex(0xf6f7f9),
    .popup = Colour::hex(0xfcfcfd),
    .raised = Colour::hex(0xe4e8ed),
    .hovered = Colour::hex(0xd6dbe3),
    .pressed = Colour::hex(0xc6cdd7),
    .border = Colour::hex(0xc2c9d3),
    .selected = Colour::hex(0xc8dbf6),
    .text = Colour::hex(0x1b2026),
    .muted = Colour::hex(0x454e59),
    .faint = Colour::hex(0x586270),
    .accent = Colour::hex(0x1258b8),
    .accentDeep = Colour::hex(0x1b5fc0),
    .accentHover = Colour::hex(0x164f9f),
    .onAccent = Colour::hex(0xffffff),
    .good = Colour::hex(0x0b6644),
    .warning = Colour::hex(0x845200),
    .danger = Colour::hex(0xb00030),
    .done = Colour::hex(0x0f7a52),
    .partly = Colour::hex(0xb06f00),
    .missing = Colour::hex(0x75828f),
    .outdated = Colour::hex(0x7b3fbf),
    .alarm = Colour::hex(0xe83fd8),
    .plain = Colour::hex(0x2b3038),
    .scale = kScale,
};

const Palette& currentPalette() {
  const Look* look = currentLook();
  return look != nullptr && look->light ? kLightPalette : kDarkPalette;
}

}  // namespace acentric::ui
