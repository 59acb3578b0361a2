#include "engine/measure/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/measure/plot_range.h"

namespace acentric {
namespace {

constexpr double kLeft = 72, kRight = 22, kTop = 34, kBottom = 52;
constexpr double kLetter = 6.3, kLine = 13;  ///< of labels, pixels
constexpr double kAir = 0.08;                ///< beyond the outermost points, of the axis

struct Axis {
  double low = 0, high = 1;  ///< logarithms where it is logarithmic
  double from = 0, to = 1;   ///< pixels
  bool logarithmic = false;
  double at(double value) const {
    const double v = logarithmic ? std::log10(value) : value;
    return from + (to - from) * std::clamp((v - low) / (high - low), -0.02, 1.02);
  }
  std::vector<double> ticks(int count) const {
    return logarithmic ? ticksOf(std::pow(10, low), std::pow(10, high), count, true)
                       : ticksOf(low, high, count, false);
  }
};

/// What the points fill, but for some far from all others, which are not among `always`; and as much of their
/// bars as lies no farther beyond than that once more.
Axis axisFor(std::vector<double> places, std::vector<double> always, std::vector<double> bars,
             bool logarithmic, double from, double to) {
  if (logarithmic)
    for (auto* values : {&places, &always, &bars})
      for (double& value : *values) value = std::log10(value);
  const auto [least, most] = plotRange(places, always, false);
  const double reach = std::max({most - least, 1e-3 * std::abs(most), 1e-9});
  double low = least, high = most;
  for (const double bar : bars)
    low = std::min(low, std::max(bar, least - 0.3 * reach)),
    high = std::max(high, std::min(bar, most + 0.3 * reach));
  const double air = kAir * std::max(high - low, reach);
  return {low - air, high + air, from, to, logarithmic};
}

struct Box {
  double x0, y0, x1, y1;
  bool meets(const Box& o) const { return x0 < o.x1 && o.x0 < x1 && y0 < o.y1 && o.y0 < y1; }
};

/// Labels where no other and no point is; those for which there is no room are left out.
class Labels {
 public:
  Labels(const Plot& plot, const Axis& x, const Axis& y)
      : border_{kLeft, kTop, plot.width - 2.0, plot.height - kBottom} {
    for (const PlotPoint& p : plot.points)
      taken_.push_back({x.at(p.x) - 5, y.at(p.y) - 5, x.at(p.x) + 5, y.at(p.y) + 5});
  }
  std::string place(const PlotPoint& point, double x, double y) {
    const double width = kLetter * double(point.label.size());
    const std::array<Box, 6> places{{{x + 7, y - 8, x + 7 + width, y + 6},
                                     {x - 7 - width, y - 8, x - 7, y + 6},
                                     {x - width / 2, y - 22, x + width / 2, y - 7},
                                     {x - width / 2, y + 7, x + width / 2, y + 22},
                                     {x + 7, y - 21, x + 7 + width, y - 7},
                                     {x + 7, y + 6, x + 7 + width, y + 20}}};
    for (const Box& box : places) {
      if (box.x0 < border_.x0 || box.x1 > border_.x1 || box.y0 < border_.y0 || box.y1 > border_.y1) continue;
      if (std::ranges::any_of(taken_, [&](const Box& other) { return box.meets(other); })) continue;
      taken_.push_back(box);
      return fmt::format("<text class=\"label\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", box.x0,
                         box.y0 + kLine - 2, htmlText(point.label));
    }
    return {};
  }

 private:
  Box border_;
  std::vector<Box> taken_;
};

std::string lineOf(double x0, double y0, double x1, double y1, const char* kind) {
  return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", kind,
                     x0, y0, x1, y1);
}

std::string axesOf(const Plot& plot, const Axis& x, const Axis& y) {
  std::string svg;
  for (const double tick : x.ticks(6)) {
    svg += lineOf(x.at(tick), y.from, x.at(tick), y.to, "grid");
    svg += fmt::format("<text class=\"tick\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{:g}</text>\n",
                       x.at(tick), y.from + 16, tick);
  }
  for (const double tick : y.ticks(6)) {
    svg += lineOf(x.from, y.at(tick), x.to, y.at(tick), "grid");
    svg += fmt::format("<text class=\"tick\" text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{:g}</text>\n",
                       x.from - 7, y.at(tick) + 4, tick);
  }
  svg += lineOf(x.from, y.from, x.to, y.from, "axis") + lineOf(x.from, y.from, x.from, y.to, "axis");
  svg += fmt::format("<text class=\"name\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{}\">{}</text>\n",
                     0.5 * (x.from + x.to), plot.height - 12, htmlText(plot.across));
  const double middle = 0.5 * (y.from + y.to);
  svg += fmt::format(
      "<text class=\"name\" text-anchor=\"middle\" x=\"16\" y=\"{0:.1f}\" transform=\"rotate(-90 16 "
      "{0:.1f})\">{1}</text>\n",
      middle, htmlText(plot.up));
  return svg;
}

std::string polylineOf(const Plot& plot, const std::vector<std::size_t>& line, const Axis& x, const Axis& y) {
  std::string points;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const PlotPoint& p = plot.points[line[i]];
    if (plot.steps && i > 0)
      points += fmt::format("{:.1f},{:.1f} ", x.at(p.x), y.at(plot.points[line[i - 1]].y));
    points += fmt::format("{:.1f},{:.1f} ", x.at(p.x), y.at(p.y));
  }
  return fmt::format("<polyline class=\"line\" points=\"{}\"/>\n", points);
}

