#pragma once
/// Going from camera to camera of a cell: round its ring, and to the cameras of the other hand.

#include <optional>

#include "engine/layout/layout.h"

namespace acentric::editor {

/// A camera as a part of what a cell is drawn from. It outlives changes of the layout as long as the cell has
/// such a piece.
struct CameraPlace {
  CellId cell;
  int cover = 0;  ///< of the region's
  int piece = 0;  ///< of the cover's
  bool operator==(const CameraPlace&) const = default;
};

/// Index into Layout::cameras; nothing if the layout has no such place.
std::optional<int> cameraAtPlace(const Layout& layout, const CameraPlace& place);
/// The first camera of a cell.
std::optional<CameraPlace> firstPlace(const Layout& layout, const CellId& cell);
/// A place of the camera: in `preferred` if one of its covers names it, else in the first region whose does.
std::optional<CameraPlace> placeOf(const Layout& layout, int camera,
                                   const std::optional<CellId>& preferred = {});
/// The next camera of the ring, counter-clockwise with `steps` = 1, clockwise with -1. Pieces of the same
/// camera count once.
CameraPlace stepped(const Layout& layout, const CameraPlace& place, int steps);
/// Of the cell's next cover, the camera that looks most nearly the same way; nothing if it has one cover.
std::optional<CameraPlace> otherHand(const Layout& layout, const CameraPlace& place);

}  // namespace acentric::editor
