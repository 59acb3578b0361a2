#include "engine/export/capture_mesh.h"

#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "tests/view/capture_fixtures.h"

namespace acentric {
namespace {

using test::AnalyticScene;

/// Where the ray of direction (c, t) meets the patch's two triangles, as inverse distance; nothing beside
/// them unless `extended`. A triangle of corners (c, t, w) holds the point (sum of c, sum of t, sum of w),
/// whatever their weights.
std::optional<double> inverseAlong(const glm::dvec3& ray, const ColumnCamera& camera, const MeshPatch& patch,
                                   const MeshBound& bound, bool extended = false) {
  const auto corners = cornersOf(camera, patch, bound);
  for (const auto& [i, j, k] : {std::array{0, 1, 2}, std::array{2, 1, 3}}) {
    const glm::dmat3 columns(corners[std::size_t(i)], corners[std::size_t(j)], corners[std::size_t(k)]);
    const glm::dvec3 weights = glm::inverse(columns) * ray;
    if (!extended && (weights.x < 0 || weights.y < 0 || weights.z < 0)) continue;
    const auto w = [&](int corner) { return double(patch.inverseDistance[std::size_t(corner)]); };
    return weights.x * w(i) + weights.y * w(j) + weights.z * w(k);
  }
  return std::nullopt;
}

glm::dvec3 rayOf(const ColumnCamera& camera, int column, int row) {
  return {camera.directionAt(column + 0.5), camera.tangentAt(row + 0.5)};
}

int columnOf(const DisplayCapture& capture, std::uint32_t sample) {
  return int(std::ranges::upper_bound(capture.columnStart, sample) - capture.columnStart.begin()) - 1;
}

struct Meshed {
  DisplayCapture capture;
  MeshBound bound;
  CaptureMesh mesh;
};
Meshed meshed(const AnalyticScene& scene, int layers, double error, int columns = 120, int rows = 240) {
  Meshed m;
  m.capture = prepareForDisplay(
      test::capture(scene, test::cameraAt({0, 0, 1.6}, 20, columns, rows), nullptr, layers), 1);
  for (std::size_t i = 0; i < m.capture.samples.size(); ++i) {  // needed by one region here, by another there
    PackedSample& sample = m.capture.samples[i];
    sample = packSample(inverseDistanceOf(sample), std::uint8_t(1u << (i / 7 % 8)), sample.row);
  }
  m.bound = meshBound(m.capture.camera, error, 2);
  TaskRunner runner(0);
  m.mesh = buildCaptureMesh(m.capture, m.bound, runner);
  return m;
}

AnalyticScene panes(AnalyticScene scene) {
  for (std::size_t i = 0; i < scene.boxes.size(); i += 3) scene.boxes[i].colour.a = 0.4f;
  return scene;
}

TEST(CaptureMesh, HoldsEveryOpaqueSampleOnceWithinTheBound) {
  for (const int layers : {1, 4})
    for (const double error : {0.05, 0.5, 4.0}) {
      const Meshed m = meshed(panes(test::randomBoxes(unsigned(7 + layers), 70, 2)), layers, error);
      std::vector<int> held(m.capture.samples.size(), 0);
      double worst = 0;
      for (const MeshPatch& patch : m.mesh.patches)
        for (int k = 0; k < patch.columns; ++k)
          for (int r = 0; r < patch.rows; ++r) {
            const std::uint32_t sample =
                m.mesh.samples[patch.firstSample + std::uint32_t(k * patch.rows + r)];
            ++held[sample];
            ASSERT_EQ(columnOf(m.capture, sample), patch.column + k);
            ASSERT_EQ(m.capture.samples[sample].row, patch.row + r);
            ASSERT_EQ(rolesOf(m.capture.samples[sample]) & ~patch.roles, 0);
            const auto w = inverseAlong(rayOf(m.capture.camera, patch.column + k, patch.row + r),
                                        m.capture.camera, patch, m.bound);
            ASSERT_TRUE(w) << "the patch does not reach its own sample";
            worst = std::max(worst, std::abs(*w - double(inverseDistanceOf(m.capture.samples[sample]))));
          }
      for (std::size_t i = 0; i < held.size(); ++i)
        ASSERT_EQ(held[i], m.capture.colour[i].a == 255 ? 1 : 0) << i;
      EXPECT_LE(worst, m.bound.inverseDistance * 1.001 + 1e-6);
      EXPECT_LT(m.mesh.patches.size(), m.mesh.samples.size() / 4) << "nothing is merged";
    }
}

TEST(CaptureMesh, ShiftsNoSampleByMoreThanItsErrorForAnyEyeWithinReach) {
  const double error = 0.5, reach = 2;
  const Meshed m = meshed(test::randomBoxes(3, 70, 2.5), 2, error);
  test::RandomViews views(5);
  double worst = 0;
  for (const MeshPatch& patch : m.mesh.patches)
    for (int k = 0; k < patch.columns; ++k)
      for (int r = 0; r < patch.rows; ++r) {
        const std::uint32_t sample = m.mesh.samples[patch.firstSample + std::uint32_t(k * patch.rows + r)];
        const glm::dvec3 ray = rayOf(m.capture.camera, patch.column + k, patch.row + r);
        const double w = double(inverseDistanceOf(m.capture.samples[sample]));
        const double shown = *inverseAlong(ray, m.capture.camera, patch, m.bound);
        const glm::dvec2 at = directionOf(views.between(0, kTwoPi)) * views.between(0, reach);
        const glm::dvec3 b(-at, 0), real = ray + w * b, drawn = ray + shown * b;
        if (glm::length(real) < 0.2) continue;  // so near that a sample is no small angle
        const double apart = glm::length(glm::cross(real, drawn)) / glm::length(real) / glm::length(drawn);
        const double sampleAngle = m.capture.camera.columnPitch() / glm::length(real);
        worst = std::max(worst, apart / sampleAngle);
      }
  EXPECT_LE(worst, error * 1.02);
  EXPECT_GT(worst, 0.2 * error) << "the bound is far from what is used of it";
}

TEST(CaptureMesh, JoinsNoSurfacesThatADepthLiesBetween) {
  // Boards of their own colours, one behind the other, each at least a quarter of a metre from the next.
  AnalyticScene boards;
  boards.floor = false;
  test::RandomViews random(8);
  for (int i = 0; i < 20; ++i) {
    const double x = 3 + 0.25 * i, y = random.between(-2, 3), z = random.between(-1, 3);
    const float grey = 0.04f * float(i + 1);
    boards.boxes.push_back({{x, y - random.between(0.1, 1), z - random.between(0.1, 1)},
                            {x + 0.001, y + random.between(0.1, 1), z + random.between(0.1, 1)},
                            {grey, 1 - grey, 0.3f, 1}});
  }
  for (const int layers : {1, 4}) {
    const Meshed m = meshed(boards, layers, 0.25, 300, 600);
    std::size_t merged = 0;
    for (const MeshPatch& patch : m.mesh.patches) {
      const std::size_t count = std::size_t(patch.columns) * patch.rows;
      merged += count;
      for (std::size_t i = 1; i < count; ++i)
        ASSERT_EQ(m.capture.colour[m.mesh.samples[patch.firstSample + i]],
                  m.capture.colour[m.mesh.samples[patch.firstSample]])
            << patch.column << " " << patch.row;
    }
    EXPECT_GT(merged, 10 * m.mesh.patches.size());
  }
}

TEST(CaptureMesh, TakesAFewTrianglesOfAWallWhateverItsTurn) {
  AnalyticScene wall;
  wall.boxes.push_back({{3, -40, -40}, {4, 40, 40}, {0.5f, 0.4f, 0.3f, 1}});
  const Meshed m = meshed(wall, 1, 0.25, 960, 1200);
  EXPECT_GT(m.mesh.samples.size(), 1'000'000u);
  EXPECT_LT(m.mesh.triangleCount(), m.mesh.samples.size() / 200);
}

TEST(CaptureMesh, NeedsFewerTrianglesForALargerErrorAndIsTheSameForAnyNumberOfThreads) {
  const AnalyticScene scene = test::randomBoxes(4, 80, 2);
  const Meshed fine = meshed(scene, 3, 0.05, 300, 400), coarse = meshed(scene, 3, 2, 300, 400);
  EXPECT_LT(coarse.mesh.triangleCount(), 0.9 * double(fine.mesh.triangleCount()));
  TaskRunner three(2);
  const CaptureMesh again = buildCaptureMesh(fine.capture, fine.bound, three);
  EXPECT_EQ(again.samples, fine.mesh.samples);
  ASSERT_EQ(again.patches.size(), fine.mesh.patches.size());
  for (std::size_t i = 0; i < again.patches.size(); ++i)
    ASSERT_EQ(again.patches[i].inverseDistance, fine.mesh.patches[i].inverseDistance);
}

/// Patch and place among its samples of each sample of a capture with one layer, by column and row.
struct Held {
  const MeshPatch* patch = nullptr;
  std::uint8_t fringes = 0;
};
std::map<std::pair<int, int>, Held> heldBy(const CaptureMesh& mesh) {
  std::map<std::pair<int, int>, Held> held;
  for (const MeshPatch& patch : mesh.patches)
    for (int k = 0; k < patch.columns; ++k)
      for (int r = 0; r < patch.rows; ++r)
        held[{patch.column + k, patch.row + r}] = {
            &patch, mesh.fringes[patch.firstSample + std::uint32_t(k * patch.rows + r)]};
  return held;
}

TEST(CaptureMesh, IsTheSameAtAnyScale) {
  const Meshed metres = meshed(test::randomBoxes(4, 80, 2), 2, 0.25);
  for (const float scale : {0x1p-10f, 0x1p13f}) {
    DisplayCapture capture = metres.capture;
    for (PackedSample& sample : capture.samples)
      sample = packSample(inverseDistanceOf(sample) / scale, rolesOf(sample), sample.row);
    TaskRunner runner(0);
    const CaptureMesh mesh =
        buildCaptureMesh(capture, meshBound(capture.camera, 0.25, 2 * double(scale)), runner);
    EXPECT_EQ(mesh.samples, metres.mesh.samples);
    EXPECT_EQ(mesh.fringes, metres.mesh.fringes);
    ASSERT_EQ(mesh.patches.size(), metres.mesh.patches.size());
  }
}

TEST(CaptureMesh, FringesCloseTheGapsBetweenPatchesOfACurvedSurface) {
  const Capture waves =
      test::captureBy(test::cameraAt({0, 0, 1.6}, 0, 200, 300), nullptr, {},
                      [](Capture& out, BackgroundBuilder&, const test::PixelRay& ray) {
                        const double azimuth = std::atan2(ray.direction.y, ray.direction.x);
                        const double w = 0.3 + 0.05 * std::sin(7 * azimuth) * std::cos(4 * ray.direction.z);
                        test::addSample(out, ray.row, 1 / w, glm::vec4(0.5f, 0.5f, 0.5f, 1));
                      });
  const DisplayCapture capture = prepareForDisplay(waves, 1);
  const MeshBound bound = meshBound(capture.camera, 0.5, 2);
  TaskRunner runner(0);
  const CaptureMesh mesh = buildCaptureMesh(capture, bound, runner);
  auto held = heldBy(mesh);
  int borders = 0;
  double widest = 0;
  for (int k = 0; k + 1 < capture.camera.columns; ++k)
    for (int r = 0; r + 1 < capture.camera.rows; ++r)
      for (const bool across : {true, false}) {
        const Held here = held[{k, r}], next = held[{k + across, r + !across}];
        if (here.patch == next.patch) continue;
        const glm::dvec3 border(capture.camera.directionAt(k + (across ? 1.0 : 0.5)),
                                capture.camera.tangentAt(r + (across ? 0.5 : 1.0)));
        const double gap = std::abs(*inverseAlong(border, capture.camera, *here.patch, bound, true) -
                                    *inverseAlong(border, capture.camera, *next.patch, bound, true)) /
                           bound.inverseDistance * bound.error;
        const double closed = fringeOf(here.fringes, across ? kHighColumn : kBottomRow, bound) +
                              fringeOf(next.fringes, across ? kLowColumn : kTopRow, bound);
        EXPECT_LE(gap, closed) << k << " " << r;
        widest = std::max(widest, gap);
        ++borders;
      }
  EXPECT_GT(borders, 1000);
  EXPECT_GT(widest, 2 * kOpenFringe) << "nothing for fringes to close";
}

TEST(CaptureMesh, ReachesNoFartherWhereTheSurfaceEnds) {
  AnalyticScene walls;
  walls.floor = false;
  walls.boxes.push_back({{3, -1, 0.6}, {3.1, 1.2, 2.4}, {0.5f, 0.4f, 0.3f, 1}});
  walls.boxes.push_back({{6, -9, -9}, {7, 0, 9}, {0.2f, 0.4f, 0.6f, 1}});  // behind its right half
  const Meshed m = meshed(walls, 1, 0.25, 600, 800);
  auto held = heldBy(m.mesh);
  const auto colourOf = [&](const Held& at) {
    return std::bit_cast<std::uint32_t>(m.capture.colour[m.mesh.samples[at.patch->firstSample]]);
  };
  int edges = 0;
  for (const auto& [place, here] : held)
    for (const auto& [side, column, row] :
         {std::tuple(kLowColumn, -1, 0), {kHighColumn, 1, 0}, {kTopRow, 0, -1}, {kBottomRow, 0, 1}}) {
      const auto beside = held.find({place.first + column, place.second + row});
      if (beside != held.end() && colourOf(beside->second) == colourOf(here)) continue;
      EXPECT_EQ(here.fringes >> side & kMostFringe, 0);
      ++edges;
    }
  EXPECT_GT(edges, 1000);
}

TEST(CaptureMesh, ReachIsTheFarthestEyeThatACameraServes) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  for (std::size_t camera = 0; camera < layout->cameras.size(); ++camera) {
    const double reach = eyeReach(*layout, int(camera));
    for (const Region& region : layout->regions)
      for (const Cover& cover : region.covers)
        for (const Piece& piece : cover.pieces)
          for (const glm::dvec2& corner : region.polygon.corners)
            if (piece.camera == int(camera)) {
              EXPECT_LE(glm::distance(corner, layout->cameras[camera].position), reach + 1e-9);
            }
  }
}

}  // namespace
}  // namespace acentric
