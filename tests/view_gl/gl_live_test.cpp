/// Frames that wait for no capture to be on the graphics card, against those that do.

#include <algorithm>

#include "engine/view_gl/capture_residency.h"
#include "gl_fixture.h"
#include "tests/view/capture_fixtures.h"
#include "tests/view/mirror_fixtures.h"

namespace acentric {
namespace {

using test::differingShare;

/// Of captures; more than all the coarse ones of these tests take, less than a fine one.
constexpr std::size_t kBytesPerFrame = 300'000;

class LiveRenderer {
 public:
  explicit LiveRenderer(std::size_t bytesPerFrame = kBytesPerFrame) {
    auto made = GlRenderer::create(
        {.waitForCaptures = false, .bytesPerFrame = bytesPerFrame, .secondsPerFrame = 600});
    EXPECT_TRUE(made) << made.error().describe();
    if (made) renderer_ = std::move(*made);
  }
  GlRenderer& operator*() { return *renderer_; }
  Frame draw(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings) {
    return test::drawnBy(*renderer_, scene, view, settings);
  }
  /// As the editor does: a new frame when there is something new to be shown, none while there is not.
  Frame drawWhenReady(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings) {
    Frame frame = draw(scene, view, settings);
    while (frame.stats.capturesAwaited > 0) {
      const auto news = renderer_->receive();
      EXPECT_TRUE(news);
      if (news && *news) {
        frame = draw(scene, view, settings);
      } else if (!renderer_->anyToReceive()) {
        ADD_FAILURE() << "something is awaited and nothing is on its way";
        return frame;
      }
    }
    return frame;
  }

 private:
  std::unique_ptr<GlRenderer> renderer_;
};

class GlLive : public test::WithGl {
 protected:
  GlLive() {
    views_.rise = 0.3, views_.pitch = 0.4;
    views_.width = 161, views_.height = 99;
    settings_.renderer = Renderer::gl;
    settings_.fillHoles = false;
  }
  WalkScene boxes(double perDegree, int layers = 2) const {
    return test::walkScene(test::randomPatches(3, 60, 3.4), layout_, region_, perDegree, layers);
  }
  PerspectiveView nextView() { return views_.next(*layout_, region_, 60); }
  static void expectSame(const Frame& a, const Frame& b) {
    EXPECT_TRUE(a.colour.pixels == b.colour.pixels);
    EXPECT_TRUE(a.source.pixels == b.source.pixels);
  }
  static std::vector<std::weak_ptr<const DisplayCapture>> watched(const WalkScene& scene) {
    std::vector<std::weak_ptr<const DisplayCapture>> all;
    for (const auto& capture : scene.captures)
      if (capture) all.push_back(capture);
    return all;
  }
  static bool areLetGoOf(const std::vector<std::weak_ptr<const DisplayCapture>>& captures) {
    return std::ranges::all_of(captures, [](const auto& capture) { return capture.expired(); });
  }
  static bool anyAlive(const std::vector<std::weak_ptr<const DisplayCapture>>& captures) {
    return std::ranges::any_of(captures, [](const auto& capture) { return !capture.expired(); });
  }

