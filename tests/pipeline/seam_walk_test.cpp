/// Seams and popping from the scene to the frame: none where everything is right, and each fault where it is.

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/bake/bake.h"
#include "engine/bake/truth.h"
#include "engine/measure/seams.h"
#include "engine/pipeline/region_crossings.h"
#include "engine/scene/local_geometry.h"
#include "engine/view/render.h"
#include "tests/bake/memory_sink.h"
#include "tests/pipeline/small_project.h"

namespace acentric {
namespace {

/// A room of one colour with a few blocks on its floor. Nothing is lit: colours are exact.
RayScenePtr room() {
  test::SceneBuilder builder;
  const auto unlit = [&](glm::vec3 colour) {
    Material m = test::matte(colour);
    m.unlit = true;
    return builder.material(m);
  };
  builder.box(unlit({0.4f, 0.35f, 0.3f}), {-6, -6, 0}, {6, 6, 3}, true);
  builder.box(unlit({0.1f, 0.3f, 0.6f}), {3.5f, -1, 0}, {4.5f, 0.5f, 1.2f});
  builder.box(unlit({0.6f, 0.2f, 0.1f}), {-1, 3.5f, 0}, {1, 4.5f, 0.8f});
  return builder.rays();
}

class SeamWalk : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    open_ = new OpenProject(test::openWith(room(), test::smallProject(1.2, 2)));
    test::MemorySink memory;
    TaskRunner runner(0);
    std::vector<int> all;
    for (std::size_t c = 0; c < open_->layout->cameras.size(); ++c) all.push_back(int(c));
    ASSERT_TRUE(bake(*open_->rays, *open_->layout, all, open_->project.bake, memory, runner));
    walk_ = new WalkScene;
    walk_->scene = open_->scene;
    walk_->layout = open_->layout;
    walk_->plan = open_->plan;
    for (const ContentKey& key : open_->keys)
      walk_->captures.push_back(
          std::make_shared<const DisplayCapture>(prepareForDisplay(*memory.find(key), 1)));
    for (const Region& region : open_->layout->regions)
      walk_->local.push_back(
          std::make_shared<const LocalGeometry>(clipToPolygon(*open_->scene, region.grown)));
  }
  static void TearDownTestSuite() { delete open_, delete walk_; }

  static PerspectiveView viewAt(const PathPose& pose) {
    PerspectiveView view;
    view.eye = pose.eye;
    view.yawRadians = pose.yawRadians;
    view.pitchRadians = pose.pitchRadians;
    view.width = 160, view.height = 90;
    return view;
  }
  static Frame frameOf(const WalkScene& walk, const PerspectiveView& view) {
    TaskRunner runner(0);
    ViewSettings settings;
    settings.reconstruction = Reconstruction::splat;  // of the samples, whose colours are changed here
    auto frame = renderFrame(walk, view, settings, runner);
    EXPECT_TRUE(frame) << frame.error().describe();
    return frame ? std::move(*frame) : Frame();
  }
  static SeamSums seamOf(const WalkScene& walk, const PerspectiveView& view) {
    TaskRunner runner(0);
    const TruthFrame truth = renderTruth(*open_->rays, view, open_->project.bake, 1, 1, runner);
    return measureSeam(frameOf(walk, view), truth.colour, truth.rayDistance);
  }
  /// Looks down at the floor, so that the border of local geometry is in the picture.
  static PerspectiveView lookingDown() { return viewAt({{0, 0, open_->layout->eyeZ()}, 0.3, radians(-35)}); }
  /// The first change of region on the way from the middle to the left.
  static RegionCrossing firstCrossing() {
    const double z = open_->layout->eyeZ();
    return crossingsBetween(*open_->layout, {{0, 0, z}, 0, 0}, {{0, 1.19, z}, 0, 0}).at(0);
  }

  static inline OpenProject* open_ = nullptr;
  static inline WalkScene* walk_ = nullptr;
};

TEST_F(SeamWalk, ShowsNoSeamWhereLocalGeometryIsShadedAsTheBakeIs) {
  const SeamSums sums = seamOf(*walk_, lookingDown());
  EXPECT_GT(sums.across.pairs, 100u);
  EXPECT_LT(sums.localError(), 0.5);
  EXPECT_LT(sums.across.meanExcess(), 1);
  EXPECT_LT(sums.across.visibleShare(), 0.02);
}

TEST_F(SeamWalk, ShowsAMisshadedLocalPart) {
  WalkScene wrong = *walk_;
  const auto darker = std::make_shared<Scene>(*walk_->scene);
  for (Material& material : darker->materials) material.baseColour *= glm::vec4(0.8f, 0.8f, 0.8f, 1);
  wrong.scene = darker;
  const SeamSums sums = seamOf(wrong, lookingDown()), right = seamOf(*walk_, lookingDown());
  EXPECT_EQ(sums.across.pairs, right.across.pairs);
  EXPECT_GT(sums.localError(), 8);
  EXPECT_NEAR(sums.capturedError(), right.capturedError(), 1e-9);
  EXPECT_GT(sums.across.meanExcess(), 8);
  EXPECT_GT(sums.across.visibleShare(), 0.95);
  EXPECT_LT(sums.within.visibleShare(), 0.02) << "elsewhere it is as even as before";
}

TEST_F(SeamWalk, PopsLittleWhereARegionGivesWayToTheNext) {
  const RegionCrossing crossing = firstCrossing();
  const Frame before = frameOf(*walk_, viewAt(crossing.before)),
              after = frameOf(*walk_, viewAt(crossing.after));
  const Change change = changeBetween(before.colour, after.colour);
  EXPECT_GT(change.psnr, 24);
  EXPECT_LT(change.changedShare, 0.05);
}

TEST_F(SeamWalk, PopsWhereTheNextRegionsImagesHaveOtherColours) {
  const RegionCrossing crossing = firstCrossing();
  const Frame before = frameOf(*walk_, viewAt(crossing.before));
  const Change right = changeBetween(before.colour, frameOf(*walk_, viewAt(crossing.after)).colour);
  WalkScene wrong = *walk_;
  for (const Cover& cover : open_->layout->regions[std::size_t(crossing.to)].covers)
    for (const Piece& piece : cover.pieces) {
      auto darker = std::make_shared<DisplayCapture>(*wrong.captures[std::size_t(piece.camera)]);
      for (Rgba8& colour : darker->colour) colour = Rgba8(colour.r / 2, colour.g / 2, colour.b / 2, colour.a);
      wrong.captures[std::size_t(piece.camera)] = std::move(darker);
    }
  const Change change = changeBetween(before.colour, frameOf(wrong, viewAt(crossing.after)).colour);
  EXPECT_LT(change.psnr, right.psnr - 6);
  EXPECT_GT(change.changedShare, 0.5);
}

}  // namespace
}  // namespace acentric
