/// What the engine calls things is in the editor's catalogues.

#include "editor/session/engine_texts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "engine/layout/layout_spec.h"
#include "engine/measure/attribution.h"
#include "engine/measure/sweep.h"
#include "engine/pipeline/bake_presets.h"
#include "engine/scene/effect_plan.h"

namespace acentric::editor {
namespace {

bool listed(const std::string& text) {
  return std::ranges::any_of(kEngineTexts, [&](const char* known) { return text == known; });
}

TEST(EngineTexts, NamesThatTheEditorShowsAreListed) {
  for (int e = 0; e < kEffectCount; ++e) EXPECT_TRUE(listed(labelOf(Effect(e)))) << labelOf(Effect(e));
  for (int c = 0; c < 7; ++c) EXPECT_TRUE(listed(describe(Configuration(c)))) << describe(Configuration(c));
  for (const BakePreset preset : kBakePresets) EXPECT_TRUE(listed(nameOf(preset))) << nameOf(preset);
  for (const MeasureInfo& info : measures()) {
    const bool sameEverywhere =
        std::ranges::none_of(std::string(info.label), [](char c) { return c >= 'a' && c <= 'z'; });
    EXPECT_TRUE(sameEverywhere || listed(info.label)) << info.label;
  }
  BakeSettings other;
  other.samplesPerDegree *= 3, other.ambientRays += 7, other.shadowRays += 7, other.bounces += 3;
  other.colourQuality -= 7, other.surfaceTexel *= 3, other.maxLayers += 3, other.pruning = !other.pruning;
  other.pruningLoss += 0.125, other.testEyes += 3, other.distanceShift += 0.125;
  const auto differences = differencesFrom(other, BakePreset::balanced);
  EXPECT_GE(differences.size(), 8U);
  for (const std::string& name : differences) EXPECT_TRUE(listed(name)) << name;
}

}  // namespace
}  // namespace acentric::editor
