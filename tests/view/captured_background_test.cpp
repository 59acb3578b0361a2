#include "engine/view/captured_background.h"

#include "tests/view/capture_fixtures.h"

namespace acentric {
namespace {

const Sky kSky{{0.1f, 0.2f, 0.7f}, {0.6f, 0.6f, 0.6f}, {0.2f, 0.1f, 0.1f}};

/// A capture of nothing but background: runs of random length, gaps and roles.
DisplayCapture randomBackground(const ColumnCamera& camera, std::mt19937& random) {
  Capture capture;
  capture.camera = camera;
  capture.columnStart.assign(static_cast<std::size_t>(camera.columns) + 1, 0);
  BackgroundBuilder background;
  for (int k = 0; k < camera.columns; ++k) {
    for (int row = 0; row < camera.rows;) {
      const int end = std::min(camera.rows, row + 1 + static_cast<int>(random() % 40));
      const auto roles = static_cast<std::uint8_t>(random() % 4);
      for (; row < end; ++row)
        if (roles != 0) background.add(row, roles);
    }
    background.closeColumn();
  }
  capture.background = std::move(background).finish(kSky);
  EXPECT_TRUE(capture.check());
  return prepareForDisplay(capture, 1);
}

/// Does the piece show the background in this direction? 1 yes, 0 no, -1 too near a border to tell.
int shows(const PieceDraw& piece, const DisplayCapture& capture, const glm::dvec3& direction) {
  constexpr double kNear = 1e-7;
  const auto between = [&](double position) {
    return std::abs(position - std::round(position)) < kNear * std::max(1.0, std::abs(position));
  };
  const double azimuth = std::atan2(direction.y, direction.x);
  if (piece.clipToPart) {
    const double inPart = wrapAngle(azimuth - piece.part.azimuths.low);
    const double width = piece.part.azimuths.width;
    if (std::min({inPart, kTwoPi - inPart, std::abs(inPart - width)}) < kNear) return -1;
    if (inPart >= width) return 0;
  }
  const ColumnCamera& camera = capture.camera;
  const double x = wrapAngle(azimuth - camera.lowAzimuth) / camera.columnPitch();
  const double elevation = std::atan2(direction.z, std::hypot(direction.x, direction.y));
  const double y = (camera.topElevation - elevation) / camera.rowPitch();
  if (between(x) || between(y) || kTwoPi - wrapAngle(azimuth - camera.lowAzimuth) < kNear) return -1;
  if (x >= camera.columns || y < 0 || y >= camera.rows) return 0;
  const auto k = static_cast<std::size_t>(x);
  const auto drawn = [&](const ColumnRun& run) { return int(k) >= run.first && int(k) < run.last; };
  if (std::ranges::none_of(piece.runs, drawn)) return 0;
  const CaptureBackground& runs = capture.background.runs;
  for (std::size_t i = runs.columnStart[k]; i < runs.columnStart[k + 1]; ++i)
    if (y >= runs.firstRow[i] && y < runs.endRow[i]) return (runs.roles[i] & piece.roles) != 0;
  return 0;
}

int codesApart(const Rgba8& a, const Rgba8& b) {
  int most = 0;
  for (int i = 0; i < 3; ++i) most = std::max(most, std::abs(int(a[i]) - int(b[i])));
  return most;
}

/// Two captures that overlap; the second lies over the first.
TEST(CapturedBackground, IsWhatEachPixelsOwnDirectionFindsInTheRuns) {
  test::RandomViews views(41);
  const ColumnCamera cameras[] = {test::cameraAt({3, 1, 1.6}, 20, 90, 150), test::cameraAt({-2, 4, 1.6}, 50)};
  std::size_t compared = 0, shown = 0;
  for (int round = 0; round < 60; ++round) {
    WalkScene scene;
    ViewPlan plan;
    for (const ColumnCamera& camera : cameras) {
      scene.captures.push_back(
          std::make_shared<const DisplayCapture>(randomBackground(camera, views.random)));
      PieceDraw piece;
      piece.camera = static_cast<int>(plan.backgrounds.size());
      piece.roles = round % 3 == 0 ? 0xff : 2;
      if (round % 2 == 0)
        piece.runs = {{0, camera.columns, true}};
      else
        piece.runs = {{camera.columns / 2, camera.columns - 7, false}, {5, camera.columns / 3, true}};
      piece.clipToPart = round % 4 > 1;
      piece.part.azimuths = {views.between(0, kTwoPi), views.between(0.1, 6)};
      plan.backgrounds.push_back(piece);
    }
    PerspectiveView view;
    view.yawRadians = views.between(-0.6, 1.6);
    view.pitchRadians = round % 5 == 0 ? 0 : round % 5 == 1 ? kPi / 2 : views.between(-kPi / 2, kPi / 2);
    view.fovRadians = radians(views.between(20, 110));
    view.width = 61 + round % 2, view.height = 47;
    Canvas canvas;
    clearCanvas(scene, view, plan, 0, view.width, canvas);
    CapturedBackground(scene, plan).paint(view, canvas);
    for (int x = 0; x < view.width; ++x)
      for (int y = 0; y < view.height; ++y) {
        const glm::dvec3 direction = view.rayThrough(x + 0.5, y + 0.5);
        int slot = 0;
        for (std::size_t i = 0; i < plan.backgrounds.size() && slot >= 0; ++i)
          if (const int found = shows(plan.backgrounds[i], *scene.captures[i], direction); found != 0)
            slot = found < 0 ? -1 : int(capturedBackgroundSlot(i));
        if (slot < 0) continue;
        const CanvasPixel pixel = canvas.column(x)[y];
        ASSERT_EQ(int(slotOf(pixel)), slot) << round << ": " << x << ", " << y;
        ++compared;
        if (slot == 0) continue;
        ++shown;
        ASSERT_EQ(inverseZDepthOf(pixel), 0);
        ASSERT_LE(codesApart(colourOf(static_cast<std::uint32_t>(pixel)),
                             encodeForDisplay(kSky.radiance(glm::vec3(direction)), 1)),
                  1);
      }
  }
  EXPECT_GT(compared, 160000u);
  EXPECT_GT(shown, 10000u);
}

TEST(CapturedBackground, LiesBehindEverySampleWhicheverCaptureHasIt) {
  test::AnalyticScene analytic = test::randomBoxes(5, 40, 4);
  analytic.floor = false;
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const WalkScene walk = test::walkScene(analytic, layout, 0, 4);
  test::RandomViews views(3);
  for (int i = 0; i < 8; ++i) {
    const PerspectiveView view = views.next(*layout, 0, 70);
    ViewSettings settings = test::plainSettings();
    const Frame list = test::frameOf(walk, view, settings);
    settings.renderer = Renderer::zbuffer;
    const Frame zbuffer = test::frameOf(walk, view, settings);
    std::size_t wrong = 0;
    const Rgba8 sky = encodeForDisplay(glm::vec3(analytic.skyColour), 1);
    for (int y = 0; y < view.height; ++y)
      for (int x = 0; x < view.width; ++x)
        wrong += (list.colour.at(x, y) == sky) != (zbuffer.colour.at(x, y) == sky);
    EXPECT_EQ(wrong, 0u) << i;
  }
}

}  // namespace
}  // namespace acentric
