#include <cmath>

#include "engine/measure/compare.h"
#include "engine/view/view_plan.h"
#include "gl_fixture.h"
#include "tests/view/capture_fixtures.h"
#include "tests/view/mirror_scene.h"

namespace acentric {
namespace {

using test::AnalyticScene;
using test::differingShare;
using test::differingSources;
using test::onCpu;

/// How far meshes may be from the nearest of splats that follow the surface: along edges a splat takes whole
/// pixels, a mesh those whose centres it covers. Scenes of flat colours: all else is equal.
struct Tolerance {
  double colours = 0.03, sources = 0.02;  ///< shares of the pixels
  double psnr = 28;                       ///< dB
};
constexpr double kMeanAlongEdges = 0.006;  ///< of the colours

class GlMesh : public test::WithGl {
 protected:
  GlMesh() {
    views_.rise = 0.3, views_.pitch = 0.4;
    views_.width = 321, views_.height = 199;
  }
  PerspectiveView nextView(const Layout& layout, int region, double fovDegrees) {
    return views_.next(layout, region, fovDegrees);
  }
  /// The share of pixels whose colours differ by more than so many codes.
  double expectLikeCpu(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings,
                       int codes = 0, const Tolerance& tolerance = {}) {
    const Frame cpu = onCpu(scene, view, settings), gl = onGl(scene, view, settings);
    const double share = differingShare(cpu.colour, gl.colour, codes);
    EXPECT_LE(share, tolerance.colours) << degrees(view.fovRadians);
    EXPECT_GE(psnrOf(cpu.colour, gl.colour), tolerance.psnr) << degrees(view.fovRadians);
    EXPECT_LE(differingSources(cpu, gl), tolerance.sources) << degrees(view.fovRadians);
    EXPECT_LE(double(gl.holeCount()), 1.3 * double(cpu.holeCount()) + 20) << degrees(view.fovRadians);
    EXPECT_EQ(gl.stats.images, cpu.stats.images);
    EXPECT_EQ(gl.stats.missingImages, cpu.stats.missingImages);
    return share;
  }

  test::RandomViews views_{11};
};

ViewSettings asMesh() {
  ViewSettings settings;
  settings.renderer = Renderer::glMesh;
  settings.reconstruction = Reconstruction::surface;
  settings.fillHoles = false;
  return settings;
}

TEST_F(GlMesh, PaintsWhatTheCpuPaints) {
  double sum = 0;
  int views = 0;
  for (Configuration configuration : {Configuration::b, Configuration::e}) {
    const auto layout = test::layoutAroundOrigin(configuration);
    const int region = *layout->regionAt({0.1, 0.05});
    for (const double perDegree : {2.5, 6.0}) {
      const WalkScene scene = test::walkScene(test::randomBoxes(3, 60, 3.4), layout, region, perDegree, 3);
      for (int i = 0; i < 4; ++i, ++views) {
        ViewSettings settings = asMesh();
        settings.secondaryCover = i % 2 == 0;
        sum += expectLikeCpu(scene, nextView(*layout, region, 60), settings);
      }
    }
  }
  EXPECT_LE(sum / views, kMeanAlongEdges);
  EXPECT_GT(sum, 0) << "the points were drawn";
}

TEST_F(GlMesh, PaintsWhatTheCpuPaintsAtAnyFieldOfView) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomBoxes(5, 60, 3.4), layout, region, 3);
  bool clipped = false;
  for (const double fov : {10.0, 90.0, 120.0, 150.0, 179.0}) {
    const PerspectiveView view = nextView(*layout, region, fov);
    // Towards the border of the widest a splat stands for dozens of pixels.
    expectLikeCpu(scene, view, asMesh(), 0, fov > 170 ? Tolerance{0.06, 0.1, 20} : Tolerance{});
    const auto plan = planView(scene, view, asMesh());
    ASSERT_TRUE(plan);
    for (const PieceDraw& piece : plan->pieces) clipped |= piece.clipToPart;
  }
  EXPECT_TRUE(clipped) << "no view was wide enough to be split in parts";
}

TEST_F(GlMesh, ShowsOnlyTheSamplesThatThePiecesNeed) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  WalkScene scene = test::walkScene(test::randomBoxes(5, 60, 3.4), layout, region, 3);
  for (auto& shared : scene.captures) {
    if (!shared) continue;
    auto capture = std::make_shared<DisplayCapture>(*shared);
    for (PackedSample& sample : capture->samples)  // bands of rows, of which some roles need every other one
      sample = packSample(inverseDistanceOf(sample), sample.row / 16 % 2 == 0 ? 0x55 : 0xaa, sample.row,
                          sample.slant);
    shared = capture;
  }
  ViewSettings settings = asMesh();
  settings.secondaryCover = false;
  std::size_t holes = 0;
  for (int i = 0; i < 4; ++i) {
    const PerspectiveView view = nextView(*layout, region, 60);
    const Frame cpu = onCpu(scene, view, settings), gl = onGl(scene, view, settings);
    holes += cpu.holeCount();
    EXPECT_LE(differingSources(cpu, gl), 0.06) << "the borders of the bands";
    EXPECT_NEAR(double(gl.holeCount()), double(cpu.holeCount()), 0.1 * double(cpu.holeCount()) + 20);
  }
  EXPECT_GT(holes, 10000u) << "roles leave nothing out";
}

