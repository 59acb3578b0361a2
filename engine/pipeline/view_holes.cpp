#include "engine/pipeline/view_holes.h"

#include <algorithm>

#include "engine/layout/drawing_order.h"

namespace acentric {
namespace {

/// Surfaces along one view ray that are asked for; behind so many hardly anything is captured.
constexpr int kMostSurfaces = 12;

class ViewJudge {
 public:
  ViewJudge(const CaptureReach& reach, const PerspectiveView& view, const ViewSettings& settings, int region)
      : reach_(reach),
        view_(view),
        settings_(settings),
        region_(reach.layout().regions[std::size_t(region)]) {
    if (settings.secondaryCover)
      covers_ = drawnCovers(reach.layout(), region);
    else
      covers_ = {chooseCover(region_, sectorOf(view))};
  }

  struct Pixel {
    float rayDistance = std::numeric_limits<float>::infinity();
    bool missed = false;
    bool open = false;  ///< no captured surface along the ray at all
  };

  Pixel judge(double u, double v) const {
    Pixel pixel;
    const glm::dvec3 direction = view_.rayThrough(u, v);
    OpaqueHit hit = reach_.tracer().trace(view_.eye, direction, 0, kInfinity);
    if (!hit.found()) return pixel;
    pixel.rayDistance = float(hit.distance);
    if (settings_.localGeometry &&
        region_.grown.containsClosed(glm::dvec2(view_.eye + hit.distance * direction)))
      return pixel;
    pixel.open = true;
    for (int n = 0; n < kMostSurfaces && pixel.open; ++n) {
      if (!hit.found()) {
        pixel.open = !skyHeld(direction);
        break;
      }
      const glm::dvec3 point = view_.eye + hit.distance * direction;
      // Of what lies in the near band only the local geometry is drawn.
      pixel.open = region_.grown.containsClosed(glm::dvec2(point)) || !held(point);
      if (n == 0) pixel.missed = pixel.open;
      const double behind = hit.distance * (1 + 1e-6) + 1e-9;
      hit = reach_.tracer().trace(view_.eye, direction, behind, kInfinity);
    }
    return pixel;
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  bool held(const glm::dvec3& point) const {
    return std::ranges::any_of(covers_, [&](const Cover& cover) {
      const Piece* piece = pieceAt(cover, glm::dvec2(point));
      return piece != nullptr && reach_.holds(piece->camera, point, piece->role);
    });
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
  const ViewSettings& settings_;
  const Region& region_;
  std::vector<Cover> covers_;
};

}  // namespace

Result<ViewHoles> predictHoles(const CaptureReach& reach, const PerspectiveView& view,
                               const ViewSettings& settings, TaskRunner& runner) {
  if (Status sound = view.check(); !sound) return tl::unexpected(sound.error());
  const auto region = reach.layout().regionAt(glm::dvec2(view.eye));
  if (!region)
    return fail(ErrorKind::invalidArgument, "the eye stands outside every region", "predicted holes");
  const ViewJudge judge(reach, view, settings, *region);
  ViewHoles holes;
  holes.openPixels = Image<std::uint8_t>(view.width, view.height);
  holes.rayDistance = FloatImage(view.width, view.height);
  struct Row {
    std::uint64_t missed = 0, open = 0;
  };
  std::vector<Row> rows(std::size_t(view.height));
  runner.parallelFor(rows.size(), [&](std::size_t y) {
    for (int x = 0; x < view.width; ++x) {
      const ViewJudge::Pixel pixel = judge.judge(x + 0.5, double(y) + 0.5);
      rows[y].missed += pixel.missed ? 1 : 0;
      rows[y].open += pixel.open ? 1 : 0;
      holes.openPixels.at(x, int(y)) = pixel.open ? 1 : 0;
      holes.rayDistance.at(x, int(y)) = pixel.rayDistance;
    }
  });
  const double pixels = double(view.width) * view.height;
  for (const Row& row : rows) {
    holes.missed += double(row.missed) / pixels;
    holes.open += double(row.open) / pixels;
  }
  return holes;
}

}  // namespace acentric
