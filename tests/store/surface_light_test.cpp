#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "engine/base/file.h"
#include "engine/store/block_file.h"
#include "engine/store/capture_store.h"
#include "engine/store/light_coder.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {
namespace fs = std::filesystem;

SurfaceLight randomLight(std::size_t triangles, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> light(0, 4);
  SurfaceLight result;
  result.firstSample.push_back(0);
  for (std::size_t t = 0; t < triangles; ++t) {
    const std::uint32_t resolution = random() % 3 == 0 ? 0 : random() % 9;
    const bool back = random() % 4 == 0;
    const std::uint32_t samples = resolution == 0 ? 0 : surfaceSampleCount(resolution) * (back ? 2 : 1);
    result.resolution.push_back(static_cast<std::uint16_t>(resolution));
    result.hasBack.push_back(back ? 1 : 0);
    result.firstSample.push_back(result.firstSample.back() + samples);
    for (std::uint32_t i = 0; i < samples; ++i)
      result.light.push_back(packColour({light(random), light(random), light(random), 1}));
  }
  return result;
}

void expectSame(const SurfaceLight& a, const SurfaceLight& b) {
  EXPECT_EQ(a.firstSample, b.firstSample);
  EXPECT_EQ(a.resolution, b.resolution);
  EXPECT_EQ(a.hasBack, b.hasBack);
  EXPECT_EQ(a.light, b.light);
}

class SurfaceLightFile : public FolderTest {
 protected:
  fs::path path() const { return folder_ / "surface.light"; }
};

TEST_F(SurfaceLightFile, RoundTripsBitForBit) {
  for (const std::size_t triangles : {0, 1, 500, 70000}) {
    const SurfaceLight light = randomLight(triangles, 3);
    const Status written = writeSurfaceLight(light, {1, 1}, path());
    ASSERT_TRUE(written) << written.error().describe();
    const auto back = readSurfaceLight(path());
    ASSERT_TRUE(back) << back.error().describe();
    expectSame(light, *back);
  }
}

/// Light that changes slowly over each of so many triangles, to six bits behind the first as a bake keeps it.
SurfaceLight smoothLight(std::size_t triangles, std::uint16_t resolution) {
  SurfaceLight result;
  result.resolution.assign(triangles, resolution), result.hasBack.assign(triangles, 0);
  for (std::size_t t = 0; t < triangles; ++t) {
    result.firstSample.push_back(std::uint32_t(result.light.size()));
    for (int i = 0; i <= resolution; ++i)
      for (int j = 0; i + j <= resolution; ++j) {
        const float bright = 1 + 0.3f * std::sin(0.1f * float(i) + 0.2f * float(j) + float(t));
        HalfColour colour = packColour({bright, 0.9f * bright, 0.7f * bright, 1});
        for (auto* channel : {&colour.r, &colour.g, &colour.b}) *channel &= std::uint16_t(~15u);
        result.light.push_back(colour);
      }
  }
  result.firstSample.push_back(std::uint32_t(result.light.size()));
  return result;
}

TEST_F(SurfaceLightFile, TakesLittleMoreThanWhatCannotBeForetold) {
  const SurfaceLight light = smoothLight(200, 20);
  ASSERT_TRUE(writeSurfaceLight(light, {1, 1}, path()));
  const auto back = readSurfaceLight(path());
  ASSERT_TRUE(back) << back.error().describe();
  expectSame(light, *back);
  EXPECT_LT(fs::file_size(path()), light.light.size()) << "eight bits of 48 and more";
}

TEST_F(SurfaceLightFile, HoldsTheBrightestAndTheDarkestSideBySide) {
  for (const std::uint16_t step : {1, 16}) {
    SurfaceLight light = smoothLight(3, 6);
    std::mt19937 random(step);
    for (HalfColour& colour : light.light)
      for (auto* channel : {&colour.r, &colour.g, &colour.b})
        *channel = std::uint16_t(random() % 2 == 0 ? 0 : 0x7c00 - step);
    ASSERT_TRUE(writeSurfaceLight(light, {1, 1}, path()));
    const auto back = readSurfaceLight(path());
    ASSERT_TRUE(back) << back.error().describe();
    expectSame(light, *back);
  }
}

/// Triangles with the given fronts, and backs a tenth as bright if so.
SurfaceLight withDarkBacks(const SurfaceLight& fronts) {
  SurfaceLight result = fronts;
  result.light.clear();
  for (std::size_t t = 0; t < fronts.resolution.size(); ++t) {
    const auto begin = fronts.light.begin() + fronts.firstSample[t];
    const auto end = fronts.light.begin() + fronts.firstSample[t + 1];
    result.hasBack[t] = 1, result.firstSample[t] = std::uint32_t(result.light.size());
    result.light.insert(result.light.end(), begin, end);
    for (auto sample = begin; sample != end; ++sample) {
      const glm::vec4 colour = unpackColour(*sample);
      result.light.push_back(packColour({glm::vec3(colour) * 0.1f, 1}));
    }
  }
  result.firstSample.back() = std::uint32_t(result.light.size());
  return result;
}

TEST(LightCoder, DarkBacksDoNotMakeFrontsCostMore) {
  const SurfaceLight fronts = smoothLight(4000, 1), both = withDarkBacks(fronts);
  SurfaceLight backs = fronts;
  backs.light.clear();
  for (std::size_t i = 0; i < both.light.size(); ++i)
    if (i / 3 % 2 == 1) backs.light.push_back(both.light[i]);
  EXPECT_NEAR(double(codeLight(both, 0).size()),
              double(codeLight(fronts, 0).size() + codeLight(backs, 0).size()), 16);
}

