#include "engine/pipeline/bake_presets.h"

#include <algorithm>

#include "engine/pipeline/knobs.h"

namespace acentric {
namespace {

BakeSettings fineSettings() {
  BakeSettings fine;
  fine.samplesPerDegree = 32;
  fine.ambientRays = 128;
  fine.shadowRays = 64;
  fine.bounces = 4;
  fine.surfaceTexel = 0.02;
  fine.testEyes = 16;
  fine.pruningLoss = 0.0001;
  fine.colourQuality = 97;
  return fine;
}

BakeSettings settingsOf(BakePreset preset) {
  if (preset == BakePreset::fine) return fineSettings();
  return preset == BakePreset::draft ? BakeSettings{}.at(Quality::draft) : BakeSettings{};
}

}  // namespace

const char* nameOf(BakePreset preset) {
  return preset == BakePreset::draft ? "draft" : preset == BakePreset::balanced ? "balanced" : "fine";
}

BakeSettings withPreset(const BakeSettings& settings, BakePreset preset) {
  BakeSettings out = settingsOf(preset);
  out.ambientRadius = settings.ambientRadius;
  out.eyeRange = settings.eyeRange;
  out.silhouettes = settings.silhouettes;
  return out;
}

std::vector<std::string> differencesFrom(const BakeSettings& settings, BakePreset preset) {
  const BakeSettings wanted = settingsOf(preset);
  std::vector<std::string> names;
  const auto compare = [&](auto BakeSettings::*field, const char* name) {
    if (settings.*field != wanted.*field) names.emplace_back(name);
  };
  compare(&BakeSettings::samplesPerDegree, "samples per degree");
  compare(&BakeSettings::ambientRays, "ambient rays");
  compare(&BakeSettings::shadowRays, "shadow rays");
  compare(&BakeSettings::bounces, "bounces");
  compare(&BakeSettings::colourQuality, "colour quality");
  compare(&BakeSettings::surfaceTexel, "surface texel");
  compare(&BakeSettings::maxLayers, "most layers");
  compare(&BakeSettings::pruning, "pruning");
  compare(&BakeSettings::pruningLoss, "pruning loss");
  compare(&BakeSettings::testEyes, "test eyes");
  compare(&BakeSettings::distanceShift, "distance shift");
  return names;
}

std::optional<BakePreset> presetInForce(const BakeSettings& settings) {
  for (const BakePreset preset : kBakePresets)
    if (withPreset(settings, preset) == settings) return preset;
  return std::nullopt;
}

BakePreset nearestPreset(const BakeSettings& settings) {
  constexpr BakePreset kOrder[] = {BakePreset::balanced, BakePreset::draft, BakePreset::fine};
  return *std::ranges::min_element(
      kOrder, {}, [&](BakePreset preset) { return differencesFrom(settings, preset).size(); });
}

SweepSetting settingOf(const Project& project, BakePreset preset) {
  Project wanted = project;
  wanted.bake = withPreset(project.bake, preset);
  SweepSetting setting;
  for (const Knob& knob : knobs())
    if (std::string value = knob.value(wanted); value != knob.value(project))
      setting.push_back({knob.name, std::move(value)});
  return setting;
}

}  // namespace acentric
