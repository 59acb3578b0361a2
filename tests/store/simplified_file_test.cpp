#include <gtest/gtest.h>

#include <random>

#include "engine/base/file.h"
#include "engine/store/capture_store.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {
namespace fs = std::filesystem;

SimplifiedLocal randomSimplified(unsigned seed) {
  std::mt19937 engine(seed);
  const auto number = [&] { return std::uint32_t(engine() % 1000); };
  const auto share = [&] { return float(engine() % 1000) / 1000; };
  SimplifiedLocal s;
  for (int m = 0; m < 3; ++m) {
    SimplifiedMesh mesh{number(), {}, {}};
    for (int n = 0; n < 100 * (m + 1); ++n) mesh.sceneVertices.push_back(number());
    for (int n = 0; n < 50 * (m + 1); ++n) mesh.triangles.emplace_back(number(), number(), number());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      s.lightFrom.push_back(engine() % 2 == 0 ? number() : SimplifiedLocal::kResampled);
      s.lightResolution.push_back(std::uint16_t(engine() % 8));
    }
    s.meshes.push_back(mesh);
  }
  for (int n = 0; n < 900; ++n) s.vertices.push_back({{share(), share(), share()}, {share(), share()}});
  for (int n = 0; n < 300; ++n)
    s.triangles.push_back({{number(), number(), number()}, std::uint32_t(n % 3), number()});
  for (int n = 0; n < 500; ++n) s.lightPlaces.push_back({number(), {share(), share()}});
  s.report = {5000, 300, 20, 3, 0.004, 0.0001, 777, true, false, 1.5, 12, 41.5, 0.75, 900, 7, 44};
  return s;
}

void expectSame(const SimplifiedLocal& a, const SimplifiedLocal& b) {
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  for (std::size_t n = 0; n < a.vertices.size(); ++n) {
    EXPECT_EQ(a.vertices[n].position, b.vertices[n].position);
    EXPECT_EQ(a.vertices[n].barycentric, b.vertices[n].barycentric);
  }
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (std::size_t n = 0; n < a.triangles.size(); ++n) {
    EXPECT_EQ(a.triangles[n].vertices, b.triangles[n].vertices);
    EXPECT_EQ(a.triangles[n].mesh, b.triangles[n].mesh);
    EXPECT_EQ(a.triangles[n].triangle, b.triangles[n].triangle);
  }
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t n = 0; n < a.meshes.size(); ++n) {
    EXPECT_EQ(a.meshes[n].sceneMesh, b.meshes[n].sceneMesh);
    EXPECT_EQ(a.meshes[n].sceneVertices, b.meshes[n].sceneVertices);
    EXPECT_EQ(a.meshes[n].triangles, b.meshes[n].triangles);
  }
  EXPECT_EQ(a.lightFrom, b.lightFrom);
  EXPECT_EQ(a.lightResolution, b.lightResolution);
  ASSERT_EQ(a.lightPlaces.size(), b.lightPlaces.size());
  for (std::size_t n = 0; n < a.lightPlaces.size(); ++n) {
    EXPECT_EQ(a.lightPlaces[n].sceneTriangle, b.lightPlaces[n].sceneTriangle);
    EXPECT_EQ(a.lightPlaces[n].barycentric, b.lightPlaces[n].barycentric);
  }
  EXPECT_EQ(a.report.before, b.report.before);
  EXPECT_EQ(a.report.after, b.report.after);
  EXPECT_EQ(a.report.rim, b.report.rim);
  EXPECT_EQ(a.report.split, b.report.split);
  EXPECT_EQ(a.report.maxError, b.report.maxError);
  EXPECT_EQ(a.report.meanError, b.report.meanError);
  EXPECT_EQ(a.report.errorSamples, b.report.errorSamples);
  EXPECT_EQ(a.report.loosenedFrom, b.report.loosenedFrom);
  EXPECT_EQ(a.report.piecesLeftOut, b.report.piecesLeftOut);
  EXPECT_EQ(a.report.trianglesLeftOut, b.report.trianglesLeftOut);
  EXPECT_EQ(a.report.withinError, b.report.withinError);
  EXPECT_EQ(a.report.withinBudget, b.report.withinBudget);
  EXPECT_EQ(a.report.seconds, b.report.seconds);
  EXPECT_EQ(a.report.comparedFrames, b.report.comparedFrames);
  EXPECT_EQ(a.report.psnr, b.report.psnr);
  EXPECT_EQ(a.report.meanDifference, b.report.meanDifference);
}