  test::RandomViews views_{11};
  ViewSettings settings_;
  std::shared_ptr<const Layout> layout_ = test::layoutAroundOrigin(Configuration::b);
  int region_ = *layout_->regionAt({0.1, 0.05});
};

TEST_F(GlLive, ShowsTheCoarseWhileTheFineAreSentInPieces) {
  const PerspectiveView view = nextView();
  const WalkScene coarse = test::onlyInView(boxes(0.5), view, settings_),
                  fine = test::onlyInView(boxes(3), view, settings_);
  LiveRenderer live;
  const Frame first = live.draw(coarse, view, settings_);
  expectSame(first, onGl(coarse, view, settings_));
  EXPECT_EQ(first.stats.capturesAwaited, 0) << "small enough to be sent at once";

  const Frame waited = onGl(fine, view, settings_);
  Frame frame = live.draw(fine, view, settings_);
  expectSame(frame, first);
  EXPECT_GT(frame.stats.images, 1);
  EXPECT_EQ(frame.stats.capturesAwaited, frame.stats.images);
  EXPECT_EQ(frame.stats.standIns, frame.stats.images);
  EXPECT_EQ(frame.stats.missingImages, 0);
  std::uint64_t sent = 0;
  int frames = 0, mixed = 0;
  for (; frame.stats.capturesAwaited > 0; ++frames) {
    ASSERT_TRUE((*live).anyToReceive());
    const int before = frame.stats.capturesAwaited;
    frame = live.draw(fine, view, settings_);
    EXPECT_LE(frame.stats.bytesSent, kBytesPerFrame);
    EXPECT_LE(frame.stats.capturesAwaited, before);
    EXPECT_EQ(frame.stats.standIns, frame.stats.capturesAwaited);
    mixed += frame.stats.capturesAwaited > 0 && frame.stats.capturesAwaited < frame.stats.images;
    sent += frame.stats.bytesSent;
  }
  EXPECT_GT(mixed, 0);
  EXPECT_GT(sent, 5 * kBytesPerFrame);
  EXPECT_GE(frames, int(sent / kBytesPerFrame));
  expectSame(frame, waited);
  EXPECT_NE(frame.colour.pixels, first.colour.pixels);
  EXPECT_EQ(live.draw(fine, view, settings_).stats.bytesSent, 0u);
  EXPECT_FALSE((*live).anyToReceive());
}

TEST_F(GlLive, CamerasAreMissingWithNothingToShowAndThenAreThere) {
  const PerspectiveView view = nextView();
  const WalkScene fine = test::onlyInView(boxes(3), view, settings_);
  LiveRenderer live;
  const Frame first = live.draw(fine, view, settings_);
  EXPECT_EQ(first.stats.images, 0);
  EXPECT_GT(first.stats.capturesAwaited, 0);
  EXPECT_EQ(first.stats.missingImages, first.stats.capturesAwaited);
  EXPECT_EQ(first.stats.standIns, 0);
  EXPECT_EQ(first.stats.bytesSent, 0u);
  expectSame(live.drawWhenReady(fine, view, settings_), onGl(fine, view, settings_));
}

TEST_F(GlLive, EndsWithThePictureOfThoseWhoWaitedWithMirrorsAndGlass) {
  test::MirrorScene room = test::roomWithMirror();
  room.surfaces.silhouettes = true;
  room.surfaces.boxes.push_back({{3.5, -1, 0.8}, {3.51, 1, 1.9}, {0.1f, 0.2f, 0.6f, 0.4f}});  // glass
  const auto layout = test::layoutAroundOrigin(Configuration::b, 2, 4);
  const int region = *layout->regionAt({0.05, 0.05});
  const WalkScene coarse = test::walkScene(room, layout, region, 0.5),
                  fine = test::walkScene(room, layout, region, 3);
  const PerspectiveView view = test::viewIntoMirror(*layout, {}, 161, 99);
  LiveRenderer live;
  const Frame waited = onGl(coarse, view, settings_);
  expectSame(live.drawWhenReady(coarse, view, settings_), waited);
  const Frame stillCoarse = live.draw(fine, view, settings_);
  expectSame(stillCoarse, waited);
  EXPECT_GT(stillCoarse.stats.standIns, 0);
  expectSame(live.drawWhenReady(fine, view, settings_), onGl(fine, view, settings_));
}

TEST_F(GlLive, WhatIsAroundTheEyeIsSentBeforeItIsSeen) {
  const WalkScene scene = boxes(3);
  const PerspectiveView there = nextView();
  PerspectiveView away = there;
  away.yawRadians += kPi;
  LiveRenderer live;
  const int lacked = live.draw(scene, there, settings_).stats.capturesAwaited;
  int news = 0;
  bool seen = false, around = false;
  while ((*live).anyToReceive()) {
    news += *(*live).receive() ? 1 : 0;
    if (news == lacked && !seen) {
      const Frame frame = live.draw(scene, there, settings_);
      seen = frame.stats.capturesAwaited == 0;
      around = (*live).anyToReceive();
    }
  }
  EXPECT_TRUE(seen && around) << "what is seen comes first";
  EXPECT_EQ(news, lacked) << "what is not seen calls for no new picture";
  for (const PerspectiveView& view : {there, away}) {
    const Frame frame = live.draw(scene, view, settings_);
    EXPECT_EQ(frame.stats.capturesAwaited, 0);
    expectSame(frame, onGl(scene, view, settings_));
  }
}

TEST_F(GlLive, TheCoarseStandInForWhatComesWhileTheEyeLooksAway) {
  const WalkScene coarse = boxes(0.5), fine = boxes(3);
  const PerspectiveView there = nextView();
  PerspectiveView away = there;
  away.yawRadians += kPi;
  LiveRenderer live;
  const Frame first = live.drawWhenReady(coarse, there, settings_);
  live.draw(fine, away, settings_);
  const Frame again = live.draw(fine, there, settings_);
  EXPECT_EQ(again.stats.missingImages, 0);
  EXPECT_GT(again.stats.standIns, 0);
  EXPECT_GT(first.stats.images, 0);
  expectSame(live.drawWhenReady(fine, there, settings_), onGl(fine, there, settings_));
}

TEST_F(GlLive, KeepsNoMoreInMemoryThanTheWalkButWhatStandsIn) {
  WalkScene coarse = boxes(0.5), fine = boxes(3);
  const PerspectiveView there = nextView();
  PerspectiveView away = there;
  away.yawRadians += kPi;
  LiveRenderer live;
  live.drawWhenReady(fine, there, settings_);
  const auto evicted = watched(fine);
  live.draw(fine = coarse, away, settings_);
  EXPECT_TRUE(areLetGoOf(evicted)) << "what is larger stands in out of sight";

  live.drawWhenReady(coarse, there, settings_);
  const auto standing = watched(coarse);
  coarse = fine = boxes(3);
  live.draw(fine, there, settings_);
  EXPECT_TRUE(anyAlive(standing));
  live.drawWhenReady(fine, there, settings_);
  live.drawWhenReady(fine, away, settings_);
  EXPECT_TRUE(areLetGoOf(standing));

  const auto wanted = watched(fine);
  LiveRenderer other;
  other.draw(fine, there, settings_);
  for (auto& capture : fine.captures) capture.reset();
  coarse = fine;
  const Frame gone = other.draw(fine, there, settings_);
  EXPECT_EQ(gone.stats.capturesAwaited, 0);
  EXPECT_FALSE((*other).anyToReceive());
  live.draw(fine, there, settings_);
  EXPECT_TRUE(areLetGoOf(wanted));
}

TEST_F(GlLive, OtherRenderersEndTheSendingAndLetGoOfStandIns) {
  WalkScene scene = boxes(3);
  const PerspectiveView view = nextView();
  LiveRenderer live;
  live.draw(scene, view, settings_);
  (*live).stopSending();
  EXPECT_FALSE((*live).anyToReceive());
  expectSame(live.drawWhenReady(scene, view, settings_), onGl(scene, view, settings_));
  const auto drawn = watched(scene);
  scene = {};
  EXPECT_TRUE(anyAlive(drawn));
  (*live).stopSending();
  EXPECT_TRUE(areLetGoOf(drawn));
}

TEST_F(GlLive, TwoRenderersSendEachTheirOwn) {
  const WalkScene coarse = boxes(0.5), fine = boxes(3);
  const PerspectiveView a = nextView(), b = nextView();
  LiveRenderer first, second;
  first.draw(coarse, a, settings_);
  first.draw(fine, a, settings_);
  EXPECT_EQ(second.draw(fine, b, settings_).stats.images, 0);
  expectSame(second.drawWhenReady(fine, b, settings_), onGl(fine, b, settings_));
  expectSame(first.drawWhenReady(fine, a, settings_), onGl(fine, a, settings_));
}

TEST_F(GlLive, TellsWhatIsWrongWithACapture) {
  const WalkScene sound = boxes(3);
  const PerspectiveView view = nextView();
  for (const std::size_t bytesPerFrame : {kBytesPerFrame, std::size_t(1) << 30}) {  // later, and at once
    WalkScene scene = sound;
    const auto spoilt = std::ranges::find_if(scene.captures, [&](const auto& capture) {
      WalkScene alone = sound;
      for (auto& other : alone.captures) other = other == capture ? capture : nullptr;
      return capture && onGl(alone, view, settings_).stats.images == 1;
    });
    ASSERT_NE(spoilt, scene.captures.end());
    const std::string name = "capture of camera " + std::to_string(spoilt - scene.captures.begin());
    auto capture = std::make_shared<DisplayCapture>(**spoilt);
    auto patches = std::make_shared<DisplayPatches>(*capture->patches);
    patches->cover.pop_back();
    capture->patches = patches;
    *spoilt = capture;
    LiveRenderer live(bytesPerFrame);
    auto drawn = (*live).draw(scene, view, settings_);
    for (; drawn; drawn = (*live).draw(scene, view, settings_)) ASSERT_TRUE((*live).anyToReceive());
    EXPECT_EQ(drawn.error().kind, ErrorKind::malformed);
    EXPECT_EQ(drawn.error().where, name);
    EXPECT_FALSE((*live).draw(scene, view, settings_)) << "told as long as it is needed";
    *spoilt = nullptr;
    EXPECT_GT(live.drawWhenReady(scene, view, settings_).stats.missingImages, 0);
    expectSame(live.drawWhenReady(sound, view, settings_), onGl(sound, view, settings_));
  }
}

TEST_F(GlLive, IsDestroyedWhileItSends) {
  const WalkScene scene = boxes(3);
  for (int i = 0; i < 4; ++i) LiveRenderer().draw(scene, nextView(), settings_);
  for (const auto& capture : scene.captures) EXPECT_LE(capture.use_count(), 1);
}

TEST_F(GlLive, WhatIsOnItsWayCountsAsGraphicsMemory) {
  const WalkScene scene = boxes(2);
  std::vector<std::shared_ptr<const DisplayCapture>> captures;
  std::ranges::copy_if(scene.captures, std::back_inserter(captures),
                       [](const auto& c) { return c != nullptr; });
  ASSERT_GE(captures.size(), 2u);
  CaptureResidency residency;
  ASSERT_TRUE(residency.get(captures[0], "there"));
  const std::size_t there = residency.bytes();
  const std::size_t coming = bufferBytes(*captures[1]);
  residency.trim(there);
  ASSERT_TRUE(residency.ask(captures[1], "coming"));
  residency.end();
  SendLimit little(1000, 600), all(coming, 600);
  EXPECT_FALSE(*residency.receive(little));
  EXPECT_EQ(little.left(), 0u);
  residency.trim(there + coming);
  EXPECT_TRUE(residency.ready(captures[0]));
  residency.trim(there + coming);
  residency.trim(there + coming - 1);
  EXPECT_FALSE(residency.ready(captures[0]));
  EXPECT_TRUE(*residency.receive(all));
  EXPECT_EQ(residency.bytes(), coming);
}

}  // namespace
}  // namespace acentric
