#include "editor/overlays/scale_colour.h"

#include <algorithm>

namespace acentric::editor {

ui::Colour scaleColour(double t) {
  const auto& stops = ui::currentPalette().scale;
  const double at = std::clamp(t, 0.0, 1.0) * double(stops.size() - 1);
  const std::size_t low = std::min(std::size_t(at), stops.size() - 2);
  return stops[low].mixed(stops[low + 1], float(at - double(low)));
}

}  // namespace acentric::editor
