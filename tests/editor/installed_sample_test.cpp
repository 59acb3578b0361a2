/// The sample as it is installed, and each user's copy of it.

#include "editor/session/installed_sample.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "engine/base/file.h"

namespace acentric::editor {
namespace {

namespace fs = std::filesystem;

class InstalledSampleTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("acentric_sample_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(installed() / "paths");
    write(installed() / "gallery.acentric.json", "project");
    write(installed() / "gallery.glb", "model");
    write(installed() / "paths" / "walk.json", "path");
  }
  void TearDown() override { fs::remove_all(folder_); }
  static void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }
  fs::path installed() const { return folder_ / "prefix/share/acentric/sample"; }
  fs::path data() const { return folder_ / "home/.local/share/acentric"; }

  fs::path folder_;
};

TEST_F(InstalledSampleTest, IsFoundFromTheProgramUnderAnyPrefix) {
  EXPECT_EQ(installedSample(folder_ / "prefix/bin/acentric-editor"), installed());
  EXPECT_TRUE(installedSample(folder_ / "elsewhere/bin/acentric-editor").empty());
  fs::remove(installed() / "gallery.acentric.json");
  EXPECT_TRUE(installedSample(folder_ / "prefix/bin/acentric-editor").empty());
}

TEST_F(InstalledSampleTest, IsCopiedOnceAndWhatTheUserDidToItStays) {
  const auto first = copyOfSample(installed(), data());
  ASSERT_TRUE(first) << first.error().describe();
  EXPECT_EQ(*first, data() / "gallery/gallery.acentric.json");
  EXPECT_EQ(readText(data() / "gallery/gallery.glb").value_or(""), "model");
  EXPECT_EQ(readText(data() / "gallery/paths/walk.json").value_or(""), "path");
  write(*first, "edited");
  const auto second = copyOfSample(installed(), data());
  ASSERT_TRUE(second);
  EXPECT_EQ(readText(*second).value_or(""), "edited");
  EXPECT_EQ(std::distance(fs::directory_iterator(data()), fs::directory_iterator()), 1)
      << "nothing but the copy is left";
}

TEST_F(InstalledSampleTest, NothingHalfIsLeftWhereItCannotBeCopied) {
  fs::create_directories(data() / "gallery");
  write(data() / "gallery/mine.txt", "somebody's");
  const auto copied = copyOfSample(installed(), data());
  ASSERT_FALSE(copied);
  EXPECT_NE(copied.error().describe().find((data() / "gallery").string()), std::string::npos);
  EXPECT_EQ(std::distance(fs::directory_iterator(data()), fs::directory_iterator()), 1);
  EXPECT_EQ(readText(data() / "gallery/mine.txt").value_or(""), "somebody's");
}

}  // namespace
}  // namespace acentric::editor
