/// Texts in other languages: which one the system asks for, what is shown where a catalogue has no text, a
/// wrong one or is damaged.

#include "ui/translate.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <clocale>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>

namespace acentric {
namespace {

namespace fs = std::filesystem;

/// What a compiled catalogue holds; the text of "" is its header.
std::string compiled(const std::map<std::string, std::string>& texts) {
  const auto word = [](std::size_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += char(value >> (8 * i) & 0xff);
    return bytes;
  };
  const std::size_t count = texts.size();
  std::string keys, values, data;
  std::size_t at = 28 + 16 * count;
  const auto put = [&](std::string& table, const std::string& text) {
    table += word(text.size()) + word(at + data.size());
    data += text + '\0';
  };
  for (const auto& [key, value] : texts) put(keys, key);
  for (const auto& [key, value] : texts) put(values, value);
  return word(0x950412de) + word(0) + word(count) + word(28) + word(28 + 8 * count) + word(0) + word(0) +
         keys + values + data;
}

std::string readAll(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Translate : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(testing::TempDir()) / ("translate-" + std::to_string(getpid()) + "-" +
                                            testing::UnitTest::GetInstance()->current_test_info()->name());
  }
  void TearDown() override {
    ASSERT_TRUE(setLanguage("en").has_value());
    fs::remove_all(root_);
  }
  /// A folder of its own with this as the German catalogue.
  fs::path folderWith(const std::string& bytes) {
    const fs::path folder = root_ / std::to_string(++folders_);
    fs::create_directories(folder / "de/LC_MESSAGES");
    std::ofstream(folder / "de/LC_MESSAGES/acentric.mo", std::ios::binary) << bytes;
    return folder;
  }