class SimplifiedFile : public FolderTest {
 protected:
  fs::path path() const { return folder_ / "a.local"; }
};

TEST_F(SimplifiedFile, RoundTripsBitForBit) {
  for (const SimplifiedLocal& written : {randomSimplified(1), SimplifiedLocal{}}) {
    ASSERT_TRUE(writeSimplified(written, {3, 4}, path()));
    const auto back = readSimplified(path());
    ASSERT_TRUE(back) << back.error().describe();
    expectSame(written, *back);
  }
}

TEST_F(SimplifiedFile, DamageIsAlwaysFound) {
  ASSERT_TRUE(writeSimplified(randomSimplified(2), {3, 4}, path()));
  const auto sound = readFile(path());
  ASSERT_TRUE(sound);
  std::mt19937 engine(6);
  for (int round = 0; round < 300; ++round) {
    auto bytes = *sound;
    if (round % 4 == 0)
      bytes.resize(engine() % bytes.size());
    else
      bytes[engine() % bytes.size()] ^= std::byte(1u << (engine() % 8));
    writeQuickly(path(), bytes);
    const auto read = readSimplified(path());
    ASSERT_FALSE(read) << "round " << round;
    EXPECT_EQ(read.error().where, path().string());
  }
}

TEST_F(SimplifiedFile, IsKeptInTheStoreUnderItsKeyAndPruned) {
  const auto store = CaptureStore::open(folder_);
  ASSERT_TRUE(store);
  const ContentKey key{7, 8}, other{9, 10};
  EXPECT_FALSE(store->hasSimplified(key));
  const SimplifiedLocal written = randomSimplified(3);
  ASSERT_TRUE(store->putSimplified(key, written));
  EXPECT_TRUE(store->hasSimplified(key));
  EXPECT_GT(store->bytesOf(key), 1000u);
  const auto back = store->getSimplified(key);
  ASSERT_TRUE(back);
  expectSame(written, *back);
  // Under another name it is not what it says.
  fs::copy_file(folder_ / ("simplified-" + key.toHex() + ".local"),
                folder_ / ("simplified-" + other.toHex() + ".local"));
  EXPECT_FALSE(store->getSimplified(other));
  EXPECT_FALSE(store->hasSimplified(other)) << "it was set aside";
  EXPECT_GT(store->prune({key}), 0u) << "what was set aside goes";
  EXPECT_TRUE(store->hasSimplified(key));
  EXPECT_GT(store->prune({}), 1000u);
  EXPECT_FALSE(store->hasSimplified(key));
}

TEST_F(SimplifiedFile, IsCheckedUnderItsKeyWithoutBeingSetAside) {
  const auto store = CaptureStore::open(folder_);
  ASSERT_TRUE(store);
  const ContentKey key{7, 8}, other{9, 10};
  EXPECT_TRUE(store->check(key).empty()) << "nothing is there";
  ASSERT_TRUE(store->putSimplified(key, randomSimplified(4)));
  EXPECT_TRUE(store->check(key).empty());
  const fs::path file = folder_ / ("simplified-" + key.toHex() + ".local"),
                 copy = folder_ / ("simplified-" + other.toHex() + ".local");
  fs::copy_file(file, copy);
  fs::resize_file(file, fs::file_size(file) - 1);
  for (const auto& [under, path] : {std::pair{key, file}, std::pair{other, copy}}) {
    const std::vector<Error> problems = store->check(under);
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].where, path.string());
    EXPECT_TRUE(fs::exists(path));
  }
}

}  // namespace
}  // namespace acentric
