#pragma once
/// A chart of lines over logarithmic axes: how one measure grows with another.

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace acentric {

struct ChartLine {
  std::string name;
  std::vector<glm::dvec2> points;  ///< x rising
};

struct Chart {
  std::string title, subtitle;
  std::string note;        ///< below the subtitle, or empty
  std::string across, up;  ///< what the axes show, with units
  std::vector<ChartLine> lines;
};

/// As .svg or .png. Every line needs a point, and every coordinate must be finite and above 0.
Status writeChart(const Chart& chart, const std::filesystem::path& path);

}  // namespace acentric
