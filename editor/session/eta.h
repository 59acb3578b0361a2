#pragma once
/// Time left, from the rate of the last half minute. Pure: times are handed in, in seconds.

#include <deque>
#include <optional>

namespace acentric::editor {

class Eta {
 public:
  static constexpr double kWindow = 30;

  void reset() { samples_.clear(); }
  /// A fall of `done`, or another total, begins anew: another stage.
  void report(double now, double done, double total);
  /// Nothing until the rate is known: two reports at least half a second apart.
  std::optional<double> secondsLeft(double now) const;
  std::optional<double> perSecond() const;

 private:
  struct Sample {
    double time, done;
  };
  std::deque<Sample> samples_;
  double total_ = 0;
};

}  // namespace acentric::editor
