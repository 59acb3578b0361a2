#pragma once
/// What a sweep found, made the project's.

#include "editor/actions/action.h"
#include "engine/measure/sweep.h"

namespace acentric::editor {

/// As one edit; told where it changes nothing or cannot be.
void applySetting(ActionContext& c, const SweepSetting& setting, const std::string& label);

}  // namespace acentric::editor
