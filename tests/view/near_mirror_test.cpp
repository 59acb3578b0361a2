/// Mirrors within the near band: polygons, which show the reflections that captures hold.

#include <algorithm>

#include "tests/view/mirror_fixtures.h"

namespace acentric {
namespace {

using test::AnalyticBox;
using test::frameOf;
using test::MirrorScene;
using test::plainSettings;
using test::psnrInMirrors;
using test::roomWithMirror;

class NearMirrors : public testing::Test {
 protected:
  /// `near`: boxes beside the mirror that are local geometry too.
  WalkScene walk(const std::vector<AnalyticBox>& near = {}) {
    scene_ = roomWithMirror();
    return test::walkPastNearMirrors(scene_, near, layout_, region_, 5);
  }
  /// With its mirrors as any other polygon.
  static WalkScene poster(WalkScene walk) {
    walk.mirrors = nullptr;
    return walk;
  }
  PerspectiveView view(const glm::dvec3& offset) const { return test::viewIntoMirror(*layout_, offset); }
  /// What a ray through the middle of a pixel sees, nearest first.
  std::vector<MirrorScene::Seen> truth(const PerspectiveView& view, int x, int y) const {
    return scene_.along(view.eye, view.rayThrough(x + 0.5, y + 0.5), 0);
  }

  std::shared_ptr<const Layout> layout_ = test::layoutAroundOrigin(Configuration::b, 2, 4);
  int region_ = *layout_->regionAt({0.05, 0.05});
  MirrorScene scene_;
};

TEST_F(NearMirrors, ShowWhatTheEyeSeesInThem) {
  const WalkScene scene = walk(), still = poster(scene);
  for (const glm::dvec3& offset : {glm::dvec3(0), glm::dvec3(0.3, -0.6, 0.1), glm::dvec3(-0.5, 0.5, -0.2)}) {
    const PerspectiveView from = view(offset);
    const ViewSettings settings = test::splatSettings();
    const double with = psnrInMirrors(scene_, from, frameOf(scene, from, settings)),
                 without = psnrInMirrors(scene_, from, frameOf(still, from, settings));
    RecordProperty("psnr", std::to_string(with) + " instead of " + std::to_string(without));
    EXPECT_GT(with, without + 6);
    EXPECT_GT(with, 20);
  }
}

TEST_F(NearMirrors, StayLocalGeometryAndNothingElseOfThePictureChanges) {
  const WalkScene scene = walk(), still = poster(scene);
  const PerspectiveView from = view({0.3, -0.5, 0});
  const ViewSettings settings = test::splatSettings();
  const Frame with = frameOf(scene, from, settings), without = frameOf(still, from, settings);
  EXPECT_EQ(with.source.pixels, without.source.pixels);
  std::size_t changed = 0;
  for (int y = 0; y < from.height; ++y)
    for (int x = 0; x < from.width; ++x)
      if (with.source.at(x, y) != kSourceLocal)
        ASSERT_EQ(with.colour.at(x, y), without.colour.at(x, y)) << x << " " << y;
      else
        changed += with.colour.at(x, y) != without.colour.at(x, y);
  EXPECT_GT(changed, std::size_t(9 * std::ranges::count(with.source.pixels, kSourceLocal) / 10));
}

TEST_F(NearMirrors, HideBehindNearerLocalGeometryAlone) {
  // One box before the mirror; one behind it, which nothing shows.
  const AnalyticBox before{{2.5, -0.5, 0.9}, {2.6, 0.4, 1.9}, {0.1f, 0.7f, 0.2f, 1}},
      behind{{4.1, -0.8, 0.9}, {4.2, 0.9, 2.2}, {0.8f, 0.1f, 0.6f, 1}};
  const WalkScene scene = walk({before, behind});
  int ofBox = 0;
  for (const Renderer renderer : {Renderer::list, Renderer::scalar, Renderer::zbuffer}) {
    const PerspectiveView from = view({0.2, -0.2, 0});
    const Frame frame = frameOf(scene, from, plainSettings(renderer));
    EXPECT_GT(psnrInMirrors(scene_, from, frame), 20);
    for (int y = 0; y < from.height; ++y)
      for (int x = 0; x < from.width; ++x) {
        const auto seen = truth(from, x, y);
        if (seen.front().mirror != 0 || seen.front().colour != before.colour) continue;
        ++ofBox;
        ASSERT_EQ(frame.colour.at(x, y), encodeForDisplay(glm::vec3(before.colour), 1)) << x << " " << y;
      }
  }
  EXPECT_GT(ofBox, 3000);
}

TEST_F(NearMirrors, AreTintedByGlassBeforeThemAndNotByGlassBehind) {
  const glm::vec4 red(0.9f, 0, 0, 0.5f);
  const PerspectiveView from = view({0.3, -0.5, 0});
  const Frame clear = frameOf(walk(), from, {});
  const Frame before = frameOf(walk({{{3.5, -3, 0}, {3.51, 3, 4}, red}}), from, {});
  const Frame behind = frameOf(walk({{{4.1, -1.9, 0.7}, {4.11, 1.9, 2.5}, red}}), from, {});
  const Rgba8 least = encodeForDisplay(glm::vec3(red) * red.a, 1);
  for (int y = 90; y < 110; ++y)
    for (int x = 120; x < 200; ++x) {
      ASSERT_GE(before.colour.at(x, y).r + 2, least.r);
      ASSERT_EQ(behind.colour.at(x, y), clear.colour.at(x, y));
    }
}

TEST_F(NearMirrors, AreTheSameForAnyThreadCountAndRenderer) {
  const WalkScene scene = walk({{{2.5, -0.5, 0.9}, {2.6, 0.4, 1.9}, {0.1f, 0.7f, 0.2f, 1}}});
  const PerspectiveView from = view({0.2, -0.4, 0});
  ViewSettings settings = test::splatSettings();
  settings.renderer = Renderer::scalar;
  const Frame truth = frameOf(scene, from, settings);
  settings.renderer = Renderer::list;
  for (const int workers : {0, 1, 3}) {
    const Frame frame = frameOf(scene, from, settings, workers);
    EXPECT_EQ(frame.colour.pixels, truth.colour.pixels) << workers;
    EXPECT_EQ(frame.source.pixels, truth.source.pixels);
  }
  const Frame list = frameOf(scene, from, settings);
  settings.renderer = Renderer::zbuffer;
  const Frame nearest = frameOf(scene, from, settings);
  for (std::size_t p = 0; p < list.colour.pixels.size(); ++p)
    if (list.source.pixels[p] == kSourceLocal) {
      ASSERT_EQ(nearest.colour.pixels[p], list.colour.pixels[p]) << p;
    }
}

TEST_F(NearMirrors, KeepTheirOwnColourWhereNothingIsKnown) {
  WalkScene scene = walk();
  for (auto& capture : scene.captures) {
    if (!capture) continue;
    auto without = std::make_shared<DisplayCapture>(*capture);
    without->reflections = nullptr;
    capture = without;
  }
  const PerspectiveView from = view({0.3, -0.5, 0});
  EXPECT_EQ(frameOf(scene, from, {}).colour.pixels, frameOf(poster(scene), from, {}).colour.pixels);
}

}  // namespace
}  // namespace acentric
