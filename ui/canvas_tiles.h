#pragma once
/// Parts of a plan that lie near one another, so that what is off the window is skipped by the hundred, and
/// so that each part's coordinates are small numbers beside an origin of its own: single precision then does
/// for map coordinates of thousands of kilometres and for every zoom. Pure.

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ui/canvas_view.h"

namespace acentric::ui {

/// World box of one thing.
struct CanvasBox {
  glm::dvec2 low{0}, high{0};
};

struct CanvasTile {
  glm::dvec2 origin{0};                ///< world; what the tile's coordinates are relative to
  CanvasBox box;                       ///< of its things
  std::uint32_t first = 0, count = 0;  ///< of CanvasTiles::order
};

struct CanvasTiles {
  std::vector<CanvasTile> tiles;
  std::vector<std::uint32_t> order;  ///< the things, tile by tile; within a tile in the order they were given
};

/// About `perTile` things in each.
CanvasTiles tilesOf(std::span<const CanvasBox> boxes, std::size_t perTile = 512);

/// Does the box, grown by `margin` pixels, come into the view's area?
bool onScreen(const CanvasView& view, const CanvasBox& box, double marginPixels);

}  // namespace acentric::ui
