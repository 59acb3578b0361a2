#pragma once
/// What the view of accuracy against time shows.

#include <optional>

#include "editor/session/sweep_watch.h"

namespace acentric::editor {

/// What one of its two parts shows.
struct AccuracyAxes {
  Measure error;  ///< upwards
  Measure cost;   ///< to the right
};

struct AccuracyState {
  bool goals = false;  ///< the search for what keeps to goals, instead of all settings
  SweepRequest request;
  SweepRequest goalsRequest{.frames = 4, .width = 1280, .height = 720, .goals = {60e6, 16, 35}};
  AccuracyAxes axes{Measure::msSsim, Measure::frameMs}, goalsAxes{Measure::psnr, Measure::bytes};
  std::optional<SweepSetting> selected;
  bool difference = false;  ///< the picture shows how far the frame is from the truth

  AccuracyAxes& shownAxes() { return goals ? goalsAxes : axes; }
  const AccuracyAxes& shownAxes() const { return goals ? goalsAxes : axes; }
};

}  // namespace acentric::editor
