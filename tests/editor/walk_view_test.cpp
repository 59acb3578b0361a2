/// What is shown of the walk: truth beside it, frame times, images in use, saved pictures.

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <optional>
#include <set>

#include "editor/actions/action_table.h"
#include "editor/session/frame_times.h"
#include "editor/session/screenshot.h"
#include "editor/session/used_images.h"
#include "editor/session/walk_renderer.h"
#include "engine/base/file.h"
#include "engine/view/view_cameras.h"

#include "tests/editor/session_fixture.h"

namespace acentric::editor {
namespace {

fs::path emptyFolder(const char* name) {
  const fs::path folder = fs::temp_directory_path() / (name + std::to_string(::getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

class WalkViewTest : public OpenSessionTest {
 protected:
  void SetUp() override {
    OpenSessionTest::SetUp();
    view_.eye = glm::dvec3(session_->project().spawn().position, session_->built()->layout->eyeZ());
    view_.yawRadians = 0.4;
    view_.width = 64, view_.height = 48;
  }
  TruthFrame truthOf(const PerspectiveView& view, int rays) const {
    TaskRunner runner(1);
    const OpenProject& open = *session_->built();
    return renderTruth(*open.rays, view, open.project.bake, open.project.exposure, rays, runner);
  }
  CompareRequest request(int rays, std::shared_ptr<const Frame> frame = nullptr) const {
    return {session_->built(), view_, session_->project().exposure, rays, std::move(frame)};
  }
  /// What the walk would show if it were the truth, painted by one camera but for its first row, a hole.
  std::shared_ptr<const Frame> perfectFrame(int rays) const {
    auto frame = std::make_shared<Frame>();
    frame->colour = truthOf(view_, rays).colour;
    frame->source = Image<PixelSource>(view_.width, view_.height, sourceOfCamera(0));
    for (int x = 0; x < view_.width; ++x) frame->source.at(x, 0) = kSourceHole;
    return frame;
  }

  PerspectiveView view_;
};

TEST_F(WalkViewTest, TheTruthIsCoarseAtFirstAndEndsAsTheOneThatIsMeasuredAgainst) {
  TruthCompare& compare = session_->comparing();
  std::vector<int> rays;
  const CompareRequest wanted = request(9);
  compare.follow(wanted);
  EXPECT_EQ(compare.truth(), nullptr);
  waitFor([&] {
    compare.follow(wanted);
    if (compare.truth() && (rays.empty() || rays.back() != compare.truth()->raysPerPixel))
      rays.push_back(compare.truth()->raysPerPixel);
    return compare.truth() && compare.truth()->raysPerPixel == 9 && !compare.tracing();
  });
  EXPECT_TRUE(std::ranges::is_sorted(rays));
  EXPECT_EQ(compare.truth()->frame.colour.pixels, truthOf(view_, 9).colour.pixels);
  EXPECT_EQ(compare.compared(), nullptr) << "there is no frame yet";
  EXPECT_EQ(describe(*compare.truth()), "truth, 9 rays per pixel");
}

TEST_F(WalkViewTest, FiguresAreOfTheFrameAndTheTruthThatTheyName) {
  TruthCompare& compare = session_->comparing();
  const auto frame = perfectFrame(4);
  waitFor([&] {
    compare.follow(request(4, frame));
    return compare.compared() && compare.compared()->raysPerPixel == 4;
  });
  EXPECT_EQ(compare.compared()->figures.psnr, 99) << "the same picture";
  EXPECT_NEAR(compare.compared()->figures.ssim, 1, 1e-9);
  EXPECT_NEAR(compare.compared()->figures.holeShare, 1.0 / view_.height, 1e-9) << "a row of all";
  EXPECT_EQ(figuresText(*compare.compared()), "PSNR 99.0 dB   SSIM 1.000   holes 2.08 % of pixels");
  EXPECT_EQ(againstText(*compare.compared()), "against 4 rays per pixel, 64×48 pixels");

  // Another frame from the same place: the truth stays, the figures are not those of the frame before.
  auto dark = std::make_shared<Frame>(*frame);
  for (Rgba8& pixel : dark->colour.pixels) pixel = Rgba8(0, 0, 0, 255);
  const auto truth = compare.truth();
  compare.follow(request(4, dark));
  EXPECT_EQ(compare.compared(), nullptr);
  EXPECT_EQ(compare.truth(), truth);
  waitFor([&] {
    compare.follow(request(4, dark));
    return compare.compared() != nullptr;
  });
  EXPECT_EQ(compare.compared()->frame, dark);
  EXPECT_LT(compare.compared()->figures.psnr, 30);
}

TEST_F(WalkViewTest, WhenTheEyeMovesTheTruthIsGoneAtOnce) {
  TruthCompare& compare = session_->comparing();
  view_.width = 1600, view_.height = 1200;
  compare.follow(request(16));
  EXPECT_TRUE(compare.tracing());
  waitFor([&] { return compare.truth() != nullptr; });
  compare.follow(std::nullopt);  // it moves
  EXPECT_EQ(compare.truth(), nullptr);
  const auto asked = std::chrono::steady_clock::now();
  waitFor([&] { return !compare.tracing(); });
  EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds(5));
  EXPECT_EQ(compare.truth(), nullptr);
  view_.yawRadians += 0.1, view_.width = 64, view_.height = 48;
  waitFor([&] {
    compare.follow(request(1));
    return compare.truth() && compare.truth()->raysPerPixel == 1;
  });
  EXPECT_EQ(compare.truth()->frame.colour.pixels, truthOf(view_, 1).colour.pixels);
}

TEST_F(WalkViewTest, MoreRaysRefineTheTruthAndFewerReplaceIt) {
  TruthCompare& compare = session_->comparing();
  const auto until = [&](int rays) {
    waitFor([&] {
      compare.follow(request(rays));
      return compare.truth() && compare.truth()->raysPerPixel == rays && !compare.tracing();
    });
  };
  until(1);
  compare.follow(request(16));
  EXPECT_EQ(compare.truth()->raysPerPixel, 1) << "stays until there is a finer one";
  until(16);
  compare.follow(request(4));
  EXPECT_EQ(compare.truth(), nullptr) << "no figures against more rays than are asked for";
  until(4);
  until(4);
}

TEST_F(WalkViewTest, ImagesInUseAreListedAsTheyArePainted) {
  const LoadedWalk& walk = *session_->walk();
  const Layout& layout = *walk.walk.layout;
  const auto ring = std::ranges::find(layout.regions, RegionKind::ring, &Region::kind);
  ASSERT_NE(ring, layout.regions.end());
  view_.eye = glm::dvec3(ring->polygon.centroid() + glm::dvec2(0.05, 0.02), view_.eye.z);
  ViewSettings settings;
  const auto images = usedImages(walk, view_, settings, nullptr);
  std::vector<int> cameras;
  for (const UsedImage& image : images) {
    cameras.push_back(image.camera);
    EXPECT_EQ(image.state, ImageState::missing) << "nothing is baked";
    EXPECT_FALSE(image.share.has_value());
  }
  EXPECT_EQ(cameras, paintingOrder(layout, view_, settings));
  std::ranges::sort(cameras);
  EXPECT_EQ(cameras, camerasOf(layout, view_, settings).cameras);
  // The other hand lies behind: once the own cover has begun, only the own cover follows.
  const auto own = std::ranges::find(images, SourceRole::ownCover, &UsedImage::role);
  ASSERT_NE(own, images.end());
  EXPECT_NE(own, images.begin());
  for (auto image = own; image != images.end(); ++image) EXPECT_EQ(image->role, SourceRole::ownCover);
  settings.secondaryCover = false;
  EXPECT_EQ(int(usedImages(walk, view_, settings, nullptr).size()), int(images.end() - own));
}

TEST_F(WalkViewTest, AnImagesShareIsThatOfThePixelsThatItPainted) {
  const LoadedWalk& walk = *session_->walk();
  const auto order = paintingOrder(*walk.walk.layout, view_, {});
  ASSERT_GE(order.size(), 2U);
  Frame frame;
  frame.colour = ColourImage(4, 2);
  frame.source = Image<PixelSource>(4, 2, sourceOfCamera(order.back()));
  frame.source.at(1, 1) = kSourceLocal;
  frame.source.at(2, 0) = sourceOfCamera(order.front());
  const auto images = usedImages(walk, view_, {}, &frame);
  EXPECT_EQ(images.back().share, 6.0 / 8);
  EXPECT_EQ(images.front().share, 1.0 / 8);
  const ColourImage veil = spotlight(frame, order.front());
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) EXPECT_EQ(veil.at(x, y).a == 0, x == 2 && y == 0) << x << " " << y;
}

TEST_F(WalkViewTest, APictureIsSavedBesideTheProjectAndItsPlaceTold) {
  ColourImage picture(3, 2, Rgba8(10, 200, 30, 255));
  session_->savePicture(picture);
  waitFor([&] { return !session_->savingPicture().running(); });
  const fs::path file = folder_ / "room-view-001.png";
  const auto read = readColourImage(file);
  ASSERT_TRUE(read) << read.error().describe();
  EXPECT_EQ(read->pixels, picture.pixels);
  EXPECT_NE(session_->messages().all().back().text.find(file.string()), std::string::npos);
}

TEST(FrameTimes, KeepsTheNewestAndSumsTheirParts) {
  FrameTimes times;
  EXPECT_EQ(times.spread().count, 0);
  for (int i = 1; i <= 300; ++i) {
    FrameStats stats;
    stats.planSeconds = 0.001;
    stats.warpSeconds = i * 1e-3;
    stats.localSeconds = 0.002;
    stats.fillSeconds = 0.003;
    stats.sendSeconds = 0.004;
    times.add(stats);
    times.presented(0.01);
    times.presented(1);  // the window shows the same picture again
  }
  ASSERT_EQ(times.frames().size(), FrameTimes::kMost);
  EXPECT_NEAR(times.frames().front().total(), 0.061 + 0.020, 1e-12);
  EXPECT_NEAR(times.frames().back().total(), 0.300 + 0.020, 1e-12);
  EXPECT_NEAR(times.frames().back().seconds[std::size_t(FramePart::captures)], 0.300, 1e-12);
  EXPECT_NEAR(times.spread().median, 0.020 + 0.5 * (0.180 + 0.181), 1e-12);
  EXPECT_NEAR(times.spread().p99, 0.020 + 0.298, 1e-12) << "238 of 240 do not exceed it";
  EXPECT_EQ(times.spread().count, 240);
}

TEST(Screenshots, GetTheNextNumberAndNeverReplaceAFile) {
  const fs::path folder = emptyFolder("acentric_screenshots_");
  const fs::path project = folder / "hall.acentric.json";
  const ColourImage picture(2, 2, Rgba8(1, 2, 3, 255));
  EXPECT_EQ(nextScreenshot(project), folder / "hall-view-001.png");
  for (const char* name : {"hall-view-007.png", "hall-view-x9.png", "hall-view-.png", "hallway-view-050.png"})
    ASSERT_TRUE(writeTextAtomically(folder / name, "not ours"));
  for (int i = 8; i <= 10; ++i) {
    const auto written = writeScreenshot(picture, project);
    ASSERT_TRUE(written) << written.error().describe();
    EXPECT_EQ(*written,
              folder / ("hall-view-0" + std::string(i < 10 ? "0" : "") + std::to_string(i) + ".png"));
  }
  EXPECT_EQ(readText(folder / "hall-view-007.png").value(), "not ours");
  const auto nowhere = writeScreenshot(picture, folder / "no such" / "hall.acentric.json");
  ASSERT_FALSE(nowhere);
  EXPECT_NE(nowhere.error().where.find("hall-view-001.png"), std::string::npos);
  fs::remove_all(folder);
}

TEST(Screenshots, OfSeveralAtOnceAreAllKept) {
  const fs::path folder = emptyFolder("acentric_screenshots_at_once_");
  constexpr int kThreads = 4, kEach = 6;
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < kThreads; ++t)
      threads.emplace_back([&, t] {
        for (int i = 0; i < kEach; ++i)
          EXPECT_TRUE(writeScreenshot(ColourImage(1, 1, Rgba8(t, i, 0, 255)), folder / "hall.acentric.json"));
      });
  }
  std::set<std::pair<int, int>> seen;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto picture = readColourImage(entry.path());
    ASSERT_TRUE(picture) << entry.path();
    seen.emplace(picture->at(0, 0).r, picture->at(0, 0).g);
  }
  EXPECT_EQ(seen.size(), std::size_t(kThreads * kEach));
  fs::remove_all(folder);
}

