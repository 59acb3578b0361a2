#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <numbers>

#include "engine/base/file.h"
#include "engine/picture/layout_picture.h"
#include "engine/picture/legend.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

fs::path planPath(const char* name) {
  return fs::path(testing::TempDir()) / ("plan-" + std::to_string(getpid()) + "-" + name);
}

PlanPolygon square(const glm::dvec2& low, double side) {
  PlanPolygon polygon;
  polygon.corners = {low, low + glm::dvec2(side, 0), low + glm::dvec2(side), low + glm::dvec2(0, side)};
  return polygon;
}

std::size_t pixelsOf(const ColourImage& image, const Rgba8& colour) {
  return std::size_t(std::count(image.pixels.begin(), image.pixels.end(), colour));
}

/// The mean position of a colour's pixels.
glm::dvec2 middleOf(const ColourImage& image, const Rgba8& colour) {
  glm::dvec2 sum(0);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (image.at(x, y) == colour) sum += glm::dvec2(x, y);
  return sum / double(pixelsOf(image, colour));
}

constexpr Rgba8 kPlanRed{255, 0, 0, 255}, kPlanGreen{0, 255, 0, 255}, kPlanBlue{0, 0, 255, 255};

TEST(PlanPicture, DrawsTheWorldWithYUpwardsAndToScale) {
  PlanPicture picture;
  for (const auto& [low, fill] :
       {std::pair{glm::dvec2(0, 0), kPlanRed}, {{3, 0}, kPlanGreen}, {{0, 4}, kPlanBlue}}) {
    picture.polygons.push_back(square(low, 1));
    picture.polygons.back().fill = fill;
    picture.polygons.back().strokeWidth = 0;
  }
  const auto image = drawPlanPicture(picture);
  ASSERT_TRUE(image.has_value()) << image.error().describe();
  const glm::dvec2 red = middleOf(*image, kPlanRed), right = middleOf(*image, kPlanGreen) - red,
                   up = middleOf(*image, kPlanBlue) - red;
  EXPECT_GT(right.x, 0);
  EXPECT_NEAR(right.y, 0, 0.6);
  EXPECT_NEAR(up.x, 0, 0.6);
  EXPECT_NEAR(-up.y / right.x, 4.0 / 3, 0.01);
  EXPECT_NEAR(std::sqrt(double(pixelsOf(*image, kPlanRed))), right.x / 3, 2);
}

TEST(PlanPicture, ColoursByValueAndMarksWhatIsOverTheLimit) {
  PlanPicture picture;
  picture.scale = PlanScale{.label = "load",
                            .unit = "",
                            .low = 1,
                            .high = 100,
                            .logarithmic = true,
                            .limit = 50,
                            .limitLabel = "limit"};
  for (const double value : {1.0, 10.0, 100.0}) {
    picture.polygons.push_back(square({3 * double(picture.polygons.size()), 0}, 2));
    picture.polygons.back().value = value;
    picture.polygons.back().marked = value > 50;
  }
  const auto image = drawPlanPicture(picture);
  ASSERT_TRUE(image.has_value());
  for (const double share : {0.0, 0.5, 1.0}) EXPECT_GT(pixelsOf(*image, scaleColour(share)), 10000u) << share;
  EXPECT_GT(pixelsOf(*image, kAlarmColour), 500u);
}

TEST(PlanPicture, PutsARastersFirstRowOnItsUpperSide) {
  PlanPicture picture;
  ColourImage image(2, 2, kPlanBlue);
  image.at(0, 0) = kPlanRed;
  image.at(1, 1) = kPlanGreen;
  picture.rasters.push_back({image, {-1, -1}, {1, 1}});
  const auto drawn = drawPlanPicture(picture);
  ASSERT_TRUE(drawn.has_value());
  const glm::dvec2 red = middleOf(*drawn, kPlanRed), green = middleOf(*drawn, kPlanGreen);
  EXPECT_LT(red.x, green.x);
  EXPECT_LT(red.y, green.y);
  EXPECT_EQ(pixelsOf(*drawn, kPlanRed), pixelsOf(*drawn, kPlanGreen));
}

TEST(PlanPicture, DrawsACamerasSectorOnTheSideItLooksTo) {
  PlanPicture picture;
  picture.polygons.push_back(square({-2, -2}, 4));
  picture.cameraRadius = 1;
  picture.cameras.push_back(
      {{0, 0}, std::numbers::pi / 3, std::numbers::pi / 3, kPlanRed});  // looks along +y
  const auto image = drawPlanPicture(picture);
  ASSERT_TRUE(image.has_value());
  double count = 0;
  glm::dvec2 sum(0);
  for (int y = 0; y < image->height; ++y)
    for (int x = 0; x < image->width; ++x)
      if (const Rgba8 p = image->at(x, y); p.r > 200 && p.g < 180 && p.b < 180)
        sum += glm::dvec2(x, y), ++count;
  ASSERT_GT(count, 100);
  sum /= count;
  PlanPicture dot;
  dot.polygons = picture.polygons;
  dot.markers.push_back({{0, 0}, MarkerShape::dot, kPlanBlue, 6, ""});
  const auto centre = middleOf(drawPlanPicture(dot).value(), kPlanBlue);
  EXPECT_NEAR(sum.x, centre.x, 2);
  EXPECT_LT(sum.y, centre.y - 20);
}

