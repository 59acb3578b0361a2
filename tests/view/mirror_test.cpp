#include "tests/view/mirror_fixtures.h"

namespace acentric {
namespace {

using test::frameOf;
using test::MirrorScene;
using test::plainSettings;
using test::psnrInMirrors;
using test::roomWithMirror;

struct Walk {
  std::shared_ptr<const Layout> layout = test::layoutAroundOrigin(Configuration::b);
  int region = *layout->regionAt({0.05, 0.05});
  PerspectiveView view(const glm::dvec3& offset) const { return test::viewIntoMirror(*layout, offset); }
};

TEST(Mirrors, ShowWhatTheEyeSeesInThemNotWhatTheCameraSaw) {
  const MirrorScene scene = roomWithMirror();
  const Walk walk;
  const WalkScene moving = test::walkScene(scene, walk.layout, walk.region, 5),
                  still = test::walkScene(scene, walk.layout, walk.region, 5, false);
  for (const glm::dvec3& offset : {glm::dvec3(0), glm::dvec3(0.3, -0.6, 0.1), glm::dvec3(-0.5, 0.5, -0.2)}) {
    const PerspectiveView view = walk.view(offset);
    const double with = psnrInMirrors(scene, view, frameOf(moving, view, {})),
                 without = psnrInMirrors(scene, view, frameOf(still, view, {}));
    RecordProperty("psnr", std::to_string(with) + " instead of " + std::to_string(without));
    EXPECT_GT(with, without + 6);
    EXPECT_GT(with, 20);
  }
}

TEST(Mirrors, KeepTheirDepthAndNothingElseOfThePictureChanges) {
  const MirrorScene scene = roomWithMirror();
  const Walk walk;
  const WalkScene moving = test::walkScene(scene, walk.layout, walk.region, 4),
                  still = test::walkScene(scene, walk.layout, walk.region, 4, false);
  const PerspectiveView view = walk.view({0.3, -0.5, 0});
  const ViewSettings settings = test::splatSettings();
  const auto plan = planView(moving, view, settings), plainPlan = planView(still, view, settings);
  ASSERT_TRUE(plan && plainPlan);
  EXPECT_FALSE(plan->reflections.empty());
  EXPECT_TRUE(plainPlan->reflections.empty());
  const Canvas with = test::paint(moving, view, settings, *plan),
               without = test::paint(still, view, settings, *plainPlan);
  EXPECT_TRUE(without.mirrors.empty());
  std::size_t mirrored = 0, changed = 0;
  for (std::size_t i = 0; i < with.pixels.size(); ++i) {
    EXPECT_EQ(inverseZDepthOf(with.pixels[i]), inverseZDepthOf(without.pixels[i]));
    mirrored += with.mirrors[i] != 0;
    if (with.mirrors[i] == 0)
      ASSERT_EQ(with.pixels[i], without.pixels[i]);
    else
      changed += (with.pixels[i] & 0xffffff) != (without.pixels[i] & 0xffffff);
  }
  EXPECT_GT(mirrored, 1000u);
  EXPECT_GT(changed, mirrored / 10);
}

TEST(Mirrors, NeverShowWhatAnotherShows) {
  // Two mirrors that meet in a corner, one tinted red, one green: what red shows has no green.
  MirrorScene scene = roomWithMirror();
  scene.mirrors = {{0, 4, {-2, 0.4}, {2.5, 2.8}, {1, 0, 0}, 1}, {1, 2.5, {1.5, 0.4}, {4, 2.8}, {0, 1, 0}, 2}};
  const Walk walk;
  const WalkScene moving = test::walkScene(scene, walk.layout, walk.region, 4);
  constexpr int kToneCurve = 16;  // codes that it gives to channels without light
  int red = 0, green = 0;
  for (const double yaw : {20.0, 40.0}) {
    PerspectiveView view = walk.view({0.35, 0.1, 0.1});
    view.yawRadians = radians(yaw);
    for (const bool depthTest : {false, true}) {
      const auto plan = planView(moving, view, {});
      ASSERT_TRUE(plan);
      const Canvas canvas = test::paint(moving, view, {}, *plan, depthTest);
      for (std::size_t i = 0; i < canvas.pixels.size(); ++i) {
        const Rgba8 colour = colourOf(static_cast<std::uint32_t>(canvas.pixels[i]));
        red += canvas.mirrors[i] == 1;
        green += canvas.mirrors[i] == 2;
        ASSERT_LE(canvas.mirrors[i] == 1 ? colour.g : canvas.mirrors[i] == 2 ? colour.r : 0, kToneCurve);
      }
    }
  }
  EXPECT_GT(red, 2000);
  EXPECT_GT(green, 2000);
}

TEST(Mirrors, AreTheSameForAnyThreadCountAndKernel) {
  MirrorScene scene = roomWithMirror();
  scene.surfaces.boxes.push_back({{3.5, -0.5, 0.9}, {3.51, 0.7, 1.8}, {0.2f, 0.1f, 0.7f, 0.5f}});
  const Walk walk;
  const WalkScene moving = test::walkScene(scene, walk.layout, walk.region, 4);
  const PerspectiveView view = walk.view({0.2, -0.4, 0});
  ViewSettings settings;
  settings.renderer = Renderer::scalar;
  const Frame truth = frameOf(moving, view, settings);
  settings.renderer = Renderer::list;
  for (int workers : {0, 1, 3}) {
    const Frame frame = frameOf(moving, view, settings, workers);
    EXPECT_EQ(frame.colour.pixels, truth.colour.pixels) << workers;
    EXPECT_EQ(frame.source.pixels, truth.source.pixels);
    EXPECT_EQ(frame.stats.samplesDrawn, truth.stats.samplesDrawn);
  }
}

TEST(Mirrors, BehindGlassStayTinted) {
  MirrorScene scene = roomWithMirror();
  const glm::vec4 glass(0.9f, 0, 0, 0.5f);
  scene.surfaces.boxes.push_back({{3.5, -3, 0}, {3.51, 3, 4}, glass});
  const Walk walk;
  const WalkScene moving = test::walkScene(scene, walk.layout, walk.region, 4);
  const PerspectiveView view = walk.view({0.3, -0.5, 0});
  for (const Renderer renderer : {Renderer::list, Renderer::zbuffer}) {
    const Frame frame = frameOf(moving, view, plainSettings(renderer));
    const Rgba8 least = encodeForDisplay(glm::vec3(glass) * glass.a, 1);
    for (int y = 90; y < 110; ++y)
      for (int x = 120; x < 200; ++x) ASSERT_GE(frame.colour.at(x, y).r + 2, least.r);
  }
}

}  // namespace
}  // namespace acentric
