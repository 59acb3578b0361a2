#include "editor/tools/density_tool.h"

#include <cmath>
#include <utility>

#include "ui/keys.h"

namespace acentric::editor {

void DensityTool::press(const PointerEvent& event, const LayoutSpec& spec) {
  stroke_ = {{}, (event.modifiers & ui::modifier::control) != 0};
  last_ = event.world;
  paint(last_, spec);
}

void DensityTool::move(const PointerEvent& event, const LayoutSpec& spec) {
  // A fast pointer leaps over cells; the finest are this small.
  const double step = 0.25 * spec.cellSize / double(1 << (canSplit(spec.configuration) ? 2 : 0));
  constexpr double kMostSteps = 10'000;
  const double steps = std::ceil(std::min(glm::distance(event.world, last_) / step, kMostSteps));
  for (double n = 1; n <= steps; ++n) paint(glm::mix(last_, event.world, n / steps), spec);
  last_ = event.world;
}

PaintDensityIntent DensityTool::release() { return std::exchange(stroke_, {}); }

bool DensityTool::cancel() { return !std::exchange(stroke_, {}).cells.empty(); }

void DensityTool::paint(const glm::dvec2& place, const LayoutSpec& spec) {
  for (const auto& [number, apv] : spec.freeApvs)
    if (!apv.traditional() && polygonOf(apv).containsClosed(place)) {
      stroke_.cells.insert({number, 0, kFreeSlot});
      return;
    }
  const CellId cell = cellAt(spec, place).id;
  if (isPlaced(spec, cell)) stroke_.cells.insert(cell);
}

}  // namespace acentric::editor
