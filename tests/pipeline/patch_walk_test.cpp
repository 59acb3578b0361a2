/// Captures with silhouettes from the scene to the frame.

#include <set>

#include "engine/bake/truth.h"
#include "engine/measure/compare.h"
#include "engine/view/patch_tiles.h"
#include "tests/pipeline/baked_room.h"
#include "tests/pipeline/hall_of_blocks.h"

namespace acentric {
namespace {

/// With a slanted board.
RayScenePtr hall() {
  test::SceneBuilder builder = test::hallOfBlocks();
  builder.quad(builder.material(test::glowing({0.8f, 0.7f, 0.1f})), {5, -3, 0.2f}, {5.5f, 3, 0.9f},
               {5.5f, 3, 2.4f}, {5, -3, 3.1f});
  return builder.rays();
}

class PatchWalk : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Project project = test::smallProject(1.2, 4);
    project.bake.silhouettes = true;
    room_ = new test::BakedRoom(hall(), project);
  }
  static void TearDownTestSuite() { delete room_; }

  static std::vector<PerspectiveView> views() {
    std::vector<PerspectiveView> views;
    for (int i = 0; i < 5; ++i) {
      PerspectiveView view;
      view.eye = {0.5 * std::cos(2.1 * i), 0.5 * std::sin(2.1 * i), room_->open.layout->eyeZ()};
      view.yawRadians = 1.3 * i + 0.2, view.pitchRadians = 0.1 * (i - 2);
      view.width = 400, view.height = 225;
      views.push_back(view);
    }
    return views;
  }
  static Frame frameOf(const PerspectiveView& view, Reconstruction reconstruction,
                       Renderer renderer = Renderer::list, int workers = 1) {
    ViewSettings settings;
    settings.reconstruction = reconstruction;
    settings.renderer = renderer;
    TaskRunner runner(workers);
    auto frame = renderFrame(room_->walk, view, settings, runner);
    EXPECT_TRUE(frame) << frame.error().describe();
    return frame ? std::move(*frame) : Frame();
  }
  static TruthFrame truthOf(const PerspectiveView& view) {
    TaskRunner runner(1);
    return renderTruth(*room_->open.rays, view, room_->open.project.bake, 1, 16, runner);
  }

  static test::BakedRoom* room_;
};
test::BakedRoom* PatchWalk::room_ = nullptr;

TEST_F(PatchWalk, CapturesHavePatches) {
  for (const auto& capture : room_->walk.captures) {
    ASSERT_NE(capture->patches, nullptr);
    EXPECT_LT(capture->patches->patches.size(), capture->samples.size() / 20);
  }
}

TEST_F(PatchWalk, EdgesLieWhereTheyAreInTheTruth) {
  for (const PerspectiveView& view : views()) {
    const TruthFrame truth = truthOf(view);
    const auto patches = compare(frameOf(view, Reconstruction::patches), truth.colour, truth.rayDistance);
    const auto splats = compare(frameOf(view, Reconstruction::splat), truth.colour, truth.rayDistance);
    ASSERT_TRUE(patches && splats);
    EXPECT_GT(patches->psnr, splats->psnr + 2) << view.yawRadians;
    EXPECT_GT(patches->psnr, 29) << view.yawRadians;
    EXPECT_LE(patches->holeShare, 0.001) << view.yawRadians;
  }
}

TEST_F(PatchWalk, FramesAreTheSameForAnyNumberOfThreadsAndEveryKernel) {
  for (const PerspectiveView& view : views()) {
    const Frame one = frameOf(view, Reconstruction::patches, Renderer::list, 0);
    for (const Frame& other : {frameOf(view, Reconstruction::patches, Renderer::list, 2),
                               frameOf(view, Reconstruction::patches, Renderer::scalar, 0)}) {
      EXPECT_EQ(one.colour.pixels, other.colour.pixels);
      EXPECT_EQ(one.source.pixels, other.source.pixels);
      EXPECT_EQ(one.stats.samplesDrawn, other.stats.samplesDrawn);
    }
  }
}

