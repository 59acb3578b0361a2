/// Mirrors within the near band, against the CPU.

#include <algorithm>

#include "gl_fixture.h"
#include "tests/view/mirror_fixtures.h"

namespace acentric {
namespace {

using test::AnalyticBox;
using test::differingShare;
using test::differingSources;
using test::kMostDifferingShare;
using test::onCpu;

class GlMirrors : public test::WithGl {
 protected:
  WalkScene walk(const std::vector<AnalyticBox>& near) {
    scene_ = test::roomWithMirror();
    scene_.surfaces.silhouettes = true;
    return test::walkPastNearMirrors(scene_, near, layout_, region_, 4);
  }
  PerspectiveView view(const glm::dvec3& offset) const {
    return test::viewIntoMirror(*layout_, offset, 321, 199);
  }
  bool hasVariant(const std::string& words) const {
    return std::ranges::any_of(renderer_->variants(),
                               [&](const std::string& v) { return v.find(words) != std::string::npos; });
  }

  std::shared_ptr<const Layout> layout_ = test::layoutAroundOrigin(Configuration::b, 2, 4);
  int region_ = *layout_->regionAt({0.05, 0.05});
  test::MirrorScene scene_;
};

TEST_F(GlMirrors, AreAsOnTheCpuAmongLocalGeometry) {
  std::vector<AnalyticBox> near = {{{4.1, -0.8, 0.9}, {4.2, 0.9, 2.2}, {0.8f, 0.1f, 0.6f, 1}},
                                   {{3.5, 0.6, 0.5}, {3.51, 1.6, 2.2}, {0.9f, 0, 0, 0.5f}}};
  for (const double y : {-0.9, -0.6, -0.3, 0.0, 0.3})
    near.push_back({{2.5, y, 0.9}, {2.6, y + 0.1, 1.9}, {0.1f, 0.7f, 0.2f, 1}});
  const WalkScene scene = walk(near);
  for (const glm::dvec3& offset : {glm::dvec3(0), glm::dvec3(0.3, -0.6, 0.1)}) {
    ViewSettings settings;
    settings.renderer = Renderer::gl;
    settings.fillHoles = false;
    const PerspectiveView from = view(offset);
    const Frame cpu = onCpu(scene, from, settings), gl = onGl(scene, from, settings);
    // Glass blends in the framebuffer's own rounding.
    EXPECT_LE(differingShare(cpu.colour, gl.colour, 2), kMostDifferingShare);
    EXPECT_LE(differingSources(cpu, gl), kMostDifferingShare);
    EXPECT_GT(std::ranges::count(gl.source.pixels, kSourceLocal), 10000);
    settings.fillHoles = true;
    EXPECT_GT(test::psnrInMirrors(scene_, from, onGl(scene, from, settings)), 20);
  }
}

TEST_F(GlMirrors, CompileNothingWhereThereAreNone) {
  WalkScene scene = walk({});
  const auto mirrors = std::exchange(scene.mirrors, nullptr);
  const PerspectiveView from = view({0.3, -0.5, 0});
  const Frame poster = onGl(scene, from, {});
  const char* const marking = "local.frag MARK_MIRROR";
  EXPECT_FALSE(hasVariant(marking));
  scene.mirrors = mirrors;  // the same polygons, told anew
  EXPECT_GT(differingShare(onGl(scene, from, {}).colour, poster.colour), 0.1);
  EXPECT_TRUE(hasVariant(marking));
}

}  // namespace
}  // namespace acentric
