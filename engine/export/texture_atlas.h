#pragma once
/// Many small pictures on few large ones, each with a border of its own pixels around it so that filtering
/// never reads a neighbour's.

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace acentric {

struct AtlasPlace {
  int page = 0;
  glm::ivec2 at{0};  ///< of the picture itself, inside its border
};

struct AtlasPlan {
  std::vector<AtlasPlace> places;  ///< in the order of the sizes
  std::vector<glm::ivec2> pages;   ///< their sizes
};

inline constexpr int kAtlasBorder = 1;

/// Rows of pictures of falling height. `side`: of a page, at least the largest picture with its border.
AtlasPlan planAtlas(std::span<const glm::ivec2> sizes, int side, int border = kAtlasBorder);

}  // namespace acentric