TEST(Screenshots, AreSplitWhereTheBorderIs) {
  const ColourImage left(4, 2, Rgba8(255, 0, 0, 255)), right(4, 2, Rgba8(0, 0, 255, 255));
  const ColourImage both = splitPicture(left, right, 0.25);
  for (int x = 0; x < 4; ++x) EXPECT_EQ(both.at(x, 1), (x < 1 ? left : right).at(x, 1)) << x;
  EXPECT_EQ(splitPicture(left, right, 1).pixels, left.pixels);
  EXPECT_EQ(splitPicture(left, right, 0).pixels, right.pixels);
}

TEST(WalkViewActions, ALookIsSwitchedOnAndOffAndOneAtATime) {
  const std::vector<Action> table = makeActionTable();
  Session session({});
  EditorState state;
  ActionContext context{session, state};
  const auto run = [&](const char* id) { findAction(table, std::string(id))->run(context); };
  run("view.split");
  EXPECT_EQ(state.walkLook, WalkLook::split);
  run("view.difference");
  EXPECT_EQ(state.walkLook, WalkLook::difference);
  EXPECT_FALSE(findAction(table, std::string("view.split"))->checked(context));
  run("view.difference");
  EXPECT_EQ(state.walkLook, WalkLook::picture);
  run("compare.rays.16");
  EXPECT_EQ(state.truthRays, 16);
  run("compare.gain.8");
  EXPECT_EQ(state.differenceGain, 8);
  EXPECT_TRUE(findAction(table, std::string("compare.gain.8"))->checked(context));
}

