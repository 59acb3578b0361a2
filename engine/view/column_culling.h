#pragma once
/// Which rows of a capture's column can fall on a rectangle of the picture.
///
/// Seen from the eye, the sample (t, w) of column direction c lies in direction c + t z + w b (apv.md section
/// 2): affine in the row tangent t and the inverse distance w. A side of the rectangle is a plane through the
/// eye, so "inside it" is a linear inequality in t once the most favourable w of the column's range is put
/// in. Nothing visible is ever culled, whatever the pitch and the field of view.

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "engine/geometry/perspective_view.h"

namespace acentric {

/// Inward unit normals, in world axes, of the rectangle's four sides and of the plane through the eye.
struct FrustumPlanes {
  std::array<glm::dvec3, 5> normals;
};

/// `margin` pixels are added all around, for splats whose centre lies beside the rectangle.
FrustumPlanes frustumPlanes(const PerspectiveView& view, const PixelRect& rect, double margin);

/// How far a splat of the largest allowed side reaches from its centre, with room for rounding.
constexpr double splatMargin(int maxSplatPixels) { return 0.5 * maxSplatPixels + 1.5; }

struct TangentRange {
  double low = 0;
  double high = 0;
};

/// Row tangents within [all.low, all.high] that can fall into the frustum; nothing if none can.
/// `range`: smallest and largest inverse distance of the column's samples.
std::optional<TangentRange> visibleTangents(const FrustumPlanes& planes, const glm::dvec2& columnDirection,
                                            const glm::dvec3& baseline, const glm::dvec2& range,
                                            const TangentRange& all);

}  // namespace acentric
