#include "engine/store/range_coder.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace acentric {
namespace {

/// Bits of contexts of every likelihood, with plain ones between.
struct Coded {
  std::size_t context;
  bool bit;
  int plainBits;
  std::uint32_t plain;
};
std::vector<Coded> someBits(std::size_t count, unsigned seed) {
  constexpr double kChances[] = {0.5, 0.9, 0.99, 0.9999, 0, 1};
  std::mt19937 random(seed);
  std::vector<Coded> bits;
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t context = random() % std::size(kChances);
    const int plainBits = random() % 16 == 0 ? int(1 + random() % 32) : 0;
    const auto plain = std::uint32_t(random());
    bits.push_back({context, std::bernoulli_distribution(kChances[context])(random), plainBits,
                    plainBits == 32 ? plain : plain & ((1u << plainBits) - 1)});
  }
  return bits;
}

std::vector<std::byte> written(const std::vector<Coded>& bits) {
  RangeWriter writer;
  std::array<BitChance, 6> chances;
  for (const Coded& coded : bits) {
    writer.bit(chances[coded.context], coded.bit);
    writer.plain(coded.plain, coded.plainBits);
  }
  return std::move(writer).finish();
}

TEST(RangeCoder, GivesBackWhatWasWrittenAndTakesAllOfIt) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const auto bits = someBits(seed * 97, seed);
    const auto bytes = written(bits);
    RangeReader reader(bytes);
    std::array<BitChance, 6> chances;
    for (const Coded& coded : bits) {
      ASSERT_EQ(reader.bit(chances[coded.context]), coded.bit);
      ASSERT_EQ(reader.plain(0, coded.plainBits), coded.plain);
    }
    EXPECT_TRUE(reader.atEnd()) << seed;
  }
}

TEST(RangeCoder, BitsThatAreAlmostSureTakeAlmostNothing) {
  RangeWriter writer;
  BitChance chance;
  for (int n = 0; n < 100'000; ++n) writer.bit(chance, n % 1000 == 999);
  EXPECT_LT(std::move(writer).finish().size(), 100'000 / 8 / 50);
}

TEST(RangeCoder, CarriesRunThroughAnyNumberOfBytes) {
  RangeWriter writer;
  BitChance sure;
  for (int n = 0; n < 200; ++n) sure.learn(false);
  std::vector<bool> bits(2000, true);  // against all odds: the lower end climbs towards all ones
  bits.insert(bits.end(), 500, false);
  for (const bool bit : bits) {
    BitChance chance = sure;
    writer.bit(chance, bit);
  }
  const auto bytes = std::move(writer).finish();
  RangeReader reader(bytes);
  for (const bool bit : bits) {
    BitChance chance = sure;
    ASSERT_EQ(reader.bit(chance), bit);
  }
  EXPECT_TRUE(reader.atEnd());
}

TEST(RangeCoder, TellsOfBytesThatAreMissingOrTooMany) {
  const auto bits = someBits(5000, 3);
  const auto bytes = written(bits);
  for (const int change : {-1, 1}) {
    auto other = bytes;
    other.resize(std::size_t(int(bytes.size()) + change));
    RangeReader reader(other);
    std::array<BitChance, 6> chances;
    for (const Coded& coded : bits) {
      reader.bit(chances[coded.context]);
      reader.plain(0, coded.plainBits);
    }
    EXPECT_FALSE(reader.atEnd()) << change;
  }
}

}  // namespace
}  // namespace acentric
