/// Where a walk begins, as it is shown and set on the command line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/file.h"
#include "engine/pipeline/project.h"
#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

using testing::HasSubstr;

TEST(Start, IsShownSetAndFoundAnew) {
  TemporaryFolder folder{"start"};
  const std::string project = (folder.path() / "room.acentric.json").string();
  const std::string model = (folder.path() / "room.obj").string();
  ASSERT_TRUE(writeTextAtomically(
      model, "# File units = meters\nv -9 0 4\nv 9 0 4\nv 9 0 -4\nv -9 0 -4\nf 1 2 3 4\n"));
  const auto start = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {ACENTRIC_PROGRAM, "start", project});
    return runProcess(more);
  };
  ASSERT_EQ(runProcess({ACENTRIC_PROGRAM, "new", model, "--up", "y", "-o", project}).exitCode, 0);
  const auto begun = loadProject(project);
  ASSERT_TRUE(begun);

  const ProcessResult set = start({"--at", "1.5,-2", "--yaw", "90"});
  ASSERT_EQ(set.exitCode, 0) << set.errors;
  EXPECT_THAT(start({}).output, HasSubstr("the walk begins at (1.50, -2.00) m, looking 90.0 degrees"));
  const ProcessResult outside = start({"--at", "500,0"});
  EXPECT_EQ(outside.exitCode, 1);
  EXPECT_THAT(outside.errors, HasSubstr("the nearest place to stand is"));
  EXPECT_THAT(start({}).output, HasSubstr("(1.50, -2.00)")) << "a refused place changes nothing";

  ASSERT_EQ(start({"--find"}).exitCode, 0);
  EXPECT_EQ(loadProject(project)->spawn(), begun->spawn()) << "as in the new project";
}

}  // namespace
}  // namespace acentric::test
