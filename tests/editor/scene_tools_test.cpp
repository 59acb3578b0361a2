/// The 3D view without a window: its camera, its pointer, what lies under a pixel, and going from camera to
/// camera.

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "editor/tools/camera_steps.h"
#include "editor/tools/orbit_camera.h"
#include "editor/tools/scene_hits.h"
#include "editor/tools/scene_tool.h"
#include "engine/geometry/conventions.h"
#include "ui/keys.h"

namespace acentric::editor {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

void expectAt(const OrbitCamera& camera, const glm::dvec3& point, const glm::dvec2& pixel) {
  const Projected seen = project(camera.view(), point);
  EXPECT_GT(seen.depth, 0);
  EXPECT_NEAR(seen.pixel.x, pixel.x, 1e-6);
  EXPECT_NEAR(seen.pixel.y, pixel.y, 1e-6);
}

OrbitCamera camera(const glm::ivec2& size = {800, 600}) {
  OrbitCamera camera;
  camera.setSize(size);
  camera.frame({-3, -2, 0}, {4, 6, 1.6}, true);
  return camera;
}

TEST(OrbitCamera, FramesABoxWholeAndTightlyInPicturesOfAnyShape) {
  for (const glm::ivec2& size : {glm::ivec2(800, 600), glm::ivec2(300, 900), glm::ivec2(1600, 200)}) {
    const OrbitCamera orbit = camera(size);
    double widest = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 at((corner & 1) ? 4 : -3, (corner & 2) ? 6 : -2, (corner & 4) ? 1.6 : 0);
      const Projected seen = project(orbit.view(), at);
      ASSERT_GT(seen.depth, 0);
      const glm::dvec2 half = 0.5 * glm::dvec2(size);
      const glm::dvec2 share = glm::abs(seen.pixel - half) / half;
      widest = std::max({widest, share.x, share.y});
    }
    EXPECT_LE(widest, 1);
    EXPECT_GT(widest, 0.8);
  }
}

TEST(OrbitCamera, OrbitsAboutItsTargetAtTheSameDistance) {
  OrbitCamera orbit = camera();
  const glm::dvec3 target = orbit.target();
  const double distance = orbit.distance(), yaw = orbit.view().yawRadians;
  orbit.orbit({100, 40});
  EXPECT_EQ(orbit.target(), target);
  EXPECT_NEAR(glm::distance(orbit.eye(), target), distance, 1e-9);
  EXPECT_NEAR(orbit.view().yawRadians, yaw - 100 * OrbitCamera::kRadiansPerPixel, 1e-12);
  expectAt(orbit, target, {400, 300});
  for (int i = 0; i < 50; ++i) orbit.orbit({0, 100});  // never over the top
  EXPECT_TRUE(orbit.view().check().has_value());
  EXPECT_GT(orbit.eye().z, target.z);
}

TEST(OrbitCamera, PansWithTheHeldPointUnderThePointer) {
  OrbitCamera orbit = camera();
  const glm::dvec2 from(220, 410), to(530, 90);
  const glm::dvec3 held = orbit.eye() + 7.5 * orbit.rayThrough(from);
  for (int i = 1; i <= 10; ++i) orbit.pan((to - from) / 10.0, held);
  expectAt(orbit, held, to);
}

TEST(OrbitCamera, DolliesTowardsThePointUnderThePointer) {
  OrbitCamera orbit = camera();
  const glm::dvec2 pixel(610, 140);
  const glm::dvec3 point = orbit.eye() + 5.0 * orbit.rayThrough(pixel);
  for (int i = 0; i < 12; ++i) {
    orbit.dolly(0.84, point);
    expectAt(orbit, point, pixel);
  }
  EXPECT_NEAR(glm::distance(orbit.eye(), point), 5 * std::pow(0.84, 12), 1e-9);
  for (int i = 0; i < 500; ++i) orbit.dolly(0.5, point);
  EXPECT_GE(orbit.distance(), OrbitCamera::kNearest * (1 - 1e-9));
  EXPECT_TRUE(orbit.view().check().has_value());
}

TEST(OrbitCamera, CentresOnAPointFromTheSameSide) {
  OrbitCamera orbit = camera();
  const double yaw = orbit.view().yawRadians, pitch = orbit.view().pitchRadians;
  orbit.centreOn({1, 2, 0.5});
  expectAt(orbit, {1, 2, 0.5}, {400, 300});
  EXPECT_EQ(orbit.view().yawRadians, yaw);
  EXPECT_EQ(orbit.view().pitchRadians, pitch);
}

TEST(OrbitCamera, HoldsOnBesideItsTargetWhereThereIsNoSurface) {
  const OrbitCamera orbit = camera();
  const glm::dvec3 beside = orbit.besideTarget({100, 100});
  expectAt(orbit, beside, {100, 100});
  EXPECT_NEAR(project(orbit.view(), beside).depth, orbit.distance(), 1e-9);
}

