#include "engine/view/view_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "engine/base/contract.h"
#include "engine/geometry/conventions.h"
#include "engine/view/column_culling.h"
#include "engine/view/column_order.h"
#include "engine/view/picture_axes.h"

namespace acentric {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A sample on the border itself is still drawn, however the bake rounded it.
constexpr double kBorderSlack = 1e-4;

std::vector<float> largestInverseDistances(const DisplayCapture& capture, const ConvexPolygon& grown) {
  std::vector<float> limits(static_cast<std::size_t>(capture.camera.columns), kInfinity);
  const glm::dvec2 centre(capture.camera.centreOfProjection);
  for (std::size_t k = 0; k < limits.size(); ++k) {
    const auto span = grown.raySpan(centre, glm::dvec2(capture.columnDirection[k]));
    if (span && span->second > 0) limits[k] = static_cast<float>((1 + kBorderSlack) / span->second);
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

/// What a view can show of captures.
struct Sight {
  FrustumPlanes planes;
  PictureAxes axes;
  double margin;  ///< of splats
  int width;      ///< of the picture

  /// On which columns of the picture something in this direction may lie, at these tangents and inverse
  /// distances.
  void reach(const glm::dvec2& direction, const glm::dvec3& baseline, const glm::dvec2& range,
             ColumnSight& sight) const {
    const glm::dvec3 a = axes.project(glm::dvec3(direction, 0)), b = axes.project(baseline),
                     up = axes.project(glm::dvec3(0, 0, 1));
    sight.x0 = 0, sight.x1 = width;
    double low = width, high = 0;
    // A quotient of functions that are linear in tangent and inverse distance each: corners are extremes.
    for (const double t : {sight.tangents.low, sight.tangents.high})
      for (const double w : {range.x, range.y}) {
        const glm::dvec3 q = a + t * up + w * b;
        if (!(q.z > 1e-3 * (1 + std::abs(t)))) return;  // beside the eye, or behind it
        low = std::min(low, q.x / q.z), high = std::max(high, q.x / q.z);
      }
    sight.x0 = static_cast<int>(std::clamp(std::floor(low - margin), 0.0, double(width)));
    sight.x1 = static_cast<int>(std::clamp(std::ceil(high + margin), 0.0, double(width)));
  }
};

/// Fills piece.sight; says of each column whether something of it may be seen.
std::vector<char> visibleColumns(const DisplayCapture& capture, const Sight& sight, PieceDraw& piece) {
  const TangentRange rows{capture.camera.tangentAt(capture.camera.rows - 0.5), capture.camera.tangentAt(0.5)};
  const std::size_t columns = static_cast<std::size_t>(capture.camera.columns);
  std::vector<char> visible(columns, 0);
  piece.sight.assign(columns, {});
  for (std::size_t k = 0; k < columns; ++k) {
    const glm::dvec2 direction(capture.columnDirection[k]), range(drawnRange(capture, piece, k));
    const auto tangents = visibleTangents(sight.planes, direction, glm::dvec3(piece.baseline), range, rows);
    if (!tangents) continue;
    piece.sight[k].tangents = *tangents;
    sight.reach(direction, glm::dvec3(piece.baseline), range, piece.sight[k]);
    visible[k] = piece.sight[k].x0 < piece.sight[k].x1;
  }
  return visible;
}

/// Columns whose background the piece draws. What is infinitely far moves with the eye.
std::vector<char> visibleBackground(const DisplayCapture& capture, const PieceDraw& piece,
                                    const FrustumPlanes& planes) {
  const CaptureBackground& runs = capture.background.runs;
  std::vector<char> visible(static_cast<std::size_t>(capture.camera.columns), 0);
  for (std::size_t k = 0; k < visible.size(); ++k) {
    const std::size_t first = runs.columnStart[k], end = runs.columnStart[k + 1];
    if (first == end || (!piece.minInverseDistance.empty() && piece.minInverseDistance[k] > 0)) continue;
    const TangentRange rows{capture.background.rowBorder[runs.endRow[end - 1]],
                            capture.background.rowBorder[runs.firstRow[first]]};
    visible[k] =
        visibleTangents(planes, glm::dvec2(capture.columnDirection[k]), glm::dvec3(0), glm::dvec2(0), rows)
            .has_value();
  }
  return visible;
}

int roleIn(const Cover& cover, const OrderedPiece& ordered) {
  const auto found = std::ranges::find_if(cover.pieces, [&](const Piece& piece) {
    return piece.camera == ordered.camera && piece.clip == ordered.clip;
  });
  return found == cover.pieces.end() ? -1 : found->role;
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

Result<ViewPlan> planView(const WalkScene& scene, const PerspectiveView& view, const ViewSettings& settings) {
  require(scene.layout != nullptr, "a walk scene needs a layout");
  if (auto status = view.check(); !status) return tl::unexpected(status.error());
  if (auto status = settings.check(); !status) return tl::unexpected(status.error());
  const Layout& layout = *scene.layout;
  const glm::dvec2 eye(view.eye);
  const auto regionIndex = layout.regionAt(eye);
  if (!regionIndex) {
    const Layout::Nearest nearest = layout.nearestRegion(eye);
    if (nearest.region < 0)
      return fail(ErrorKind::invalidArgument, "the layout has no region to stand in: place a cell first",
                  "view");
    return fail(ErrorKind::invalidArgument,
                fmt::format("the eye ({:.3f}, {:.3f}) stands outside every region; the nearest point inside "
                            "is ({:.3f}, {:.3f})",
                            eye.x, eye.y, nearest.point.x, nearest.point.y),
                "view");
  }

  ViewPlan plan;
  plan.region = *regionIndex;
  const Region& region = layout.regions[static_cast<std::size_t>(plan.region)];
  const ViewSector sector = sectorOf(view);
  const double margin = splatMargin(settings.maxSplatPixels);
  const Sight sight{frustumPlanes(view, {0, 0, view.width, view.height}, margin), PictureAxes(view), margin,
                    view.width};
  std::set<int> missing;

  const auto addCover = [&](const Cover& cover, bool secondary) {
    for (const OrderedPiece& ordered : visiblePieces(layout, plan.region, cover, sector)) {
      const std::size_t camera = static_cast<std::size_t>(ordered.camera);
      if (camera >= scene.captures.size() || scene.captures[camera] == nullptr) {
        missing.insert(ordered.camera);
        continue;
      }
      const DisplayCapture& capture = *scene.captures[camera];
      PieceDraw piece;
      piece.camera = ordered.camera;
      piece.part = ordered.part;
      piece.clipToPart = ordered.part.azimuths.low != sector.azimuths.low ||
                         ordered.part.azimuths.width != sector.azimuths.width;
      piece.secondary = secondary;
      piece.roles = roleBit(layout.cameras[camera], roleIn(cover, ordered));
      piece.baseline = glm::vec3(capture.camera.centreOfProjection - view.eye);
      piece.maxInverseDistance = largestInverseDistances(capture, region.grown);
      if (ordered.clip) piece.minInverseDistance = leastInverseDistances(capture, *ordered.clip);
      const ColumnOrder order =
          columnOrder(capture.camera, eye - glm::dvec2(capture.camera.centreOfProjection));
      piece.epipoleColumn = order.epipoleColumn;
      const auto add = [&](const DisplayCapture& samples, std::vector<PieceDraw>& draws) {
        piece.runs = keepColumns(order.runs, visibleColumns(samples, sight, piece));
        if (piece.runs.empty()) return;
        piece.nearestFirst = samples.layered && mostlyBeforeFoot(samples, piece);
        draws.push_back(piece);
      };
      if (capture.background.runs.runCount() > 0) {
        piece.runs = keepColumns(order.runs, visibleBackground(capture, piece, sight.planes));
        if (!piece.runs.empty()) plan.backgrounds.push_back(piece);
      }
      if (capture.reflections) add(*capture.reflections, plan.reflections);
      add(capture, plan.pieces);
    }
  };

  const Cover& chosen = chooseCover(region, sector);
  if (settings.secondaryCover) {
    for (const Cover& panorama : layout.panoramasFor(plan.region)) addCover(panorama, true);
    for (const Cover& cover : region.covers)
      if (&cover != &chosen) addCover(cover, true);
  }
  addCover(chosen, false);
  plan.missingImages = static_cast<int>(missing.size());
  return plan;
}

}  // namespace acentric
