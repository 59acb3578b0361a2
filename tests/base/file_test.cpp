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
  ASSERT_TRUE(writeFileAtomically(folder_ / "a.txt", {}));
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

TEST_F(FileTest, RemovesTemporariesOfDeadProcessesOnly) {
  std::ofstream(folder_ / (std::string(kTemporaryPrefix) + "999999999-0.exr")) << "x";
  std::ofstream(folder_ / (std::string(kTemporaryPrefix) + std::to_string(::getpid()) + "-0.exr")) << "x";
  std::ofstream(folder_ / "kept.exr") << "x";
  EXPECT_EQ(removeStaleTemporaries(folder_), 1);
  EXPECT_EQ(filesInFolder(), 2u);
}

TEST_F(FileTest, NamesTheFileThatCannotBeRead) {
  const auto missing = readText(folder_ / "none.txt");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, ErrorKind::notFound);
  EXPECT_NE(missing.error().describe().find("none.txt"), std::string::npos);
  EXPECT_FALSE(readText(folder_));
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
