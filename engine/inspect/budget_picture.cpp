#include "engine/inspect/budget_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/contract.h"
#include "engine/picture/layout_picture.h"

namespace acentric {
namespace {

/// "812", "24 k", "1.2 M".
std::string shortCount(std::size_t count) {
  if (count < 1000) return fmt::format("{}", count);
  if (count < 999'500) return fmt::format("{:.{}f} k", double(count) / 1e3, count < 9950 ? 1 : 0);
  return fmt::format("{:.2f} M", double(count) / 1e6);
}

PlanScale scaleOf(const RegionBudgets& budgets, std::optional<std::size_t> limit) {
  PlanScale scale;
  scale.label = "triangles per region";
  const auto [least, most] = std::ranges::minmax_element(budgets.triangles);
  scale.low = budgets.triangles.empty() ? 0 : double(*least);
  scale.high = budgets.triangles.empty() ? 1 : double(*most);
  // Scenes are crowded in few places: counts differ by orders of magnitude.
  scale.logarithmic = scale.high > 20 * std::max(scale.low, 1.0);
  if (scale.logarithmic) scale.low = std::max(scale.low, 1.0);
  if (!(scale.high > scale.low)) scale.high = scale.low + 1;
  if (limit) scale.limit = double(*limit), scale.limitLabel = "budget";
  return scale;
}

}  // namespace

PlanPicture pictureOf(const Layout& layout, const RegionBudgets& budgets, std::optional<std::size_t> limit,
                      std::string title) {
  require(budgets.triangles.size() == layout.regions.size(), "budgets are those of the layout");
  PlanPicture picture = pictureOf(layout, std::move(title));
  std::erase_if(picture.legend, [](const LegendEntry& e) { return e.swatch == LegendSwatch::area; });
  picture.scale = scaleOf(budgets, limit);
  for (std::size_t r = 0; r < layout.regions.size(); ++r) {
    PlanPolygon& polygon = picture.polygons[r];
    polygon.value = double(budgets.triangles[r]);
    polygon.stroke = {255, 255, 255, 255};
    polygon.marked = limit && budgets.triangles[r] > *limit;
    polygon.label = shortCount(budgets.triangles[r]);
  }
  picture.notes.push_back(
      fmt::format("Median {}, most {} triangles after clipping to the region grown by {:g} m.",
                  shortCount(budgets.median()), shortCount(budgets.worst()), layout.spec.nearBand));
  if (limit) {
    const std::size_t over = budgets.over(*limit).size();
    if (over > 0) picture.legend.push_back({"over budget", kAlarmColour, LegendSwatch::markedArea});
    picture.notes.push_back(fmt::format("{} of {} regions exceed the budget of {}.", over,
                                        layout.regions.size(), shortCount(*limit)));
  }
  return picture;
}

}  // namespace acentric
