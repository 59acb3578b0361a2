#include "engine/pipeline/new_project.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

class NewProjectTest : public FolderTest {};

TEST_F(NewProjectTest, EveryStoreyHasCellsHoweverSmallItsShareIs) {
  // Ground of 80 x 80 m, and a roof of 20 x 20 m over a part of it.
  std::ofstream(folder_ / "yard.obj") << "v -40 -40 0\nv 40 -40 0\nv 40 40 0\nv -40 40 0\n"
                                         "v 0 0 4\nv 20 0 4\nv 20 20 4\nv 0 20 4\n"
                                         "f 1 2 3 4\nf 5 6 7 8\n";
  ImportHost host;
  host.importer = ACENTRIC_IMPORTER;
  NewProjectOptions options;
  options.import.up = UpAxis::z;
  options.everyStorey = true;
  options.cellSize = 3;
  options.bakeMinutes = 0.01;  // of two cells or so
  TaskRunner runner(1);
  const auto made = makeProject(folder_ / "yard.obj", folder_ / "yard.acentric.json", options, host, runner);
  ASSERT_TRUE(made) << made.error().describe();
  EXPECT_EQ(made->limitedBy, LimitedBy::minutes);
  const auto& storeys = made->open.project.storeys;
  ASSERT_EQ(storeys.size(), 2U);
  for (const Storey& storey : storeys) {
    const auto layout = buildLayout(storey.layout);
    ASSERT_TRUE(layout) << layout.error().describe();
    EXPECT_GT(layout->regions.size(), 0U) << storey.name;
    EXPECT_LE(layout->cameras.size(), kFewestCameras) << storey.name;
  }
}

}  // namespace
}  // namespace acentric
