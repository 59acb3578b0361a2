/// Machines that are not a person's desk: process 1 of a container, and users without a home.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "engine/base/file.h"
#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

const char* const kTriangle = "v -4 -4 0\nv 4 -4 0\nv 4 4 0\nv -4 4 0\nf 1 2 3 4\n";

class Environment : public testing::Test {
 protected:
  void SetUp() override {
    model = folder.path() / "floor.obj";
    ASSERT_TRUE(writeTextAtomically(model, kTriangle));
  }
  ProcessResult run(std::vector<std::string> before, const std::string& project) {
    for (const std::string& word :
         {std::string(ACENTRIC_PROGRAM), std::string("new"), model.string(), std::string("--up"),
          std::string("z"), std::string("-o"), (folder.path() / project).string()})
      before.push_back(word);
    return runProcess(before);
  }
  TemporaryFolder folder{"environment"};
  std::filesystem::path model;
};

TEST_F(Environment, ImportsWorkAsProcessOne) {
  const std::vector<std::string> inside{"unshare", "--fork", "--pid"};
  std::vector<std::string> nothing = inside;
  nothing.push_back("true");
  if (runProcess(nothing).exitCode != 0) GTEST_SKIP() << "no namespaces of processes may be made here";
  const ProcessResult made = run(inside, "one.acentric.json");
  EXPECT_EQ(made.exitCode, 0) << made.errors;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "one.acentric.json"));
}

TEST_F(Environment, WithoutAHomeEverythingWorksAndItIsSaidOnceWhereImportsAreKept) {
  const ProcessResult made =
      run({"env", "-u", "XDG_CACHE_HOME", "HOME=/dev/null", "TMPDIR=" + folder.path().string()},
          "two.acentric.json");
  EXPECT_EQ(made.exitCode, 0) << made.errors;
  const std::string words = "imports are kept in " + folder.path().string();
  const auto first = made.errors.find(words);
  EXPECT_NE(first, std::string::npos) << made.errors;
  EXPECT_EQ(made.errors.find(words, first + 1), std::string::npos);
  // What bakes on several machines remember of their plan is kept there too.
  const std::string project = (folder.path() / "two.acentric.json").string();
  const ProcessResult part =
      runProcess({"env", "-u", "XDG_CACHE_HOME", "HOME=/dev/null", "TMPDIR=" + folder.path().string(),
                  ACENTRIC_PROGRAM, "bake", project, "--quality", "preview", "--shard", "1/9"});
  EXPECT_EQ(part.exitCode, 0) << part.errors;
  const auto kept = folder.path() / fmt::format("acentric-{}", static_cast<unsigned>(::geteuid())) / "plans";
  ASSERT_TRUE(std::filesystem::exists(kept));
  EXPECT_FALSE(std::filesystem::is_empty(kept));
  const ProcessResult usual =
      run({"env", "XDG_CACHE_HOME=" + (folder.path() / "cache").string()}, "three.acentric.json");
  EXPECT_EQ(usual.exitCode, 0) << usual.errors;
  EXPECT_EQ(usual.errors.find("imports are kept"), std::string::npos);
}

}  // namespace
}  // namespace acentric::test
