#include "engine/layout/gap_order.h"

#include <algorithm>

#include "engine/layout/azimuth_order.h"

namespace acentric {
namespace {

/// Azimuths [from, to) at which rays from the eye cross a piece.
struct Arc {
  glm::dvec2 from, to;
};

/// The eye lies in the wedge's mirror image at its apex: rays end in the wedge exactly if they point into it.
Arc wedgeArc(const Piece& piece) { return {piece.low.direction(), piece.high.direction()}; }

/// Rays cross a strip exactly if they leave through its edge.
Arc stripArc(const Piece& piece, const glm::dvec2& eye) {
  Arc arc{piece.low.to - eye, piece.high.to - eye};
  if (arc.from == glm::dvec2(0)) arc.from = piece.low.direction();  // the eye at the edge's end
  if (arc.to == glm::dvec2(0)) arc.to = piece.high.direction();
  return arc;
}

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

std::vector<OrderedPiece> orderGap(const Cover& cover, const ViewSector& sector) {
  std::vector<OrderedPiece> ordered;
  for (std::size_t k = 0; k < cover.pieces.size(); ++k) {
    const Piece& piece = cover.pieces[k];
    const bool wedge = k < std::size_t(cover.wedges);
    if (meets(wedge ? wedgeArc(piece) : stripArc(piece, sector.eye), sector))
      ordered.push_back({piece.camera, sector});
  }
  return ordered;
}

}  // namespace acentric
