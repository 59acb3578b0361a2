#include "tests/bench/figures.h"

#include <algorithm>

namespace acentric::bench {
namespace {

nlohmann::ordered_json spreadJson(const std::vector<double>& values) {
  const Spread spread = spreadOf(values);
  return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}, {"count", spread.count}};
}

volatile double sink = 0;

}  // namespace

void Figures::add(const std::string& what, const std::string& unit, const std::vector<double>& values) {
  nlohmann::ordered_json figure = {{"what", what}, {"unit", unit}};
  figure.update(spreadJson(values));
  figures_.push_back(std::move(figure));
}

void Figures::add(const std::string& what, const std::string& unit, const std::vector<double>& values,
                  const std::string& otherName, const std::vector<double>& other) {
  add(what, unit, values);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(values.size(), other.size()); ++i)
    if (other[i] > 0) ratios.push_back(values[i] / other[i]);
  nlohmann::ordered_json beside = {{"name", otherName}};
  beside.update(spreadJson(other));
  figures_.back()["beside"] = std::move(beside);
  figures_.back()["ratio"] = spreadOf(ratios).median;
}

void Figures::fact(const std::string& what, nlohmann::ordered_json value) { facts_[what] = std::move(value); }

nlohmann::ordered_json Figures::json() const {
  return {{"bench", bench_}, {"facts", facts_}, {"figures", figures_}};
}

std::vector<double> secondsOf(int repeats, const std::function<void()>& work) {
  std::vector<double> seconds;
  for (int i = 0; i < repeats; ++i) {
    const Stopwatch watch;
    work();
    seconds.push_back(watch.seconds());
  }
  return seconds;
}

Turns secondsByTurns(int repeats, const std::function<void()>& one, const std::function<void()>& other) {
  Turns turns;
  for (int i = 0; i < repeats; ++i) {
    turns.one.push_back(secondsOf(1, one).front());
    turns.other.push_back(secondsOf(1, other).front());
  }
  return turns;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

void used(double value) { sink = sink + value; }

}  // namespace acentric::bench