std::string barsOf(const PlotPoint& p, const Axis& x, const Axis& y) {
  std::string svg;
  if (p.xHigh > p.xLow) svg += lineOf(x.at(p.xLow), y.at(p.y), x.at(p.xHigh), y.at(p.y), "bar");
  if (p.yHigh > p.yLow) svg += lineOf(x.at(p.x), y.at(p.yLow), x.at(p.x), y.at(p.yHigh), "bar");
  return svg;
}

std::string pointOf(const PlotPoint& p, const Axis& x, const Axis& y) {
  const char* kind = p.kind == PlotPoint::Kind::base    ? "base"
                     : p.kind == PlotPoint::Kind::front ? "front"
                                                        : "plain";
  return fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"><title>{}</title></circle>\n",
                     kind, x.at(p.x), y.at(p.y), p.kind == PlotPoint::Kind::plain ? 3.5 : 5,
                     htmlText(p.hint));
}

}  // namespace

std::vector<double> ticksOf(double low, double high, int count, bool logarithmic) {
  std::vector<double> ticks;
  if (logarithmic) {
    for (int power = int(std::floor(std::log10(low))) - 1; power <= int(std::ceil(std::log10(high))); ++power)
      for (const double digit : {1.0, 2.0, 5.0}) {
        const double tick = digit * std::pow(10, power);
        if (tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9)) ticks.push_back(tick);
      }
    if (ticks.size() > std::size_t(2 * count))
      std::erase_if(ticks, [](double tick) { return std::abs(std::remainder(std::log10(tick), 1)) > 1e-6; });
    if (ticks.size() >= 3) return ticks;
    ticks.clear();  // less than a decade: as on a linear axis
  }
  const double rough = (high - low) / count, decade = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * decade;
  for (const double digit : {5.0, 2.0, 1.0})
    if (digit * decade >= rough * (1 - 1e-9)) step = digit * decade;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high * (1 + 1e-12) + 1e-9 * step; ++k)
    ticks.push_back(k == 0 ? 0 : k * step);
  return ticks;
}

std::string svgOf(const Plot& plot) {
  std::string svg = fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "role=\"img\" aria-label=\"{2}\">\n<text class=\"title\" x=\"{3}\" y=\"18\">{2}</text>\n",
      plot.width, plot.height, htmlText(plot.title), kLeft);
  if (plot.points.empty()) return svg + "</svg>\n";
  std::vector<double> xs, ys, xAlways, yAlways, xBars, yBars;
  for (const PlotPoint& p : plot.points) {
    xs.push_back(p.x), ys.push_back(p.y);
    if (p.kind != PlotPoint::Kind::plain) xAlways.push_back(p.x), yAlways.push_back(p.y);
    if (p.xHigh > p.xLow) xBars.insert(xBars.end(), {p.xLow, p.xHigh});
    if (p.yHigh > p.yLow) yBars.insert(yBars.end(), {p.yLow, p.yHigh});
  }
  const Axis x = axisFor(xs, xAlways, xBars, plot.logAcross, kLeft, plot.width - kRight);
  const Axis y = axisFor(ys, yAlways, yBars, false, plot.height - kBottom, kTop);
  svg += axesOf(plot, x, y);
  for (const PlotPoint& p : plot.points) svg += barsOf(p, x, y);
  for (const auto& line : plot.lines) svg += polylineOf(plot, line, x, y);
  std::vector<const PlotPoint*> order;  // what matters most last, on top; and labelled first
  for (const PlotPoint& p : plot.points) order.push_back(&p);
  std::ranges::stable_sort(order, {}, &PlotPoint::kind);
  for (const PlotPoint* p : order) svg += pointOf(*p, x, y);
  Labels labels(plot, x, y);
  std::ranges::reverse(order);
  for (const PlotPoint* p : order)
    if (!p->label.empty()) svg += labels.place(*p, x.at(p->x), y.at(p->y));
  return svg + "</svg>\n";
}

}  // namespace acentric
