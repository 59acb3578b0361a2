#pragma once
/// Points with error bars over two axes, as SVG to be put into HTML.

#include <string>
#include <vector>

#include "engine/base/html_text.h"

namespace acentric {

struct PlotPoint {
  double x = 0, y = 0;
  double xLow = 0, xHigh = 0, yLow = 0, yHigh = 0;  ///< ends of its bars; equal: none
  std::string label;                                ///< written beside it where there is room
  std::string hint;                                 ///< shown when pointed at
  enum class Kind { plain, front, base } kind = Kind::plain;
};

struct Plot {
  std::string title;
  std::string across, up;  ///< what the axes show, with units
  bool logAcross = false;  ///< all x, and their bars, must be above 0
  int width = 620, height = 400;
  std::vector<PlotPoint> points;
  /// Places that lines join, one line a list; steps go across first, as the border of what is reached does.
  std::vector<std::vector<std::size_t>> lines;
  bool steps = false;
};

std::string svgOf(const Plot& plot);

/// Round values within [low, high], about `count` of them: 1, 2 or 5 times powers of ten; for logarithmic
/// axes of those as many as lie there, thinned to decades where they are many.
std::vector<double> ticksOf(double low, double high, int count, bool logarithmic);

}  // namespace acentric
