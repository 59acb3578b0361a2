/// Published folders: what is in them, what of a former one they keep, and what is left when it fails.

#include "engine/pipeline/publish_walk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <map>

#include "engine/base/file.h"
#include "engine/export/bundle_read.h"
#include "engine/export/walk_read.h"
#include "tests/export/small_walk.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Baked once; each test publishes to folders of its own.
class PublishWalkTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    room = fs::temp_directory_path() / ("acentric-publish-test-" + std::to_string(::getpid()));
    fs::create_directories(room / "page");
    put(room / "page/index.html", "<title>Acentric walk</title><main></main>");
    put(room / "page/viewer.js", "walk()");
    put(room / "page/viewer.css", "p {}");
    runner = new TaskRunner(1);
    baked = new OpenProject(test::bakedProject(room / "small.acentric.json", *runner));
  }
  static void TearDownTestSuite() {
    fs::remove_all(room);
    delete runner;
    delete baked;
  }
  void SetUp() override {
    parent_ = room / testing::UnitTest::GetInstance()->current_test_info()->name();
    site_ = parent_ / "site";
  }

  static void put(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    ASSERT_TRUE(writeTextAtomically(file, text));
  }
  static Result<PublishReport> publish(const OpenProject& open, const fs::path& folder, bool oneFile = false,
                                       std::stop_token stop = {}, const Progress& progress = {}) {
    PublishOptions options;
    options.page = room / "page";
    options.oneFile = oneFile;
    options.bundle.generator = "a test";
    return publishWalk({&open, 1}, folder, options, *runner, progress, std::move(stop));
  }
  static std::map<std::string, std::string> filesIn(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file())
        files[fs::relative(entry.path(), folder).string()] = *readText(entry.path());
    return files;
  }
  /// All that lies beside the folder.
  std::vector<std::string> beside() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(parent_))
      names.push_back(entry.path().filename().string());
    return names;
  }

  static inline fs::path room;
  static inline TaskRunner* runner = nullptr;
  static inline OpenProject* baked = nullptr;
  fs::path parent_, site_;
};

TEST_F(PublishWalkTest, HasTheBundleThePageAndItsPosterAndTellsTheirSize) {
  const auto report = publish(*baked, site_);
  ASSERT_TRUE(report) << report.error().describe();
  const auto files = filesIn(site_);
  std::uint64_t bytes = 0;
  for (const auto& [name, text] : files) bytes += text.size();
  EXPECT_EQ(report->bytes, bytes);
  EXPECT_EQ(report->files, files.size());
  EXPECT_EQ(report->bundle.reused, 0u);
  EXPECT_GT(report->bundle.localBytes, 0u);
  EXPECT_TRUE(readBundle(site_));
  EXPECT_TRUE(files.contains("poster.jpg"));
  EXPECT_THAT(files.at("index.html"), HasSubstr("og:title\" content=\"small\""));
  EXPECT_THAT(beside(), testing::ElementsAre("site"));
}

TEST_F(PublishWalkTest, AsOneFileIsThePageWithAWalkThatItNames) {
  const auto report = publish(*baked, site_, true);
  ASSERT_TRUE(report) << report.error().describe();
  EXPECT_EQ(report->walk, site_ / "small.acentric");
  EXPECT_EQ(report->files, 5u) << "page, poster and walk";
  EXPECT_THAT(filesIn(site_).at("index.html"), HasSubstr("acentric-walk\" content=\"small.acentric\""));
  auto files = bundleAt(report->walk);
  ASSERT_TRUE(files) << files.error().describe();
  EXPECT_TRUE(readBundle(**files));
  EXPECT_THAT(beside(), testing::ElementsAre("site"));
  // And a folder of files in its place.
  ASSERT_TRUE(publish(*baked, site_));
  EXPECT_FALSE(fs::exists(site_ / "small.acentric"));
}

