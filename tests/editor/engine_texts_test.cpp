/// What the engine calls things is in the editor's catalogues.

#include "editor/session/engine_texts.h"

#include <fmt/args.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "editor/session/engine_error_parts.h"
#include "editor/session/engine_errors.h"
#include "editor/session/engine_import.h"
#include "editor/session/engine_names.h"
#include "editor/session/engine_walk_errors.h"
#include "editor/session/messages.h"
#include "engine/bake/bake_settings.h"
#include "engine/base/file.h"
#include "engine/layout/layout_spec.h"
#include "engine/measure/attribution.h"
#include "engine/measure/sweep.h"
#include "engine/pipeline/bake_presets.h"
#include "engine/pipeline/project.h"
#include "engine/scene/effect_plan.h"
#include "tests/support/project_folder.h"

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
  EXPECT_EQ(engineText("1,234,567 triangles in 2 meshes"), "1\u202f234\u202f567 Dreiecke in 2 Meshes");
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

/// The pattern with the values 11, 12, ... in it, numbered as its fields are.
std::string filled(const std::string& pattern) {
  fmt::dynamic_format_arg_store<fmt::format_context> values;
  for (int i = 0; i < 10; ++i) values.push_back(11 + i);
  return fmt::vformat(pattern, values);
}

template <class Table>
void expectEachFindsItself(const Table& table) {
  for (const std::string english : table) {
    const std::string expected = filled(tr(english));
    EXPECT_EQ(engineText(filled(english)), expected) << english;
    if constexpr (std::is_same_v<Table, std::decay_t<decltype(kErrors)>> ||
                  std::is_same_v<Table, std::decay_t<decltype(kWalkErrors)>>) {
      const Error error{ErrorKind::malformed, filled(english), "/tmp/a: b.txt"};
      EXPECT_EQ(engineText(error), "/tmp/a: b.txt: " + expected);
      EXPECT_EQ(engineText(error.describe()), "/tmp/a: b.txt: " + expected) << "as a line of a report";
    }
  }
}

TEST(EngineTexts, EachPatternTakesWhatItMakesAndNoOtherDoes) {
  for (const char* code : {"de", "ja"}) {
    ASSERT_TRUE(setLanguage(code, ACENTRIC_CATALOGUES).has_value());
    expectEachFindsItself(kEnginePatterns), expectEachFindsItself(kImportPatterns);
    expectEachFindsItself(kErrors), expectEachFindsItself(kWalkErrors);
  }
  std::set<std::string> patterns;
  for (const char* english : kErrors) EXPECT_TRUE(patterns.insert(english).second) << english;
  for (const char* english : kWalkErrors) EXPECT_TRUE(patterns.insert(english).second) << english;
  ASSERT_TRUE(setLanguage("en").has_value());
}

class EngineErrors : public test::ProjectFolder {
 protected:
  void SetUp() override {
    ProjectFolder::SetUp();
    ASSERT_TRUE(setLanguage("de", ACENTRIC_CATALOGUES).has_value());
  }
  void TearDown() override {
    ProjectFolder::TearDown();
    ASSERT_TRUE(setLanguage("en").has_value());
  }
};

TEST_F(EngineErrors, OfLayoutsNameTheirParts) {
  LayoutSpec spec;
  spec.cellSize = -1;
  EXPECT_TRUE(
      engineText(spec.check().error()).starts_with("Anordnung: die Zellengröße in Metern ist -1; der "))
      << engineText(spec.check().error());
  spec = {};
  spec.removed.insert(CellId{1, 2, 99});
  EXPECT_TRUE(engineText(spec.check().error())
                  .starts_with("Anordnung: die entfernte Region (1, 2, 99) gibt es in Konfiguration "))
      << engineText(spec.check().error());
  spec = {};
  spec.outline.loops = {{{0, 0}, {1, 0}}};
  EXPECT_EQ(engineText(spec.check().error()),
            "Anordnung: Schleife 1 des Umrisses hat 2 Punkte; sie braucht mindestens 3");
  EXPECT_EQ(engineText(parseConfiguration("x; y").error()),
            "Anordnung: eine Konfiguration „x; y“ gibt es nicht; a, b, c, d, e, f oder g wählen");
}

