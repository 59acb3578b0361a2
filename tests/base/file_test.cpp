#include "engine/base/file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "engine/base/hash.h"

namespace acentric {
namespace {
namespace fs = std::filesystem;

class FileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("acentric-file-test-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::size_t filesInFolder() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}));
  }
  fs::path folder_;
};

TEST_F(FileTest, WritesWhatItReads) {
  ASSERT_TRUE(writeTextAtomically(folder_ / "a.txt", "one\ntwo"));
  EXPECT_EQ(readText(folder_ / "a.txt").value(), "one\ntwo");
  ASSERT_TRUE(writeTextAtomically(folder_ / "a.txt", ""));
  EXPECT_EQ(readText(folder_ / "a.txt").value(), "");
  ASSERT_TRUE(writeFileAtomically(folder_ / "a.txt", std::span<const std::byte>{}));
  EXPECT_EQ(readText(folder_ / "a.txt").value(), "");
}

TEST_F(FileTest, AFailedWriteLeavesTheOldFileAndNoTemporary) {
  ASSERT_TRUE(writeTextAtomically(folder_ / "a.txt", "old"));
  const Status status = replaceFileAtomically(folder_ / "a.txt", [](const fs::path& temporary) -> Status {
    std::ofstream(temporary) << "half";
    return fail(ErrorKind::outOfSpace, "disk is full");
  });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::outOfSpace);
  EXPECT_EQ(readText(folder_ / "a.txt").value(), "old");
  EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(FileTest, WritesPartsOneBehindTheOtherAcrossThePiecesItFlushes) {
  std::vector<std::byte> big(9'000'001);
  for (std::size_t i = 0; i < big.size(); ++i) big[i] = std::byte(i * 2654435761u >> 24);
  const std::span<const std::byte> all(big),
      parts[] = {all.first(5), {}, all.subspan(5, 8'000'000), all.subspan(8'000'005)};
  ASSERT_TRUE(writeFileAtomically(folder_ / "big", parts));
  EXPECT_EQ(readFile(folder_ / "big").value(), big);
}

TEST_F(FileTest, AStoppedWriteLeavesTheOldFileAndNoTemporary) {
  ASSERT_TRUE(writeTextAtomically(folder_ / "a.txt", "old"));
  std::stop_source stop;
  stop.request_stop();
  const std::vector<std::byte> bytes(100);
  const Status status = writeFileAtomically(folder_ / "a.txt", bytes, stop.get_token());
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::cancelled);
  EXPECT_EQ(readText(folder_ / "a.txt").value(), "old");
  EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(FileTest, RemovesTemporariesOfDeadProcessesOfThisMachineOnly) {
  const std::string mine = temporaryNameStart();
  const std::string process = std::to_string(::getpid()) + "-";
  ASSERT_TRUE(mine.starts_with(kTemporaryPrefix) && mine.ends_with("-" + process));
  const std::string here = mine.substr(0, mine.size() - process.size());
  const std::string elsewhere = std::string(kTemporaryPrefix) + "00000000-";
  std::ofstream(folder_ / (here + "999999999-0.exr")) << "dead";
  std::ofstream(folder_ / (mine + "0.exr")) << "alive";
  std::ofstream(folder_ / (elsewhere + "999999999-0.exr")) << "who knows";
  std::ofstream(folder_ / "kept.exr") << "x";
  EXPECT_EQ(removeStaleTemporaries(folder_), 1);
  EXPECT_EQ(filesInFolder(), 3u);
}

TEST_F(FileTest, RemovesTemporariesThatNobodyHasWrittenToForADay) {
  const auto written = folder_ / (std::string(kTemporaryPrefix) + "00000000-1-0.exr");
  std::ofstream(written) << "another machine's";
  std::filesystem::last_write_time(written,
                                   std::filesystem::file_time_type::clock::now() - std::chrono::hours(23));
  EXPECT_EQ(removeStaleTemporaries(folder_), 0);
  std::filesystem::last_write_time(written,
                                   std::filesystem::file_time_type::clock::now() - std::chrono::hours(25));
  EXPECT_EQ(removeStaleTemporaries(folder_), 1);
}

TEST_F(FileTest, TriesWhetherAFolderCanBeWrittenAndLeavesNothing) {
  EXPECT_TRUE(checkWritable(folder_));
  EXPECT_EQ(filesInFolder(), 0u);
  const Status missing = checkWritable(folder_ / "none");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().where, (folder_ / "none").string());
}

TEST_F(FileTest, NamesTheFileThatCannotBeRead) {
  const auto missing = readText(folder_ / "none.txt");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, ErrorKind::notFound);
  EXPECT_NE(missing.error().describe().find("none.txt"), std::string::npos);
  EXPECT_FALSE(readText(folder_));
}

TEST_F(FileTest, RefusesNamesWithANulRatherThanCutThem) {
  ASSERT_TRUE(writeTextAtomically(folder_ / "a.txt", "text"));
  const std::filesystem::path name = folder_ / std::string("a.txt\0.png", 10);
  const auto read = readText(name);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::invalidArgument);
  EXPECT_EQ(writeTextAtomically(name, "other").error().kind, ErrorKind::invalidArgument);
  EXPECT_EQ(readText(folder_ / "a.txt").value(), "text");
}

TEST_F(FileTest, SaysThatAFolderHasTheNameOfWhatIsWritten) {
  std::filesystem::create_directories(folder_ / "taken");
  const Status written = writeTextAtomically(folder_ / "taken", "text");
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("a folder has this name"), std::string::npos);
}

TEST_F(FileTest, RefusesFilesAboveTheLimit) {
  ASSERT_TRUE(writeTextAtomically(folder_ / "big.txt", std::string(2000, 'x')));
  const auto read = readText(folder_ / "big.txt", 1000);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::tooLarge);
}

TEST(Hash, KeysDifferByContentAndByBoundaries) {
  const auto key = [](auto... parts) {
    Hasher hasher;
    (hasher.text(parts), ...);
    return hasher.finish();
  };
  EXPECT_EQ(key("ab", "c"), key("ab", "c"));
  EXPECT_NE(key("ab", "c"), key("a", "bc"));
  EXPECT_EQ(Hasher().value(0.0).finish(), Hasher().value(-0.0).finish());
}

TEST(Hash, HexRoundTrips) {
  const ContentKey key = Hasher().text("x").finish();
  EXPECT_EQ(ContentKey::fromHex(key.toHex()).value(), key);
  EXPECT_FALSE(ContentKey::fromHex("12"));
  EXPECT_FALSE(ContentKey::fromHex(std::string(32, 'g')));
}

}  // namespace
}  // namespace acentric
