#pragma once
/// Qualities of a bake to choose from before anything is measured: sets of values for all of the bake's
/// settings that trade accuracy for time and bytes. How far the eye may go up and down and how far light
/// reaches are the place's own, and stay.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/measure/sweep.h"
#include "engine/pipeline/project.h"

namespace acentric {

/// As BakeSettings::at(Quality::draft) of what new projects have; what these have; and more of everything.
enum class BakePreset : std::uint8_t { draft, balanced, fine };
inline constexpr BakePreset kBakePresets[] = {BakePreset::draft, BakePreset::balanced, BakePreset::fine};
const char* nameOf(BakePreset preset);  ///< draft, balanced, fine

BakeSettings withPreset(const BakeSettings& settings, BakePreset preset);
/// What differs from the preset, in people's words: "samples per degree", ...
std::vector<std::string> differencesFrom(const BakeSettings& settings, BakePreset preset);
/// The one that the settings are as; nothing where they are somebody's own.
std::optional<BakePreset> presetInForce(const BakeSettings& settings);
/// The one with the fewest differences; of several the first of balanced, draft, fine.
BakePreset nearestPreset(const BakeSettings& settings);
/// What a sweep calls the preset in this project.
SweepSetting settingOf(const Project& project, BakePreset preset);

}  // namespace acentric
