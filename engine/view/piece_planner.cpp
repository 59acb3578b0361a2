#include "engine/view/piece_planner.h"

#include <algorithm>
#include <limits>

#include "engine/geometry/conventions.h"
#include "engine/view/column_order.h"

namespace acentric {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A sample on a piece's border itself is still drawn, however the bake rounded it.
constexpr double kBorderSlack = 1e-4;

std::vector<float> largestInverseDistances(const DisplayCapture& capture, const ConvexPolygon& grown) {
  std::vector<float> limits(static_cast<std::size_t>(capture.camera.columns), kInfinity);
  const glm::dvec2 centre(capture.camera.centreOfProjection);
  for (std::size_t k = 0; k < limits.size(); ++k) {
    const auto span = grown.raySpan(centre, glm::dvec2(capture.columnDirection[k]));
    if (span && span->second > 0)
      limits[k] = static_cast<float>((1 + kBorderSlack) / ((1 - kBorderOverlap) * span->second));
  }
  return limits;
}

/// Where each column's ray leaves the piece; 0 where it never does (the sky is then the piece's).
std::vector<float> leastInverseDistances(const DisplayCapture& capture, const Clip& clip) {
  std::vector<float> limits(static_cast<std::size_t>(capture.camera.columns), 0.0f);
  const glm::dvec2 centre(capture.camera.centreOfProjection), along = clip.side.line.direction();
  const double away = cross(along, centre - clip.side.line.from);  // > 0: the centre lies left
  for (std::size_t k = 0; k < limits.size(); ++k) {
    const double rate = cross(along, glm::dvec2(capture.columnDirection[k]));
    const double distance = -away / rate;
    if (clip.side.left ? rate < 0 : rate > 0)
      limits[k] = distance > 0 ? static_cast<float>((1 - kBorderSlack) / distance) : kInfinity;
  }
  return limits;
}

/// Do most drawn columns end before the foot of the perpendicular from the eye? (Renderers that cannot order
/// the samples of each pixel on their own go by this.)
bool mostlyBeforeFoot(const DisplayCapture& capture, const PieceDraw& piece) {
  int before = 0, all = 0;
  for (const ColumnRun& run : piece.runs)
    for (int k = run.first; k < run.last; ++k) {
      const std::size_t column = static_cast<std::size_t>(k);
      const RowOrder order =
          rowOrder(glm::dvec2(capture.columnDirection[column]), -glm::dvec3(piece.baseline));
      const glm::vec2 range = drawnRange(capture, piece, column);
      before += 0.5f * (range.x + range.y) > order.footInverse;
      ++all;
    }
  return 2 * before > all;
}

}  // namespace

PiecePlanner::PiecePlanner(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings)
    : scene_(scene),
      eye_(view.eye),
      margin_(splatMargin(settings.maxSplatPixels)),
      planes_(frustumPlanes(view, {0, 0, view.width, view.height}, margin_)),
      axes_(view),
      width_(view.width) {}

/// On which columns of the picture something in this direction may lie, at these tangents and inverse
/// distances.
void PiecePlanner::reach(const glm::dvec2& direction, const glm::dvec3& baseline, const glm::dvec2& range,
                         ColumnSight& sight) const {
  const glm::dvec3 a = axes_.project(glm::dvec3(direction, 0)), b = axes_.project(baseline),
                   up = axes_.project(glm::dvec3(0, 0, 1));
  sight.x0 = 0, sight.x1 = width_;
  double low = width_, high = 0;
  // A quotient of functions that are linear in tangent and inverse distance each: corners are extremes.
  for (const double t : {sight.tangents.low, sight.tangents.high})
    for (const double w : {range.x, range.y}) {
      const glm::dvec3 q = a + t * up + w * b;
      if (!(q.z > 1e-3 * (1 + std::abs(t)))) return;  // beside the eye, or behind it
      low = std::min(low, q.x / q.z), high = std::max(high, q.x / q.z);
    }
  sight.x0 = static_cast<int>(std::clamp(std::floor(low - margin_), 0.0, double(width_)));
  sight.x1 = static_cast<int>(std::clamp(std::ceil(high + margin_), 0.0, double(width_)));
}

