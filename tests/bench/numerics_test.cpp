#include "engine/bench/numerics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/pipeline/small_project.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

class BenchNumerics : public FolderTest {};

double valueOf(const NumericsTable& table, const std::string& cases, const std::string& way,
               std::size_t column) {
  for (const NumericsRow& row : table.rows)
    if (row.cases.starts_with(cases) && row.way.starts_with(way)) return row.values[column];
  ADD_FAILURE() << "no row " << cases << ", " << way;
  return 0;
}

TEST_F(BenchNumerics, SaysWhatFloatsNaiveSignsAndFewerBitsCost) {
  test::SceneBuilder builder;
  const int matte = builder.material(test::matte());
  builder.box(matte, {-4, -4, 0}, {4, 4, 3}, true).box(matte, {1.5f, 1, 0}, {2, 1.5f, 3});
  builder.point({0, 0, 2.5f}, 50);
  Project project = test::smallProject(0.5, 2);
  project.bake.ambientRays = 0;
  const OpenProject open = test::openWith(builder.rays(), project, folder_ / "room.acentric.json");
  TaskRunner runner(1);
  BakeRequest request;
  request.surfaceLight = false;
  ASSERT_TRUE(bakeProject(open, request, runner));
  PerspectiveView view;
  view.eye = {0.1, 0.05, open.layout->eyeZ()};
  view.width = 160, view.height = 90;
  const auto numerics = benchNumerics(open, {view}, {1}, runner);
  ASSERT_TRUE(numerics) << numerics.error().describe();
  ASSERT_EQ(numerics->size(), 3u);

  const NumericsTable& warp = numerics->at(0);
  EXPECT_LT(valueOf(warp, "frames", "float, one", 0), 5) << "per cent of the pixels";
  EXPECT_EQ(valueOf(warp, "frames", "float, one", 0), valueOf(warp, "frames", "float, vectors", 0))
      << "all kernels in floats give the same bits";
  EXPECT_LT(valueOf(warp, "5000 km", "float, vectors", 0), 5);
  EXPECT_GT(valueOf(warp, "5000 km", "places in floats", 0), 20);
  EXPECT_TRUE(std::isnan(valueOf(warp, "frames", "double", 0))) << "the reference";

  const NumericsTable& signs = numerics->at(1);
  for (const char* cases : {"points anywhere", "points on borders", "on borders, 5000 km"})
    EXPECT_EQ(valueOf(signs, cases, "exact", 0), 0);
  EXPECT_GT(valueOf(signs, "points on borders", "naive in floats", 0), 10);

  const NumericsTable& distances = numerics->at(2);
  double last = 1e9;
  for (const char* bits : {"12", "16", "20", "24", "32"}) {
    const double shift = valueOf(distances, "what the walk shows", bits, 1);
    EXPECT_LT(shift, last) << bits << " bits";
    last = shift;
  }
  EXPECT_LT(valueOf(distances, "1 mm to 10 km", "24 bits", 2), 0.1) << "pixels";
  EXPECT_GT(valueOf(distances, "1 mm to 10 km", "16 bits, even steps of distance", 2), 1);
  EXPECT_LT(valueOf(distances, "what the walk shows", "16 bits of a float", 3),
            valueOf(distances, "what the walk shows", "32", 3))
      << "fewer bits take fewer bytes";
}

}  // namespace
}  // namespace acentric
