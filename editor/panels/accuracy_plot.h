#pragma once
/// Settings as marks over two axes, with the line of those that are worth having.

#include <imgui.h>

#include <optional>
#include <string>
#include <vector>

namespace acentric::editor {

struct PlotAxis {
  std::string label;                ///< with its unit
  bool logarithmic = false;         ///< all values must be above 0
  std::optional<double> goal = {};  ///< drawn as a line across
};

struct PlotMark {
  double x = 0, y = 0;
  double xLow = 0, xHigh = 0, yLow = 0, yHigh = 0;  ///< ends of its bars
  std::string name;                                 ///< written beside it; empty: nothing
  bool front = false;                               ///< on the line
  bool base = false;                                ///< the project as it is
  bool selected = false;
};

struct AccuracyPlot {
  std::optional<std::size_t> hovered;  ///< the mark under the pointer
  std::vector<ImVec2> places;          ///< of the marks; empty where there was no room
};
/// In an area of the current window, screen pixels.
AccuracyPlot drawAccuracyPlot(const ImVec2& low, const ImVec2& high, const PlotAxis& across,
                              const PlotAxis& up, const std::vector<PlotMark>& marks);

}  // namespace acentric::editor
