/// What care with hard cases costs: nanoseconds beside a naive variant, and the share of a frame for what a
/// frame does.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "engine/scene/local_geometry.h"
#include "engine/view/column_order.h"
#include "engine/view/render.h"
#include "engine/view/view_plan.h"
#include "tests/view/analytic_scene.h"

using namespace acentric;

namespace {

constexpr int kRounds = 200'000;
double sink = 0;  // what is computed is used

/// Best of five, nanoseconds a call.
template <class Work>
double nanoseconds(int calls, const Work& work) {
  double best = 1e18;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    for (int n = 0; n < calls; ++n) sink += double(work(n));
    best = std::min(
        best, std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count());
  }
  return best / calls;
}

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

int main() {
  const auto layout = test::layoutAroundOrigin(Configuration::b);
  const WalkScene scene =
      test::walkScene(test::randomBoxes(1, 60, 3.2), layout, *layout->regionAt({0, 0}), 8);
  PerspectiveView view;
  view.eye = {0.4, 0.3, layout->eyeZ()};
  view.yawRadians = 0.7;
  TaskRunner two(1);
  ViewSettings settings;
  double frame = 1e18;
  for (int n = 0; n < 20; ++n)
    frame = std::min(frame, renderFrame(scene, view, settings, two)->stats.totalSeconds * 1e9);
  const ViewPlan plan = planView(scene, view, settings).value();
  std::size_t columns = 0;
  for (const PieceDraw& piece : plan.pieces)
    for (const ColumnRun& run : piece.runs) columns += std::size_t(run.last - run.first);
  fmt::print("a frame of 960x540: {:.2f} ms, {} pieces, {} columns drawn\n", frame * 1e-6, plan.pieces.size(),
             columns);
  const auto print = [&](const char* what, double careful, double naive, double perFrame) {
    fmt::print("{:<58} {:7.1f} ns, naive {:6.1f} ns", what, careful, naive);
    if (perFrame > 0)
      fmt::print("; {:.0f} a frame: {:+.4f} %", perFrame, 100 * (careful - naive) * perFrame / frame);
    fmt::print("\n");
  };

  const ColumnCamera& camera = scene.captures[std::size_t(plan.pieces[0].camera)]->camera;
  const auto offset = [](int n) { return glm::dvec3(0.4 + 1e-6 * n, 0.3, 1e-3 * (n & 63)); };
  print("columns in runs around the epipole, a capture",
        nanoseconds(kRounds, [&](int n) { return columnOrder(camera, glm::dvec2(offset(n))).runs.size(); }),
        nanoseconds(kRounds,
                    [&](int n) {
                      return std::vector<ColumnRun>{{0, camera.columns, n % 2 == 0}}.size();
                    }),
        double(plan.pieces.size()));
  print("rows towards or away from the pivot, a column",
        nanoseconds(kRounds, [&](int n) { return rowOrder(glm::dvec2(0.6, 0.8), offset(n)).pivotTangent; }),
        nanoseconds(kRounds, [&](int n) { return offset(n).z > 0; }), double(columns));
  const glm::dvec3 far(5e6, -5e6, 0);
  print("camera from eye in double, then float, a capture",
        nanoseconds(kRounds, [&](int n) { return glm::vec3(far + offset(n) - far).x; }),
        nanoseconds(kRounds, [&](int n) { return (glm::vec3(offset(n)) - glm::vec3(0.4f)).x; }),
        double(plan.pieces.size()));
  print("region of an eye, half-open and exact",
        nanoseconds(kRounds, [&](int n) { return layout->regionAt(glm::dvec2(offset(n))).value_or(0); }),
        nanoseconds(kRounds,
                    [&](int n) { return std::lround(offset(n).x / 2) + std::lround(offset(n).y / 2); }),
        1);

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
  print("clipping a triangle at a border, exact signs",
        perTriangle * nanoseconds(20, [&](int) { return clipToPolygon(soup, square).triangles.size(); }),
        perTriangle * nanoseconds(20,
                                  [&](int) {
                                    std::size_t left = 0;
                                    for (const auto& t : triangles) left += clippedByDistances(t, corners);
                                    return left;
                                  }),
        0);
  const auto normal = [&]<class Vector>(int n, Vector) {
    const auto& t = triangles[std::size_t(n) % triangles.size()];
    const Vector a(t[0]), b(t[1]), c(t[2]);
    return glm::normalize(glm::cross(b - a, c - a)).x;
  };
  print("a triangle's normal in double", nanoseconds(kRounds, [&](int n) { return normal(n, glm::dvec3()); }),
        nanoseconds(kRounds, [&](int n) { return normal(n, glm::vec3()); }), 0);
  fmt::print("(sum {})\n", sink);
}
