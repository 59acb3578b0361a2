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

TEST(EngineTexts, AreToldInTheLanguageWithTheirValues) {
  EXPECT_EQ(engineText("nothing is below it"), "nothing is below it");
  ASSERT_TRUE(setLanguage("de", ACENTRIC_CATALOGUES).has_value());
  EXPECT_EQ(engineText("nothing is below it"), "nichts ist darunter");
  EXPECT_EQ(engineText("baking camera 12 (3 of 54)"), "Kamera 12 wird gebacken (3 von 54)");
  EXPECT_EQ(engineText("a surface is 0.20 m away towards 7 degrees and up; 0.40 m are asked for"),
            "eine Fläche ist 0.20 m entfernt, Richtung 7 Grad und aufwärts; verlangt sind 0.40 m");
  EXPECT_EQ(engineText("12 triangles in 2 meshes"), "12 Dreiecke in 2 Meshes");
  EXPECT_EQ(engineText("1 material, 0 textures, 2 lights"), "1 Material, 0 Texturen, 2 Lichter");
  EXPECT_EQ(engineText("2 materials with textures: {0}, {x"), "2 Materialien mit Texturen: {0}, {x")
      << "names are no patterns";
  EXPECT_EQ(engineText("something else, of 3"), "something else, of 3");
  EXPECT_EQ(engineText(""), "");
  ASSERT_TRUE(setLanguage("ja", ACENTRIC_CATALOGUES).has_value());
  EXPECT_EQ(engineText("a surface is 0.20 m away towards 7 degrees; 0.40 m are asked for"),
            "面が7度の方向0.20 mにあります（必要な距離は0.40 m）");
  EXPECT_EQ(engineText("camera 3, looks to 90°"), "カメラ3、向き90°");
  ASSERT_TRUE(setLanguage("en").has_value());
}

}  // namespace
}  // namespace acentric::editor
