#include "engine/layout/gap_order.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/layout/azimuth_order.h"

namespace acentric {
namespace {

/// Azimuths [from, to) at which rays from the eye cross a piece.
struct Arc {
  glm::dvec2 from, to;
};

/// The gap's corners and the two directions in which its sides are continued beyond each.
class Gap {
 public:
  explicit Gap(const ConvexPolygon& polygon) : polygon_(polygon), count_(static_cast<int>(polygon.size())) {}
  int count() const { return count_; }
  const glm::dvec2& corner(int k) const {
    return polygon_.corners[std::size_t(((k % count_) + count_) % count_)];
  }

  /// Rays cross a strip exactly if they leave through its edge.
  Arc stripArc(int edge, const glm::dvec2& eye) const {
    Arc arc{corner(edge) - eye, corner(edge + 1) - eye};
    if (arc.from == glm::dvec2(0)) arc.from = corner(edge) - corner(edge - 1);  // the eye at the edge's end
    if (arc.to == glm::dvec2(0)) arc.to = corner(edge + 1) - corner(edge + 2);
    return arc;
  }

  /// A wedge, or a sub-camera's part of one, is convex and the eye is not in it: its arc is the hull of the
  /// directions to its corners and of those in which it goes on for ever.
  Arc wedgeArc(int k, const Piece& piece, const glm::dvec2& eye) const {
    std::array<glm::dvec2, 4> directions{corner(k) - eye, piece.low.direction(), piece.high.direction(),
                                         glm::dvec2(0)};
    if (piece.clip) {
      // Cut off beyond the tip of the strip beside it: there it goes on along the cut, not along the sector's
      // border. The tip lies an edge's length beyond the corner.
      const int behind = piece.clip->side.left ? k + 1 : k - 1;
      directions[piece.clip->side.left ? 1 : 2] = piece.clip->side.line.direction();
      directions[3] = 2.0 * corner(k) - corner(behind) - eye;
    }
    Arc arc{piece.low.direction(), piece.low.direction()};
    bool any = false;
    for (const glm::dvec2& direction : directions) {
      if (direction == glm::dvec2(0)) continue;
      if (!any) arc = {direction, direction};
      any = true;
      if (turn(arc.from, direction) < 0) arc.from = direction;
      if (turn(arc.to, direction) > 0) arc.to = direction;
    }
    return arc;
  }

 private:
  const ConvexPolygon& polygon_;
  int count_;
};

bool meets(const Arc& arc, const ViewSector& sector) {
  const double width = sector.azimuths.width;
  if (width >= kTwoPi) return true;
  const glm::dvec2 right = directionOf(sector.azimuths.low);
  if (inArc(arc.from, right, arc.to)) return true;
  const double angle = angleFrom(right, arc.from);
  if (std::abs(angle - width) > 1e-9) return angle < width;
  return turn(directionOf(sector.azimuths.low + width), arc.from) < 0;  // too close to call by angles
}

}  // namespace

std::vector<OrderedPiece> orderGap(const ConvexPolygon& gap, const Cover& cover, const ViewSector& sector) {
  const Gap corners(gap);
  const int wedges = cover.wedges;
  const int parts = std::max(1, wedges / corners.count());
  struct Wedge {
    double away;  ///< from the eye's side of the gap, radians around the gap's middle
    OrderedPiece piece;
  };
  std::vector<Wedge> visible;
  const glm::dvec2 middle = gap.centroid(), eyeSide = sector.eye - middle;
  for (int w = 0; w < wedges; ++w) {
    const Piece& piece = cover.pieces[std::size_t(w)];
    const int k = w / parts;
    if (!meets(corners.wedgeArc(k, piece, sector.eye), sector)) continue;
    // The parts of a wedge lie on either side of the line from the middle through its corner.
    const double turned = ((w % parts + 0.5) / parts - 0.5) * kTwoPi / corners.count();
    const glm::dvec2 out = corners.corner(k) - middle;
    const double azimuth = std::atan2(out.y, out.x) + turned;
    const double away = std::abs(std::remainder(azimuth - std::atan2(eyeSide.y, eyeSide.x), kTwoPi));
    visible.push_back({away, {piece.camera, sector, piece.clip}});
  }
  std::ranges::stable_sort(visible, std::ranges::greater{}, &Wedge::away);
  std::vector<OrderedPiece> ordered;
  for (Wedge& wedge : visible) ordered.push_back(std::move(wedge.piece));
  for (std::size_t k = std::size_t(wedges); k < cover.pieces.size(); ++k)
    if (meets(corners.stripArc(static_cast<int>(k) - wedges, sector.eye), sector))
      ordered.push_back({cover.pieces[k].camera, sector, cover.pieces[k].clip});
  return ordered;
}

}  // namespace acentric
