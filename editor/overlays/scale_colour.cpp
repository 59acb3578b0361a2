#include "editor/overlays/scale_colour.h"

#include <algorithm>
#include <array>

namespace acentric::editor {

ui::Colour scaleColour(double t) {
  static constexpr std::array<std::uint32_t, 5> kStops{0x3b528b, 0x21918c, 0x5ec962, 0xaadc32, 0xfde725};
  const double at = std::clamp(t, 0.0, 1.0) * double(kStops.size() - 1);
  const std::size_t low = std::min(std::size_t(at), kStops.size() - 2);
  return ui::Colour::hex(kStops[low]).mixed(ui::Colour::hex(kStops[low + 1]), float(at - double(low)));
}

}  // namespace acentric::editor
