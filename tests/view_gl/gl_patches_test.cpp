/// Patches on the graphics card, against the CPU: the same rays of each pixel, so the same picture.

#include <algorithm>
#include <cmath>
#include <map>

#include "gl_fixture.h"
#include "tests/pipeline/baked_room.h"
#include "tests/pipeline/hall_of_blocks.h"

namespace acentric {
namespace {

using test::differingSources;
using test::kMostDifferingShare;
using test::onCpu;

/// With a mirror on a far wall and one that stands beside the path.
RayScenePtr hall() {
  test::SceneBuilder builder = test::hallOfBlocks();
  const int silver = builder.material(test::silver());
  builder.quad(silver, {6, -3, 0.5f}, {6, -3, 2.8f}, {6, 3, 2.8f}, {6, 3, 0.5f});
  builder.quad(silver, {-0.8f, 1.4f, 0.8f}, {0.6f, 1.4f, 0.8f}, {0.6f, 1.4f, 2.4f}, {-0.8f, 1.4f, 2.4f});
  builder.sky({0.5f, 0.6f, 0.9f});
  return builder.rays();
}

class GlPatches : public test::WithGl {
 protected:
  static void TearDownTestSuite() { rooms_.clear(); }
  /// Baked once for all tests.
  static const test::BakedRoom& roomOf(Configuration configuration) {
    if (const auto known = rooms_.find(configuration); known != rooms_.end()) return known->second;
    Project project = test::smallProject(1.2, 3);
    project.layout().configuration = configuration;
    project.bake.silhouettes = true;
    test::BakedRoom room(hall(), project);
    room.walk.mirrors = room.open.mirrors;
    return rooms_.emplace(configuration, std::move(room)).first->second;
  }
  static std::vector<PerspectiveView> viewsOf(const Layout& layout) {
    std::vector<PerspectiveView> views;
    for (int i = 0; i < 8; ++i) {
      PerspectiveView view;
      view.eye = {0.5 * std::cos(2.1 * i), 0.5 * std::sin(2.1 * i), layout.eyeZ()};
      view.yawRadians = kPi / 4 * i, view.pitchRadians = 0.1 * (i % 3 - 1);
      view.fovRadians = radians(i == 5 ? 179.0 : 60.0);
      view.width = 321, view.height = 199;  // odd: half a pixel matters
      views.push_back(view);
    }
    return views;
  }
  /// Decibels between both pictures.
  static double likeness(const Frame& a, const Frame& b) {
    double squares = 0;
    for (std::size_t i = 0; i < a.colour.pixels.size(); ++i) {
      const Rgba8 &p = a.colour.pixels[i], &q = b.colour.pixels[i];
      for (const int difference : {p.r - q.r, p.g - q.g, p.b - q.b}) squares += difference * difference;
    }
    return 10 * std::log10(255.0 * 255.0 * 3 * double(a.colour.pixels.size()) / std::max(squares, 1e-9));
  }
  bool hasVariant(const std::string& words) const {
    return std::ranges::any_of(renderer_->variants(),
                               [&](const std::string& v) { return v.find(words) != std::string::npos; });
  }

 private:
  static inline std::map<Configuration, test::BakedRoom> rooms_;
};

TEST_F(GlPatches, ArePaintedAsOnTheCpu) {
  for (const Configuration configuration : {Configuration::b, Configuration::e}) {
    const test::BakedRoom& room = roomOf(configuration);
    bool reflected = false, second = false, clipped = false;
    for (const PerspectiveView& view : viewsOf(*room.open.layout)) {
      ViewSettings settings;
      settings.renderer = Renderer::gl;
      for (const bool local : {true, false}) {
        settings.localGeometry = settings.fillHoles = local;
        const Frame cpu = onCpu(room.walk, view, settings), gl = onGl(room.walk, view, settings);
        EXPECT_GE(likeness(cpu, gl), 50) << nameOf(configuration) << " " << view.yawRadians << " " << local;
        EXPECT_LE(differingSources(cpu, gl), kMostDifferingShare) << view.yawRadians << " " << local;
        EXPECT_EQ(gl.stats.images, cpu.stats.images);
        EXPECT_GT(gl.stats.samplesRead, 0u);
      }
      const auto plan = planView(room.walk, view, settings);
      ASSERT_TRUE(plan);
      reflected |= !plan->reflections.empty();
      for (const PieceDraw& piece : plan->pieces) second |= piece.secondary, clipped |= piece.clipToPart;
    }
    EXPECT_TRUE(reflected) << "no view shows a mirror";
    EXPECT_TRUE(second) << "no view has a second cover";
    EXPECT_TRUE(clipped) << "no view is so wide that it is split in parts";
  }
  for (const char* words :
       {"patches.frag MIRRORS", "patches.frag REFLECT", "patches_begin.frag LOCAL_MIRRORS"})
    EXPECT_TRUE(hasVariant(words)) << words;
}

TEST_F(GlPatches, WhoseTexelsAreNotThoseTheySayAreRefused) {
  const test::BakedRoom& room = roomOf(Configuration::b);
  WalkScene walk = room.walk;
  ViewSettings settings;
  settings.renderer = Renderer::gl;
  for (auto& capture : walk.captures) {
    auto damaged = std::make_shared<DisplayCapture>(*capture);
    auto patches = std::make_shared<DisplayPatches>(*capture->patches);
    patches->patches.back().rows += 1;
    damaged->patches = patches;
    capture = damaged;
  }
  const auto drawn = renderer_->draw(walk, viewsOf(*room.open.layout).front(), settings);
  ASSERT_FALSE(drawn);
  EXPECT_EQ(drawn.error().kind, ErrorKind::malformed);
}

}  // namespace
}  // namespace acentric
