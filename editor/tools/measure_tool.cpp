#include "editor/tools/measure_tool.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "engine/geometry/conventions.h"
#include "ui/keys.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

std::optional<glm::dvec2> cornerAt(const PointerEvent& event, const LayoutSpec& spec,
                                   const SnapTargets& targets, double pixelsPerMetre) {
  if ((event.modifiers & ui::modifier::alt) != 0) return std::nullopt;
  if (const auto corner = nearestCorner(targets.corners, event.world, pixelsPerMetre)) return corner;
  return nearestCellCorner(spec, event.world, pixelsPerMetre);
}

}  // namespace

void MeasureTool::press(const PointerEvent& event, const LayoutSpec& spec, const SnapTargets& targets,
                        double pixelsPerMetre) {
  const auto corner = cornerAt(event, spec, targets, pixelsPerMetre);
  const glm::dvec2 place = corner.value_or(event.world);
  ruler_ = Ruler{place, place, corner.has_value(), corner.has_value()};
  dragging_ = true;
}

void MeasureTool::move(const PointerEvent& event, const LayoutSpec& spec, const SnapTargets& targets,
                       double pixelsPerMetre) {
  if (!dragging_) return;
  const auto corner = cornerAt(event, spec, targets, pixelsPerMetre);
  ruler_->to = corner.value_or(event.world);
  ruler_->toCorner = corner.has_value();
}

bool MeasureTool::cancel() {
  dragging_ = false;
  return std::exchange(ruler_, std::nullopt).has_value();
}

std::string describe(const MeasureTool::Ruler& ruler) {
  const glm::dvec2 way = ruler.to - ruler.from;
  // No minus before a zero.
  const auto plain = [](double value) { return std::abs(value) < 0.0005 ? 0.0 : value; };
  return trf("{:.3f} m at {:.1f}°\nx {:.3f} m, y {:.3f} m", glm::length(way),
             plain(degrees(std::atan2(way.y, way.x))), plain(way.x), plain(way.y));
}

}  // namespace acentric::editor
