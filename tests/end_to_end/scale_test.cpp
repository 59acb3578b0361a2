/// The question about a model's scale, as a person meets it on the command line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/file.h"
#include "tests/end_to_end/sample_project.h"

namespace acentric::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Scale, OfALandTooLargeForItsCellsIsAskedAboutWhereNoProjectCanBeMade) {
  TemporaryFolder folder{"scale"};
  const std::string model = (folder.path() / "land.obj").string();
  const std::string project = (folder.path() / "land.acentric.json").string();
  ASSERT_TRUE(writeTextAtomically(
      model, "# File units = meters\nv 0 0 0\nv 90000 0 0\nv 90000 9 -90000\nv 0 9 -90000\nf 1 2 3 4\n"));
  const ProcessResult refused = runProcess({ACENTRIC_PROGRAM, "new", model, "--up", "y", "--cell", "6",
                                            "--max-cameras", "0", "--bake-minutes", "0", "-o", project});
  EXPECT_EQ(refused.exitCode, 1);
  EXPECT_THAT(refused.errors, HasSubstr("it is 127 km across; at 0.01 metres per unit"));
  EXPECT_THAT(refused.errors, HasSubstr("--metres-per-unit 0.01"));

  const ProcessResult large =
      runProcess({ACENTRIC_PROGRAM, "new", model, "--up", "y", "--no-estimate", "-o", project});
  ASSERT_EQ(large.exitCode, 0) << large.errors;
  EXPECT_THAT(large.output, AllOf(HasSubstr("large cells: "), HasSubstr("--metres-per-unit 0.01")));

  const ProcessResult made = runProcess(
      {ACENTRIC_PROGRAM, "new", model, "--force", "--up", "y", "--metres-per-unit", "0.001", "-o", project});
  ASSERT_EQ(made.exitCode, 0) << made.errors;
  const ProcessResult larger = runProcess(
      {ACENTRIC_PROGRAM, "model", project, "--metres-per-unit", "0.002", "--light", "in-textures"});
  EXPECT_EQ(larger.exitCode, 0) << larger.errors;
  EXPECT_THAT(runProcess({ACENTRIC_PROGRAM, "model", project}).output,
              HasSubstr("0.002 metres per unit, light in-textures"));
  EXPECT_THAT(runProcess({ACENTRIC_PROGRAM, "info", project}).output, HasSubstr("180.00 x 180.00"));
}

}  // namespace
}  // namespace acentric::test
