#pragma once
/// What the view of accuracy against time shows.

#include <optional>

#include "editor/session/sweep_watch.h"

namespace acentric::editor {

struct AccuracyState {
  SweepRequest request;
  Measure error = Measure::msSsim;  ///< upwards
  Measure cost = Measure::frameMs;  ///< to the right
  std::optional<SweepSetting> selected;
  bool difference = false;  ///< the picture shows how far the frame is from the truth
};

}  // namespace acentric::editor
