#include "engine/measure/numerics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace acentric {
namespace {

Numerics example() {
  const double none = std::numeric_limits<double>::quiet_NaN();
  return {{"Signs",
           "On <which> side.",
           {"wrong, %", "ns"},
           {{"anywhere", false, "exact", {0, 15.5}}, {"on, borders", true, "naive", {12.5, none}}}}};
}

TEST(Numerics, ComeBackFromJsonAsTheyWere) {
  const Numerics before = example();
  const auto after = parseNumerics(toJson(before), "x.json");
  ASSERT_TRUE(after) << after.error().describe();
  ASSERT_EQ(after->size(), 1u);
  const NumericsTable &a = before.front(), &b = after->front();
  EXPECT_EQ(a.title, b.title);
  EXPECT_EQ(a.explanation, b.explanation);
  EXPECT_EQ(a.columns, b.columns);
  ASSERT_EQ(b.rows.size(), 2u);
  EXPECT_EQ(b.rows[0].values, a.rows[0].values);
  EXPECT_EQ(b.rows[1].cases, "on, borders");
  EXPECT_TRUE(b.rows[1].hard);
  EXPECT_EQ(b.rows[1].values[0], 12.5);
  EXPECT_TRUE(std::isnan(b.rows[1].values[1])) << "what was not measured stays so";
  EXPECT_FALSE(parseNumerics("[{\"title\": 3}]", "x.json"));
}

TEST(Numerics, AreWrittenForProgramsAndPeople) {
  const std::string csv = toCsv(example());
  EXPECT_EQ(std::ranges::count(csv, '\n'), 4) << "a heading and three values";
  EXPECT_NE(csv.find("Signs,\"on, borders\",1,naive,\"wrong, %\",12.5"), std::string::npos) << csv;
  const std::string text = toText(example());
  EXPECT_NE(text.find("15.5"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  const std::string html = toHtml(example());
  EXPECT_NE(html.find("On &lt;which&gt; side."), std::string::npos);
  EXPECT_EQ(toHtml({}), "");
}

}  // namespace
}  // namespace acentric