TEST_F(SurfaceLightFile, BrokenTablesAreNeverWritten) {
  const std::function<void(SurfaceLight&)> breakages[] = {
      [](SurfaceLight& l) { l.firstSample.pop_back(); }, [](SurfaceLight& l) { l.hasBack.pop_back(); },
      [](SurfaceLight& l) { l.hasBack[1] = 2; },         [](SurfaceLight& l) { l.resolution[7] = 60000; },
      [](SurfaceLight& l) { l.firstSample[4] += 900; },  [](SurfaceLight& l) { l.light.pop_back(); },
      [](SurfaceLight& l) { l.light[3].g = 0x7c00; }};
  for (const auto& damage : breakages) {
    SurfaceLight light = randomLight(50, 4);
    damage(light);
    EXPECT_FALSE(writeSurfaceLight(light, {1, 1}, path()));
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(SurfaceLightFile, ASideFlagThatIsNoneIsRefusedBeforeSamplesAreRead) {
  SurfaceLight light = smoothLight(1, 5);
  const std::vector<std::byte> stream = codeLight(light, 4);
  const auto write = [&](std::uint8_t flag) {
    light.hasBack = {flag};
    BlockFileWriter file(BlockFileKind::surfaceLight, {1, 1});
    file.describe(std::uint64_t(1)), file.describe(std::uint64_t(light.light.size()));
    file.describe(std::uint64_t(stream.size())), file.describe(std::uint8_t(4));
    EXPECT_TRUE(file.addRecords(std::array<ConstLane, 2>{laneOf(std::as_const(light.resolution)),
                                                         laneOf(std::as_const(light.hasBack))},
                                1));
    EXPECT_TRUE(file.addStream(stream));
    EXPECT_TRUE(file.write(path()));
  };
  write(0);
  EXPECT_TRUE(readSurfaceLight(path()));
  for (const int flag : {2, 4, 255}) {
    write(std::uint8_t(flag));
    const auto read = readSurfaceLight(path());
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().describe().find("side flag"), std::string::npos) << read.error().describe();
  }
}

TEST_F(SurfaceLightFile, DamageIsAlwaysFound) {
  const SurfaceLight light = randomLight(200, 5);
  ASSERT_TRUE(writeSurfaceLight(light, {1, 1}, path()));
  const auto sound = readFile(path());
  ASSERT_TRUE(sound);
  std::mt19937 random(6);
  for (int round = 0; round < 500; ++round) {
    auto bytes = *sound;
    if (round % 4 == 0)
      bytes.resize(random() % bytes.size());
    else
      bytes[random() % (round % 2 ? bytes.size() : 100)] ^= std::byte(1u << (random() % 8));
    writeQuickly(path(), bytes);
    const auto read = readSurfaceLight(path());
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().kind, ErrorKind::malformed);
    EXPECT_NE(read.error().describe().find("surface.light"), std::string::npos);
  }
}

TEST_F(SurfaceLightFile, PartsAreKeptUnderTheirKeyAndDamagedOnesAreDeleted) {
  const auto store = CaptureStore::open(folder_);
  ASSERT_TRUE(store.has_value());
  const ContentKey key{7, 8}, other{7, 9};
  const SurfaceLightPart first{{0, 2}, {1, 2}, {{1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}}};
  const SurfaceLightPart second{{1}, {1}, {{13, 14, 15, 16}}};
  ASSERT_TRUE(store->putSurfaceLightPart(key, first));
  ASSERT_TRUE(store->putSurfaceLightPart(key, second));
  ASSERT_TRUE(store->putSurfaceLightPart(other, second));
  const auto parts = store->getSurfaceLightParts(key);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].runs, first.runs);
  EXPECT_EQ(parts[0].sizes, first.sizes);
  EXPECT_EQ(parts[0].light, first.light);
  EXPECT_EQ(parts[1].light, second.light);
  EXPECT_FALSE(store->putSurfaceLightPart(key, {{3}, {2}, {HalfColour{}}})) << "contradicts itself";
  EXPECT_FALSE(store->putSurfaceLightPart(key, {{3}, {1}, {{0x7c00, 0, 0, 0}}})) << "infinite light";

  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) files.push_back(entry.path());
  ASSERT_EQ(files.size(), 3u);
  const auto ofKey = std::ranges::find_if(files, [&](const auto& path) {
    return path.filename().string().find(key.toHex()) != std::string::npos;
  });
  ASSERT_NE(ofKey, files.end());
  std::filesystem::resize_file(*ofKey, std::filesystem::file_size(*ofKey) - 1);
  EXPECT_EQ(store->getSurfaceLightParts(key).size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(*ofKey));

  store->prune({key});
  EXPECT_TRUE(store->getSurfaceLightParts(other).empty()) << "of a light that nobody asks for";
  EXPECT_EQ(store->getSurfaceLightParts(key).size(), 1u) << "a bake may still go on from it";
  store->forgetSurfaceLightParts(key);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(SurfaceLightFile, ACaptureIsNoSurfaceLight) {
  ASSERT_TRUE(writeSurfaceLight(randomLight(5, 1), {1, 1}, path()));
  const auto read = readCapturePack(path());
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::malformed);
}

}  // namespace
}  // namespace acentric
