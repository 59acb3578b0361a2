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
