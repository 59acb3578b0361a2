#include "engine/measure/svg_plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace acentric {
namespace {

TEST(SvgPlot, TicksAreRoundLieWithinAndAreAFew) {
  for (const bool logarithmic : {false, true})
    for (const double low : {0.003, 0.9, 4.0, 37.0})
      for (const double factor : {1.02, 1.5, 8.0, 4000.0}) {
        const double high = low * factor;
        const auto ticks = ticksOf(low, high, 6, logarithmic);
        EXPECT_GE(ticks.size(), 2u) << low << " " << high;
        EXPECT_LE(ticks.size(), 14u) << low << " " << high;
        EXPECT_TRUE(std::ranges::is_sorted(ticks));
        for (const double tick : ticks) {
          EXPECT_GE(tick, low * (1 - 1e-6));
          EXPECT_LE(tick, high * (1 + 1e-6));
        }
      }
  EXPECT_EQ(ticksOf(-1, 1, 4, false), (std::vector<double>{-1, -0.5, 0, 0.5, 1}));
}

TEST(SvgPlot, EscapesWhatHtmlWouldTakeForItself) {
  EXPECT_EQ(htmlText("a<b>&\"'c"), "a&lt;b&gt;&amp;&quot;&#39;c");
}

std::size_t countOf(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) ++count;
  return count;
}

TEST(SvgPlot, DrawsEveryPointWithItsBarsAndLabelsOnlyWhereThereIsRoom) {
  Plot plot;
  plot.title = "a & b", plot.across = "ms", plot.up = "dB", plot.logAcross = true;
  for (int i = 0; i < 30; ++i) {
    PlotPoint p{5, 30, 5, 5, 29, 31, "the same place", "hint", PlotPoint::Kind::plain};
    plot.points.push_back(p);
  }
  plot.points.push_back({50, 40, 45, 55, 40, 40, "far away", "hint", PlotPoint::Kind::front});
  plot.lines = {{0, 30}};
  const std::string svg = svgOf(plot);
  EXPECT_EQ(countOf(svg, "<circle"), 31u);
  EXPECT_EQ(countOf(svg, "class=\"bar\""), 31u);
  EXPECT_EQ(countOf(svg, "far away"), 1u);
  EXPECT_LT(countOf(svg, ">the same place<"), 7u);
  EXPECT_GE(countOf(svg, ">the same place<"), 1u);
  EXPECT_EQ(countOf(svg, "<polyline"), 1u);
  EXPECT_EQ(countOf(svg, "nan"), 0u);
}

TEST(SvgPlot, OnePointAndNoneAreDrawnToo) {
  Plot plot;
  EXPECT_NE(svgOf(plot).find("</svg>"), std::string::npos);
  plot.points.push_back({0, 0, 0, 0, 0, 0, "", "", PlotPoint::Kind::base});
  const std::string svg = svgOf(plot);
  EXPECT_EQ(countOf(svg, "<circle"), 1u);
  EXPECT_EQ(countOf(svg, "nan") + countOf(svg, "inf"), 0u);
}

}  // namespace
}  // namespace acentric
