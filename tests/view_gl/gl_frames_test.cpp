/// Frames of analytic scenes on the graphics card, against the CPU.

#include <algorithm>
#include <cmath>

#include "engine/view/view_plan.h"
#include "gl_fixture.h"
#include "tests/view/capture_fixtures.h"
#include "tests/view/mirror_scene.h"

namespace acentric {
namespace {

using test::AnalyticScene;
using test::differingShare;
using test::differingSources;
using test::kMostDifferingShare;
using test::onCpu;

class GlFrames : public test::WithGl {
 protected:
  GlFrames() { views_.width = 321, views_.height = 199; }  // odd: half a pixel matters

  PerspectiveView nextView(const Layout& layout, int region, double fovDegrees) {
    return views_.next(layout, region, fovDegrees);
  }

  void expectLikeCpu(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                     double tolerance = kMostDifferingShare) {
    const Frame cpu = onCpu(scene, view, settings), gl = onGl(scene, view, settings);
    ASSERT_EQ(gl.colour.pixels.size(), cpu.colour.pixels.size());
    EXPECT_LE(differingShare(cpu.colour, gl.colour, 1), tolerance) << degrees(view.fovRadians);
    EXPECT_LE(differingSources(cpu, gl), tolerance) << degrees(view.fovRadians);
    EXPECT_EQ(gl.stats.images, cpu.stats.images);
    EXPECT_EQ(gl.stats.missingImages, cpu.stats.missingImages);
    EXPECT_TRUE(gl.stats.samplesRead > 0 || cpu.stats.samplesDrawn == 0);
  }

  test::RandomViews views_{11};
};

ViewSettings withoutFill() {
  ViewSettings settings;
  settings.renderer = Renderer::gl;
  settings.fillHoles = false;
  return settings;
}

TEST_F(GlFrames, PaintsWhatTheCpuPaintsFromAnyEyeInARing) {
  for (Configuration configuration : {Configuration::b, Configuration::e}) {
    const auto layout = test::layoutAroundOrigin(configuration);
    ASSERT_NE(layout, nullptr);
    const int region = *layout->regionAt({0.1, 0.05});
    const WalkScene scene = test::walkScene(test::randomPatches(3, 60, 3.4), layout, region, 2.5);
    for (bool secondary : {false, true})
      for (int i = 0; i < 4; ++i) {
        ViewSettings settings = withoutFill();
        settings.secondaryCover = secondary;
        expectLikeCpu(scene, nextView(*layout, region, 60), settings);
      }
  }
}

TEST_F(GlFrames, PaintsWhatTheCpuPaintsAtAnyFieldOfView) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomPatches(5, 60, 3.4), layout, region, 3);
  bool clipped = false;
  for (double fov : {1.0, 30.0, 90.0, 120.0, 150.0, 179.0}) {
    const PerspectiveView view = nextView(*layout, region, fov);
    expectLikeCpu(scene, view, withoutFill());
    const auto plan = planView(scene, view, withoutFill());
    ASSERT_TRUE(plan);
    for (const PieceDraw& piece : plan->pieces) clipped |= piece.clipToPart;
  }
  EXPECT_TRUE(clipped) << "no view was wide enough to be split in parts";
}

TEST_F(GlFrames, DrawsTheLayersOfAPixelInTheCpusOrder) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomPatches(6, 90, 3.2), layout, region, 2, 4);
  for (int i = 0; i < 5; ++i) expectLikeCpu(scene, nextView(*layout, region, 60), withoutFill());
}

TEST_F(GlFrames, TintsEachPaneOnceOverWhatLiesBehind) {
  AnalyticScene analytic = test::randomPatches(8, 50, 5);
  analytic.boxes.push_back({{3.4, -3, 0.5}, {3.41, 3, 2.6}, {0.7f, 0.2f, 0.1f, 0.5f}});
  analytic.boxes.push_back({{3.9, -2, 0.2}, {3.91, 3, 2.2}, {0.1f, 0.2f, 0.6f, 0.3f}});
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0, 0});
  const WalkScene scene = test::walkScene(analytic, layout, region, 3, 3);
  PerspectiveView view;
  view.width = 321, view.height = 199;
  for (const glm::dvec2& eye : {glm::dvec2(0, 0), glm::dvec2(0.5, -0.4), glm::dvec2(-0.6, 0.5)}) {
    view.eye = glm::dvec3(eye, layout->eyeZ());
    const Frame cpu = onCpu(scene, view, withoutFill()), gl = onGl(scene, view, withoutFill());
    EXPECT_LE(differingShare(cpu.colour, gl.colour, 1), kMostDifferingShare);
    EXPECT_LE(differingSources(cpu, gl), kMostDifferingShare);
    ASSERT_EQ(cpu.holeCount(), gl.holeCount());
  }
}

