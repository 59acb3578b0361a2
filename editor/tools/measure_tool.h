#pragma once
/// A ruler in the plan: drag for the distance and the direction between two places; both land on corners of
/// the outline, of walls and of cells (Alt: anywhere). Changes nothing.

#include <optional>
#include <string>

#include "editor/tools/pointer_event.h"
#include "editor/tools/snap.h"

namespace acentric::editor {

class MeasureTool {
 public:
  struct Ruler {
    glm::dvec2 from{0}, to{0};  ///< plan, metres
    bool fromCorner = false, toCorner = false;
  };
  /// Left button only.
  void press(const PointerEvent& event, const LayoutSpec& spec, const SnapTargets& targets,
             double pixelsPerMetre);
  void move(const PointerEvent& event, const LayoutSpec& spec, const SnapTargets& targets,
            double pixelsPerMetre);
  void release() { dragging_ = false; }
  /// True if there was a ruler.
  bool cancel();
  /// The last one drawn stays until the next.
  const std::optional<Ruler>& ruler() const { return ruler_; }

 private:
  std::optional<Ruler> ruler_;
  bool dragging_ = false;
};

/// "3.42 m at 26.6°, x 3.06 m, y 1.53 m": the angle counter-clockwise from east.
std::string describe(const MeasureTool::Ruler& ruler);

}  // namespace acentric::editor
