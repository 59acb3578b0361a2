#pragma once
/// Which parts of the window differ from the frame before: only they are drawn again. Where a processor does
/// the graphics card's work, a frame costs what its changed pixels do. No OpenGL here.
///
/// The window is cut into tiles. A tile's content is told by all triangles that may touch it, in order: their
/// corners, colours, texture (whose handle says which picture it holds, texture.h) and clipping; and by the
/// renders of canvases there (canvas_gl.h).

#include <imgui.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace acentric::ui {

/// Pixels of the framebuffer [min, max), y down.
struct PixelRect {
  glm::ivec2 min{0}, max{0};
  bool operator==(const PixelRect&) const = default;
};

class Damage {
 public:
  static constexpr int kTile = 32;         ///< pixels, both ways
  static constexpr std::size_t kMost = 8;  ///< rectangles; what would be more becomes one that holds all

  /// What changed since the last call: rectangles that do not overlap, none if nothing did. All of it the
  /// first time, after forget(), and when the size changes.
  std::vector<PixelRect> update(const ImDrawData& data);
  /// What is on the window is no longer what was drawn.
  void forget() { tiles_.clear(); }

 private:
  void addCommand(const ImDrawData& data, const ImDrawList& list, const ImDrawCmd& command);
  void addTo(const glm::vec2& low, const glm::vec2& high, std::uint64_t content);
  std::vector<PixelRect> rectsOf(const std::vector<std::uint64_t>& former) const;

  glm::ivec2 size_{0}, count_{0};     ///< pixels; tiles
  std::vector<std::uint64_t> tiles_;  ///< row by row
};

/// Leaves of the commands what draws inside the rectangles: each command is there once for each rectangle
/// that it may touch, clipped to it.
void clipTo(ImDrawData& data, const std::vector<PixelRect>& rects);

}  // namespace acentric::ui
