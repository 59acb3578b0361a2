// What the judges of sampling foretell, against captures that were baked.
#include "engine/pipeline/coverage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/pipeline/small_project.h"

namespace acentric {
namespace {
using test::matte;
using test::SceneBuilder;

/// A furnished room and a small layout in it, opened as a project that was never saved.
OpenProject openRoom(const SceneBuilder& builder, double samplesPerDegree) {
  Project project = test::smallProject(1.5, samplesPerDegree);
  project.bake.ambientRays = 0;
  return test::openWith(builder.rays(), project, "room.acentric.json");
}

SceneBuilder furnishedModel() {
  SceneBuilder builder;
  const int white = builder.material(matte());
  Material pane = matte();
  pane.transmission = 0.9f;
  const int glass = builder.material(pane);
  builder.box(white, {-8, -8, 0}, {8, 8, 3}, true);
  builder.box(white, {3.6, -1, 0}, {3.9, 1, 2.4});
  builder.box(white, {-5, 3.5, 0}, {-4, 4.5, 3});
  builder.box(white, {-1, -5, 0}, {1.5, -4.6, 1.1});
  builder.quad(glass, {5, -4, 0}, {5, 4, 0}, {5, 4, 3}, {5, -4, 3});
  return builder;
}

/// Does a pixel of the capture at or beside the point's hold a sample as far away?
bool heldByCapture(const Capture& capture, const glm::dvec3& point, double tolerance) {
  const ColumnCamera& camera = capture.camera;
  const glm::dvec3 offset = point - camera.centreOfProjection;
  const double flat = glm::length(glm::dvec2(offset));
  const double azimuth = wrapAngle(std::atan2(offset.y, offset.x) - camera.lowAzimuth);
  const int column = int(azimuth / camera.columnPitch());
  const int row = int((camera.topElevation - std::atan2(offset.z, flat)) / camera.rowPitch());
  for (int k = std::max(0, column - 1); k <= std::min(camera.columns - 1, column + 1); ++k)
    for (std::size_t i = capture.columnStart[std::size_t(k)]; i < capture.columnStart[std::size_t(k) + 1];
         ++i)
      if (std::abs(int(capture.row[i]) - row) <= 1 &&
          std::abs(double(capture.inverseDistance[i]) * flat - 1) < tolerance)
        return true;
  return false;
}

TEST(ProjectReach, ForetellsWhatTheBakeCaptures) {
  OpenProject open = openRoom(furnishedModel(), 4);
  open.project.bake.pruning = false;  // random points are seen from no eye in particular
  open.project.bake.maxLayers = 2;
  open.project.bake.silhouettes = false;  // they reach one pixel farther
  const ProjectReach reach(open);
  TaskRunner runner(1);
  CameraBaker baker(*open.rays, open.project.bake);
  const SurfacePoints points(open.scene);
  int agreed = 0, held = 0, missed = 0, missing = 0, checked = 0;
  for (std::size_t c = 0; c < open.layout->cameras.size(); c += 4) {
    const LayoutCamera& camera = open.layout->cameras[c];
    CaptureCounts counts;
    const auto capture = baker.bake(camera, (*reach).columns(int(c)), runner, counts);
    ASSERT_TRUE(capture) << capture.error().describe();
    for (std::uint64_t n = 0; n < 600; ++n) {
      const SurfacePoint point = points.at(n);
      if (open.scene->meshes[point.mesh].material == 1) continue;  // glass is kept beside what is behind it
      const glm::dvec2 way = glm::dvec2(point.position) - camera.position;
      if (wrapAngle(std::atan2(way.y, way.x) - camera.lowAzimuth) >= camera.fovRadians) continue;
      const bool foretold = (*reach).holds(int(c), point.position);
      const bool captured = heldByCapture(*capture, point.position, 0.03);
      agreed += foretold == captured ? 1 : 0;
      held += foretold ? 1 : 0;
      missed += foretold ? 0 : 1;
      missing += foretold || captured ? 0 : 1;
      ++checked;
    }
  }
  ASSERT_GT(checked, 500);
  EXPECT_GT(held, checked / 4);
  ASSERT_GT(missed, 100) << "else there is nothing to foretell";
  // A pixel is a quarter of a degree wide: at edges it may hold the neighbouring surface.
  EXPECT_GT(double(missing) / missed, 0.85) << missing << " of " << missed;
  EXPECT_GT(double(agreed) / checked, 0.97) << agreed << " of " << checked;
}

TEST(OpaqueTracer, SeesThroughGlassAndBlendedSurfacesAsTheTruthDoes) {
  SceneBuilder builder;
  const int white = builder.material(matte());
  Material pane = matte(), veil = matte(), cloth = matte();
  pane.transmission = 1;
  veil.alphaMode = cloth.alphaMode = AlphaMode::blend;
  veil.baseColour.a = 0.4f;
  const int glass = builder.material(pane), thin = builder.material(veil), thick = builder.material(cloth);
  const auto wallAt = [&](int material, float x) {
    builder.quad(material, {x, -2, 0}, {x, 2, 0}, {x, 2, 3}, {x, -2, 3});
  };
  wallAt(glass, 1), wallAt(thin, 2), wallAt(thick, 3), wallAt(white, 4);
  const auto tracer = opaqueTracerFor(builder.rays());
  const glm::dvec3 eye(0, 0, 1), forward(1, 0, 0);
  EXPECT_NEAR(tracer->trace(eye, forward, 0, 100).distance, 3, 1e-5) << "a blended surface of alpha 1";
  EXPECT_NEAR(tracer->trace(eye, forward, 3.5, 100).distance, 4, 1e-5);
  EXPECT_FALSE(tracer->trace(eye, forward, 0, 2.5).found());
  EXPECT_FALSE(tracer->trace(eye, forward, 4.5, 100).found());
  EXPECT_FALSE(hidden(*tracer, eye, {3, 0, 1}));
  EXPECT_TRUE(hidden(*tracer, eye, {4, 0, 1}));
  PerspectiveView view;
  view.eye = eye;
  view.width = view.height = 33;
  TaskRunner runner;
  const TruthFrame truth = renderTruth(*builder.rays(), view, BakeSettings{}, 1, 1, runner);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const OpaqueHit hit = tracer->trace(eye, view.rayThrough(x + 0.5, y + 0.5), 0, 1e9);
      const float expected = truth.rayDistance.at(x, y);
      EXPECT_EQ(hit.found(), std::isfinite(expected));
      if (hit.found()) {
        EXPECT_NEAR(hit.distance, expected, 1e-4);
      }
    }
}

TEST(HoleCorrelation, ComparesWhatIsForetoldWithWhatWasRendered) {
  OpenProject open = openRoom(furnishedModel(), 4);
  open.project.bake.maxLayers = 1;  // so that holes open
  const ProjectReach reach(open);
  TaskRunner runner(1);
  std::vector<PerspectiveView> views;
  for (int k = 0; k < 8; ++k) {
    PerspectiveView view;
    view.eye = {0.8 * std::cos(0.8 * k), 0.8 * std::sin(0.8 * k), open.layout->eyeZ()};
    view.yawRadians = kTwoPi * k / 8;
    view.width = 64, view.height = 36;
    views.push_back(view);
  }
  // A renderer that leaves exactly the foretold pixels open agrees in every way.
  const ViewSettings options;
  const auto faithful = [&](const PerspectiveView& view) -> Result<Frame> {
    const auto holes = predictHoles(*reach, view, options, runner);
    Frame frame;
    frame.source = Image<PixelSource>(view.width, view.height, kSourceLocal);
    for (std::size_t i = 0; i < frame.source.pixels.size(); ++i)
      if (holes->openPixels.pixels[i] != 0)
        frame.source.pixels[i] = i % 2 == 0 ? kSourceHole : kSourceInvented;
    return frame;
  };
  const auto result = correlateHoles(reach, views, options, faithful, runner);
  ASSERT_TRUE(result) << result.error().describe();
  ASSERT_EQ(result->frames.size(), 8u);
  std::uint64_t holes = 0;
  for (const HoleSample& frame : result->frames) {
    EXPECT_EQ(frame.holes, frame.predicted);
    EXPECT_EQ(frame.holes, frame.both);
    EXPECT_NEAR(frame.measured, double(frame.holes) / (64 * 36), 1e-12);
    holes += frame.holes;
  }
  EXPECT_GT(holes, 0u);
  EXPECT_GT(result->open.pearson, 0.99);

  const auto failing = [](const PerspectiveView&) -> Result<Frame> {
    return fail(ErrorKind::notFound, "gone");
  };
  EXPECT_EQ(correlateHoles(reach, views, options, failing, runner).error().message, "gone");
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(correlateHoles(reach, views, options, faithful, runner, {}, stop.get_token()).error().kind,
            ErrorKind::cancelled);
}

}  // namespace
}  // namespace acentric
