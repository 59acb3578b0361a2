#include "editor/tools/camera_steps.h"

#include <cmath>

namespace acentric::editor {
namespace {

const Region* regionOf(const Layout& layout, const CellId& cell) {
  const auto region = layout.findRegion(cell);
  return region ? &layout.regions[std::size_t(*region)] : nullptr;
}

std::optional<CameraPlace> placeIn(const Region& region, int camera) {
  for (std::size_t c = 0; c < region.covers.size(); ++c)
    for (std::size_t p = 0; p < region.covers[c].pieces.size(); ++p)
      if (region.covers[c].pieces[p].camera == camera) return CameraPlace{region.id, int(c), int(p)};
  return std::nullopt;
}

double lookOf(const LayoutCamera& camera) { return camera.lowAzimuth + 0.5 * camera.fovRadians; }

}  // namespace

std::optional<int> cameraAtPlace(const Layout& layout, const CameraPlace& place) {
  const Region* region = regionOf(layout, place.cell);
  if (region == nullptr || place.cover < 0 || place.cover >= int(region->covers.size())) return std::nullopt;
  const std::vector<Piece>& pieces = region->covers[std::size_t(place.cover)].pieces;
  if (place.piece < 0 || place.piece >= int(pieces.size())) return std::nullopt;
  return pieces[std::size_t(place.piece)].camera;
}

std::optional<CameraPlace> firstPlace(const Layout& layout, const CellId& cell) {
  const CameraPlace first{cell, 0, 0};
  return cameraAtPlace(layout, first) ? std::optional(first) : std::nullopt;
}

std::optional<CameraPlace> placeOf(const Layout& layout, int camera, const std::optional<CellId>& preferred) {
  if (preferred)
    if (const Region* region = regionOf(layout, *preferred))
      if (const auto place = placeIn(*region, camera)) return place;
  for (const Region& region : layout.regions)
    if (const auto place = placeIn(region, camera)) return place;
  return std::nullopt;
}

CameraPlace stepped(const Layout& layout, const CameraPlace& place, int steps) {
  const auto from = cameraAtPlace(layout, place);
  if (!from) return place;
  const std::vector<Piece>& pieces = regionOf(layout, place.cell)->covers[std::size_t(place.cover)].pieces;
  const int count = int(pieces.size());
  CameraPlace next = place;
  for (int tried = 0; tried < count; ++tried) {
    next.piece = (next.piece + (steps > 0 ? 1 : count - 1)) % count;
    if (pieces[std::size_t(next.piece)].camera != *from) return next;
  }
  return place;
}

std::optional<CameraPlace> otherHand(const Layout& layout, const CameraPlace& place) {
  const auto from = cameraAtPlace(layout, place);
  if (!from) return std::nullopt;
  const Region& region = *regionOf(layout, place.cell);
  if (region.covers.size() < 2) return std::nullopt;
  const int cover = (place.cover + 1) % int(region.covers.size());
  const double look = lookOf(layout.cameras[std::size_t(*from)]);
  std::optional<CameraPlace> nearest;
  double least = 0;
  const std::vector<Piece>& pieces = region.covers[std::size_t(cover)].pieces;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const double away =
        std::abs(std::remainder(lookOf(layout.cameras[std::size_t(pieces[p].camera)]) - look, kTwoPi));
    if (nearest && away >= least) continue;
    nearest = CameraPlace{place.cell, cover, int(p)};
    least = away;
  }
  return nearest;
}

}  // namespace acentric::editor