TEST_F(GlFrames, ShowsTheSkyAtInfinity) {
  AnalyticScene analytic;
  analytic.floor = false, analytic.silhouettes = true;
  const auto layout = test::layoutAroundOrigin(Configuration::e);
  const int region = *layout->regionAt({0.1, 0.1});
  const WalkScene scene = test::walkScene(analytic, layout, region, 2);
  PerspectiveView view;
  view.eye = {0.3, -0.2, layout->eyeZ()};
  view.width = 160, view.height = 90;
  const Frame gl = onGl(scene, view, ViewSettings{});
  const Rgba8 sky = encodeForDisplay(glm::vec3(analytic.skyColour), 1);
  for (const Rgba8& pixel : gl.colour.pixels) ASSERT_EQ(pixel, sky);
  EXPECT_EQ(gl.holeCount(), 0u);
}

TEST_F(GlFrames, FillsHolesWithTheFartherSurfaceAndMarksThemInvented) {
  // No secondary cover and one layer: the eye sees behind the boxes' edges.
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomPatches(9, 80, 3.1), layout, region, 3);
  ViewSettings settings = withoutFill();
  settings.secondaryCover = false;
  std::size_t invented = 0;
  for (int i = 0; i < 4; ++i) {
    PerspectiveView view = nextView(*layout, region, 60);
    view.eye.z = layout->eyeZ();
    view.pitchRadians = 0;  // all within the captures' elevations: the holes are those behind edges
    settings.fillHoles = false;
    const Frame open = onGl(scene, view, settings);
    settings.fillHoles = true;
    const Frame cpu = onCpu(scene, view, settings), filled = onGl(scene, view, settings);
    EXPECT_EQ(filled.holeCount(), open.holeCount()) << "an invented pixel counts as a hole";
    double difference = 0;
    std::size_t here = 0;
    for (std::size_t p = 0; p < open.source.pixels.size(); ++p) {
      if (open.source.pixels[p] != kSourceHole) {
        ASSERT_EQ(filled.source.pixels[p], open.source.pixels[p]);
        ASSERT_EQ(filled.colour.pixels[p], open.colour.pixels[p]);
        continue;
      }
      ASSERT_EQ(filled.source.pixels[p], kSourceInvented);
      ASSERT_EQ(filled.colour.pixels[p].a, 255);
      // Below the horizon a hole reaches from the picture's border to where the captures begin; how such a
      // plain is filled is a matter of taste. Above it holes lie behind the edges of boxes.
      if (p >= open.source.pixels.size() / 2) continue;
      const glm::ivec3 apart =
          glm::abs(glm::ivec3(filled.colour.pixels[p]) - glm::ivec3(cpu.colour.pixels[p]));
      difference += (apart.x + apart.y + apart.z) / 3.0;
      ++here;
    }
    invented += here;
    // Another way of growing than the CPU's, the same rule of what grows.
    if (here > 20) {
      EXPECT_LT(difference / double(here), 20) << here << " pixels";
    }
  }
  EXPECT_GT(invented, 100u);
}

TEST_F(GlFrames, LeavesTheGapOfAMissingImageVisible) {
  const auto layout = test::layoutAroundOrigin(Configuration::e);
  const int region = *layout->regionAt({0.1, 0.1});
  WalkScene scene = test::walkScene(test::randomPatches(9, 30, 3.1), layout, region, 2);
  PerspectiveView view;
  view.eye = {0.3, -0.2, layout->eyeZ()};
  view.width = 320, view.height = 200;
  const auto plan = planView(scene, view, ViewSettings{});
  ASSERT_TRUE(plan);
  const std::size_t kept = std::size_t(plan->pieces.back().camera);
  for (std::size_t camera = 0; camera < scene.captures.size(); ++camera)
    if (camera != kept) scene.captures[camera] = nullptr;
  ViewSettings settings;
  settings.secondaryCover = false;
  const Frame gl = onGl(scene, view, settings), cpu = onCpu(scene, view, settings);
  EXPECT_GT(gl.stats.missingImages, 0);
  const auto open = [](const Frame& frame) {
    return double(std::count(frame.source.pixels.begin(), frame.source.pixels.end(), kSourceHole));
  };
  EXPECT_GT(open(cpu), 1000);
  EXPECT_NEAR(open(gl), open(cpu), 0.2 * open(cpu));
}

TEST_F(GlFrames, GivesTheSamePictureTwice) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomPatches(10, 60, 3.4), layout, region, 3, 3);
  const PerspectiveView view = nextView(*layout, region, 60);
  const Frame first = onGl(scene, view, ViewSettings{});
  onGl(scene, nextView(*layout, region, 60), ViewSettings{});
  const Frame second = onGl(scene, view, ViewSettings{});
  EXPECT_EQ(first.colour.pixels, second.colour.pixels);
  EXPECT_EQ(first.source.pixels, second.source.pixels);
}

