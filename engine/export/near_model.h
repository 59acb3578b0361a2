#pragma once
/// Local geometry as textured triangles that need no light: what they show, base colour and baked light
/// together, is in texture atlases of their own, one picture for each chart (surface_charts.h).
///
/// A chart has texels as fine as what it shows (its textures and its light), and no finer than an eye in the
/// region resolves (kTexelsPerDegree), or than kFinestTexel, or kFinestMaskTexel where alpha is cut off.
/// Where half as many show the same, it has those.

#include "engine/export/draw_model.h"
#include "engine/view/walk_scene.h"

namespace acentric {

inline constexpr double kTexelsPerDegree = 20;
inline constexpr double kFinestTexel = 0.002, kFinestMaskTexel = 0.0015;  ///< metres
/// Of a region: where there are more, all are coarser by one factor.
inline constexpr double kMostNearTexels = 1 << 25;

struct NearModelCounts {
  std::size_t triangles = 0, charts = 0, texels = 0, textures = 0;
};

/// Without flat mirrors: what they show lies behind them (patch_model.h). Blended meshes come last. Textures
/// have at most `atlasPixels` a side; a chart that does not fit one is coarser.
NearModelCounts addNear(const WalkScene& walk, std::size_t region, const LocalGeometry& local,
                        int atlasPixels, DrawModel& model);

/// Metres at least from an eye in the polygon at `eyeZ` to a triangle.
double eyeDistance(const ConvexPolygon& polygon, double eyeZ, const std::array<glm::vec3, 3>& triangle);

}  // namespace acentric
