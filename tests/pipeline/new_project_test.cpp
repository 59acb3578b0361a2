#include "engine/pipeline/new_project.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

class NewProjectTest : public FolderTest {
 protected:
  /// Of ground of 80 x 80 m, and a roof of 20 x 20 m over a part of it, both laid out.
  Result<NewProject> makeYard(NewProjectOptions options) const {
    std::ofstream(folder_ / "yard.obj") << "v -40 -40 0\nv 40 -40 0\nv 40 40 0\nv -40 40 0\n"
                                           "v 0 0 4\nv 20 0 4\nv 20 20 4\nv 0 20 4\n"
                                           "f 1 2 3 4\nf 5 6 7 8\n";
    ImportHost host;
    host.importer = ACENTRIC_IMPORTER;
    options.import.up = UpAxis::z;
    options.everyStorey = true;
    options.cellSize = 3;
    TaskRunner runner(1);
    return makeProject(folder_ / "yard.obj", folder_ / "yard.acentric.json", options, host, runner);
  }
};

TEST_F(NewProjectTest, EveryStoreyHasCellsHoweverSmallItsShareIs) {
  NewProjectOptions options;
  options.bakeMinutes = 0.01;  // of two cells or so
  const auto made = makeYard(options);
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

TEST_F(NewProjectTest, StoreysKeepToTheMostCamerasTogether) {
  NewProjectOptions options;
  options.bakeMinutes = 0;
  options.mostCameras = 60;
  const auto made = makeYard(options);
  ASSERT_TRUE(made) << made.error().describe();
  std::size_t cameras = 0;
  for (const Storey& storey : made->open.project.storeys) {
    const auto layout = buildLayout(storey.layout);
    ASSERT_TRUE(layout) << layout.error().describe();
    EXPECT_GT(layout->cameras.size(), 0U) << storey.name;
    cameras += layout->cameras.size();
  }
  EXPECT_LE(cameras, options.mostCameras);
}

}  // namespace
}  // namespace acentric
