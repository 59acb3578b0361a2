/// A browser is asked for by xdg-open, and whoever has none is told the address.

#include "engine/serve/browser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "engine/base/file.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class BrowserTest : public testing::Test {
 protected:
  void SetUp() override {
    const char* path = std::getenv("PATH");
    before_ = path == nullptr ? "" : path;
    folder_ = fs::path(testing::TempDir()) / ("browser-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    ::setenv("PATH", folder_.c_str(), 1);
  }
  void TearDown() override {
    ::setenv("PATH", before_.c_str(), 1);
    fs::remove_all(folder_);
  }
  void putOpener(const std::string& script) {
    ASSERT_TRUE(writeTextAtomically(folder_ / "xdg-open", "#!/bin/sh\n" + script));
    fs::permissions(folder_ / "xdg-open", fs::perms::owner_all);
  }
  template <class Done>
  static bool within(const Done& done) {
    for (int i = 0; i < 1000; ++i) {
      if (done()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  fs::path folder_;
  std::string before_;
  Browser browser_;
};

TEST_F(BrowserTest, IsGivenTheAddress) {
  putOpener("echo \"$1\" > " + (folder_ / "asked").string());
  ASSERT_TRUE(browser_.open("http://127.0.0.1:8000/#at=1,2,3,4"));
  EXPECT_TRUE(within(
      [&] { return readText(folder_ / "asked").value_or("") == "http://127.0.0.1:8000/#at=1,2,3,4\n"; }));
  EXPECT_FALSE(browser_.takeTrouble());
}

TEST_F(BrowserTest, ThatCannotBeHadIsToldWithTheAddress) {
  const Status none = browser_.open("http://127.0.0.1:8000/");
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().describe(), HasSubstr("xdg-utils"));
  EXPECT_THAT(none.error().describe(), HasSubstr("http://127.0.0.1:8000/"));
}

TEST_F(BrowserTest, ThatXdgOpenDoesNotFindIsToldOnce) {
  putOpener("exit 3\n");
  ASSERT_TRUE(browser_.open("http://127.0.0.1:8000/"));
  std::optional<Error> trouble;
  ASSERT_TRUE(within([&] { return (trouble = browser_.takeTrouble()).has_value(); }));
  EXPECT_THAT(trouble->describe(), HasSubstr("http://127.0.0.1:8000/"));
  EXPECT_FALSE(browser_.takeTrouble());
}

}  // namespace
}  // namespace acentric
