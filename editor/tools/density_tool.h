#pragma once
/// Paints how densely regions are sampled: press a placed cell or a free APV, or drag over several; with Ctrl
/// they get the project's density again. What was painted is one intention, as the button goes up.

#include <glm/glm.hpp>
#include <set>

#include "editor/tools/pointer_event.h"
#include "engine/layout/layout.h"

namespace acentric::editor {

struct PaintDensityIntent {
  std::set<CellId> cells;
  bool erase = false;  ///< back to the project's
};

class DensityTool {
 public:
  void press(const PointerEvent& event, const LayoutSpec& spec);
  void move(const PointerEvent& event, const LayoutSpec& spec);
  PaintDensityIntent release();
  bool cancel();  ///< true if something had been painted
  const std::set<CellId>& painted() const { return stroke_.cells; }

 private:
  void paint(const glm::dvec2& place, const LayoutSpec& spec);

  PaintDensityIntent stroke_;
  glm::dvec2 last_{0};
};

}  // namespace acentric::editor
