#include "engine/picture/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/picture/cairo_canvas.h"

namespace acentric {
namespace {

constexpr double kLegendText = 15, kLegendLine = 21, kBarWidth = 26, kBarHeight = 230, kLegendSwatch = 22;

double drawWrapped(CairoCanvas& canvas, const std::string& text, const glm::dvec2& at, double width,
                   const Rgba8& colour, bool bold = false) {
  double y = at.y;
  for (const std::string& line : canvas.wrap(text, kLegendText, width, bold)) {
    canvas.text(line, {at.x, y + kLegendText}, kLegendText, colour, Align::left, bold);
    y += kLegendLine;
  }
  return y - at.y;
}

std::string withUnit(double value, const std::string& unit) {
  const std::string number = shortNumber(value);
  return unit.empty() ? number : number + " " + unit;
}

double drawScale(CairoCanvas& canvas, const PlanScale& scale, const glm::dvec2& at, double width) {
  double y = at.y + drawWrapped(canvas, scale.label, at, width, kInkColour, true) + 8;
  const double top = y, bottom = y + kBarHeight;
  for (int step = 0; step < int(kBarHeight); ++step) {
    const double share = 1 - (step + 0.5) / kBarHeight;
    // A little overlap: no hairlines between the strips.
    canvas.fillRectangle({at.x, top + step}, {at.x + kBarWidth, std::min(top + step + 1.3, bottom)},
                         scaleColour(share));
  }
  canvas.strokeRectangle({at.x, top}, {at.x + kBarWidth, bottom}, kFaintColour, 1);
  const auto heightOf = [&](double value) { return bottom - kBarHeight * scale.shareOf(value); };
  const bool limited = scale.limit && *scale.limit >= scale.low && *scale.limit <= scale.high;
  for (const double value : roundNumbers(scale.low, scale.high, 7, scale.logarithmic)) {
    const double tick = heightOf(value);
    canvas.path({{at.x + kBarWidth, tick}, {at.x + kBarWidth + 6, tick}}, false);
    canvas.strokePath(kFaintColour, 1.2, false);
    if (limited && std::abs(tick - heightOf(*scale.limit)) < kLegendText) continue;
    canvas.text(withUnit(value, scale.unit), {at.x + kBarWidth + 11, tick + 0.35 * kLegendText}, kLegendText,
                kInkColour);
  }
  if (limited) {
    const double line = heightOf(*scale.limit);
    canvas.path({{at.x - 5, line}, {at.x + kBarWidth + 8, line}}, false);
    canvas.strokePath(kAlarmColour, 3, false);
    canvas.text(scale.limitLabel + " " + withUnit(*scale.limit, scale.unit),
                {at.x + kBarWidth + 14, line + 0.35 * kLegendText}, kLegendText, kAlarmColour, Align::left,
                true);
  }
  y = bottom + kLegendLine;
  if (scale.limit && !limited)
    y += drawWrapped(canvas, scale.limitLabel + " " + withUnit(*scale.limit, scale.unit) + " (off the scale)",
                     {at.x, y - 8}, width, kAlarmColour, true);
  return y - at.y;
}

void drawSwatch(CairoCanvas& canvas, const LegendEntry& entry, const glm::dvec2& at) {
  const glm::dvec2 centre = at + glm::dvec2(kLegendSwatch / 2, 0);
  const glm::dvec2 low = centre - glm::dvec2(kLegendSwatch / 2, 7),
                   high = centre + glm::dvec2(kLegendSwatch / 2, 7);
  switch (entry.swatch) {
    case LegendSwatch::area:
      canvas.fillRectangle(low, high, entry.colour);
      canvas.strokeRectangle(low, high, kFaintColour, 0.8);
      return;
    case LegendSwatch::markedArea:
      canvas.strokeRectangle(low, high, entry.colour, 3);
      return;
    case LegendSwatch::line:
    case LegendSwatch::dashedLine:
      canvas.path({{low.x, centre.y}, {high.x, centre.y}}, false);
      canvas.strokePath(entry.colour, 2.2, entry.swatch == LegendSwatch::dashedLine);
      return;
    case LegendSwatch::camera:
      canvas.wedge({low.x + 2, centre.y}, kLegendSwatch - 6, -0.5, 0.5);
      canvas.fillPath({entry.colour.r, entry.colour.g, entry.colour.b, 110});
      canvas.strokePath(entry.colour, 1.2, false);
      return;
    case LegendSwatch::dot:
      return drawMarker(canvas, MarkerShape::dot, centre, 7, entry.colour);
    case LegendSwatch::ring:
      return drawMarker(canvas, MarkerShape::ring, centre, 7, entry.colour);
    case LegendSwatch::cross:
      return drawMarker(canvas, MarkerShape::cross, centre, 7, entry.colour);
    case LegendSwatch::diamond:
      return drawMarker(canvas, MarkerShape::diamond, centre, 7, entry.colour);
  }
}

}  // namespace

bool hasLegend(const PlanPicture& picture) {
  return picture.scale || !picture.legend.empty() || !picture.notes.empty();
}

double drawLegend(CairoCanvas& canvas, const PlanPicture& picture, const glm::dvec2& at, double width) {
  double y = at.y;
  if (picture.scale) y += drawScale(canvas, *picture.scale, at, width) + 12;
  for (const LegendEntry& entry : picture.legend) {
    drawSwatch(canvas, entry, {at.x, y + 0.65 * kLegendText});
    y += drawWrapped(canvas, entry.text, {at.x + kLegendSwatch + 12, y}, width - kLegendSwatch - 12,
                     kInkColour) +
         6;
  }
  if (!picture.notes.empty()) y += 12;
  for (const std::string& note : picture.notes)
    y += drawWrapped(canvas, note, {at.x, y}, width, {73, 80, 87, 255}) + 6;
  return y - at.y;
}

void drawMarker(CairoCanvas& canvas, MarkerShape shape, const glm::dvec2& at, double size,
                const Rgba8& colour) {
  constexpr Rgba8 kHalo{255, 255, 255, 255};
  switch (shape) {
    case MarkerShape::dot:
      canvas.circle(at, 0.7 * size);
      canvas.fillPath(colour);
      canvas.strokePath(kHalo, 0.25 * size, false);
      return;
    case MarkerShape::diamond:
      canvas.path({{at.x - size, at.y}, {at.x, at.y - size}, {at.x + size, at.y}, {at.x, at.y + size}}, true);
      canvas.fillPath(colour);
      canvas.strokePath(kHalo, 0.25 * size, false);
      return;
    case MarkerShape::ring:
    case MarkerShape::cross:
      for (const bool halo : {true, false}) {
        if (shape == MarkerShape::ring) {
          canvas.circle(at, 0.85 * size);
        } else {
          const double s = 0.75 * size;
          canvas.path({{at.x - s, at.y - s}, {at.x + s, at.y + s}}, false);
          canvas.path({{at.x - s, at.y + s}, {at.x + s, at.y - s}}, false);
        }
        canvas.strokePath(halo ? kHalo : colour, (halo ? 0.7 : 0.38) * size, false);
      }
      return;
  }
}

std::vector<double> roundNumbers(double low, double high, int most, bool logarithmic) {
  std::vector<double> found;
  if (!(high > low) || most < 1 || !std::isfinite(low) || !std::isfinite(high)) return found;
  if (logarithmic && low > 0 && high / low > 8) {
    for (const std::vector<double>& digits : {std::vector<double>{1, 2, 5}, {1, 3}, {1}}) {
      found.clear();
      for (double power = std::floor(std::log10(low)); power <= std::log10(high); ++power)
        for (const double digit : digits)
          if (const double value = digit * std::pow(10, power); value >= low && value <= high)
            found.push_back(value);
      if (int(found.size()) <= most) return found;
    }
    return found;
  }
  double step = std::pow(10, std::floor(std::log10((high - low) / most)));
  for (const double factor : {1.0, 2.0, 5.0, 10.0})
    if ((high - low) / (factor * step) <= most) {
      step *= factor;
      break;
    }
  for (double n = std::ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; ++n)
    found.push_back(n == 0 ? 0 : n * step);
  return found;
}

std::string shortNumber(double value) {
  const double size = std::abs(value);
  const auto digits = [](double v) { return fmt::format("{:.3g}", v); };
  if (size >= 999.5e6) return digits(value / 1e9) + " G";
  if (size >= 999.5e3) return digits(value / 1e6) + " M";
  if (size >= 9999.5) return digits(value / 1e3) + " k";
  if (size >= 100) return fmt::format("{:.0f}", value);
  return digits(value);
}

}  // namespace acentric