TEST_F(GlFrames, RefusesWhatTheCpuRefuses) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const WalkScene scene =
      test::walkScene(test::randomPatches(10, 5, 3.4), layout, *layout->regionAt({0.1, 0.05}), 1);
  PerspectiveView view;
  view.eye = {500, 0, 1.6};
  EXPECT_EQ(renderer_->draw(scene, view, {}).error().kind, ErrorKind::invalidArgument);
  view.eye = {0.1, 0.05, 1.6};
  view.width = 0;
  EXPECT_EQ(renderer_->draw(scene, view, {}).error().kind, ErrorKind::invalidArgument);
  view.width = 100;
  ViewSettings settings;
  settings.maxSplatPixels = 65;
  EXPECT_EQ(renderer_->draw(scene, view, settings).error().kind, ErrorKind::invalidArgument);
  TaskRunner runner(0);
  settings = {};
  settings.renderer = Renderer::gl;
  EXPECT_FALSE(renderFrame(scene, view, settings, runner)) << "what is drawn here is not drawn there";
}

TEST_F(GlFrames, RefusesWhatIsNoPatches) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  PerspectiveView view;
  view.eye = {0.1, 0.05, layout->eyeZ()};
  view.width = 100, view.height = 60;
  const WalkScene scene = test::walkScene(test::randomPatches(10, 5, 3.4), layout, region, 1);
  ViewSettings settings = test::splatSettings();
  settings.renderer = Renderer::gl;
  const auto splats = renderer_->draw(scene, view, settings);
  ASSERT_FALSE(splats);
  EXPECT_EQ(splats.error().kind, ErrorKind::invalidArgument);
  EXPECT_NE(splats.error().message.find("CPU renderer"), std::string::npos);
  const WalkScene bare = test::walkScene(test::randomBoxes(10, 5, 3.4), layout, region, 1);
  const auto without = renderer_->draw(bare, view, withoutFill());
  ASSERT_FALSE(without);
  EXPECT_EQ(without.error().kind, ErrorKind::unsupported);
  EXPECT_EQ(without.error().where.rfind("capture of camera ", 0), 0u) << without.error().where;
  EXPECT_TRUE(renderer_->draw(scene, view, withoutFill()));
}

TEST_F(GlFrames, PaintsTheBackgroundWhereTheCpuDoes) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  WalkScene walk =
      test::walkScene(test::randomPatches(3, 60, 3.4), layout, *layout->regionAt({0.1, 0.05}), 2.5);
  Scene scene;
  scene.bounds.add({-9, -9, 0});
  scene.bounds.add({9, 9, 5});
  scene.sky = {{0.1f, 0.2f, 0.7f}, {0.6f, 0.6f, 0.6f}, {0.2f, 0.1f, 0.1f}};
  walk.scene = std::make_shared<const Scene>(std::move(scene));
  walk.plan = planEffects(*walk.scene);
  for (const double pitch : {0.0, 60.0, 90.0, -80.0}) {
    PerspectiveView view = nextView(*layout, *layout->regionAt({0.1, 0.05}), 70);
    view.eye.z = layout->eyeZ();
    view.pitchRadians = radians(pitch);
    const Frame cpu = onCpu(walk, view, withoutFill()), gl = onGl(walk, view, withoutFill());
    EXPECT_LE(differingSources(cpu, gl), kMostDifferingShare) << pitch;
    // Edges before the sky: a ray of a pixel that meets another part of a texel is an eighth of it.
    EXPECT_LE(test::differingShare(cpu.colour, gl.colour, 1), 0.005) << pitch;
    EXPECT_EQ(std::ranges::count(cpu.source.pixels, kSourceBackground) > 0, std::abs(pitch) > 1);
  }
}

TEST_F(GlFrames, ShowsInMirrorsWhatTheCpuShows) {
  test::MirrorScene mirrors{test::randomPatches(12, 50, 3.4), {}};
  mirrors.mirrors.push_back({0, 4, {-2, 0.4}, {2.5, 2.8}, {0.9f, 0.8f, 0.7f}, 1});
  mirrors.mirrors.push_back({1, 2.5, {1.5, 0.4}, {4, 2.8}, {0.6f, 0.9f, 0.9f}, 200});
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  for (const bool glass : {false, true}) {
    if (glass) mirrors.surfaces.boxes.push_back({{3.5, -1, 0.8}, {3.51, 1, 1.9}, {0.1f, 0.2f, 0.6f, 0.4f}});
    const WalkScene scene = test::walkScene(mirrors, layout, region, 3),
                    still = test::walkScene(mirrors, layout, region, 3, false);
    for (const double yaw : {0.0, 0.6}) {
      PerspectiveView view = nextView(*layout, region, 70);
      view.yawRadians = yaw;
      view.pitchRadians = 0;
      for (const bool fill : {false, true}) {
        ViewSettings settings;
        settings.fillHoles = fill;
        const Frame cpu = onCpu(scene, view, settings), gl = onGl(scene, view, settings);
        EXPECT_GT(differingShare(cpu.colour, onCpu(still, view, settings).colour), 0.02)
            << "the mirrors fill the view";
        const double share = differingShare(cpu.colour, gl.colour, 1);
        EXPECT_TRUE(fill || share <= kMostDifferingShare) << share;
        EXPECT_LE(differingSources(cpu, gl), kMostDifferingShare);
      }
    }
  }
}

}  // namespace
}  // namespace acentric
