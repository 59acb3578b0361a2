#include "engine/measure/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "engine/measure/sweep_report.h"

namespace acentric {
namespace {

Spread spread(double value) { return spreadOf({0.9 * value, value, 1.1 * value}); }

SweepPoint point(SweepSetting setting, double error, double milliseconds, double bytes) {
  SweepPoint p;
  p.setting = std::move(setting);
  for (std::size_t m = 0; m < kMeasures; ++m) p.values[m] = spread(1 + double(m));
  p[Measure::msSsim] = spreadOf({1 - error});
  p[Measure::frameMs] = spreadOf({milliseconds});
  p[Measure::bytes] = spreadOf({bytes});
  p.bakeKey = "0a";
  p.pictures = "pictures/none";
  p.measureSeconds = 1.25;
  return p;
}

Sweep small() {
  Sweep sweep;
  sweep.project = "room.acentric.json", sweep.scene = "a \"room\" & <more>", sweep.path = "tour";
  sweep.version = "1.2.3", sweep.processor = "x", sweep.threads = 2, sweep.fingerprint = "ff";
  sweep.width = 64, sweep.height = 36, sweep.frames = 3, sweep.repeats = 2, sweep.truthSamples = 4;
  sweep.truthPictures = "pictures", sweep.referenceMs = 7.5;
  sweep.points = {point({}, 0.03, 8, 1e9),
                  point({{"reconstruction", "splat"}}, 0.05, 6, 1e9),
                  point({{"reconstruction", "point"}}, 0.4, 5.9, 1e9),
                  point({{"samples-per-degree", "16"}}, 0.02, 14, 4e9),
                  point({{"renderer", "scalar"}}, 0.03, 90, 1e9),
                  point({{"renderer", "zbuffer"}}, 0.029, 9, 1e9)};
  SweepPoint skipped;
  skipped.setting = {{"layers", "1"}};
  skipped.skipped = "would take 3 s, of 1 s";
  sweep.points.push_back(skipped);
  return sweep;
}

TEST(Sweep, IsTheSameAfterBeingWrittenAndRead) {
  Sweep sweep = small();
  sweep.points[1].bakeEstimated = true;
  sweep.points[1].changedFrames = 3;
  sweep.points[1][Measure::depthError] = {};  // was not measured
  const auto read = parseSweep(toJson(sweep), "here");
  ASSERT_TRUE(read) << read.error().describe();
  EXPECT_EQ(toJson(*read), toJson(sweep));
  ASSERT_EQ(read->points.size(), sweep.points.size());
  EXPECT_EQ(read->points[1].setting, sweep.points[1].setting);
  EXPECT_EQ(read->points[1][Measure::psnr].max, sweep.points[1][Measure::psnr].max);
  EXPECT_EQ(read->points[1][Measure::depthError].count, 0);
  EXPECT_EQ(read->points.back().skipped, sweep.points.back().skipped);
}

TEST(Sweep, RefusesWhatIsNoSweepByTheNameOfItsFile) {
  for (const char* text : {"", "{}", "[1]", R"({"format":"acentric-sweep","version":2})",
                           R"({"format":"acentric-sweep","version":1,"points":3})"}) {
    const auto read = parseSweep(text, "some.json");
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().where, "some.json");
  }
}

TEST(Sweep, FrontLeavesOutWhatIsSkippedOrDominated) {
  const Sweep sweep = small();
  EXPECT_EQ(frontOf(sweep), (std::vector<std::size_t>{0, 1, 2, 3, 5}));
}

TEST(Sweep, PresetsAreTheQuickestOfTheGoodTheMiddleAndTheBest) {
  const auto presets = presetsOf(small());
  ASSERT_EQ(presets.size(), 3u);
  EXPECT_EQ(presets[0].name, "fast");
  EXPECT_EQ(presets[0].setting, (SweepSetting{{"reconstruction", "splat"}}))
      << "points are quicker, but have twenty times the error";
  EXPECT_EQ(presets[1].name, "balanced");
  EXPECT_EQ(presets[1].setting, SweepSetting{});
  EXPECT_EQ(presets[2].name, "accurate");
  EXPECT_EQ(presets[2].setting, (SweepSetting{{"samples-per-degree", "16"}}));
  const auto read = parsePresets(toJson(small()), "here");
  ASSERT_TRUE(read);
  ASSERT_EQ(read->size(), 3u);
  EXPECT_EQ((*read)[0].setting, presets[0].setting);
}

TEST(Sweep, OfOnePointHasItForEveryPreset) {
  Sweep sweep = small();
  sweep.points.resize(1);
  for (const SweepPreset& preset : presetsOf(sweep)) EXPECT_EQ(preset.setting, SweepSetting{});
  sweep.points.clear();
  EXPECT_TRUE(presetsOf(sweep).empty());
}

TEST(Sweep, CsvHasALineForEachPointAndAsManyCellsInEach) {
  Sweep sweep = small();
  sweep.points.back().skipped = "no \"room\", none";
  std::istringstream lines(toCsv(sweep));
  std::string header;
  std::getline(lines, header);
  const auto cells = [](const std::string& line) {
    bool quoted = false;
    int count = 1;
    for (const char c : line) quoted ^= c == '"', count += c == ',' && !quoted ? 1 : 0;
    return count;
  };
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_EQ(cells(line), cells(header)) << line;
  EXPECT_EQ(count, sweep.points.size());
}

TEST(SweepReport, NamesEverySettingAndNeedsNoOtherFile) {
  const auto html = sweepReport(small(), "/nowhere");
  ASSERT_TRUE(html);
  for (const char* text : {"reconstruction splat", "samples-per-degree 16", "would take 3 s", "MS-SSIM", "dB",
                           "ms", "balanced", "a &quot;room&quot; &amp; &lt;more&gt;"})
    EXPECT_NE(html->find(text), std::string::npos) << text;
  for (const char* text : {"src=\"http", "href=\"http", "<script src", "nan", "inf\""})
    EXPECT_EQ(html->find(text), std::string::npos) << text;
  const auto count = [&](const char* word) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = html->find(word, at)) != std::string::npos; ++at) ++n;
    return n;
  };
  EXPECT_GE(count("<svg"), 3u);
  EXPECT_EQ(count("<svg"), count("</svg>"));
  EXPECT_EQ(count("<table"), count("</table>"));
}

}  // namespace
}  // namespace acentric