TEST(PlanPicture, IsWrittenAsSvgAndPng) {
  LayoutSpec spec;
  spec.configuration = Configuration::b;
  spec.cellSize = 1;
  spec.outline.loops = {{{-2, -2}, {3, -2}, {3, 3}, {-2, 3}}};
  PlanPicture picture = pictureOf(buildLayout(spec).value(), "A & B <plan> \xff");
  picture.notes = {"grüße: 5 m²"};
  const fs::path svg = planPath("a.svg"), png = planPath("a.png");
  ASSERT_TRUE(writePlanPicture(picture, svg).has_value());
  ASSERT_TRUE(writePlanPicture(picture, png).has_value());
  const std::string text = readText(svg).value();
  EXPECT_NE(text.find("<svg"), std::string::npos);
  EXPECT_NE(text.find("</svg>"), std::string::npos);
  EXPECT_NE(text.find("width=\"1400"), std::string::npos);
  const auto image = readColourImage(png);
  ASSERT_TRUE(image.has_value());
  EXPECT_EQ(image->width, 1400);
  EXPECT_EQ(image->pixels, drawPlanPicture(picture).value().pixels);
  fs::remove(svg), fs::remove(png);
}

TEST(PlanPicture, RefusesWhatItCannotWrite) {
  PlanPicture picture;
  const auto ending = writePlanPicture(picture, planPath("a.jpg"));
  ASSERT_FALSE(ending.has_value());
  EXPECT_EQ(ending.error().kind, ErrorKind::invalidArgument);
  EXPECT_FALSE(writePlanPicture(picture, "/proc/no/such/folder/a.png").has_value());
  picture.width = 10;
  EXPECT_FALSE(drawPlanPicture(picture).has_value());
  picture.width = 400;
  picture.markers.push_back({{std::nan(""), 0}, MarkerShape::dot, kPlanRed, 5, ""});
  EXPECT_FALSE(drawPlanPicture(picture).has_value());
  picture.markers.clear();
  EXPECT_TRUE(drawPlanPicture(picture).has_value()) << "an empty plan is a page with its title";
  picture.rasters.push_back({ColourImage{}, {0, 0}, {1, 1}});
  EXPECT_FALSE(drawPlanPicture(picture).has_value());
}

TEST(PlanPicture, LightnessGrowsAlongTheScale) {
  double last = -1;
  for (int step = 0; step <= 100; ++step) {
    const Rgba8 c = scaleColour(step / 100.0);
    const double lightness = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
    EXPECT_GT(lightness, last) << step;
    last = lightness;
  }
  EXPECT_EQ(scaleColour(-3), scaleColour(0));
  EXPECT_EQ(scaleColour(std::nan("")), (Rgba8{173, 181, 189, 255}));
}

TEST(PlanPicture, TicksAreRoundAndFew) {
  EXPECT_EQ(roundNumbers(0, 10, 6, false), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(roundNumbers(3, 7, 6, false), (std::vector<double>{3, 4, 5, 6, 7}));
  EXPECT_EQ(roundNumbers(1, 1000, 7, true), (std::vector<double>{1, 3, 10, 30, 100, 300, 1000}));
  EXPECT_TRUE(roundNumbers(1, 1, 5, false).empty());
  for (const double high : {0.013, 1.7, 96.0, 12345.0, 8e7})
    for (const bool logarithmic : {false, true}) {
      const auto ticks = roundNumbers(high / 300, high, 7, logarithmic);
      EXPECT_LE(ticks.size(), 8u);
      EXPECT_GE(ticks.size(), 2u) << high;
      for (const double tick : ticks) EXPECT_TRUE(tick >= high / 300 * 0.999 && tick <= high * 1.001);
    }
  EXPECT_EQ(shortNumber(1234567), "1.23 M");
  EXPECT_EQ(shortNumber(250000), "250 k");
  EXPECT_EQ(shortNumber(0.25), "0.25");
  EXPECT_EQ(shortNumber(1500), "1500");
}

}  // namespace
}  // namespace acentric

#if defined(__SANITIZE_ADDRESS__)
/// Fontconfig, which Cairo asks for letters, keeps its lists until the process ends.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig.so"; }
#endif
