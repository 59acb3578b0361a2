#pragma once
/// The patches of a picture as tables for shaders (shaders/patch.glsl), with the tiles that they may show in.

#include <functional>
#include <glm/glm.hpp>

#include "engine/view/patch_tiles.h"

namespace acentric {

/// Places as in PatchColumn: at pixel (0, 0), and per pixel down and across; the inverse depth comes last.
struct PatchRecord {
  glm::vec4 start, down, across;
  float columnOffset, rowOffset, middleTangent;
  std::uint32_t firstTexel;  ///< of its border
  std::uint32_t size;        ///< columns | rows << 16, without the border
  std::uint32_t looks;       ///< mirror | is it blended? << 8 | PatchColumn::settled << 9
  std::uint32_t piece;       ///< of PatchTables::pieces
  std::uint32_t unused = 0;
};
static_assert(sizeof(PatchRecord) == 80, "shaders read five times four words");

struct PieceRecord {
  glm::vec2 perRadian;   ///< columns, rows
  std::uint32_t roles;   ///< bits of texels
  std::uint32_t source;  ///< PixelSource
  /// Borders of the part of the view that it is painted in: at pixel (0, 0), per pixel across and down;
  /// inside where they are >= 0.
  glm::vec3 low;
  std::uint32_t part;  ///< 0 = all of it, 1 = inside both borders, 2 = inside one of them
  glm::vec3 high;
  std::uint32_t unused = 0;
};
static_assert(sizeof(PieceRecord) == 48, "shaders read three times four words");

struct PatchTables {
  std::vector<PatchRecord> patches;  ///< by their numbers in `tiles`
  std::vector<PieceRecord> pieces;
  PatchTiles tiles;

  /// `firstTexel`: where a capture's texels begin among all that shaders read. `allTiles`: also those that
  /// no patch touches.
  void set(std::span<const StripDraw> strips, int width, int height,
           const std::function<std::uint32_t(const DisplayCapture&)>& firstTexel, bool allTiles = false);
};

}  // namespace acentric
