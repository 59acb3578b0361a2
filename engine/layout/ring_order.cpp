#include "engine/layout/ring_order.h"

#include <algorithm>

#include "engine/layout/azimuth_order.h"

namespace acentric {
namespace {

/// A sector as the eye sees it, turned into a counter-clockwise ring (a clockwise one is mirrored in y and
/// listed backwards). A ray of azimuth t crosses the sector exactly for t in [azimuth of `toApex`, azimuth of
/// `high`).
struct Sector {
  int camera;
  glm::dvec2 toApex, low, high;
};

std::vector<Sector> canonicalRing(const Cover& cover, const glm::dvec2& eye) {
  const bool mirrored = cover.hand == Hand::clockwise;
  std::vector<Sector> ring;
  ring.reserve(cover.pieces.size());
  for (const Piece& piece : cover.pieces) {
    Sector sector{piece.camera, piece.apex - eye, piece.low.direction(), piece.high.direction()};
    if (mirrored) {
      const glm::dvec2 flip(1, -1);
      sector = {piece.camera, flip * sector.toApex, flip * sector.high, flip * sector.low};
    }
    // At the apex itself rays stay in their own sector: it is crossed from its low border on.
    if (sector.toApex == glm::dvec2(0)) sector.toApex = sector.low;
    ring.push_back(sector);
  }
  if (mirrored) std::ranges::reverse(ring);
  return ring;
}

class RingWalk {
 public:
  explicit RingWalk(std::vector<Sector> ring)
      : ring_(std::move(ring)), count_(static_cast<int>(ring_.size())) {}

  /// Calls emit(sector, partStart, partWidth) back to front, part after part, from azimuth `start` on.
  template <class Emit>
  void walk(double start, double width, const Emit& emit) const {
    // Of a ring that closes, parts are wide; one that comes broken from a file must not go on for ever.
    for (int parts = 0; width > 0 && parts <= 2 * count_; ++parts) {
      const glm::dvec2 ray = directionOf(start);
      const int first = sectorAtInfinity(ray);
      int last = nearestSector(ray, first);
      double partWidth = width;
      for (const int begun = last; last < begun + count_; ++last) {
        const double angle = angleToSector(ray, last + 1);
        if (angle >= width) break;  // what begins a rounding error before the end shows in no pixel
        // The farthest camera comes round again, now as the nearest: no linear order holds from here on.
        if (last + 1 == first + count_) {
          partWidth = angle;
          break;
        }
      }
      for (int m = first; m <= last; ++m) emit(at(m), start, partWidth);
      start += partWidth;
      width -= partWidth;
    }
  }

 private:
  const Sector& at(int m) const { return ring_[std::size_t(((m % count_) + count_) % count_)]; }

  /// The sector in which a ray of this direction ends.
  int sectorAtInfinity(const glm::dvec2& ray) const {
    for (int m = 0; m < count_; ++m)
      if (inArc(at(m).low, ray, at(m).high)) return m;
    return 0;
  }

  /// The sector in which the ray leaves the polygon: on along the front chain of apexes while they lie right
  /// of it.
  int nearestSector(const glm::dvec2& ray, int first) const {
    int last = first;
    for (int m = first + 1; m < first + count_; ++m) {
      const Sector& next = at(m);
      const int side = turn(ray, next.toApex);
      const bool onFrontChain = turn(ray, next.low) > 0;
      if (!onFrontChain || side > 0 || (side == 0 && glm::dot(ray, next.toApex) < 0)) break;
      last = m;
    }
    return last;
  }

  /// From `ray` on to the azimuth where sector m begins, in (0, 2 pi].
  double angleToSector(const glm::dvec2& ray, int m) const {
    const double angle = angleFrom(ray, at(m).toApex);
    return angle > 0 ? angle : kTwoPi;
  }

  std::vector<Sector> ring_;
  int count_;
};

}  // namespace

std::vector<OrderedPiece> orderRing(const Cover& cover, const ViewSector& sector) {
  std::vector<OrderedPiece> ordered;
  if (cover.pieces.empty()) return ordered;
  const bool mirrored = cover.hand == Hand::clockwise;
  const double width = std::min(sector.azimuths.width, kTwoPi);
  const double start = mirrored ? -(sector.azimuths.low + width) : sector.azimuths.low;
  RingWalk(canonicalRing(cover, sector.eye))
      .walk(start, width, [&](const Sector& s, double partStart, double partWidth) {
        OrderedPiece piece{s.camera, sector};
        if (partWidth != width)
          piece.part.azimuths = {wrapAngle(mirrored ? -(partStart + partWidth) : partStart), partWidth};
        ordered.push_back(piece);
      });
  return ordered;
}

}  // namespace acentric
