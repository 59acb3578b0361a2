#include "engine/pipeline/check_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "engine/base/file.h"
#include "tests/pipeline/small_project.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;
using test::SceneBuilder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kFlips = 60;

/// A small room of which one camera and the light are baked.
class CheckedStore : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    SceneBuilder builder;
    builder.box(builder.material(test::matte()), {-4, -4, 0}, {4, 4, 3}, true).point({0, 0, 2.5f}, 50);
    Project project = test::smallProject(0.5, 1);
    project.bake.ambientRays = 0;
    project.bake.surfaceTexel = 0.5;
    open_ = test::openWith(builder.rays(), project, folder_ / "room.acentric.json");
    request_.cameras = std::vector{0};
    const ProjectBakeReport first = bake();
    ASSERT_EQ(first.captures.baked, 1);
    ASSERT_TRUE(first.surfaceLightBaked);
  }
  ProjectBakeReport bake() const {
    TaskRunner runner(0);
    auto report = bakeProject(open_, request_, runner);
    EXPECT_TRUE(report) << report.error().describe();
    return report ? *report : ProjectBakeReport{};
  }
  StoreCheck check() const {
    TaskRunner runner(0);
    auto checked = checkStore(open_, runner);
    EXPECT_TRUE(checked) << checked.error().describe();
    return checked ? *checked : StoreCheck{};
  }
  fs::path captures() const { return captureFolderFor(open_.file); }
  fs::path fileOf(const char* extension) const { return captures() / (open_.keys[0].toHex() + extension); }
  fs::path light() const { return captures() / ("surface-" + open_.surfaceLightKey.toHex() + ".light"); }
  fs::path lightRecord() const { return captures() / (open_.surfaceLightKey.toHex() + ".record"); }

  /// How many of kFlips single bits of the file may flip without a word that names it.
  int unseenFlips(const fs::path& path) const {
    const auto sound = readFile(path);
    EXPECT_TRUE(sound);
    const auto written = fs::last_write_time(path);
    std::mt19937 random(7);
    int unseen = 0;
    for (int flip = 0; flip < kFlips; ++flip) {
      auto bytes = *sound;
      bytes[random() % bytes.size()] ^= std::byte(1u << random() % 8);
      writeQuickly(path, bytes);
      fs::last_write_time(path, written);  // as a disk decays: no time tells
      const std::vector<std::string> problems = check().problems;
      unseen += std::ranges::none_of(problems, [&](const std::string& problem) {
        return problem.find(path.filename().string()) != std::string::npos;
      });
    }
    writeQuickly(path, *sound);
    fs::last_write_time(path, written);
    return unseen;
  }

  OpenProject open_;
  BakeRequest request_;
};

TEST_F(CheckedStore, IsSoundAsBakedAndLeftAsItIs) {
  const auto written = fs::last_write_time(fileOf(".record"));
  const StoreCheck found = check();
  EXPECT_THAT(found.problems, IsEmpty());
  EXPECT_EQ(found.captures, 1u);
  EXPECT_EQ(found.capturesMissing, open_.keys.size() - 1);
  EXPECT_EQ(found.withoutRecord, 0u);
  EXPECT_FALSE(found.surfaceLightMissing);
  EXPECT_EQ(fs::last_write_time(fileOf(".record")), written);
}

TEST_F(CheckedStore, TellsOfEveryFlippedBit) {
  for (const fs::path& path : {fileOf(".pack"), fileOf(".record"), light(), lightRecord()})
    EXPECT_EQ(unseenFlips(path), 0) << path;
  EXPECT_THAT(check().problems, IsEmpty());
}

TEST_F(CheckedStore, TellsOfEachFileThatIsGone) {
  for (const fs::path& path : {fileOf(".pack"), light()}) {
    const fs::path aside = path.string() + ".kept";
    fs::rename(path, aside);
    EXPECT_THAT(check().problems,
                ElementsAre(HasSubstr(path.filename().string() + ": was baked and is gone")));
    fs::rename(aside, path);
  }
  fs::remove(light());
  EXPECT_TRUE(check().surfaceLightMissing);
}

