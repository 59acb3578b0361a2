#pragma once
/// What the colours of a quantity mean, in the lower left corner of the plan.

#include <imgui.h>

#include <string>
#include <utility>
#include <vector>

#include "ui/canvas_view.h"
#include "ui/colour.h"

namespace acentric::editor {

struct ScaleLegend {
  std::string title;                                      ///< with the unit
  std::string low, high;                                  ///< at the ends of the scale; both empty: no scale
  std::vector<std::pair<std::string, ui::Colour>> lines;  ///< below it
};

void drawScaleLegend(ImDrawList& list, const ui::CanvasView& view, const ScaleLegend& legend, ImFont* font);

}  // namespace acentric::editor