/// Fills piece.sight; says of each column whether something of it may be seen.
std::vector<char> PiecePlanner::visibleColumns(const DisplayCapture& capture, PieceDraw& piece) const {
  const TangentRange rows{capture.camera.tangentAt(capture.camera.rows - 0.5), capture.camera.tangentAt(0.5)};
  const std::size_t columns = static_cast<std::size_t>(capture.camera.columns);
  std::vector<char> visible(columns, 0);
  piece.sight.assign(columns, {});
  for (std::size_t k = 0; k < columns; ++k) {
    const glm::dvec2 direction(capture.columnDirection[k]), range(drawnRange(capture, piece, k));
    const auto tangents = visibleTangents(planes_, direction, glm::dvec3(piece.baseline), range, rows);
    if (!tangents) continue;
    piece.sight[k].tangents = *tangents;
    reach(direction, glm::dvec3(piece.baseline), range, piece.sight[k]);
    visible[k] = piece.sight[k].x0 < piece.sight[k].x1;
  }
  return visible;
}

/// Columns whose background the piece draws. What is infinitely far moves with the eye.
std::vector<char> PiecePlanner::visibleBackground(const DisplayCapture& capture,
                                                  const PieceDraw& piece) const {
  const CaptureBackground& runs = capture.background.runs;
  std::vector<char> visible(static_cast<std::size_t>(capture.camera.columns), 0);
  for (std::size_t k = 0; k < visible.size(); ++k) {
    const std::size_t first = runs.columnStart[k], end = runs.columnStart[k + 1];
    if (first == end || (!piece.minInverseDistance.empty() && piece.minInverseDistance[k] > 0)) continue;
    const TangentRange rows{capture.background.rowBorder[runs.endRow[end - 1]],
                            capture.background.rowBorder[runs.firstRow[first]]};
    visible[k] =
        visibleTangents(planes_, glm::dvec2(capture.columnDirection[k]), glm::dvec3(0), glm::dvec2(0), rows)
            .has_value();
  }
  return visible;
}

void PiecePlanner::add(PieceDraw piece, const ConvexPolygon* grown, const std::optional<Clip>& clip,
                       ViewPlan& plan) const {
  const DisplayCapture& capture = *scene_.captures[static_cast<std::size_t>(piece.camera)];
  const glm::dvec3& centre = capture.camera.centreOfProjection;
  piece.baseline = glm::vec3(centre - eye_);
  piece.maxInverseDistance =
      grown != nullptr ? largestInverseDistances(capture, *grown)
                       : std::vector<float>(static_cast<std::size_t>(capture.camera.columns), kInfinity);
  if (clip) piece.minInverseDistance = leastInverseDistances(capture, *clip);
  const ColumnOrder order = columnOrder(capture.camera, glm::dvec2(eye_) - glm::dvec2(centre));
  piece.epipoleColumn = order.epipoleColumn;
  const auto addSamples = [&](const DisplayCapture& samples, std::vector<PieceDraw>& draws) {
    piece.runs = keepColumns(order.runs, visibleColumns(samples, piece));
    if (piece.runs.empty()) return;
    piece.nearestFirst = samples.layered && mostlyBeforeFoot(samples, piece);
    draws.push_back(piece);
  };
  if (capture.background.runs.runCount() > 0) {
    piece.runs = keepColumns(order.runs, visibleBackground(capture, piece));
    if (!piece.runs.empty()) plan.backgrounds.push_back(piece);
  }
  if (capture.reflections) addSamples(*capture.reflections, plan.reflections);
  addSamples(capture, plan.pieces);
}

}  // namespace acentric
