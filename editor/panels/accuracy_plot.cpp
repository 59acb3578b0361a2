#include "editor/panels/accuracy_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/measure/plot_range.h"
#include "engine/measure/svg_plot.h"
#include "ui/colour.h"
#include "ui/theme.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

namespace palette = ui::palette;

/// Values along one side of the plot.
class Scale {
 public:
  Scale(double low, double high, float from, float to, bool logarithmic)
      : logarithmic_(logarithmic), from_(from), to_(to) {
    low_ = value(low), high_ = value(high);
    const double room = high_ > low_ ? 0.08 * (high_ - low_) : std::max(0.05 * std::abs(low_), 1e-3);
    low_ -= room, high_ += room;
  }
  /// What lies beyond is at the border.
  float at(double x) const {
    return from_ + float(std::clamp((value(x) - low_) / (high_ - low_), 0.0, 1.0)) * (to_ - from_);
  }
  /// -1 below, 1 above what is shown, else 0.
  int beyond(double x) const { return value(x) < low_ ? -1 : value(x) > high_ ? 1 : 0; }
  std::vector<double> ticks(int count) const {
    return ticksOf(logarithmic_ ? std::exp(low_) : low_, logarithmic_ ? std::exp(high_) : high_, count,
                   logarithmic_);
  }

 private:
  double value(double x) const { return logarithmic_ ? std::log(x) : x; }

  bool logarithmic_;
  double low_ = 0, high_ = 1;
  float from_, to_;
};

std::string tickText(double value) { return fmt::format("{:.6g}", value); }

/// A few marks far from all others must not squash these; those on the line, the project and what is selected
/// are always shown.
Scale scaleOf(const std::vector<PlotMark>& marks, double PlotMark::*place, float from, float to,
              const PlotAxis& axis) {
  std::vector<double> values, always;
  if (axis.goal) always.push_back(*axis.goal);
  for (const PlotMark& mark : marks)
    (mark.front || mark.base || mark.selected ? always : values).push_back(mark.*place);
  values.insert(values.end(), always.begin(), always.end());
  const PlotRange range = plotRange(values, always, axis.logarithmic);
  return {range.low, range.high, from, to, axis.logarithmic};
}

/// At the border, towards where the mark would be.
void drawArrow(ImDrawList& list, const ImVec2& at, float x, float y, const ui::Colour& ink) {
  const float length = std::hypot(x, y), side = ui::scaled(6);
  const ImVec2 ahead(x / length * side, y / length * side), beside(-ahead.y, ahead.x);
  list.AddTriangleFilled({at.x + ahead.x, at.y + ahead.y},
                         {at.x - ahead.x + beside.x, at.y - ahead.y + beside.y},
                         {at.x - ahead.x - beside.x, at.y - ahead.y - beside.y}, ink.packed());
}

void tellBeyond(const PlotMark& mark, const PlotAxis& across, const PlotAxis& up, bool beyondAcross,
                bool beyondUp) {
  std::string text = tr("Beyond the axes:");
  if (beyondAcross) text += fmt::format("\n{}: {:.4g}", across.label, mark.x);
  if (beyondUp) text += fmt::format("\n{}: {:.4g}", up.label, mark.y);
  ImGui::SetTooltip("%s", text.c_str());
}

void drawAxes(ImDrawList& list, const ImVec2& low, const ImVec2& high, const Scale& x, const Scale& y,
              const PlotAxis& across, const PlotAxis& up) {
  constexpr int kAcross = 7, kUp = 6;
  const float line = ImGui::GetTextLineHeight(), near = ui::scaled(5);
  for (const double tick : x.ticks(kAcross)) {
    const float at = x.at(tick);
    list.AddLine({at, low.y}, {at, high.y}, palette::border.withOpacity(0.5F).packed());
    const std::string text = tickText(tick);
    list.AddText({at - ImGui::CalcTextSize(text.c_str()).x / 2, high.y + near}, palette::muted.packed(),
                 text.c_str());
  }
  for (const double tick : y.ticks(kUp)) {
    const float at = y.at(tick);
    list.AddLine({low.x, at}, {high.x, at}, palette::border.withOpacity(0.5F).packed());
    const std::string text = tickText(tick);
    list.AddText({low.x - near - ImGui::CalcTextSize(text.c_str()).x, at - line / 2}, palette::muted.packed(),
                 text.c_str());
  }
  list.AddRect(low, high, palette::border.packed());
  list.AddText({low.x, low.y - line - near}, palette::text.packed(), up.label.c_str());
  list.AddText({high.x - ImGui::CalcTextSize(across.label.c_str()).x, high.y + near + line},
               palette::text.packed(), across.label.c_str());
}

