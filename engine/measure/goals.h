#pragma once
/// What a walk may cost at most and how good its frames are to be, and which of many settings keeps to that.

#include <map>
#include <optional>
#include <string>

#include "engine/base/result.h"

namespace acentric {

struct Goals {
  std::optional<double> mostBytes;    ///< on disk
  std::optional<double> mostFrameMs;  ///< of the median frame
  std::optional<double> leastPsnr;    ///< dB, of the median frame

  bool empty() const { return !mostBytes && !mostFrameMs && !leastPsnr; }
  Status check() const;  ///< one goal or more; finite, above 0
  bool operator==(const Goals&) const = default;
};
/// "at most 60 MB, at most 16 ms, at least 35 dB"
std::string textOf(const Goals& goals);

/// What goals are about, all above 0.
struct GoalFigures {
  double bytes = 0, frameMs = 0, psnr = 0;
};
/// By how many doublings the worst kept goal is missed: of bytes, of milliseconds, of the pixels' error
/// (6.02 dB). At most 0: all are kept.
double missOf(const Goals& goals, const GoalFigures& figures);
/// By which settings are compared, less is better: missOf, down to a margin that is enough; then, by little,
/// bytes, or where only they or the frame are limited, the error.
double scoreOf(const Goals& goals, const GoalFigures& figures);

/// All above 0; what may be left out is: "mostBytes", "mostFrameMs", "leastPsnr".
std::map<std::string, double> numbersOf(const Goals& goals);
/// Unknown names are left out.
Goals goalsFrom(const std::map<std::string, double>& numbers);

}  // namespace acentric
