#pragma once
/// What the colours of a quantity mean, in the lower left corner of the plan.

#include <imgui.h>

#include <functional>
#include <string>
#include <vector>

#include "ui/canvas_view.h"
#include "ui/colour.h"

namespace acentric::editor {

struct LegendLine {
  std::string words;
  ui::Colour colour;  ///< of the ink, or of what the words are about
  /// Drawn before the words, about a place; without it a disc where `colour` is not an ink of texts.
  std::function<void(ImDrawList&, const ImVec2&)> sign = {};
};

struct ScaleLegend {
  std::string title;              ///< with the unit
  std::string low, high;          ///< at the ends of the scale; both empty: no scale
  std::vector<LegendLine> lines;  ///< below it
};

void drawScaleLegend(ImDrawList& list, const ui::CanvasView& view, const ScaleLegend& legend, ImFont* font);

}  // namespace acentric::editor
