#include "engine/pipeline/first_cell.h"

#include <gtest/gtest.h>

#include "engine/layout/layout.h"
#include "engine/pipeline/pipeline.h"

namespace acentric {
namespace {

TEST(FirstCells, AreLargerOnAVastPlainSoThatTheLayoutStaysSmall) {
  for (const Configuration configuration : {Configuration::b, Configuration::e, Configuration::g}) {
    EXPECT_EQ(firstCellSize(7000, configuration), kLargestUsualCell) << nameOf(configuration);
    LayoutSpec spec;
    spec.configuration = configuration;
    spec.cellSize = firstCellSize(6e7, configuration);
    EXPECT_GT(spec.cellSize, kLargestUsualCell) << nameOf(configuration);
    spec.outline = parseOutline("0,0;10000,0;10000,6000;0,6000").value();
    const auto layout = buildLayout(spec);
    ASSERT_TRUE(layout) << layout.error().describe();
    EXPECT_GT(layout->regions.size(), 100u) << nameOf(configuration);
    EXPECT_LT(layout->regions.size(), 12000u) << nameOf(configuration);
  }
}

}  // namespace
}  // namespace acentric
