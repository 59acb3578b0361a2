#pragma once
/// Back-to-front order of a traditional panorama's sectors, which all meet in one centre of projection, for
/// an eye anywhere.

#include "engine/layout/drawing_order.h"

namespace acentric {

/// `panorama`: the sectors all round one apex. A ray from the eye turns about the apex from the azimuth of
/// the eye towards its own direction, so sectors nearer to the eye's azimuth lie nearer along the ray.
std::vector<OrderedPiece> orderPanorama(const Cover& panorama, const ViewSector& sector);

}  // namespace acentric