TEST_F(PublishWalkTest, AgainIsTheSameBytesFromTheSameFiles) {
  ASSERT_TRUE(publish(*baked, site_));
  const auto before = filesIn(site_);
  const auto again = publish(*baked, site_);
  ASSERT_TRUE(again) << again.error().describe();
  EXPECT_EQ(again->bundle.reused, again->bundle.cameras);
  EXPECT_EQ(filesIn(site_), before);
}

TEST_F(PublishWalkTest, WritesAnewWhatIsMadeOtherwiseOrWasDamaged) {
  ASSERT_TRUE(publish(*baked, site_));
  const auto before = filesIn(site_);
  OpenProject brighter = *baked;
  brighter.project.exposure = 1.6f;  // colours are kept as they are shown
  const auto other = publish(brighter, site_);
  ASSERT_TRUE(other) << other.error().describe();
  EXPECT_EQ(other->bundle.reused, 0u);
  ASSERT_TRUE(publish(*baked, site_));
  ASSERT_EQ(filesIn(site_), before);
  std::size_t damaged = 0;
  for (const auto& [name, text] : before) {
    if (!name.starts_with("captures/") || damaged == 2) continue;
    std::string wrong = text;
    wrong[wrong.size() / 2] = char(wrong[wrong.size() / 2] ^ 1);
    put(site_ / name, wrong);
    ++damaged;
  }
  const auto mended = publish(*baked, site_);
  ASSERT_TRUE(mended) << mended.error().describe();
  EXPECT_EQ(mended->bundle.reused, mended->bundle.cameras - 2);
  EXPECT_EQ(filesIn(site_), before);
}

TEST_F(PublishWalkTest, StoppedOrFailedLeavesWhatWasThereAndNothingBesideIt) {
  ASSERT_TRUE(publish(*baked, site_));
  const auto before = filesIn(site_);
  OpenProject brighter = *baked;
  brighter.project.exposure = 1.6f;
  for (const char* const at : {"writing captures", "writing local geometry", "writing the page"})
    for (const bool oneFile : {false, true}) {
      std::stop_source stop;
      const auto stopped =
          publish(brighter, site_, oneFile, stop.get_token(), [&](const ProgressState& state) {
            if (state.stage == at) stop.request_stop();
          });
      ASSERT_FALSE(stopped) << at;
      EXPECT_EQ(stopped.error().kind, ErrorKind::cancelled) << stopped.error().describe();
      EXPECT_EQ(filesIn(site_), before) << at;
      EXPECT_THAT(beside(), testing::ElementsAre("site")) << at;
    }
  PublishOptions options;
  options.page = room / "no-page";
  EXPECT_FALSE(publishWalk({baked, 1}, site_, options, *runner));
  EXPECT_EQ(filesIn(site_), before);
  EXPECT_THAT(beside(), testing::ElementsAre("site"));
}

TEST_F(PublishWalkTest, ReplacesNothingOfOthers) {
  ASSERT_TRUE(publish(*baked, site_));
  put(site_ / "CNAME", "example.org");
  const auto refused = publish(*baked, site_);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().describe(), HasSubstr("CNAME"));
  EXPECT_EQ(*readText(site_ / "CNAME"), "example.org");
  const auto file = publish(*baked, site_ / "CNAME");
  ASSERT_FALSE(file);
  EXPECT_THAT(file.error().describe(), HasSubstr("no folder"));
}

TEST_F(PublishWalkTest, TellsWhatIsNotBaked) {
  EXPECT_EQ(bakeGaps({baked, 1})->describe(), "");
  OpenProject other = *baked;
  other.keys[0].low ^= 1;
  const auto one = bakeGaps({&other, 1});
  ASSERT_TRUE(one);
  EXPECT_FALSE(one->all());
  EXPECT_EQ(one->describe(), "1 of " + std::to_string(other.keys.size()) + " captures is not baked yet");
  other.surfaceLightKey.low ^= 1;
  EXPECT_THAT(bakeGaps({&other, 1})->describe(),
              HasSubstr("and the light of near surfaces are not baked yet"));
  for (ContentKey& key : other.keys) key.high ^= 1;
  EXPECT_TRUE(bakeGaps({&other, 1})->any());
}

}  // namespace
}  // namespace acentric