TEST(RendersTheSame, UnlessAPartThatThePictureReadsIsAnother) {
  Project project;
  project.layout().cellSize = 2;
  project.layout().added = {{0, 0, 0, 0}, {1, 0, 0, 0}};
  WalkScene before;
  before.layout = std::make_shared<const Layout>(buildLayout(project.layout()).value());
  const Layout& layout = *before.layout;
  before.captures.resize(layout.cameras.size());
  before.local.resize(layout.regions.size());
  PerspectiveView view;
  view.eye = {layout.regions[0].polygon.centroid(), layout.eyeZ()};
  const ViewSettings settings;
  const ViewCameras used = camerasOf(layout, view, settings);
  ASSERT_EQ(used.region, 0);
  ASSERT_LT(used.cameras.size(), layout.cameras.size());
  const auto after = [&](const std::function<void(WalkScene&)>& change) {
    WalkScene scene = before;
    change(scene);
    return rendersTheSame(before, scene, view, settings);
  };
  EXPECT_TRUE(after([](WalkScene&) {}));
  for (std::size_t c = 0; c < layout.cameras.size(); ++c)
    EXPECT_EQ(after([&](WalkScene& scene) { scene.captures[c] = std::make_shared<DisplayCapture>(); }),
              !std::ranges::binary_search(used.cameras, int(c)))
        << c;
  EXPECT_FALSE(after([](WalkScene& scene) { scene.local[0] = std::make_shared<LocalGeometry>(); }));
  EXPECT_TRUE(after([](WalkScene& scene) { scene.local[1] = std::make_shared<LocalGeometry>(); }));
  EXPECT_FALSE(after([](WalkScene& scene) { scene.surfaceLight = std::make_shared<SurfaceLight>(); }));
  EXPECT_FALSE(after([](WalkScene& scene) { scene.exposure = 2; }));
  EXPECT_FALSE(after([](WalkScene& scene) { scene.plan[Effect::sky].on = !scene.plan.on(Effect::sky); }));
}

}  // namespace
}  // namespace acentric::editor
