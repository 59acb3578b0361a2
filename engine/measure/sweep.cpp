#include "engine/measure/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace acentric {
namespace {

constexpr double kLeast = 1e-6;   ///< objectives are compared by their ratios
constexpr double kMostError = 3;  ///< of a preset, over the least there is

double shareOf(double value, double least, double most) {
  return most > least ? (value - least) / (most - least) : 0;
}

}  // namespace

std::string textOf(const SweepSetting& setting) {
  if (setting.empty()) return "as it is";
  std::string text;
  for (const KnobChoice& choice : setting)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", choice.knob, choice.value);
  return text;
}

const std::array<MeasureInfo, kMeasures>& measures() {
  static const std::array<MeasureInfo, kMeasures> table{{
      {Measure::psnr, "psnr", "PSNR", "dB", 1, 2, true, true},
      {Measure::ssim, "ssim", "SSIM", "", 1, 4, true, true},
      {Measure::msSsim, "msSsim", "MS-SSIM", "", 1, 4, true, true},
      {Measure::depthError, "depthError", "depth error", "%", 100, 2, true, false},
      {Measure::holeShare, "holeShare", "holes", "%", 100, 3, true, false},
      {Measure::flicker, "flicker", "flicker", "%", 100, 2, true, false},
      {Measure::bakeSeconds, "bakeSeconds", "bake", "s", 1, 1, false, false},
      {Measure::bytes, "bytes", "on disk", "MB", 1e-6, 1, false, false},
      {Measure::loadMs, "loadMs", "load", "ms", 1, 0, false, false},
      {Measure::frameMs, "frameMs", "frame", "ms", 1, 2, false, false},
      {Measure::frameP99Ms, "frameP99Ms", "frame p99", "ms", 1, 2, false, false},
  }};
  return table;
}

Objectives objectivesOf(const SweepPoint& point) {
  return {std::max(1 - point[Measure::msSsim].median, kLeast),
          std::max(point[Measure::frameMs].median, kLeast), std::max(point[Measure::bytes].median, kLeast)};
}

const SweepPoint* Sweep::find(const SweepSetting& setting) const {
  const auto found = std::ranges::find(points, setting, &SweepPoint::setting);
  return found == points.end() ? nullptr : &*found;
}
SweepPoint* Sweep::find(const SweepSetting& setting) {
  const auto found = std::ranges::find(points, setting, &SweepPoint::setting);
  return found == points.end() ? nullptr : &*found;
}

std::vector<std::size_t> frontOf(const Sweep& sweep) {
  std::vector<std::size_t> measured, front;
  std::vector<Objectives> objectives;
  for (std::size_t i = 0; i < sweep.points.size(); ++i)
    if (sweep.points[i].measured()) {
      measured.push_back(i);
      objectives.push_back(objectivesOf(sweep.points[i]));
    }
  for (const std::size_t i : paretoFront(objectives)) front.push_back(measured[i]);
  return front;
}

GoalFigures figuresOf(const SweepPoint& point) {
  constexpr double kLeast = 1e-6;
  const auto above = [&](Measure measure) { return std::max(point[measure].median, kLeast); };
  return {above(Measure::bytes), above(Measure::frameMs), above(Measure::psnr)};
}

const SweepPoint* proposalOf(const Sweep& sweep, const Goals& goals) {
  const SweepPoint* best = nullptr;
  for (const SweepPoint& point : sweep.points)
    if (point.measured() &&
        (best == nullptr || scoreOf(goals, figuresOf(point)) < scoreOf(goals, figuresOf(*best))))
      best = &point;
  return best;
}

std::vector<SweepPreset> presetsOf(const Sweep& sweep) {
  const std::vector<std::size_t> front = frontOf(sweep);
  if (front.empty()) return {};
  std::vector<Objectives> points;  // error; logarithms of milliseconds and bytes
  for (const std::size_t i : front) {
    const Objectives o = objectivesOf(sweep.points[i]);
    points.push_back({o[0], std::log(o[1]), std::log(o[2])});
  }
  const double least = std::ranges::min(points, {}, [](const Objectives& p) { return p[0]; })[0];
  const auto good = [&](const Objectives& p) { return p[0] <= kMostError * least; };
  Objectives low(3, HUGE_VAL), high(3, -HUGE_VAL);  // of the good ones
  for (const Objectives& p : points)
    for (std::size_t k = 0; good(p) && k < p.size(); ++k)
      low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  const auto share = [&](const Objectives& p, std::size_t k) { return shareOf(p[k], low[k], high[k]); };
  // The first of equals, so that the choice does not hang on the order of comparing.
  const auto best = [&](const auto& score) {
    return std::size_t(std::ranges::min_element(points, {}, score) - points.begin());
  };
  const std::size_t fast =
      best([&](const Objectives& p) { return std::pair(!good(p), std::pair(p[1], p[0])); });
  const std::size_t balanced = best([&](const Objectives& p) {
    return std::pair(!good(p), std::hypot(share(p, 0), 0.5 * (share(p, 1) + share(p, 2))));
  });
  const std::size_t accurate = best([&](const Objectives& p) { return std::pair(p[0], p[1]); });
  const auto settingOf = [&](std::size_t i) { return sweep.points[front[i]].setting; };
  std::vector<SweepPreset> presets{
      {"fast", settingOf(fast)}, {"balanced", settingOf(balanced)}, {"accurate", settingOf(accurate)}};
  if (sweep.goals) presets.push_back({"proposal", proposalOf(sweep, *sweep.goals)->setting});
  return presets;
}

}  // namespace acentric
