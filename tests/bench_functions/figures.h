#pragma once
/// What the benches of single functions have to tell, and how they time it.

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/base/stopwatch.h"
#include "engine/measure/statistics.h"

namespace acentric::bench {

/// Names a bench's figures; one name means the same in every build, so that builds can be compared.
class Figures {
 public:
  explicit Figures(std::string bench) : bench_(std::move(bench)) {}

  /// Values of repeated measurements.
  void add(const std::string& what, const std::string& unit, const std::vector<double>& values);
  /// The same beside another way to do it, measured by turns: `other` has the value of each turn.
  void add(const std::string& what, const std::string& unit, const std::vector<double>& values,
           const std::string& otherName, const std::vector<double>& other);
  /// What there was to do: a count, a size.
  void fact(const std::string& what, nlohmann::ordered_json value);

  /// {bench, facts: {...}, figures: [{what, unit, median, min, max, count, beside: {name, median, min, max},
  /// ratio}]}; the ratio is the median of the turns' values over the other's.
  nlohmann::ordered_json json() const;

 private:
  std::string bench_;
  nlohmann::ordered_json facts_ = nlohmann::ordered_json::object(),
                         figures_ = nlohmann::ordered_json::array();
};

/// Seconds of each of so many runs.
std::vector<double> secondsOf(int repeats, const std::function<void()>& work);
struct Turns {
  std::vector<double> one, other;
};
/// Seconds of both by turns, so that a change of the machine's speed meets both.
Turns secondsByTurns(int repeats, const std::function<void()>& one, const std::function<void()>& other);
std::vector<double> scaled(std::vector<double> values, double factor);

/// Keeps the compiler from leaving out what nobody reads.
void used(double value);

}  // namespace acentric::bench
