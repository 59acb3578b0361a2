/// What is told of a pixel of a frame.

#include "engine/pipeline/ask_picture.h"

#include "tests/pipeline/baked_room.h"

namespace acentric {
namespace {

/// A room with a pillar, which hides parts of the walls from most cameras.
class AskPictureTest : public testing::Test {
 protected:
  static RayScenePtr rays() {
    test::SceneBuilder builder;
    const int matte = builder.material(test::matte());
    builder.box(matte, {-4, -4, 0}, {4, 4, 3}, true).box(matte, {1.5f, 1, 0}, {2, 1.5f, 3});
    builder.point({0, 0, 2.5f}, 50);
    return builder.rays();
  }
  static Project project() {
    Project project = test::smallProject(0.5, 2);
    project.bake.ambientRays = 0;
    return project;
  }
  PerspectiveView viewAt(const glm::dvec2& eye, double yaw) const {
    PerspectiveView view;
    view.eye = {eye, room_.open.layout->eyeZ()};
    view.yawRadians = yaw;
    view.width = 96, view.height = 54;
    return view;
  }
  Frame frameOf(const PerspectiveView& view) {
    auto frame = renderFrame(room_.walk, view, room_.open.project.view, runner_);
    EXPECT_TRUE(frame);
    return frame ? std::move(*frame) : Frame();
  }

  test::BakedRoom room_{rays(), project()};
  TaskRunner runner_{1};
};

TEST_F(AskPictureTest, TellsWhatPaintedAPixelAndHowFinely) {
  const PerspectiveView view = viewAt({0.1, 0.05}, 3);
  const Frame frame = frameOf(view);
  const auto answer = askPicture(room_.open, room_.walk, frame, view, {48, 27}, runner_);
  ASSERT_TRUE(answer) << answer.error().describe();
  EXPECT_EQ(answer->source, frame.source.at(48, 27));
  EXPECT_EQ(answer->shown, frame.colour.at(48, 27));
  ASSERT_TRUE(answer->surface);
  EXPECT_NEAR(answer->surface->position.x, -4, 1e-3) << "the wall that it looks at";
  ASSERT_TRUE(answer->painter);
  const LayoutCamera& camera = room_.open.layout->cameras[std::size_t(answer->painter->camera)];
  EXPECT_EQ(answer->painter->camera, int(answer->source) - 1);
  EXPECT_NEAR(answer->painter->metres,
              glm::distance(glm::dvec3(camera.position, view.eye.z), answer->surface->position), 1e-6);
  // 2 samples a degree against some 1.4 pixels a degree, seen from farther away.
  const double pixelsPerDegree = view.focalPixels() * 3.14159265 / 180;
  const double eyeMetres = glm::distance(view.eye, answer->surface->position);
  EXPECT_NEAR(answer->painter->samplesPerPixel, 2 / pixelsPerDegree * eyeMetres / answer->painter->metres,
              0.15 * answer->painter->samplesPerPixel);
  EXPECT_EQ(answer->painter->layer, 1);
  EXPECT_EQ(answer->region, *room_.open.layout->regionAt(glm::dvec2(view.eye)));
  EXPECT_GT(answer->here.pixels(), 500u);
  const TruthFrame truth =
      renderTruth(*room_.open.rays, view, room_.open.project.bake, room_.walk.exposure, kAskedRays, runner_);
  EXPECT_EQ(answer->truth, truth.colour.at(48, 27)) << "a part of the truth is as all of it";
  EXPECT_EQ(answer->truthHere.at(0, 24), truth.colour.at(48 - kAskedPixels, 27 + kAskedPixels));
}

TEST_F(AskPictureTest, ADeeperLayerIsOneBehindSomethingElse) {
  int deep = 0, first = 0;
  for (const double yaw : {0.3, 0.6, 0.9}) {
    const PerspectiveView view = viewAt({-0.3, 0.35}, yaw);
    const Frame frame = frameOf(view);
    for (int x = 2; x < view.width; x += 5) {
      const auto answer = askPicture(room_.open, room_.walk, frame, view, {x, 27}, runner_);
      ASSERT_TRUE(answer);
      if (!answer->painter || answer->painter->layer == 0) continue;
      const LayoutCamera& camera = room_.open.layout->cameras[std::size_t(answer->painter->camera)];
      const glm::dvec3 from(camera.position, view.eye.z);
      const glm::dvec3 way = answer->surface->position - from;
      Ray ray{glm::vec3(from), glm::vec3(glm::normalize(way))};
      const bool hidden = room_.open.rays->trace(ray).distance < glm::length(way) - 0.2;
      EXPECT_EQ(answer->painter->layer > 1, hidden) << "column " << x;
      ++(hidden ? deep : first);
    }
  }
  EXPECT_GT(deep, 0) << "nothing that is hidden from a camera was painted";
  EXPECT_GT(first, 10);
}

TEST_F(AskPictureTest, RefusesPixelsThatAreNone) {
  const PerspectiveView view = viewAt({0, 0}, 0);
  const Frame frame = frameOf(view);
  for (const glm::ivec2 pixel : {glm::ivec2(-1, 0), glm::ivec2(96, 0), glm::ivec2(0, 54)})
    EXPECT_EQ(askPicture(room_.open, room_.walk, frame, view, pixel, runner_).error().kind,
              ErrorKind::invalidArgument);
  PerspectiveView larger = view;
  larger.width = 97;
  EXPECT_FALSE(askPicture(room_.open, room_.walk, frame, larger, {0, 0}, runner_));
  WalkScene other = room_.walk;
  other.captures.pop_back();
  EXPECT_EQ(askPicture(room_.open, other, frame, view, {0, 0}, runner_).error().message,
            "the frame is of another layout");
}

}  // namespace
}  // namespace acentric
