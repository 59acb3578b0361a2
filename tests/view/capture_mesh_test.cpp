#include "engine/view/capture_mesh.h"

#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "tests/view/capture_fixtures.h"

namespace acentric {
namespace {

using test::AnalyticScene;

/// Where the ray of direction (c, t) meets the patch's two triangles, as inverse distance; nothing beside
/// them. A triangle of corners (c, t, w) holds the point (sum of c, sum of t, sum of w), whatever their
/// weights.
std::optional<double> inverseAlong(const glm::dvec3& ray, const ColumnCamera& camera, const MeshPatch& patch,
                                   double fringe) {
  const auto corners = cornersOf(camera, patch, fringe);
  for (const auto& [i, j, k] : {std::array{0, 1, 2}, std::array{2, 1, 3}}) {
    const glm::dmat3 columns(corners[std::size_t(i)], corners[std::size_t(j)], corners[std::size_t(k)]);
    const glm::dvec3 weights = glm::inverse(columns) * ray;
    if (weights.x < 0 || weights.y < 0 || weights.z < 0) continue;
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
                                        m.capture.camera, patch, m.mesh.fringe);
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
        const double shown = *inverseAlong(ray, m.capture.camera, patch, m.mesh.fringe);
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
  // Each box has its own colour: samples of a patch that differ in it are of two surfaces.
  const Meshed m = meshed(test::randomBoxes(21, 90, 2), 3, 0.25);
  const glm::dvec3 centre = m.capture.camera.centreOfProjection;
  std::size_t many = 0;
  for (const MeshPatch& patch : m.mesh.patches) {
    std::map<std::uint32_t, int> colours;
    const std::size_t count = std::size_t(patch.columns) * patch.rows;
    many += count > 4;
    for (std::size_t i = 0; i < count; ++i)
      ++colours[std::bit_cast<std::uint32_t>(m.capture.colour[m.mesh.samples[patch.firstSample + i]])];
    if (colours.size() < 2) continue;
    // Then they touch there: on the patch each lies within the bound of one plane, and next to each other
    // the samples lie no farther apart than that plane's slope and twice the bound.
    for (int k = 0; k < patch.columns; ++k)
      for (int r = 0; r + 1 < patch.rows; ++r) {
        const auto sample = [&](int row) {
          return m.mesh.samples[patch.firstSample + std::uint32_t(k * patch.rows + row)];
        };
        const auto at = [&](int row) {
          const double w = double(inverseDistanceOf(m.capture.samples[sample(row)]));
          return centre + rayOf(m.capture.camera, patch.column + k, patch.row + row) / w;
        };
        if (m.capture.colour[sample(r)] == m.capture.colour[sample(r + 1)]) continue;
        const double pitch = m.capture.camera.rowPitch(), far = glm::distance(at(r), centre);
        EXPECT_LT(glm::distance(at(r), at(r + 1)), 0.08 + 60 * pitch * far) << far;
      }
  }
  EXPECT_GT(many, 100u);
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

TEST(CaptureMesh, ReachesOverToTheNextPatchWhereTheSurfaceGoesOn) {
  AnalyticScene wall;
  wall.floor = false;
  wall.boxes.push_back({{3, -1, 0.6}, {4, 1.2, 2.4}, {0.5f, 0.4f, 0.3f, 1}});
  const Meshed m = meshed(wall, 1, 0.25, 600, 800);
  ASSERT_GT(m.mesh.patches.size(), 8u);
  const auto holds = [&](int column, int row) {
    return std::ranges::any_of(m.mesh.patches, [&](const MeshPatch& p) {
      return column >= p.column && column < p.column + p.columns && row >= p.row && row < p.row + p.rows;
    });
  };
  for (const MeshPatch& p : m.mesh.patches) {
    const int high = p.column + p.columns, below = p.row + p.rows;
    bool atLow = p.column == 0, atHigh = high == m.capture.camera.columns, atTop = false, atBottom = false;
    for (int row = p.row; row < below; ++row)
      atLow = atLow || holds(p.column - 1, row), atHigh = atHigh || holds(high, row);
    for (int column = p.column; column < high; ++column)
      atTop = atTop || holds(column, p.row - 1), atBottom = atBottom || holds(column, below);
    EXPECT_EQ((p.joined & kLowColumn) != 0, atLow);
    EXPECT_EQ((p.joined & kHighColumn) != 0, atHigh);
    EXPECT_EQ((p.joined & kTopRow) != 0, atTop);
    EXPECT_EQ((p.joined & kBottomRow) != 0, atBottom);
  }
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
