#include "engine/layout/panorama_order.h"

#include <algorithm>
#include <cmath>

#include "engine/layout/azimuth_order.h"

namespace acentric {
namespace {

/// Do [low, low + width] and the view share a direction?
bool meets(double low, double width, const AzimuthRange& view) {
  if (width + view.width >= kTwoPi) return true;
  const double ahead = wrapAngle(low - view.low);
  return ahead <= view.width || ahead + width >= kTwoPi;
}

}  // namespace

std::vector<OrderedPiece> orderPanorama(const Cover& panorama, const ViewSector& sector) {
  struct Sector {
    double away;  ///< from the eye's azimuth about the apex, radians; pi: the farthest
    int camera;
  };
  std::vector<Sector> sectors;
  for (const Piece& piece : panorama.pieces) {
    const glm::dvec2 low = piece.low.direction(), toEye = sector.eye - piece.apex;
    const double width = angleFrom(low, piece.high.direction());
    if (toEye == glm::dvec2(0)) {
      if (meets(std::atan2(low.y, low.x), width, sector.azimuths)) sectors.push_back({0, piece.camera});
      continue;
    }
    const double toLow = angleFrom(toEye, low), fromHigh = kTwoPi - toLow - width;
    if (fromHigh < 0) {  // the eye stands in the sector: every ray begins there
      sectors.push_back({0, piece.camera});
      continue;
    }
    // Rays that turn counter-clockwise reach it with directions from toLow to half a turn on from the eye's
    // azimuth, those that turn clockwise likewise; behind the apex both do.
    const bool counterClockwise = toLow < kPi, clockwise = fromHigh < kPi;
    const double begin = counterClockwise ? toLow : kPi, end = clockwise ? kTwoPi - fromHigh : kPi;
    if (!meets(std::atan2(toEye.y, toEye.x) + begin, end - begin, sector.azimuths)) continue;
    sectors.push_back({counterClockwise && clockwise ? kPi : std::min(toLow, fromHigh), piece.camera});
  }
  std::ranges::stable_sort(sectors, std::ranges::greater{}, &Sector::away);
  std::vector<OrderedPiece> ordered;
  for (const Sector& s : sectors) ordered.push_back({s.camera, sector, {}});
  return ordered;
}

}  // namespace acentric
