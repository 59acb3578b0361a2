#include "engine/base/mapped_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/file.h"
#include "tests/support/process.h"

namespace acentric::test {
namespace {

std::string textOf(const MappedFile& file) {
  return {reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()};
}

TEST(MappedFile, HasTheBytesOfTheFileItWasOpenedAs) {
  const TemporaryFolder folder("mapped_file");
  const auto path = folder.path() / "a";
  ASSERT_TRUE(writeTextAtomically(path, "first"));
  const auto first = MappedFile::open(path);
  ASSERT_TRUE(first) << first.error().describe();
  ASSERT_TRUE(writeTextAtomically(path, "second, and longer"));
  const auto second = MappedFile::open(path);
  ASSERT_TRUE(second);
  std::filesystem::remove(path);
  EXPECT_EQ(textOf(**first), "first");
  EXPECT_EQ(textOf(**second), "second, and longer");
}

TEST(MappedFile, MayBeEmpty) {
  const TemporaryFolder folder("mapped_file");
  ASSERT_TRUE(writeTextAtomically(folder.path() / "empty", ""));
  const auto file = MappedFile::open(folder.path() / "empty");
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_TRUE((*file)->bytes().empty());
}

TEST(MappedFile, SaysWhyThereIsNone) {
  const TemporaryFolder folder("mapped_file");
  const auto missing = MappedFile::open(folder.path() / "missing");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, ErrorKind::notFound);
  EXPECT_THAT(missing.error().describe(), testing::HasSubstr("missing"));
  const auto directory = MappedFile::open(folder.path());
  ASSERT_FALSE(directory);
  EXPECT_EQ(directory.error().kind, ErrorKind::unreadable);
}

}  // namespace
}  // namespace acentric::test
