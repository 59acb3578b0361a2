#include "tests/bench_functions/figures.h"

#include "engine/cli/machine/figure.h"

namespace acentric::bench {
namespace {

volatile double sink = 0;

}  // namespace

void Figures::add(const std::string& what, const std::string& unit, const std::vector<double>& values) {
  figures_.push_back({{"what", what}, {"unit", unit}});
  cli::putSpread(figures_.back(), values);
}

void Figures::add(const std::string& what, const std::string& unit, const std::vector<double>& values,
                  const std::string& otherName, const std::vector<double>& other) {
  add(what, unit, values);
  cli::putBeside(figures_.back(), values, otherName, other);
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