TEST_F(PatchWalk, ReachTheNearestSurfacesFromEveryRegion) {
  // What is drawn first hides the rest: were the order wrong, walls would show through blocks.
  TaskRunner runner(1);
  int wrong = 0, all = 0;
  for (const PerspectiveView& view : views()) {
    ViewSettings settings;
    settings.reconstruction = Reconstruction::patches;
    FrameMemory memory;
    ASSERT_TRUE(renderFrame(room_->walk, view, settings, runner, memory));
    const TruthFrame truth = truthOf(view);
    for (int y = 1; y + 1 < view.height; ++y)
      for (int x = 1; x + 1 < view.width; ++x) {
        const glm::dvec3 ray = view.viewFromWorld() * view.rayThrough(x + 0.5, y + 0.5);
        const auto expected = [&](int dx, int dy) {
          return float(1 / (double(truth.rayDistance.at(x + dx, y + dy)) * ray.z));
        };
        float least = expected(0, 0), most = least;
        for (const int dx : {-1, 0, 1})
          for (const int dy : {-1, 0, 1})
            least = std::min(least, expected(dx, dy)), most = std::max(most, expected(dx, dy));
        const float inverse = memory.inverseZDepth.at(x, y);
        wrong += inverse < 0.95f * least || inverse > 1.05f * most;
        ++all;
      }
  }
  EXPECT_LT(wrong, all / 200);
}

TEST_F(PatchWalk, TilesListThePatchesThatTouchThem) {
  const PerspectiveView view = views().front();
  const auto plan = planView(room_->walk, view, {});
  ASSERT_TRUE(plan);
  TaskRunner runner(0);
  const PatchPlan patches = planPatches(room_->walk, view, *plan, runner);
  PatchTiles tiles;
  tiles.find(patches.surfaces, view.width, view.height);
  std::vector<const PatchDraw*> draws;
  for (const StripDraw& strip : patches.surfaces)
    for (const PatchDraw& draw : strip.patches) draws.push_back(&draw);
  std::size_t listed = 0;
  std::vector<RowRange> rows;
  std::vector<std::vector<int>> expected(draws.size());  // its tiles, by pixel
  for (std::size_t d = 0; d < draws.size(); ++d) {
    const PolygonRows& polygon = draws[d]->polygon;
    polygon.rows(polygon.x0(), polygon.x1(), rows);
    std::set<int> touched;
    for (int x = polygon.x0(); x < polygon.x1(); ++x)
      for (int y = rows[std::size_t(x - polygon.x0())].first; y < rows[std::size_t(x - polygon.x0())].end;
           ++y)
        touched.insert(y / PatchTiles::kSide * 1000 + x / PatchTiles::kSide);
    expected[d].assign(touched.begin(), touched.end());
  }
  std::vector<std::vector<int>> found(draws.size());
  for (const PatchTile& tile : tiles.tiles) {
    EXPECT_LT(tile.first, tile.end);
    for (std::uint32_t i = tile.first; i < tile.end; ++i) {
      EXPECT_TRUE(i == tile.first || tiles.patches[i - 1] < tiles.patches[i]) << "front to back";
      found[tiles.patches[i]].push_back(tile.y / PatchTiles::kSide * 1000 + tile.x / PatchTiles::kSide);
      ++listed;
    }
  }
  EXPECT_EQ(listed, tiles.patches.size());
  for (std::size_t d = 0; d < draws.size(); ++d) {
    // Rows of the columns of a tile are taken together: a few tiles more.
    EXPECT_TRUE(std::ranges::includes(found[d], expected[d])) << d;
    EXPECT_LE(found[d].size(), 2 * expected[d].size() + 1) << d;
  }
}

}  // namespace
}  // namespace acentric
