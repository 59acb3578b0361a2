/// Contrast and colour vision, from the palettes' own numbers.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "ui/colour.h"

namespace acentric::ui {
namespace {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

Triple times(const Matrix& m, const Triple& v) {
  Triple result{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) result[r] += m[r][c] * v[c];
  return result;
}

double linear(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }
Triple linear(const Colour& c) { return {linear(double(c.r)), linear(double(c.g)), linear(double(c.b))}; }

/// Relative luminance and contrast of WCAG 2.
double luminance(const Colour& c) {
  const Triple l = linear(c);
  return 0.2126 * l[0] + 0.7152 * l[1] + 0.0722 * l[2];
}
double contrast(const Colour& a, const Colour& b) {
  const double x = luminance(a) + 0.05, y = luminance(b) + 0.05;
  return std::max(x, y) / std::min(x, y);
}

/// CIELAB under D65, of linear sRGB.
Triple lab(const Triple& rgb) {
  constexpr Matrix kXyz = {{{0.4124564, 0.3575761, 0.1804375},
                            {0.2126729, 0.7151522, 0.0721750},
                            {0.0193339, 0.1191920, 0.9503041}}};
  constexpr Triple kWhite = {0.95047, 1, 1.08883};
  Triple f = times(kXyz, rgb);
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = f[i] / kWhite[i];
    f[i] = t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
  }
  return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

/// Severity 1 of Machado, Oliveira and Fernandes, A Physiologically-based Model for Simulation of Color
/// Vision Deficiency, 2009; on linear sRGB.
struct Vision {
  const char* name;
  Matrix matrix;
};
constexpr std::array<Vision, 4> kVisions = {
    {{"of all colours", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
     {"protanopia",
      {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}}},
     {"deuteranopia",
      {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}}},
     {"tritanopia",
      {{{1.255528, -0.076749, -0.178779},
        {-0.078411, 0.930809, 0.147602},
        {0.004733, 0.691367, 0.303900}}}}}};

double distance(const Colour& a, const Colour& b, const Vision& vision) {
  const auto seen = [&vision](const Colour& c) {
    Triple rgb = times(vision.matrix, linear(c));
    for (double& channel : rgb) channel = std::clamp(channel, 0.0, 1.0);
    return lab(rgb);
  };
  const Triple x = seen(a), y = seen(b);
  return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
}

using Named = std::pair<const char*, Colour Palette::*>;
constexpr double kApart = 10;

class PaletteTest : public testing::TestWithParam<const Palette*> {
 protected:
  const Palette& palette() const { return *GetParam(); }
  void expectApart(const std::vector<std::pair<std::string, Colour>>& classes) const {
    for (const Vision& vision : kVisions)
      for (std::size_t a = 0; a < classes.size(); ++a)
        for (std::size_t b = a + 1; b < classes.size(); ++b)
          EXPECT_GE(distance(classes[a].second, classes[b].second, vision), kApart)
              << classes[a].first << " and " << classes[b].first << ", " << vision.name;
  }
};

TEST_P(PaletteTest, EveryInkReadsOnEverySurface) {
  const std::vector<Named> inks = {{"text", &Palette::text},    {"muted", &Palette::muted},
                                   {"faint", &Palette::faint},  {"accent", &Palette::accent},
                                   {"good", &Palette::good},    {"warning", &Palette::warning},
                                   {"danger", &Palette::danger}};
  const std::vector<Named> surfaces = {{"backdrop", &Palette::backdrop},
                                       {"panel", &Palette::panel},
                                       {"popup", &Palette::popup},
                                       {"raised", &Palette::raised}};
  for (const auto& [ink, inkOf] : inks)
    for (const auto& [surface, surfaceOf] : surfaces)
      EXPECT_GE(contrast(palette().*inkOf, palette().*surfaceOf), 4.5) << ink << " on " << surface;
  // What buttons, fields and lists turn to under the pointer or when chosen.
  for (const auto surfaceOf : {&Palette::hovered, &Palette::pressed, &Palette::selected})
    EXPECT_GE(contrast(palette().text, palette().*surfaceOf), 4.5);
  for (const auto surfaceOf : {&Palette::hovered, &Palette::selected})
    EXPECT_GE(contrast(palette().muted, palette().*surfaceOf), 4.5);
  for (const auto surfaceOf : {&Palette::accentDeep, &Palette::accentHover})
    EXPECT_GE(contrast(palette().onAccent, palette().*surfaceOf), 4.5);
}

TEST_P(PaletteTest, ClassesOfWorkStayApartForEveryEye) {
  expectApart({{"done", palette().done}, {"partly", palette().partly}, {"missing", palette().missing}});
  // Those have signs besides; what is out of date must not look like what is done or lacks a part.
  expectApart({{"done", palette().done}, {"outdated", palette().outdated}, {"partly", palette().partly}});
}

TEST_P(PaletteTest, WarningsAreToldFromErrorsAndBothFromGood) {
  expectApart({{"good", palette().good}, {"warning", palette().warning}, {"danger", palette().danger}});
}

TEST_P(PaletteTest, StepsOfTheScaleAndWhatIsOutsideOfItStayApart) {
  std::vector<std::pair<std::string, Colour>> classes = {{"alarm", palette().alarm},
                                                         {"plain", palette().plain}};
  for (std::size_t i = 0; i < palette().scale.size(); ++i)
    classes.emplace_back("scale " + std::to_string(i), palette().scale[i]);
  expectApart(classes);
  // No colour between two steps is like what is outside of the scale.
  for (const Vision& vision : kVisions)
    for (std::size_t i = 0; i + 1 < palette().scale.size(); ++i)
      for (float t = 0; t <= 1; t += 0.125F)
        for (const Colour& outside : {palette().alarm, palette().plain})
          EXPECT_GE(distance(palette().scale[i].mixed(palette().scale[i + 1], t), outside, vision), kApart)
              << vision.name << " at " << float(i) + t;
}

TEST_P(PaletteTest, TheScaleGrowsLighter) {
  for (std::size_t i = 0; i + 1 < palette().scale.size(); ++i)
    EXPECT_GT(lab(linear(palette().scale[i + 1]))[0], lab(linear(palette().scale[i]))[0] + kApart);
}

TEST_P(PaletteTest, MarksOfClassesAreSeenOnThePlan) {
  // Large marks: 3 : 1 for what carries meaning (WCAG 2, 1.4.11), on the ground of the plan.
  for (const auto classOf : {&Palette::done, &Palette::partly, &Palette::missing, &Palette::plain})
    EXPECT_GE(contrast(palette().*classOf, palette().backdrop), 3);
}

INSTANTIATE_TEST_SUITE_P(Palettes, PaletteTest, testing::Values(&kDarkPalette, &kLightPalette),
                         [](const auto& of) { return of.param->light ? "light" : "dark"; });

TEST(CurrentPalette, IsTheDarkOneWithoutAWindow) {
  EXPECT_EQ(&currentPalette(), &kDarkPalette);
  const Colour text = palette::text;
  EXPECT_EQ(text.r, kDarkPalette.text.r);
}

TEST(Contrast, IsThatOfTheStandard) {
  EXPECT_NEAR(contrast(Colour::hex(0x000000), Colour::hex(0xffffff)), 21, 1e-6);
  EXPECT_NEAR(contrast(Colour::hex(0x777777), Colour::hex(0xffffff)), 4.48, 0.01);
}

}  // namespace
}  // namespace acentric::ui
