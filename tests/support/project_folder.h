#pragma once
/// A folder with a project file in it, gone after the test, and work done in it by another process.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace acentric::test {

class ProjectFolder : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("acentric_project_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    file_ = folder_ / "walk.acentric.json";
    std::ofstream(file_) << "{}";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Runs it in a process of its own, which then ends without tidying up: as by a kill.
  template <class Work>
  static void inAnotherProcess(Work work) {
    const pid_t child = ::fork();
    if (child == 0) {
      work();
      ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_EQ(status, 0);
  }
  void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::trunc) << text;
  }

  std::filesystem::path folder_, file_;
};

}  // namespace acentric::test
