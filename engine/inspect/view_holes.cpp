#include "engine/inspect/view_holes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/inspect/sampling_rate.h"
#include "engine/layout/drawing_order.h"

namespace acentric {
namespace {

/// Surfaces along one view ray that are asked for; behind so many hardly anything is captured.
constexpr int kMostSurfaces = 12;
/// Below this probability that a pixel is still open, what lies behind changes nothing.
constexpr double kSurelyCovered = 1e-3;

class ViewJudge {
 public:
  ViewJudge(const CaptureReach& reach, const PerspectiveView& view, const ViewHoleOptions& options,
            int region)
      : reach_(reach),
        view_(view),
        options_(options),
        region_(reach.layout().regions[std::size_t(region)]),
        viewFromWorld_(view.viewFromWorld()),
        focal_(view.focalPixels()) {
    if (options.everyCover)
      covers_ = drawnCovers(reach.layout(), region);
    else
      covers_ = {chooseCover(region_, sectorOf(view))};
  }

  struct Pixel {
    float rayDistance = std::numeric_limits<float>::infinity();
    bool missed = false;
    double open = 0;       ///< probability, with cracks between splats
    bool nothing = false;  ///< no captured surface along the ray at all
  };

  Pixel judge(double u, double v) const {
    Pixel pixel;
    const glm::dvec3 direction = view_.rayThrough(u, v);
    OpaqueHit hit = reach_.tracer().trace(view_.eye, direction, 0, kInfinity);
    if (!hit.found()) return pixel;
    pixel.rayDistance = float(hit.distance);
    if (options_.localGeometry &&
        region_.grown.containsClosed(glm::dvec2(view_.eye + hit.distance * direction)))
      return pixel;
    pixel.open = 1, pixel.nothing = true;
    for (int n = 0; n < kMostSurfaces && pixel.open > kSurelyCovered; ++n) {
      if (!hit.found()) {
        if (skyHeld(direction)) pixel.open = 0, pixel.nothing = false;
        break;
      }
      const glm::dvec3 point = view_.eye + hit.distance * direction;
      // Of what lies in the near band only the local geometry is drawn.
      if (!region_.grown.containsClosed(glm::dvec2(point))) {
        const double left = openAt(point, hit.normal, pixel.nothing);
        pixel.open *= left;
        if (n == 0) pixel.missed = pixel.nothing;
      } else if (n == 0) {
        pixel.missed = true;
      }
      const double behind = hit.distance * (1 + 1e-6) + 1e-9;
      hit = reach_.tracer().trace(view_.eye, direction, behind, kInfinity);
    }
    return pixel;
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  /// Probability that the samples of this surface leave the pixel open; `nothing` becomes false if there are
  /// any.
  double openAt(const glm::dvec3& point, const glm::dvec3& normal, bool& nothing) const {
    double open = 1;
    for (const Cover& cover : covers_) {
      const Piece* piece = pieceAt(cover, glm::dvec2(point));
      if (piece == nullptr || !reach_.holds(piece->camera, point, piece->role)) continue;
      nothing = false;
      open *= openBetween(piece->camera, point, normal);
    }
    return open;
  }

  double openBetween(int camera, const glm::dvec3& point, const glm::dvec3& normal) const {
    const ColumnCamera& columns = reach_.columns(camera);
    const SurfaceAxes axes = axesOf(normal);
    const glm::dmat2 samples = samplesPerMetre(columns, point, axes);
    if (!(std::abs(glm::determinant(samples)) > 0)) return 1;
    const glm::dvec3 q = viewFromWorld_ * (point - view_.eye);
    const auto pixels = [&](const glm::dvec3& axis) {
      const glm::dvec3 d = viewFromWorld_ * axis;
      return focal_ / q.z * glm::dvec2(d.x - q.x / q.z * d.z, d.y - q.y / q.z * d.z);
    };
    const glm::dmat2 perSample = glm::dmat2(pixels(axes.first), pixels(axes.second)) * glm::inverse(samples);
    const double pitch = std::max(columns.columnPitch(), columns.rowPitch());
    const double stretch = glm::dot(q, q) / (q.z * q.z);
    const double magnified = glm::distance(point, columns.centreOfProjection) / glm::length(q) * stretch;
    const double wanted = focal_ * pitch * options_.splatFactor * magnified;
    return openBetweenSplats(perSample, std::ceil(std::clamp(wanted, 1.0, options_.maxSplatPixels)));
  }

  bool skyHeld(const glm::dvec3& direction) const {
    const glm::dvec2 plan(direction);
    if (!(glm::length(plan) > 0)) return false;
    // A place so far out that every camera sees it in this direction.
    constexpr double kFarAway = 1e7;
    const glm::dvec2 place = glm::dvec2(view_.eye) + kFarAway * glm::normalize(plan);
    return std::ranges::any_of(covers_, [&](const Cover& cover) {
      const Piece* piece = pieceAt(cover, place);
      return piece != nullptr && reach_.holdsSky(piece->camera, direction, piece->role);
    });
  }

  const CaptureReach& reach_;
  const PerspectiveView& view_;
  const ViewHoleOptions& options_;
  const Region& region_;
  glm::dmat3 viewFromWorld_;
  double focal_;
  std::vector<Cover> covers_;
};

}  // namespace

Result<ViewHoles> predictHoles(const CaptureReach& reach, const PerspectiveView& view,
                               const ViewHoleOptions& options, TaskRunner& runner) {
  if (Status sound = view.check(); !sound) return tl::unexpected(sound.error());
  const auto region = reach.layout().regionAt(glm::dvec2(view.eye));
  if (!region)
    return fail(ErrorKind::invalidArgument, "the eye stands outside every region", "predicted holes");
  const ViewJudge judge(reach, view, options, *region);
  ViewHoles holes;
  holes.openness = holes.rayDistance = FloatImage(view.width, view.height);
  struct Row {
    std::uint64_t missed = 0, open = 0;
    double expected = 0;
  };
  std::vector<Row> rows(std::size_t(view.height));
  runner.parallelFor(rows.size(), [&](std::size_t y) {
    for (int x = 0; x < view.width; ++x) {
      const ViewJudge::Pixel pixel = judge.judge(x + 0.5, double(y) + 0.5);
      rows[y].missed += pixel.missed ? 1 : 0;
      rows[y].open += pixel.nothing ? 1 : 0;
      rows[y].expected += pixel.open;
      holes.openness.at(x, int(y)) = float(pixel.open);
      holes.rayDistance.at(x, int(y)) = pixel.rayDistance;
    }
  });
  const double pixels = double(view.width) * view.height;
  for (const Row& row : rows) {
    holes.missed += double(row.missed) / pixels;
    holes.open += double(row.open) / pixels;
    holes.expected += row.expected / pixels;
  }
  return holes;
}

}  // namespace acentric
