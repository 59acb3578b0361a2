/// The window's place on each monitor, kept in a file that anybody may have changed.

#include "editor/session/window_places.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace acentric::editor {
namespace {

namespace fs = std::filesystem;

class WindowPlacesTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("acentric_windows_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path file() const { return folder_ / "state" / "windows.json"; }

  fs::path folder_;
};

TEST_F(WindowPlacesTest, EachMonitorKeepsItsOwnTheNewestFirst) {
  EXPECT_TRUE(loadWindowPlaces(file()).empty());
  const ui::WindowPlace first{"A", {1280, 720}, {{4, 5}, {600, 500}}, true};
  const ui::WindowPlace second{"B\"\n", {9, 8}, {{-7, 6}, {5, 4}}, false};
  const ui::WindowPlace moved{"A", {1280, 720}, {{40, 50}, {700, 600}}, false};
  for (const ui::WindowPlace& place : {first, second, moved})
    ASSERT_TRUE(keepWindowPlace(place, file()).has_value());
  EXPECT_EQ(loadWindowPlaces(file()), (std::vector<ui::WindowPlace>{moved, second}));
  EXPECT_TRUE(keepWindowPlace(first, {}).has_value()) << "without a home nothing is kept";
}

TEST_F(WindowPlacesTest, WhatIsDamagedIsLeftOutAndWrittenOver) {
  fs::create_directories(file().parent_path());
  const ui::WindowPlace sound{"A", {1, 2}, {{3, 4}, {5, 6}}, false};
  for (const char* damage : {"", "{", "7", "{}", "[7,{},null]", R"([{"monitor":7}])",
                             R"([{"monitor":"A","monitorSize":[1,2],"at":[0,1e99],"size":[1,2]}])",
                             R"([{"monitor":"A","monitorSize":[1,2],"at":[0,0],"size":[1]}])",
                             R"([{"monitor":"A","monitorSize":[1,"2"],"at":[0,0],"size":[1,2]}])"}) {
    std::ofstream(file(), std::ios::trunc) << damage;
    EXPECT_TRUE(loadWindowPlaces(file()).empty()) << damage;
    ASSERT_TRUE(keepWindowPlace(sound, file()).has_value()) << damage;
    EXPECT_EQ(loadWindowPlaces(file()), std::vector<ui::WindowPlace>{sound}) << damage;
  }
  std::ofstream(file(), std::ios::trunc)
      << R"([{}, {"monitor":"A","monitorSize":[1,2],"at":[3,4],"size":[5,6],"maximised":"x"}])";
  EXPECT_EQ(loadWindowPlaces(file()), std::vector<ui::WindowPlace>{sound});
}

}  // namespace
}  // namespace acentric::editor
