#include "engine/base/link_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "engine/base/file.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

TEST(LinkFile, IsALinkOnOneDiskACopyOnAnotherAndTellsOfAFailure) {
  const std::string name = "acentric_link_" + std::to_string(::getpid());
  const fs::path folder = fs::temp_directory_path() / name, other = fs::path("/dev/shm") / name;
  std::error_code error;
  fs::create_directories(folder);
  fs::create_directories(other, error);
  const fs::path from = folder / "from";
  ASSERT_TRUE(writeTextAtomically(from, "text"));
  ASSERT_TRUE(linkOrCopyFile(from, folder / "to"));
  EXPECT_EQ(*readText(folder / "to"), "text");
  if (!error) {
    ASSERT_TRUE(linkOrCopyFile(from, other / "to"));
    EXPECT_EQ(*readText(other / "to"), "text");
  }
  EXPECT_FALSE(linkOrCopyFile(folder / "none", folder / "third"));
  EXPECT_FALSE(fs::exists(folder / "third"));
  fs::remove_all(folder);
  fs::remove_all(other, error);
}

}  // namespace
}  // namespace acentric
