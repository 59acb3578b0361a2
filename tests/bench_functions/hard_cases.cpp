/// What care with hard cases costs: nanoseconds beside a naive variant, and the share of a frame for what a
/// frame does.

#include <algorithm>
#include <cmath>

#include "engine/scene/local_geometry.h"
#include "engine/view/column_order.h"
#include "engine/view/render.h"
#include "engine/view/view_plan.h"
#include "tests/bench_functions/benches.h"
#include "tests/view/analytic_scene.h"

namespace acentric::bench {
namespace {

constexpr int kRounds = 200'000;

/// Triangles of a decimetre around a unit square's border: what exact clipping has to decide.
std::vector<std::array<glm::vec3, 3>> borderTriangles() {
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::vector<std::array<glm::vec3, 3>> triangles(4096);
  for (auto& t : triangles) {
    const glm::vec3 at(1 + 0.1f * unit(engine), unit(engine), unit(engine));
    for (glm::vec3& p : t) p = at + 0.1f * glm::vec3(unit(engine), unit(engine), unit(engine));
  }
  return triangles;
}

/// Sutherland and Hodgman by distances in floats; the number of corners left.
std::size_t clippedByDistances(const std::array<glm::vec3, 3>& triangle,
                               const std::vector<glm::vec2>& corners) {
  thread_local std::vector<glm::vec3> polygon, next;
  polygon.assign(triangle.begin(), triangle.end());
  for (std::size_t e = 0; e < corners.size() && !polygon.empty(); ++e) {
    const glm::vec2 a = corners[e], edge = corners[(e + 1) % corners.size()] - a, normal(-edge.y, edge.x);
    next.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const glm::vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const float sideP = glm::dot(normal, glm::vec2(p) - a), sideQ = glm::dot(normal, glm::vec2(q) - a);
      if (sideP >= 0) next.push_back(p);
      if ((sideP > 0 && sideQ < 0) || (sideP < 0 && sideQ > 0))
        next.push_back(p + sideP / (sideP - sideQ) * (q - p));
    }
    std::swap(polygon, next);
  }
  return polygon.size();
}

}  // namespace

Status benchHardCases(const Subject&, Figures& figures) {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const WalkScene scene =
      test::walkScene(test::randomBoxes(1, 60, 3.2), layout, *layout->regionAt({0, 0}), 8);
  PerspectiveView view;
  view.eye = {0.4, 0.3, layout->eyeZ()};
  view.yawRadians = 0.7;
  TaskRunner two(1);
  ViewSettings settings;
  std::vector<double> frames;
  for (int n = 0; n < 20; ++n)
    frames.push_back(renderFrame(scene, view, settings, two)->stats.totalSeconds * 1e3);
  figures.add("a frame of 960x540", "ms", frames);
  const ViewPlan plan = planView(scene, view, settings).value();
  std::size_t columns = 0;
  for (const PieceDraw& piece : plan.pieces)
    for (const ColumnRun& run : piece.runs) columns += std::size_t(run.last - run.first);
  figures.fact("pieces of the frame", plan.pieces.size());
  figures.fact("columns of the frame", columns);
  /// Nanoseconds of a call, of which a frame does so many.
  const auto compare = [&](const std::string& what, int calls, const auto& careful, const auto& naive,
                           double perFrame, double perCall = 1) {
    const auto all = [calls](const auto& work) {
      return [calls, &work] {
        double sum = 0;
        for (int n = 0; n < calls; ++n) sum += double(work(n));
        used(sum);
      };
    };
    const Turns turns = secondsByTurns(5, all(careful), all(naive));
    const auto one = scaled(turns.one, 1e9 / calls * perCall),
               other = scaled(turns.other, 1e9 / calls * perCall);
    figures.add(what, "ns", one, "naive", other);
    if (perFrame > 0)
      figures.fact(what + ": more of a frame's time", (spreadOf(one).median - spreadOf(other).median) *
                                                          perFrame / (spreadOf(frames).median * 1e6));
  };

  const ColumnCamera& camera = scene.captures[std::size_t(plan.pieces[0].camera)]->camera;
  const auto offset = [](int n) { return glm::dvec3(0.4 + 1e-6 * n, 0.3, 1e-3 * (n & 63)); };
  compare(
      "columns in runs around the epipole, a capture", kRounds,
      [&](int n) { return columnOrder(camera, glm::dvec2(offset(n))).runs.size(); },
      [&](int n) {
        return std::vector<ColumnRun>{{0, camera.columns, n % 2 == 0}}.size();
      },
      double(plan.pieces.size()));
  compare(
      "rows towards or away from the pivot, a column", kRounds,
      [&](int n) { return rowOrder(glm::dvec2(0.6, 0.8), offset(n)).pivotTangent; },
      [&](int n) { return offset(n).z > 0; }, double(columns));
  const glm::dvec3 far(5e6, -5e6, 0);
  compare(
      "camera from eye in double, then float, a capture", kRounds,
      [&](int n) { return glm::vec3(far + offset(n) - far).x; },
      [&](int n) { return (glm::vec3(offset(n)) - glm::vec3(0.4f)).x; }, double(plan.pieces.size()));
  compare(
      "region of an eye, half-open and exact", kRounds,
      [&](int n) { return layout->regionAt(glm::dvec2(offset(n))).value_or(0); },
      [&](int n) { return std::lround(offset(n).x / 2) + std::lround(offset(n).y / 2); }, 1);

  const auto triangles = borderTriangles();
  Scene soup;
  Mesh& mesh = soup.meshes.emplace_back();
  for (const auto& t : triangles) {
    const auto first = std::uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), t.begin(), t.end());
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  const ConvexPolygon square{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  const std::vector<glm::vec2> corners(square.corners.begin(), square.corners.end());
  const double perTriangle = 1 / double(triangles.size());
  compare(
      "clipping a triangle at a border, exact signs", 20,
      [&](int) { return clipToPolygon(soup, square).triangles.size(); },
      [&](int) {
        std::size_t left = 0;
        for (const auto& t : triangles) left += clippedByDistances(t, corners);
        return left;
      },
      0, perTriangle);
  const auto normal = [&]<class Vector>(int n, Vector) {
    const auto& t = triangles[std::size_t(n) % triangles.size()];
    const Vector a(t[0]), b(t[1]), c(t[2]);
    return glm::normalize(glm::cross(b - a, c - a)).x;
  };
  compare(
      "a triangle's normal in double", kRounds, [&](int n) { return normal(n, glm::dvec3()); },
      [&](int n) { return normal(n, glm::vec3()); }, 0);
  return {};
}

}  // namespace acentric::bench