TEST_F(GlMesh, LeavesNoPinholesInAMagnifiedWall) {
  // A quarter of a sample per degree: a sample is larger than any splat may be.
  AnalyticScene wall;
  wall.floor = false;
  wall.boxes.push_back({{3, -30, -30}, {4, 30, 30}, {0.5f, 0.4f, 0.3f, 1}});
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(wall, layout, region, 0.25);
  PerspectiveView view;
  view.width = 640, view.height = 360;
  view.fovRadians = radians(40);
  for (int i = 0; i < 6; ++i) {
    view.eye = nextView(*layout, region, 40).eye;
    view.yawRadians = views_.between(-0.4, 0.4), view.pitchRadians = views_.between(-0.3, 0.3);
    EXPECT_EQ(onGl(scene, view, asMesh()).holeCount(), 0u) << view.yawRadians;
    EXPECT_GT(onCpu(scene, view, asMesh()).holeCount(), 1000u);
  }
}

TEST_F(GlMesh, LaysPanesOverMeshesAndMarksMirrorsAsTheCpuDoes) {
  test::MirrorScene mirrors{test::randomBoxes(12, 50, 3.4), {}};
  mirrors.mirrors.push_back({0, 4, {-2, 0.4}, {2.5, 2.8}, {0.9f, 0.8f, 0.7f}, 1});
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  for (const bool glass : {false, true}) {
    if (glass) mirrors.surfaces.boxes.push_back({{3.5, -1, 0.8}, {3.51, 1, 1.9}, {0.1f, 0.2f, 0.6f, 0.4f}});
    const WalkScene scene = test::walkScene(mirrors, layout, region, 3),
                    still = test::walkScene(mirrors, layout, region, 3, false);
    for (const double yaw : {0.0, 0.6}) {
      PerspectiveView view = nextView(*layout, region, 70);
      view.yawRadians = yaw, view.pitchRadians = 0;
      EXPECT_GT(differingShare(onGl(scene, view, asMesh()).colour, onGl(still, view, asMesh()).colour), 0.02)
          << "the mirrors fill the view";
      expectLikeCpu(scene, view, asMesh(), 2);
    }
  }
}

TEST_F(GlMesh, FiltersAsTheCpuDoes) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomBoxes(3, 60, 3.4), layout, region, 3, 2);
  ViewSettings settings = asMesh();
  settings.reconstruction = Reconstruction::filtered;
  for (int i = 0; i < 4; ++i) {
    const PerspectiveView view = nextView(*layout, region, 60);
    const Frame cpu = onCpu(scene, view, settings), gl = onGl(scene, view, settings),
                plain = onGl(scene, view, asMesh());
    const double filtered = psnrOf(cpu.colour, gl.colour), unfiltered = psnrOf(cpu.colour, plain.colour);
    EXPECT_GT(filtered, 32);
    EXPECT_GT(filtered, unfiltered + 1) << "nothing is filtered";
  }
}

TEST_F(GlMesh, BuildsEachMeshOnceForAnErrorAndTellsWhatItTakes) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomBoxes(3, 60, 3.4), layout, region, 4, 2);
  const PerspectiveView view = nextView(*layout, region, 60);
  ViewSettings settings = asMesh();
  const auto costOf = [&](double error) {
    settings.meshError = error;
    const auto stats = renderer_->draw(scene, view, settings);
    EXPECT_TRUE(stats);
    EXPECT_GT(stats->meshTriangles, 100u);
    EXPECT_EQ(stats->samplesRead, 0u);
    return stats->meshes;
  };
  const std::vector<MeshCost> first = costOf(0.25), again = costOf(0.25), coarse = costOf(2);
  ASSERT_FALSE(first.empty());
  ASSERT_EQ(again.size(), first.size());
  ASSERT_EQ(coarse.size(), first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].samples, scene.captures[std::size_t(first[i].camera)]->samples.size());
    EXPECT_GT(first[i].bytes, 8 * first[i].samples);
    EXPECT_EQ(first[i].error, 0.25);
    EXPECT_EQ(again[i].buildSeconds, first[i].buildSeconds) << "built again";
    EXPECT_LT(coarse[i].triangles, first[i].triangles);
    EXPECT_EQ(coarse[i].error, 2);
  }
  settings.meshError = 0.25;
  const auto most = std::ranges::max_element(first, {}, &MeshCost::triangles);
  settings.maxMeshTriangles = int(most->triangles) * 9 / 10;
  const auto limited = renderer_->draw(scene, view, settings);
  ASSERT_TRUE(limited);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const bool fitted = first[i].triangles <= std::uint64_t(settings.maxMeshTriangles);
    EXPECT_LE(limited->meshes[i].triangles, std::uint64_t(settings.maxMeshTriangles));
    EXPECT_EQ(limited->meshes[i].error == 0.25, fitted);
  }
  settings.meshError = 0;
  EXPECT_EQ(renderer_->draw(scene, view, settings).error().kind, ErrorKind::invalidArgument);
}

TEST_F(GlMesh, GivesTheSamePictureTwice) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const int region = *layout->regionAt({0.1, 0.05});
  const WalkScene scene = test::walkScene(test::randomBoxes(10, 60, 3.4), layout, region, 3, 3);
  const PerspectiveView view = nextView(*layout, region, 60);
  const Frame first = onGl(scene, view, asMesh());
  onGl(scene, nextView(*layout, region, 60), asMesh());
  const Frame second = onGl(scene, view, asMesh());
  EXPECT_EQ(first.colour.pixels, second.colour.pixels);
  EXPECT_EQ(first.source.pixels, second.source.pixels);
}

}  // namespace
}  // namespace acentric
