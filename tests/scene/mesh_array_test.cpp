#include "engine/scene/mesh_array.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <random>

namespace acentric::test {
namespace {

using testing::ElementsAre;

const std::array<int, 3> kKept{1, 2, 3};

MeshArray<int> mapped() { return MeshArray<int>::mapped(kKept, std::make_shared<int>()); }

TEST(MeshArray, OfAMappedFileIsSharedUntilItIsChanged) {
  const MeshArray<int> first = mapped();
  MeshArray<int> second = first;
  EXPECT_TRUE(second.isMapped());
  EXPECT_EQ(std::as_const(second).data(), kKept.data());
  second.push_back(4);
  second[0] = 9;
  EXPECT_FALSE(second.isMapped());
  EXPECT_THAT(second, ElementsAre(9, 2, 3, 4));
  EXPECT_THAT(first, ElementsAre(1, 2, 3));
  EXPECT_TRUE(first.isMapped());
}

TEST(MeshArray, KeepsTheOwnerAsLongAsItReadsThere) {
  const auto owner = std::make_shared<int>();
  MeshArray<int> array = MeshArray<int>::mapped(kKept, owner);
  MeshArray<int> moved = std::move(array);
  EXPECT_EQ(owner.use_count(), 2);
  moved.pop_back();
  EXPECT_EQ(owner.use_count(), 1);
  EXPECT_THAT(moved, ElementsAre(1, 2));
}

TEST(MeshArray, IsEmptyAfterItWasMoved) {
  for (MeshArray<int> array : {mapped(), MeshArray<int>{1, 2, 3}}) {
    const MeshArray<int> taken = std::move(array);
    EXPECT_TRUE(array.empty());
    EXPECT_EQ(array.begin(), array.end());
    EXPECT_THAT(taken, ElementsAre(1, 2, 3));
  }
}

/// Whatever is done to it, it holds what a vector would.
TEST(MeshArray, DoesWhatAVectorDoes) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    MeshArray<int> array = round % 2 == 0 ? mapped() : MeshArray<int>{1, 2, 3};
    std::vector<int> vector{1, 2, 3};
    for (int step = 0; step < 12; ++step) {
      const int value = int(random() % 100);
      switch (random() % 9) {
        case 0:
          array.push_back(value), vector.push_back(value);
          break;
        case 1:
          array.emplace_back(value) += 1, vector.emplace_back(value) += 1;
          break;
        case 2:
          array.resize(std::size_t(value % 8)), vector.resize(std::size_t(value % 8));
          break;
        case 3:
          array.assign(3, value), vector.assign(3, value);
          break;
        case 4: {
          const std::array<int, 2> more{value, 1};
          const std::ptrdiff_t at = vector.empty() ? 0 : value % std::ptrdiff_t(vector.size());
          array.insert(array.begin() + at, more.begin(), more.end());
          vector.insert(vector.begin() + at, more.begin(), more.end());
          break;
        }
        case 5:
          if (!vector.empty()) array.pop_back(), vector.pop_back();
          break;
        case 6: {
          const MeshArray<int> copy = array;
          array = copy;
          break;
        }
        case 7: {
          MeshArray<int> other = mapped();
          std::swap(array, other);
          std::swap(array, other);
          break;
        }
        default:
          for (int& each : array) each += 2;
          for (int& each : vector) each += 2;
      }
      ASSERT_EQ(array.size(), vector.size());
      ASSERT_THAT(array, testing::ElementsAreArray(vector)) << round;
    }
  }
}

}  // namespace
}  // namespace acentric::test
