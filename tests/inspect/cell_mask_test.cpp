#include "engine/inspect/cell_mask.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace acentric {
namespace {

CellMask maskOf(const std::vector<std::string>& rowsFromTop) {
  CellMask mask(static_cast<int>(rowsFromTop[0].size()), static_cast<int>(rowsFromTop.size()));
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.columns; ++x)
      mask.cells[mask.index(x, y)] =
          rowsFromTop[std::size_t(mask.rows - 1 - y)][std::size_t(x)] == '#' ? 1 : 0;
  return mask;
}

CellLinks allLinks(const CellMask& mask) {
  return {std::vector<std::uint8_t>(mask.cells.size(), 1), std::vector<std::uint8_t>(mask.cells.size(), 1)};
}

long long twiceArea(const std::vector<glm::ivec2>& loop) {
  long long sum = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const glm::ivec2 a = loop[k], b = loop[(k + 1) % loop.size()];
    sum += static_cast<long long>(a.x) * b.y - static_cast<long long>(a.y) * b.x;
  }
  return sum;
}

TEST(CellMask, TracesOuterLoopsCounterClockwiseAndHolesClockwise) {
  const auto loops = traceLoops(maskOf({"#####", "#...#", "#####"}));
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(twiceArea(loops[0]), 30);
  EXPECT_EQ(twiceArea(loops[1]), -6);
  EXPECT_EQ(loops[0].size(), 4u);
}

TEST(CellMask, LoopsEncloseExactlyTheTrueCells) {
  std::mt19937 random(5);
  for (int n = 0; n < 200; ++n) {
    CellMask mask(12, 9);
    for (auto& cell : mask.cells) cell = random() % 3 != 0;
    long long area = 0;
    for (const auto& loop : traceLoops(mask)) area += twiceArea(loop);
    EXPECT_EQ(area, 2 * static_cast<long long>(mask.count()));
  }
}

TEST(CellMask, CornerContactsAreTakenOff) {
  std::mt19937 random(6);
  for (int n = 0; n < 200; ++n) {
    CellMask mask(12, 9);
    for (auto& cell : mask.cells) cell = random() % 3 != 0;
    removeCornerContacts(mask);
    for (int y = 0; y + 1 < mask.rows; ++y)
      for (int x = 0; x + 1 < mask.columns; ++x) {
        const bool a = mask.at(x, y), b = mask.at(x + 1, y), c = mask.at(x, y + 1), d = mask.at(x + 1, y + 1);
        EXPECT_FALSE(a == d && b == c && a != b);
      }
  }
}

TEST(CellMask, TheLargestPartFollowsLinks) {
  const CellMask mask = maskOf({"##.###", "##.###"});
  EXPECT_EQ(largestPart(mask, allLinks(mask)).count(), 6u);
  CellLinks links = allLinks(mask);
  for (int y = 0; y < 2; ++y) links.right[mask.index(3, y)] = 0;  // a wall after the fourth column
  const CellMask part = largestPart(mask, links);
  EXPECT_EQ(part.count(), 4u);
  EXPECT_EQ(largestPart(CellMask(3, 3), allLinks(CellMask(3, 3))).count(), 0u);
}

}  // namespace
}  // namespace acentric
