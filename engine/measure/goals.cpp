#include "engine/measure/goals.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace acentric {
namespace {

/// Of the pixels' error, a doubling.
const double kDecibels = 20 * std::log10(2.0);
constexpr double kEnough = 0.05;      ///< doublings: bytes and times vary by 3 %
constexpr double kPreference = 0.02;  ///< of what is not a goal, against what is

constexpr std::pair<const char*, std::optional<double> Goals::*> kGoals[] = {
    {"mostBytes", &Goals::mostBytes}, {"mostFrameMs", &Goals::mostFrameMs}, {"leastPsnr", &Goals::leastPsnr}};

}  // namespace

Status Goals::check() const {
  if (empty())
    return fail(ErrorKind::invalidArgument, "give a goal: bytes or milliseconds at most, dB at least",
                "goals");
  for (const auto& [name, goal] : kGoals)
    if (const auto& value = this->*goal; value && !(std::isfinite(*value) && *value > 0))
      return fail(ErrorKind::invalidArgument, fmt::format("{} is {}: it must be above 0", name, *value),
                  "goals");
  return {};
}

std::string textOf(const Goals& goals) {
  std::vector<std::string> parts;
  if (goals.mostBytes) parts.push_back(fmt::format("at most {:g} MB", *goals.mostBytes / 1e6));
  if (goals.mostFrameMs) parts.push_back(fmt::format("at most {:g} ms", *goals.mostFrameMs));
  if (goals.leastPsnr) parts.push_back(fmt::format("at least {:g} dB", *goals.leastPsnr));
  return fmt::format("{}", fmt::join(parts, ", "));
}

double missOf(const Goals& goals, const GoalFigures& figures) {
  double most = -std::numeric_limits<double>::infinity();
  if (goals.mostBytes) most = std::max(most, std::log2(figures.bytes / *goals.mostBytes));
  if (goals.mostFrameMs) most = std::max(most, std::log2(figures.frameMs / *goals.mostFrameMs));
  if (goals.leastPsnr) most = std::max(most, (*goals.leastPsnr - figures.psnr) / kDecibels);
  return most;
}

double scoreOf(const Goals& goals, const GoalFigures& figures) {
  const double rest = goals.leastPsnr ? std::log2(figures.bytes) : -figures.psnr / kDecibels;
  return std::max(missOf(goals, figures), -kEnough) + kPreference * rest;
}

std::map<std::string, double> numbersOf(const Goals& goals) {
  std::map<std::string, double> numbers;
  for (const auto& [name, goal] : kGoals)
    if (const auto& value = goals.*goal) numbers[name] = *value;
  return numbers;
}

Goals goalsFrom(const std::map<std::string, double>& numbers) {
  Goals goals;
  for (const auto& [name, goal] : kGoals)
    if (const auto found = numbers.find(name); found != numbers.end()) goals.*goal = found->second;
  return goals;
}

}  // namespace acentric