class SceneToolTest : public testing::Test {
 protected:
  SceneIntent send(ScenePointer::Kind kind, const glm::dvec2& pixel, int button = ui::mouse::left,
                   int modifiers = 0, bool picking = false) {
    now_ += 0.05;
    return tool_.handle({kind, button, modifiers, pixel, now_}, picking);
  }
  SceneIntent click(const glm::dvec2& pixel, int modifiers = 0, bool picking = false) {
    send(ScenePointer::Kind::press, pixel, ui::mouse::left, modifiers, picking);
    return send(ScenePointer::Kind::release, pixel, ui::mouse::left, modifiers, picking);
  }
  SceneTool tool_;
  double now_ = 0;
};

TEST_F(SceneToolTest, LeftDragsOrbitByAllThatThePointerMoved) {
  send(ScenePointer::Kind::press, {100, 100});
  EXPECT_TRUE(std::holds_alternative<std::monostate>(send(ScenePointer::Kind::move, {102, 101})));
  glm::dvec2 turned(0);
  for (const glm::dvec2& at : {glm::dvec2(110, 104), glm::dvec2(140, 90)})
    turned += std::get<OrbitIntent>(send(ScenePointer::Kind::move, at)).pixels;
  EXPECT_EQ(turned, glm::dvec2(40, -10));
  EXPECT_TRUE(tool_.dragging());
  EXPECT_TRUE(std::holds_alternative<std::monostate>(send(ScenePointer::Kind::release, {140, 90})));
  EXPECT_FALSE(tool_.capturing());
}

TEST_F(SceneToolTest, OtherButtonsTakeHoldAndPan) {
  for (const int button : {ui::mouse::right, ui::mouse::middle}) {
    EXPECT_EQ(std::get<HoldIntent>(send(ScenePointer::Kind::press, {50, 60}, button)).pixel,
              glm::dvec2(50, 60));
    EXPECT_EQ(std::get<PanViewIntent>(send(ScenePointer::Kind::move, {53, 58}, button)).pixels,
              glm::dvec2(3, -2));
    send(ScenePointer::Kind::release, {53, 58}, button);
  }
}

TEST_F(SceneToolTest, ClicksSelectPickOrOpen) {
  const SelectAtIntent select = std::get<SelectAtIntent>(click({10, 20}));
  EXPECT_EQ(select.pixel, glm::dvec2(10, 20));
  EXPECT_EQ(select.how, Combine::replace);
  EXPECT_EQ(std::get<OpenAtIntent>(click({11, 20})).pixel, glm::dvec2(11, 20));
  EXPECT_TRUE(std::holds_alternative<SelectAtIntent>(click({11, 20})));  // a third click is a first
  now_ += 2;
  EXPECT_EQ(std::get<SelectAtIntent>(click({11, 20}, ui::modifier::shift)).how, Combine::add);
  now_ += 2;
  EXPECT_EQ(std::get<SelectAtIntent>(click({11, 20}, ui::modifier::control)).how, Combine::toggle);
  now_ += 2;
  EXPECT_EQ(std::get<PickAtIntent>(click({30, 40}, ui::modifier::alt)).pixel, glm::dvec2(30, 40));
  EXPECT_EQ(std::get<PickAtIntent>(click({30, 40}, 0, true)).pixel, glm::dvec2(30, 40));
}

TEST_F(SceneToolTest, SlowOrDistantClicksAreTwo) {
  click({10, 20});
  now_ += 0.6;
  EXPECT_TRUE(std::holds_alternative<SelectAtIntent>(click({10, 20})));
  EXPECT_TRUE(std::holds_alternative<SelectAtIntent>(click({40, 20})));
}

Layout layoutOf(Configuration configuration) {
  LayoutSpec spec;
  spec.configuration = configuration;
  spec.cellSize = 1.5;
  spec.outline.loops = {{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}};
  const Result<Layout> layout = buildLayout(spec);
  EXPECT_TRUE(layout.has_value());
  return layout ? *layout : Layout{};
}