void drawMark(ImDrawList& list, const ImVec2& at, const PlotMark& mark, bool hovered) {
  const float radius = ui::scaled(mark.front || mark.base ? 5.5F : 4);
  const ui::Colour ink = mark.front ? ui::Colour(palette::accent) : ui::Colour(palette::muted);
  if (mark.selected || hovered)
    list.AddCircle(at, radius + ui::scaled(3), palette::text.packed(), 0, ui::scaled(1.6F));
  if (mark.base) {
    const float side = radius * 1.3F;  // a diamond
    list.AddQuadFilled({at.x, at.y - side}, {at.x + side, at.y}, {at.x, at.y + side}, {at.x - side, at.y},
                       mark.front ? ink.packed() : palette::warning.packed());
  } else if (mark.front) {
    list.AddCircleFilled(at, radius, ink.packed());
  } else {
    list.AddCircle(at, radius, ink.packed(), 0, ui::scaled(1.5F));
  }
}

}  // namespace

AccuracyPlot drawAccuracyPlot(const ImVec2& low, const ImVec2& high, const PlotAxis& across,
                              const PlotAxis& up, const std::vector<PlotMark>& marks) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float line = ImGui::GetTextLineHeight();
  const ImVec2 from(low.x + ui::scaled(62), low.y + line + ui::scaled(10));
  const ImVec2 to(high.x - ui::scaled(14), high.y - 2 * line - ui::scaled(14));
  if (marks.empty() || to.x - from.x < ui::scaled(60) || to.y - from.y < ui::scaled(60)) return {};
  const Scale x = scaleOf(marks, &PlotMark::x, from.x, to.x, across);
  const Scale y = scaleOf(marks, &PlotMark::y, to.y, from.y, up);
  drawAxes(list, from, to, x, y, across, up);
  const ImU32 goal = palette::good.withOpacity(0.8F).packed();
  if (across.goal)
    list.AddLine({x.at(*across.goal), from.y}, {x.at(*across.goal), to.y}, goal, ui::scaled(1.5F));
  if (up.goal) list.AddLine({from.x, y.at(*up.goal)}, {to.x, y.at(*up.goal)}, goal, ui::scaled(1.5F));

  std::vector<ImVec2> front;
  for (const PlotMark& mark : marks)
    if (mark.front) front.emplace_back(x.at(mark.x), y.at(mark.y));
  std::ranges::sort(front, {}, [](const ImVec2& p) { return p.x; });
  for (std::size_t i = 0; i + 1 < front.size(); ++i)
    list.AddLine(front[i], front[i + 1], palette::accent.withOpacity(0.45F).packed(), ui::scaled(1.5F));

  AccuracyPlot out;
  std::optional<std::size_t>& nearest = out.hovered;
  if (ImGui::IsWindowHovered()) {
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    float least = ui::scaled(14) * ui::scaled(14);
    for (std::size_t i = 0; i < marks.size(); ++i) {
      const float dx = x.at(marks[i].x) - pointer.x, dy = y.at(marks[i].y) - pointer.y;
      if (dx * dx + dy * dy >= least) continue;
      least = dx * dx + dy * dy;
      nearest = i;
    }
  }
  int beyond = 0;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const PlotMark& mark = marks[i];
    const ImVec2 at(x.at(mark.x), y.at(mark.y));
    const ImU32 bars = palette::muted.withOpacity(nearest == i || mark.selected ? 0.9F : 0.25F).packed();
    list.AddLine({x.at(mark.xLow), at.y}, {x.at(mark.xHigh), at.y}, bars);
    if (nearest == i || mark.selected) list.AddLine({at.x, y.at(mark.yLow)}, {at.x, y.at(mark.yHigh)}, bars);
    const int beyondX = x.beyond(mark.x), beyondY = y.beyond(mark.y);
    if (beyondX == 0 && beyondY == 0) {
      drawMark(list, at, mark, nearest == i);
    } else {
      ++beyond;
      drawArrow(list, at, float(beyondX), float(-beyondY),
                nearest == i ? ui::Colour(palette::text) : ui::Colour(palette::muted));
      if (nearest == i) tellBeyond(mark, across, up, beyondX != 0, beyondY != 0);
    }
    out.places.push_back(at);
    if (mark.name.empty()) continue;
    const float width = ImGui::CalcTextSize(mark.name.c_str()).x;
    // Above the mark, on a ground of its own: other marks may lie there.
    const float x0 =
        std::clamp(at.x - width / 2, from.x + ui::scaled(4), std::max(from.x, to.x - width - ui::scaled(4)));
    const float y0 = at.y - line - ui::scaled(9);
    list.AddRectFilled({x0 - ui::scaled(3), y0}, {x0 + width + ui::scaled(3), y0 + line},
                       palette::panel.withOpacity(0.85F).packed(), 3);
    list.AddText({x0, y0}, palette::text.packed(), mark.name.c_str());
  }
  if (beyond > 0) {
    const std::string text = trf("{} beyond the axes", beyond);
    list.AddText({to.x - ImGui::CalcTextSize(text.c_str()).x, low.y}, palette::muted.packed(), text.c_str());
  }
  return out;
}

}  // namespace acentric::editor
