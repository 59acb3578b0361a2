#pragma once
/// Regions as 3D Tiles 1.1: a tile each, its content the region's GLB, to be shown only while the viewer
/// stands in the region (`viewerRequestVolume`). Axes are the project's, Z up, metres, relative to its
/// origin; glTF's Y up is turned by whoever reads it, as the specification has it, so no tile has a
/// transform.
///
/// A region shows all that can be seen from it, so the bounding volumes of most tiles are that of the scene:
/// what finds a tile is its request volume. Tiles of many regions are in a tree of tilesets, of kMostTiles
/// each, that lie close to each other; a viewer reads those in whose request volume it stands.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/layout/layout.h"
#include "engine/scene/scene.h"

namespace acentric {

inline constexpr const char* kTilesetIndex = "tileset.json";
inline constexpr const char* kTilesetFormat = "acentric 3D Tiles walk";
inline constexpr std::size_t kMostTiles = 64;  ///< of a tileset

/// A region is shown from this far beyond its polygon: what comes next is fetched before it is stepped into.
inline constexpr double kRequestMargin = 0.25;

struct RegionTile {
  std::string file;  ///< relative to the folder
  ConvexPolygon polygon;
  double eyeZ = 0, eyeHeight = 0;  ///< the eye, and how high that is above the floor
  Bounds bounds;                   ///< of all that the file shows
  nlohmann::ordered_json extras;   ///< of the tile
};

/// A box as 3D Tiles has it: centre and three half axes.
struct TileBox {
  glm::dvec3 centre{0};
  glm::dmat3 halves{0};
};
/// Where the viewer stands for a region: the least rectangle around its polygon, grown by kRequestMargin,
/// from half of the eye's height above the floor to half of it above the eye.
TileBox requestBox(const RegionTile& tile);

/// tileset.json and those that it names. `extras`: of the tileset. There is a tile.
Status writeTileset(std::vector<RegionTile> tiles, const std::string& generator,
                    nlohmann::ordered_json extras, const std::filesystem::path& folder);

}  // namespace acentric
