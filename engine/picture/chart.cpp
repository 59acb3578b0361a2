#include "engine/picture/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/picture/cairo_canvas.h"
#include "engine/picture/drawing.h"
#include "engine/picture/legend.h"
#include "engine/picture/plan_picture.h"

namespace acentric {
namespace {

constexpr double kWidth = 1000, kHeight = 640, kLeft = 90, kRight = 210, kTop = 116, kBottom = 70;
constexpr double kChartTitle = 24, kChartText = 15, kLineWidth = 2.5, kDot = 4.5;
constexpr Rgba8 kChartPaper{255, 255, 255, 255}, kChartGrid{222, 226, 230, 255};

/// Maps decades, whole ones, to [from, to] on the page.
struct Axis {
  int low = 0, high = 1;  ///< powers of ten at its ends
  double from = 0, to = 1;
  double at(double value) const {
    return from + (to - from) * (std::log10(value) - low) / double(high - low);
  }
};

Axis axisFor(double least, double most, double from, double to) {
  const int low = int(std::floor(std::log10(least) + 1e-9));
  return {low, std::max(low + 1, int(std::ceil(std::log10(most) - 1e-9))), from, to};
}

Status draw(const Chart& chart, const Axis& x, const Axis& y, cairo_surface_t* surface) {
  CairoCanvas canvas(surface, 1);
  canvas.fillRectangle({0, 0}, {kWidth, kHeight}, kChartPaper);
  canvas.text(chart.title, {kLeft, 40}, kChartTitle, kInkColour, Align::left, true);
  canvas.text(chart.subtitle, {kLeft, 66}, kChartText, kFaintColour);
  canvas.text(chart.note, {kLeft, 88}, kChartText, kFaintColour);
  const auto line = [&](const glm::dvec2& a, const glm::dvec2& b) {
    canvas.path({a, b}, false);
    canvas.strokePath(kChartGrid, 1, false);
  };
  for (int power = x.low; power <= x.high; ++power) {
    const double at = x.at(std::pow(10, power));
    line({at, y.from}, {at, y.to});
    canvas.text(shortNumber(std::pow(10, power)), {at, y.from + 22}, kChartText, kInkColour, Align::middle);
  }
  for (int power = y.low; power <= y.high; ++power) {
    const double at = y.at(std::pow(10, power));
    line({x.from, at}, {x.to, at});
    canvas.text(shortNumber(std::pow(10, power)), {x.from - 10, at + 5}, kChartText, kInkColour,
                Align::right);
  }
  canvas.text(chart.across, {0.5 * (x.from + x.to), y.from + 50}, kChartText, kInkColour, Align::middle);
  canvas.text(chart.up, {x.from, y.to - 10}, kChartText, kInkColour);

  // Names stand at the ends of their lines, the lowest first, none over another; beside the axes, but of
  // lines that end before others.
  double last = 0;
  for (const ChartLine& each : chart.lines) last = std::max(last, each.points.back().x);
  std::vector<std::size_t> order(chart.lines.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, std::greater{},
                    [&](std::size_t i) { return y.at(chart.lines[i].points.back().y); });
  double free = kHeight;
  for (const std::size_t i : order) {
    const Rgba8 colour = categoryColour(int(i));
    std::vector<glm::dvec2> points;
    for (const glm::dvec2& p : chart.lines[i].points) points.emplace_back(x.at(p.x), y.at(p.y));
    canvas.path(points, false);
    canvas.strokePath(colour, kLineWidth, false);
    for (const glm::dvec2& p : points) {
      canvas.circle(p, kDot);
      canvas.fillPath(colour);
      canvas.endPath();
    }
    if (chart.lines[i].points.back().x < last) {
      canvas.text(chart.lines[i].name, points.back() + glm::dvec2(14, 5), kChartText, kInkColour);
      continue;
    }
    free = std::min(points.back().y + 5, free - 1.3 * kChartText);
    canvas.text(chart.lines[i].name, {x.to + 14, free}, kChartText, kInkColour);
  }
  return canvas.status();
}

}  // namespace

Status writeChart(const Chart& chart, const std::filesystem::path& path) {
  glm::dvec2 least(std::numeric_limits<double>::max()), most(0);
  for (const ChartLine& line : chart.lines) {
    if (line.points.empty())
      return fail(ErrorKind::invalidArgument, "a chart's line has no point", line.name);
    for (const glm::dvec2& p : line.points) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !(p.x > 0) || !(p.y > 0))
        return fail(ErrorKind::invalidArgument, "a chart's values must be above 0", line.name);
      least = glm::min(least, p), most = glm::max(most, p);
    }
  }
  if (chart.lines.empty()) return fail(ErrorKind::invalidArgument, "a chart needs a line", path.string());
  const Axis x = axisFor(least.x, most.x, kLeft, kWidth - kRight),
             y = axisFor(least.y, most.y, kHeight - kBottom, kTop);
  return writeDrawing({kWidth, kHeight, [&](cairo_surface_t* surface) { return draw(chart, x, y, surface); }},
                      path);
}

}  // namespace acentric