TEST_F(EngineErrors, OfBakeSettings) {
  BakeSettings bake;
  bake.bounces = 99;
  EXPECT_EQ(engineText(bake.check().error()), "Backeinstellungen: 99 Reflexionen: müssen in 1..8 liegen");
  bake = {};
  bake.surfaceTexel = 0;
  EXPECT_TRUE(
      engineText(bake.check().error()).starts_with("Backeinstellungen: Oberflächentexel 0 m: muss in "));
}

TEST_F(EngineErrors, OfFilesAndProjects) {
  const auto file = folder_ / "room: 1.json";
  EXPECT_EQ(engineText(loadProject(file).error()),
            file.string() + ": lässt sich nicht zum Lesen öffnen: Datei oder Ordner nicht gefunden");
  EXPECT_EQ(engineText(loadProject(folder_).error()), folder_.string() + ": ist ein Ordner, keine Datei");
  const auto message = [&](const std::string& text) {
    EXPECT_TRUE(writeTextAtomically(file, text).has_value());
    const auto project = loadProject(file);
    EXPECT_FALSE(project.has_value());
    return project ? std::string() : engineText(project.error());
  };
  EXPECT_TRUE(message("{").starts_with(file.string() + ": ist kein lesbares JSON: ")) << message("{");
  EXPECT_EQ(message("{}"), file.string() + ": /: hat kein \"format\"");
  const auto told = [&](const std::string& member) {
    return message("{\"format\": \"acentric-project\", " + member + "}");
  };
  EXPECT_NE(told("\"version\": 99").find("99 stammt von einem neueren Acentric"), std::string::npos)
      << told("\"version\": 99");
  EXPECT_NE(told("\"version\": 1, \"scene\": \"../a.obj\"").find("../a.obj verlässt den Ordner"),
            std::string::npos)
      << told("\"version\": 1, \"scene\": \"../a.obj\"");
  EXPECT_EQ(told("\"version\": \"1\", \"scene\": \"a.obj\", \"storeys\": []"),
            file.string() + ": /version: muss 1 sein, nicht \"1\"");
}

TEST_F(EngineErrors, ReachTheMessages) {
  Messages messages;
  messages.addFailure("Öffnen", Error{ErrorKind::malformed, "is empty", "a.glb"});
  EXPECT_NE(messages.all().back().text.find("a.glb: ist leer"), std::string::npos)
      << messages.all().back().text;
}

TEST_F(EngineErrors, KeepWhatIsUnknownInEnglish) {
  EXPECT_EQ(engineText(Error{ErrorKind::internal, "the moon is full; wait", "a.glb"}),
            "a.glb: the moon is full; wait");
  EXPECT_EQ(engineText("a.exr: writing failed: the moon is full"),
            "a.exr: Schreiben fehlgeschlagen: the moon is full");
  EXPECT_EQ(
      engineText("a.exr: writing failed: No space left on device; what is finished is kept: make room and "
                 "bake again"),
      "a.exr: Schreiben fehlgeschlagen: Kein Platz mehr auf dem Datenträger; was fertig ist, bleibt: Platz "
      "schaffen und erneut backen");
  EXPECT_EQ(engineText("texture {0}.png: the file of lights"), "Textur {0}.png: the file of lights");
  const std::string nested(3000, ':');
  EXPECT_EQ(engineText(nested + " : : x"), nested + " : : x");
}

TEST_F(EngineErrors, ImprovementsAndReportsHaveTheirValues) {
  EXPECT_EQ(engineText("cell size 2 m to 1.4 m"), "Zellengröße von 2 m auf 1.4 m");
  EXPECT_EQ(engineText("split the cell (3, -1) into four"), "die Zelle (3, -1) in vier teilen");
  EXPECT_EQ(engineText("texture wall.png: does not exist"), "Textur wall.png: gibt es nicht");
  EXPECT_EQ(engineText("unit: 0.01 m (the file's unit scale)"),
            "Einheit: 0.01 m (der Einheitenmaßstab der Datei)");
  EXPECT_EQ(engineText("project origin: moved to (5, 6, 0) m, near the scene"),
            "Ursprung des Projekts: nach (5, 6, 0) m verschoben, nahe an die Szene");
}

}  // namespace
}  // namespace acentric::editor
