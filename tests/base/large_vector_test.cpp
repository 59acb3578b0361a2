#include "engine/base/large_vector.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace acentric {
namespace {

TEST(LargeVector, BeginsAtALargePageOnceItFillsOne) {
  LargeVector<std::uint32_t> large(LargeAllocator<std::uint32_t>::kPage / sizeof(std::uint32_t));
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(large.data()) % LargeAllocator<std::uint32_t>::kPage, 0u);
}

TEST(LargeVector, KeepsWhatItHoldsWhileItGrowsFromSmallToLarge) {
  LargeVector<std::uint16_t> values;
  for (std::uint32_t i = 0; i < 3'000'000; ++i) values.push_back(static_cast<std::uint16_t>(i * 7));
  for (std::uint32_t i = 0; i < 3'000'000; ++i) ASSERT_EQ(values[i], static_cast<std::uint16_t>(i * 7));
  const LargeVector<std::uint16_t> copy = values;
  EXPECT_EQ(copy, values);
}

TEST(LargeVector, RefusesSizesThatNoMemoryHas) {
  LargeAllocator<std::uint64_t> allocator;
  EXPECT_THROW((void)allocator.allocate(std::numeric_limits<std::size_t>::max() / 4),
               std::bad_array_new_length);
}

}  // namespace
}  // namespace acentric
