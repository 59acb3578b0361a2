#include "engine/inspect/camera_sight.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/inspect/capture_reach.h"

namespace acentric {
namespace {

constexpr int kAround = 32;                            // directions in plan
constexpr std::array kSlopes{0.0, -0.35, 0.35};        // up per metre ahead
constexpr double kHiddenShare = 0.1;                   // from which it is too much
constexpr double kNearby = 0.01, kNearbyOfWay = 1e-3;  // metres, and share: a surface hides not itself

/// Is a point hidden from a camera of the region whose grown polygon this is?
bool isHidden(const glm::dvec3& point, const glm::dvec2& camera, const ConvexPolygon& grown, double eyeZ,
              const SurfaceProbe& probe) {
  const glm::dvec3 centre(camera, eyeZ);
  const double inPlan = glm::distance(glm::dvec2(point), camera);
  if (!(inPlan > 0)) return false;
  const glm::dvec3 way = point - centre;
  const double length = glm::length(way);
  const auto span = grown.raySpan(camera, glm::dvec2(way) / inPlan);
  const double begin = (span ? span->second : 0) / inPlan * length;
  const double left = length - begin;
  return left > 0 && probe(centre + way / length * begin, way / length).distance <
                         left - std::max(kNearby, kNearbyOfWay * length);
}

}  // namespace

bool CameraSight::suffices() const { return places > 0 && hidden <= kHiddenShare * shown; }

std::map<int, CameraSight> lookFrom(const std::vector<glm::dvec2>& places, const Layout& layout,
                                    const Region& region, const Bounds& bounds, const SurfaceProbe& probe) {
  std::map<int, CameraSight> sights;
  for (const Cover& cover : region.covers)
    for (const Piece& piece : cover.pieces) sights[piece.camera].places += static_cast<int>(places.size());
  const std::vector<Cover> drawn = drawnCovers(layout, static_cast<int>(&region - layout.regions.data()));
  std::vector<const Piece*> holding(drawn.size());            // the point that is looked at, by cover
  const double far = double(glm::length(bounds.size())) + 1;  // where the sky is
  for (const glm::dvec2& place : places)
    for (const double slope : kSlopes)
      for (int k = 0; k < kAround; ++k) {
        const glm::dvec3 direction =
            glm::normalize(glm::dvec3(directionOf(kTwoPi * (k + 0.5) / kAround), slope));
        const glm::dvec3 eye(place, layout.eyeZ());
        const SurfaceHit hit = probe(eye, direction);
        const glm::dvec3 point = eye + (hit.found() ? hit.distance : far) * direction;
        if (region.grown.containsClosed(glm::dvec2(point))) continue;  // local geometry
        std::ranges::transform(drawn, holding.begin(),
                               [&](const Cover& cover) { return pieceAt(cover, glm::dvec2(point)); });
        const bool missed = std::ranges::all_of(holding, [&](const Piece* piece) {
          return piece == nullptr || isHidden(point, piece->apex, region.grown, layout.eyeZ(), probe);
        });
        for (std::size_t own = 0; own < region.covers.size(); ++own)  // they come first
          if (holding[own] != nullptr) sights[holding[own]->camera].add({0, 1, missed ? 1 : 0});
      }
  return sights;
}

}  // namespace acentric