TEST_F(CheckedStore, TellsOfARecordOfAnotherCapture) {
  request_.cameras = std::vector{1};
  bake();
  fs::copy_file(captures() / (open_.keys[1].toHex() + ".record"), fileOf(".record"),
                fs::copy_options::overwrite_existing);
  EXPECT_THAT(check().problems, testing::Contains(HasSubstr("is the record of another key")));
}

TEST_F(CheckedStore, SaysOfHowManyFilesItHasNoRecord) {
  fs::remove(fileOf(".record"));
  fs::remove(lightRecord());
  const StoreCheck found = check();
  EXPECT_THAT(found.problems, IsEmpty());
  EXPECT_EQ(found.withoutRecord, 2u);
  EXPECT_EQ(unseenFlips(fileOf(".pack")), 0);
  EXPECT_EQ(unseenFlips(light()), 0);
}

TEST_F(CheckedStore, IncludesThePreviewsThatAWalkWouldShow) {
  request_.cameras = std::vector{1};
  request_.surfaceLight = false;
  TaskRunner runner(0);
  const OpenProject coarse = atQuality(open_, Quality::preview);
  ASSERT_TRUE(bakeProject(coarse, request_, runner));
  EXPECT_EQ(check().coarse, 1u);
  EXPECT_THAT(check().problems, IsEmpty());
  EXPECT_EQ(unseenFlips(captures() / (coarse.keys[1].toHex() + ".pack")), 0);
}

TEST_F(CheckedStore, IsMendedByABakeThatReadsItToTheEnd) {
  const auto flip = [](const fs::path& path, std::size_t at) {
    auto bytes = readFile(path).value();
    const auto written = fs::last_write_time(path);
    bytes[at % bytes.size()] ^= std::byte(4);
    writeQuickly(path, bytes);
    fs::last_write_time(path, written);
  };
  request_.verify = true;
  flip(fileOf(".record"), 40);
  flip(lightRecord(), 40);
  const ProjectBakeReport noted = bake();
  EXPECT_EQ(noted.captures.baked, 0) << "what it is of is sound";
  EXPECT_FALSE(noted.surfaceLightBaked);
  EXPECT_THAT(noted.damaged, testing::SizeIs(2));
  EXPECT_THAT(noted.damaged, testing::Each(HasSubstr(".record: is damaged")));
  EXPECT_THAT(check().problems, IsEmpty());
  EXPECT_EQ(check().withoutRecord, 0u);

  flip(fileOf(".pack"), 200);
  flip(light(), 200);
  const ProjectBakeReport mended = bake();
  EXPECT_EQ(mended.captures.baked, 1);
  EXPECT_TRUE(mended.surfaceLightBaked);
  EXPECT_THAT(check().problems, IsEmpty());
}

TEST_F(CheckedStore, TakesAllButWhatAFolderIsInTheWayOf) {
  request_.cameras.reset();
  const fs::path way = captures() / (open_.keys[2].toHex() + ".pack");
  fs::create_directories(way / "inside");
  fs::remove(light());
  fs::create_directories(light() / "inside");
  const ProjectBakeReport report = bake();
  const int others = int(open_.keys.size()) - 1;
  EXPECT_EQ(report.captures.baked + report.captures.reused, others);
  EXPECT_EQ(int(report.captures.cameras.size()), others);
  EXPECT_FALSE(report.surfaceLightBaked);
  ASSERT_THAT(report.refused, testing::SizeIs(2));
  for (const std::string& refused : report.refused) {
    EXPECT_THAT(refused, HasSubstr("a folder has this name; move it away"));
    EXPECT_THAT(refused, testing::Not(HasSubstr("writable")));
  }
  EXPECT_THAT(report.refused[0], HasSubstr(way.filename().string()));
  EXPECT_THAT(report.refused[1], HasSubstr(light().filename().string()));

  fs::remove_all(way);
  fs::remove_all(light());
  EXPECT_THAT(bake().refused, IsEmpty());
  EXPECT_EQ(check().captures, open_.keys.size());
  EXPECT_THAT(check().problems, IsEmpty());
}

}  // namespace
}  // namespace acentric