TEST(SceneHits, FindTheCellOnTheFloorOrUnderTheSurfaceInFrontOfIt) {
  const Layout layout = layoutOf(Configuration::b);
  const Region& region = layout.regions[layout.regions.size() / 2];
  const glm::dvec3 place(region.polygon.centroid(), latticeHeight(layout)), eye(8, -7, 9);
  const glm::dvec3 ray = glm::normalize(place - eye);
  const double distance = glm::distance(place, eye);
  EXPECT_EQ(cellUnder(layout, eye, ray, kNothing), region.id);
  EXPECT_EQ(cellUnder(layout, eye, ray, distance), region.id);
  // A table stands before it: the cell that the table stands in.
  const double table = distance - 1.5;
  const glm::dvec2 at(eye + table * ray);
  const auto other = layout.regionAt(at);
  ASSERT_TRUE(other.has_value());
  EXPECT_EQ(cellUnder(layout, eye, ray, table), layout.regions[std::size_t(*other)].id);
  EXPECT_FALSE(cellUnder(layout, eye, -ray, kNothing).has_value());
  EXPECT_FALSE(cellUnder(layout, eye, {0, 0, -1}, kNothing).has_value());
}

TEST(SceneHits, FindTheCameraNearestToThePixelThatIsNotHidden) {
  const Layout layout = layoutOf(Configuration::b);
  OrbitCamera orbit;
  orbit.setSize({900, 700});
  orbit.frame({-3, -3, 0}, {3, 3, 1.6}, true);
  const PerspectiveView view = orbit.view();
  const int camera = 17;
  const glm::dvec3 place(layout.cameras[camera].position, layout.eyeZ());
  const glm::dvec2 pixel = project(view, place).pixel;
  const auto found = cameraUnder(layout, view, pixel + glm::dvec2(2, -1), kNothing);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(layout.cameras[std::size_t(*found)].position, layout.cameras[camera].position);
  EXPECT_FALSE(cameraUnder(layout, view, {1, 1}, kNothing).has_value());
}

TEST(CameraSteps, GoRoundTheRingOnceAndBack) {
  for (const Configuration configuration : {Configuration::b, Configuration::c, Configuration::d}) {
    const Layout layout = layoutOf(configuration);
    for (const Region& region : layout.regions) {
      const auto first = firstPlace(layout, region.id);
      ASSERT_TRUE(first.has_value());
      std::set<int> expected, met;
      for (const Piece& piece : region.covers[0].pieces) expected.insert(piece.camera);
      CameraPlace place = *first;
      do {
        met.insert(*cameraAtPlace(layout, place));
        const CameraPlace next = stepped(layout, place, 1);
        EXPECT_NE(cameraAtPlace(layout, next), cameraAtPlace(layout, place));
        EXPECT_EQ(cameraAtPlace(layout, stepped(layout, next, -1)), cameraAtPlace(layout, place));
        place = next;
      } while (place != *first && met.size() <= expected.size());
      EXPECT_EQ(met, expected);
    }
  }
}

TEST(CameraSteps, TheOtherHandIsAnotherCoverThatLooksTheSameWay) {
  const Layout layout = layoutOf(Configuration::b);
  int asked = 0;
  for (const Region& region : layout.regions) {
    if (region.kind != RegionKind::ring) continue;
    ++asked;
    const CameraPlace place = *firstPlace(layout, region.id);
    const auto other = otherHand(layout, place);
    ASSERT_TRUE(other.has_value());
    EXPECT_EQ(other->cover, 1);
    const LayoutCamera& from = layout.cameras[std::size_t(*cameraAtPlace(layout, place))];
    const LayoutCamera& to = layout.cameras[std::size_t(*cameraAtPlace(layout, *other))];
    const double turn = to.lowAzimuth + to.fovRadians / 2 - from.lowAzimuth - from.fovRadians / 2;
    EXPECT_LE(std::abs(std::remainder(turn, kTwoPi)), from.fovRadians / 2 + 1e-9);
    EXPECT_EQ(otherHand(layout, *other)->cover, 0);
  }
  EXPECT_GT(asked, 2);
}

TEST(CameraSteps, OfACellThatIsGoneAreNothing) {
  const Layout layout = layoutOf(Configuration::b);
  const CameraPlace gone{{999, 0, 0}, 0, 0};
  EXPECT_FALSE(cameraAtPlace(layout, gone).has_value());
  EXPECT_FALSE(otherHand(layout, gone).has_value());
  EXPECT_EQ(stepped(layout, gone, 1), gone);
  EXPECT_FALSE(firstPlace(layout, gone.cell).has_value());
}

TEST(CameraSteps, APlaceOfACameraIsInThePreferredCellIfThatUsesIt) {
  const Layout layout = layoutOf(Configuration::b);
  for (std::size_t c = 0; c < layout.cameras.size(); ++c)
    for (const Region& region : layout.regions) {
      const auto place = placeOf(layout, int(c), region.id);
      ASSERT_TRUE(place.has_value());
      EXPECT_EQ(cameraAtPlace(layout, *place), int(c));
      bool uses = false;
      for (const Cover& cover : region.covers)
        for (const Piece& piece : cover.pieces) uses = uses || piece.camera == int(c);
      EXPECT_EQ(place->cell == region.id, uses);
    }
}

}  // namespace
}  // namespace acentric::editor
