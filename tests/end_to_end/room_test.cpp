/// A disk without room: a real file system of a few megabytes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Runs shell commands where `folder` is a disk of its own of so many kilobytes, mounted for them alone.
ProcessResult onSmallDisk(const fs::path& folder, int kilobytes, const std::string& commands) {
  return runProcess(
      {"unshare", "--mount", "bash", "-c",
       "mount -t tmpfs -o size=" + std::to_string(kilobytes) + "k tmpfs \"$1\" || exit 9; shift; " + commands,
       "bash", folder.string(), ACENTRIC_PROGRAM});
}

class SmallDiskTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(project.captures());
    if (onSmallDisk(project.captures(), 100, "true").exitCode != 0)
      GTEST_SKIP() << "a file system can be mounted by root only";
    ASSERT_EQ(project.made().exitCode, 0) << project.made().errors;
  }
  SampleProject project{"room"};
};

TEST_F(SmallDiskTest, IsRefusedBeforeTheBakeBegins) {
  const auto ran = onSmallDisk(project.captures(), 300,
                               "\"$1\" bake '" + project.file() + "'; echo code $?; ls -A '" +
                                   project.captures().string() + "' | wc -l");
  EXPECT_THAT(ran.errors, HasSubstr("MB are free: make room"));
  EXPECT_THAT(ran.output, HasSubstr("code 1\n0\n")) << "nothing was written";
}

TEST_F(SmallDiskTest, IsRefusedBeforeThePreviewsIfTheRestHasNoRoom) {
  // Previews and light would find room, and a sixteenth of a bake is soon done.
  const auto ran = onSmallDisk(project.captures(), 2000,
                               "\"$1\" bake --coarse-first '" + project.file() + "'; echo code $?; ls -A '" +
                                   project.captures().string() + "' | wc -l");
  EXPECT_THAT(ran.errors, HasSubstr("for previews and captures, 2 MB are free: make room"));
  EXPECT_THAT(ran.output, HasSubstr("code 1\n0\n")) << "nothing was written";
}

TEST_F(SmallDiskTest, ThatCannotBeWrittenIsNamedAtOnceWithTheWayOut) {
  const std::string bake = "\"$1\" bake '" + project.file() + "'; echo code $?";
  const std::string captures = "'" + project.captures().string() + "'";
  const auto empty = onSmallDisk(project.captures(), 65536, "mount -o remount,ro " + captures + "; " + bake);
  // Or the folder of captures cannot even be made.
  const auto none =
      onSmallDisk(project.captures(), 100,
                  "umount " + captures + "; rmdir " + captures + "; cd /; mount --bind '" +
                      project.folder().string() + "' '" + project.folder().string() +
                      "'; mount -o remount,ro,bind '" + project.folder().string() + "'; " + bake);
  for (const auto& ran : {empty, none}) {
    EXPECT_THAT(ran.output, HasSubstr("code 1\n"));
    EXPECT_THAT(ran.errors, HasSubstr(project.captures().string()));
    EXPECT_THAT(ran.errors, HasSubstr("Read-only file system"));
    EXPECT_THAT(ran.errors, HasSubstr("make the folder writable, or bake a copy of the project"));
  }
}

TEST_F(SmallDiskTest, ThatFillsUpLeavesNoPartAndGoesOnWhenThereIsRoom) {
  // What it would need is there when the bake begins; then another program takes the room.
  const std::string captures = "'" + project.captures().string() + "'", file = "'" + project.file() + "'";
  const auto ran =
      onSmallDisk(project.captures(), 65536,
                  "(until [ $(ls " + captures +
                      " | grep -c record) -ge 5 ]; do sleep 0.01; done;"
                      " head -c 200M /dev/zero > " +
                      captures +
                      "/other 2> /dev/null) & "
                      "\"$1\" bake " +
                      file +
                      "; echo full $?; wait;"
                      " echo temporaries $(ls -A " +
                      captures +
                      " | grep -c acentric-tmp);"
                      " echo alone $(cd " +
                      captures +
                      "; for f in *.record; do r=${f%.record};"
                      " [ -e $r.pack -o -e surface-$r.light ] || echo $f; done | wc -l);"
                      " rm " +
                      captures +
                      "/other;"
                      " \"$1\" validate " +
                      file +
                      " --json | grep -c damaged;"
                      " \"$1\" bake " +
                      file + "; echo again $?; \"$1\" bake " + file + " --verify; echo sound $?");
  EXPECT_THAT(ran.output, HasSubstr("full 1\n"));
  EXPECT_THAT(ran.errors, HasSubstr("No space left on device"));
  EXPECT_THAT(ran.errors, HasSubstr("make room and bake again"));
  EXPECT_THAT(ran.output, HasSubstr("temporaries 0\n"));
  EXPECT_THAT(ran.output, HasSubstr("alone 0\n"));
  EXPECT_THAT(ran.output, HasSubstr("again 0\n"));
  EXPECT_THAT(ran.output, HasSubstr("sound 0\n"));
}

}  // namespace
}  // namespace acentric::test
