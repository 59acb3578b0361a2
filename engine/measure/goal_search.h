#pragma once
/// Looks for a setting that keeps to goals. Settings are measured one after the other, next the one that
/// promises most for the time that it takes. What one will cost is predicted from those that were: every
/// choice is taken to add the same to the logarithms of bytes per capture pixel and of milliseconds and to
/// the PSNR, whatever the others are, and resolution to add in proportion to its own logarithm (ridge
/// regression, from usual slopes on). Pixels of captures are counted, not predicted. Of a choice that was
/// never tried the best is hoped for.

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "engine/measure/sweep.h"

namespace acentric {

struct GoalHost {
  /// Nothing: it cannot be measured, or not in the time left.
  std::function<Result<std::optional<GoalFigures>>(const SweepSetting&)> measure;
  /// The setting in its canonical order.
  std::function<SweepSetting(SweepSetting)> inOrder;
  /// Of all captures together; 0: there is no such layout. Asked often.
  std::function<double(const SweepSetting&)> pixels;
  /// That measuring it is predicted to take, above 0; infinity: more than there is. Asked often.
  std::function<double(const SweepSetting&)> seconds;
  /// Is there time for another one?
  std::function<bool()> goOn;
};

struct GoalChoices {
  std::vector<KnobChoice> choices;  ///< to be tried, of knobs with names
  std::string resolution;           ///< a knob of numbers: samples per degree
  double usualResolution = 0;       ///< the project's
  double leastResolution = 0, mostResolution = 0;
};

/// `known`: what is measured already, the empty setting among it. Gives all that is known then; of that,
/// scoreOf tells the best.
Result<std::map<SweepSetting, GoalFigures>> searchForGoals(std::map<SweepSetting, GoalFigures> known,
                                                           const Goals& goals, const GoalChoices& choices,
                                                           const GoalHost& host);

}  // namespace acentric
