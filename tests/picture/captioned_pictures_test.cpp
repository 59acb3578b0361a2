#include "engine/picture/captioned_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace acentric {
namespace {

constexpr Rgba8 kRed(200, 0, 0, 255), kBlue(0, 0, 200, 255), kWhite(255);

std::ptrdiff_t countOf(const ColourImage& image, const Rgba8& colour) {
  return std::ranges::count(image.pixels, colour);
}

TEST(WithLegend, KeepsThePictureAndAddsRowsOfEntriesBelow) {
  const ColourImage picture(200, 60, kRed);
  std::vector<LegendLine> lines{{ColourImage(14, 14, kBlue), "camera 1"}};
  const auto one = withLegend(picture, lines);
  ASSERT_TRUE(one) << one.error().describe();
  EXPECT_EQ(one->width, 200);
  ASSERT_GT(one->height, 75);
  EXPECT_EQ(countOf(*one, kRed), 200 * 60);
  EXPECT_GT(countOf(*one, kBlue), 100) << "the swatch";
  EXPECT_EQ(one->at(199, one->height - 1), kWhite);

  for (int i = 0; i < 5; ++i) lines.push_back({ColourImage(14, 14, kBlue), "another camera, far away"});
  const auto six = withLegend(picture, lines);
  ASSERT_TRUE(six);
  EXPECT_GT(six->height, one->height + 3 * 14) << "entries that do not fit begin a new row";
  EXPECT_GT(countOf(*six, kBlue), 5 * countOf(*one, kBlue));
}

TEST(WithLegend, OfNothingIsThePicture) {
  const ColourImage picture(20, 10, kRed);
  const auto same = withLegend(picture, {});
  ASSERT_TRUE(same);
  EXPECT_EQ(same->pixels, picture.pixels);
}

TEST(DrawSheet, HoldsEveryPictureWhole) {
  Sheet sheet;
  sheet.rows = {{"", {{ColourImage(40, 30, kRed), ""}, {ColourImage(40, 30, kBlue), ""}}},
                {"", {{ColourImage(40, 30, kBlue), ""}}}};
  const auto plain = drawSheet(sheet);
  ASSERT_TRUE(plain);
  EXPECT_EQ(countOf(*plain, kRed), 40 * 30);
  EXPECT_EQ(countOf(*plain, kBlue), 2 * 40 * 30);

  sheet.title = "A walk";
  sheet.headings = {"picture", "truth"};
  sheet.rows[0].label = "frame 0";
  sheet.rows[1].pictures[0].caption = "30 dB";
  sheet.notes = {"a note that is much longer than the sheet is wide, and so has to go on in another line"};
  const auto worded = drawSheet(sheet);
  ASSERT_TRUE(worded);
  EXPECT_EQ(countOf(*worded, kRed), 40 * 30);
  EXPECT_EQ(countOf(*worded, kBlue), 2 * 40 * 30);
  EXPECT_GT(worded->width, plain->width) << "labels take room";
  EXPECT_GT(worded->height, plain->height + 60) << "title, headings, captions and notes take room";
}

TEST(DrawSheet, ScalesPictures) {
  Sheet sheet;
  sheet.pictureWidth = 20;
  sheet.rows = {{"", {{ColourImage(40, 30, kRed), ""}}}};
  const auto scaled = drawSheet(sheet);
  ASSERT_TRUE(scaled);
  EXPECT_NEAR(double(countOf(*scaled, kRed)), 20 * 15, 2 * 20 + 2 * 15) << "but for its border";
}

TEST(DrawSheet, RefusesWhatNoPictureCanHold) {
  Sheet sheet;
  sheet.rows.assign(600, {"", {{ColourImage(40, 30, kRed), ""}}});
  const auto refused = drawSheet(sheet);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::invalidArgument);
}

}  // namespace
}  // namespace acentric
