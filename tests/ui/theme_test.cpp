/// Fonts and what stands in for them where they are not on the machine.

#include "ui/theme.h"

#include <gtest/gtest.h>

#include <set>

#include "ui/icons.h"

namespace acentric::ui {
namespace {

class Theme : public testing::Test {
 protected:
  void SetUp() override { ImGui::CreateContext(); }
  void TearDown() override { ImGui::DestroyContext(); }
  Fonts apply(const FontFiles& files = {}) {
    const Fonts fonts = applyTheme(look_, missing_, files);
    EXPECT_TRUE(ImGui::GetIO().Fonts->Build());
    return fonts;
  }

  Look look_;
  std::vector<std::string> missing_;
};

TEST_F(Theme, EveryIconIsAPictureOfItsOwn) {
  const Fonts fonts = apply();
  ASSERT_TRUE(missing_.empty()) << missing_.front();
  ASSERT_NE(fonts.icons, nullptr);
  EXPECT_EQ(ImGui::GetIO().FontDefault, fonts.regular);
  std::set<Icon> seen;
  for (const Icon icon : kIcons) {
    EXPECT_TRUE(seen.insert(icon).second) << "listed twice: " << std::hex << int(icon);
    const ImFontGlyph* glyph = fonts.icons->FindGlyphNoFallback(ImWchar(icon));
    ASSERT_NE(glyph, nullptr) << std::hex << int(icon);
    EXPECT_GT(glyph->X1 - glyph->X0, 4) << std::hex << int(icon);
    EXPECT_LT(glyph->X1 - glyph->X0, 28) << "wider than its button: " << std::hex << int(icon);
    EXPECT_LT(glyph->Y1 - glyph->Y0, 26) << "higher than its button: " << std::hex << int(icon);
  }
}

TEST_F(Theme, IconsGrowWithTheInterface) {
  look_.scale = 2;
  const Fonts fonts = apply();
  ASSERT_NE(fonts.icons, nullptr);
  EXPECT_EQ(fonts.icons->FontSize, 34);
}

TEST_F(Theme, WithoutTheIconsThePackageIsNamed) {
  FontFiles files;
  files.icons = "/nowhere/icons.ttf";
  const Fonts fonts = apply(files);
  EXPECT_EQ(fonts.icons, nullptr);
  ASSERT_EQ(missing_.size(), 1U);
  EXPECT_NE(missing_[0].find("/nowhere/icons.ttf"), std::string::npos);
  EXPECT_NE(missing_[0].find("fonts-fork-awesome"), std::string::npos);
  apply();
  EXPECT_TRUE(missing_.empty()) << "what was missing before is not told again";
}

constexpr ImWchar kHiragana = 0x3042, kKanji = 0x8a9e, kRareKanji = 0x685c;  // あ語桜

TEST_F(Theme, GermanLettersAndQuotesAreInTheMainFont) {
  const Fonts fonts = apply();
  for (const ImWchar letter : {0xe4, 0xf6, 0xfc, 0xc4, 0xd6, 0xdc, 0xdf, 0x201e, 0x201c, 0x2013, 0x2026})
    for (const ImFont* font : {fonts.regular, fonts.bold, fonts.small, fonts.title})
      EXPECT_NE(font->FindGlyphNoFallback(letter), nullptr) << std::hex << letter;
}

TEST_F(Theme, JapaneseLettersAreThereWhereTheyAreAskedFor) {
  Fonts fonts = apply();
  EXPECT_NE(fonts.regular->FindGlyphNoFallback(kKanji), nullptr) << "the language's own name";
  EXPECT_EQ(fonts.regular->FindGlyphNoFallback(kHiragana), nullptr);
  const int small = ImGui::GetIO().Fonts->TexHeight;
  look_.japanese = true;
  fonts = apply();
  ASSERT_TRUE(missing_.empty()) << missing_.front();
  for (const ImFont* font : {fonts.regular, fonts.bold, fonts.small})
    for (const ImWchar letter : {kHiragana, kKanji, kRareKanji})
      EXPECT_NE(font->FindGlyphNoFallback(letter), nullptr) << std::hex << letter;
  EXPECT_GT(ImGui::GetIO().Fonts->TexHeight, small);
  EXPECT_LE(ImGui::GetIO().Fonts->TexHeight, 4096);
}

TEST_F(Theme, WithoutJapaneseLettersThePackageIsNamed) {
  FontFiles files;
  files.japanese = "/nowhere/letters.ttf";
  apply(files);
  EXPECT_TRUE(missing_.empty()) << "nobody asked for them";
  look_.japanese = true;
  EXPECT_NE(apply(files).regular->FindGlyphNoFallback('a'), nullptr);
  ASSERT_EQ(missing_.size(), 1U);
  EXPECT_NE(missing_[0].find("fonts-vlgothic"), std::string::npos);
}

TEST_F(Theme, WithoutAnyFontThereIsAFontForText) {
  const Fonts fonts = apply({"/nowhere/a.ttf", "/nowhere/b.ttf", "/nowhere/c.ttf"});
  EXPECT_EQ(missing_.size(), 2U);
  for (const ImFont* font : {fonts.regular, fonts.bold, fonts.small, fonts.title}) {
    ASSERT_NE(font, nullptr);
    EXPECT_NE(font->FindGlyphNoFallback('a'), nullptr);
  }
}

}  // namespace
}  // namespace acentric::ui