  fs::path root_;
  int folders_ = 0;
};

const std::string kHeader =
    "Content-Type: text/plain; charset=UTF-8\nPlural-Forms: nplurals=2; plural=(n != 1);\n";

TEST_F(Translate, WithoutACatalogueTextsAreEnglish) {
  const char* const text = "Save";
  EXPECT_EQ(tr(text), text);
  EXPECT_EQ(trf("{} of {}", 2, 3), "2 of 3");
  EXPECT_EQ(trfMany("{} cell", "{} cells", 1, 1), "1 cell");
  EXPECT_EQ(trfMany("{} cell", "{} cells", 0, 0), "0 cells");
  EXPECT_EQ(language(), "en");
  EXPECT_EQ(catalogueTexts(), "");
}

TEST_F(Translate, LanguagesChangeAtOnceAndTextsThatWereHandedOutStay) {
  const fs::path folder = ACENTRIC_CATALOGUES;
  ASSERT_TRUE(setLanguage("de", folder).has_value());
  const char* const german = tr("Save");
  EXPECT_STREQ(german, "Speichern");
  EXPECT_STREQ(trIn("key", "Space"), "Leertaste");
  EXPECT_EQ(trfMany("{} thread", "{} threads", 1, 1), "1 Thread");
  EXPECT_EQ(trfMany("{} thread", "{} threads", 3'000'000'000U, 3), "3 Threads");
  EXPECT_EQ(tr(std::string("Undo")), "Rückgängig");
  EXPECT_NE(catalogueTexts().find("Rückgängig"), std::string::npos);
  ASSERT_TRUE(setLanguage("ja", folder).has_value());
  EXPECT_STREQ(tr("Save"), "保存");
  EXPECT_EQ(trfMany("{} thread", "{} threads", 1, 1), "1スレッド");
  EXPECT_EQ(trf("{} of {} captures baked", 2, 3), "キャプチャ3個中2個ベイク済み");
  ASSERT_TRUE(setLanguage("en", folder).has_value());
  EXPECT_STREQ(tr("Save"), "Save");
  EXPECT_STREQ(german, "Speichern");
  EXPECT_STREQ(std::setlocale(LC_ALL, nullptr), "C") << "numbers in files have points";
}

TEST_F(Translate, WhatIsNotTranslatedIsEnglishAndTheEmptyTextIsEmpty) {
  ASSERT_TRUE(setLanguage("de", folderWith(compiled({{"", kHeader}, {"Undo", "Zurück"}}))).has_value());
  EXPECT_STREQ(tr("Undo"), "Zurück");
  EXPECT_STREQ(tr("Redo"), "Redo");
  EXPECT_STREQ(tr(""), "") << "not the header";
  EXPECT_EQ(catalogueTexts(), "Zurück");
}

TEST_F(Translate, APatternThatDoesNotFitIsShownInEnglish) {
  const auto set = setLanguage("de", folderWith(compiled({{"", kHeader},
                                                          {"{} of {}", "{} von {5}"},
                                                          {"{:.1f} m", "{:s} m"},
                                                          {"{} a", "{"},
                                                          {std::string("{} cell\0{} cells", 16),
                                                           std::string("{} Zelle\0{:x^} Zellen{}", 23)}})));
  ASSERT_TRUE(set.has_value()) << set.error();
  EXPECT_EQ(trf("{} of {}", 1, 2), "1 of 2");
  EXPECT_EQ(trf("{:.1f} m", 1.0), "1.0 m");
  EXPECT_EQ(trf("{} a", 1), "1 a");
  EXPECT_EQ(trfMany("{} cell", "{} cells", 1, "one"), "one Zelle");
  EXPECT_EQ(trfMany("{} cell", "{} cells", 2, "two"), "two cells");
}

TEST_F(Translate, APatternOfPrintfKeepsItsConversions) {
  ASSERT_TRUE(setLanguage("de", folderWith(compiled({{"", kHeader},
                                                     {"%d frames", "%d Bilder"},
                                                     {"%d minutes", "%s Minuten"},
                                                     {"%.1f m", "%n%.1f m"},
                                                     {"no limit", "100 %"},
                                                     {"%.0f %%", "%.0f%%"}})))
                  .has_value());
  EXPECT_STREQ(trPrintf("%d frames"), "%d Bilder");
  EXPECT_STREQ(trPrintf("%d minutes"), "%d minutes");
  EXPECT_STREQ(trPrintf("%.1f m"), "%.1f m");
  EXPECT_STREQ(trPrintf("no limit"), "no limit");
  EXPECT_STREQ(trPrintf("%.0f %%"), "%.0f%%");
}

TEST_F(Translate, AMissingCatalogueIsToldWithTheWayOut) {
  const auto set = setLanguage("de", root_ / "nowhere");
  ASSERT_FALSE(set.has_value());
  EXPECT_NE(set.error().find("nowhere/de/LC_MESSAGES/acentric.mo"), std::string::npos);
  EXPECT_NE(set.error().find("install"), std::string::npos);
  EXPECT_EQ(language(), "en");
  EXPECT_FALSE(setLanguage("../de", ACENTRIC_CATALOGUES).has_value());
}

TEST_F(Translate, ADamagedCatalogueIsRefusedOrHarmless) {
  const std::string sound = readAll(fs::path(ACENTRIC_CATALOGUES) / "de/LC_MESSAGES/acentric.mo");
  ASSERT_GT(sound.size(), 10'000U);
  int refused = 0;
  const auto tryOut = [&](const std::string& bytes) {
    refused += !setLanguage("de", folderWith(bytes)).has_value();
    tr("Save");
    trf("{} of {} captures baked", 2, 3);
    trfMany("{} thread", "{} threads", 2, 2);
  };
  for (const std::size_t length :
       {std::size_t(0), std::size_t(3), std::size_t(27), std::size_t(28), sound.size() / 2})
    tryOut(sound.substr(0, length));
  EXPECT_EQ(refused, 5);
  std::mt19937 random(1);
  const std::size_t tables = 28 + 16 * 1400;
  for (int round = 0; round < 60; ++round) {
    std::string bytes = sound;
    for (int i = 0; i < 4; ++i) bytes[random() % (round % 2 == 0 ? 28 : tables)] = char(random());
    tryOut(bytes);
  }
  EXPECT_GT(refused, 40);
}

TEST(SystemLanguage, FollowsTheEnvironment) {
  using Variables = std::map<std::string, std::string>;
  const auto of = [](const Variables& variables) {
    return systemLanguage([&](const char* name) {
      const auto found = variables.find(name);
      return found == variables.end() ? nullptr : found->second.c_str();
    });
  };
  EXPECT_EQ(of({}), "en");
  EXPECT_EQ(of({{"LANG", "de_AT.UTF-8@euro"}}), "de");
  EXPECT_EQ(of({{"LANG", "de_DE.UTF-8"}, {"LC_MESSAGES", "ja_JP.UTF-8"}}), "ja");
  EXPECT_EQ(of({{"LANG", "de_DE"}, {"LC_ALL", "en_GB.UTF-8"}}), "en");
  EXPECT_EQ(of({{"LANG", "de_DE"}, {"LC_ALL", ""}}), "de");
  EXPECT_EQ(of({{"LANG", "C.UTF-8"}, {"LANGUAGE", "fr:de_CH:ja"}}), "de");
  EXPECT_EQ(of({{"LANG", "fr_FR.UTF-8"}, {"LANGUAGE", "en:de"}}), "en");
  EXPECT_EQ(of({{"LANG", "fr_FR.UTF-8"}}), "en");
  EXPECT_EQ(of({{"LC_ALL", "C"}, {"LANGUAGE", "de"}, {"LANG", "de_DE"}}), "en");
  EXPECT_EQ(of({{"LANG", "POSIX"}, {"LANGUAGE", "de"}}), "en");
  EXPECT_EQ(of({{"LANGUAGE", "::ja"}}), "ja");
}

}  // namespace
}  // namespace acentric
