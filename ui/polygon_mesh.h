#pragma once
/// Convex polygons of a plan, by the hundred thousand: shapes and colours stay on the graphics card, a frame
/// sends the view alone. Lines keep their width in pixels at every zoom.

#include <string>
#include <vector>

#include "ui/canvas_gl.h"

namespace acentric::ui {

struct PolygonStyle {
  ImU32 fill = 0, line = 0;  ///< packed as ImGui does; opacity 0: not painted
  float linePixels = 1;
};

class PolygonMesh {
 public:
  /// World corners of all polygons one after another; `ends`: where each ends.
  void setShapes(std::span<const glm::dvec2> corners, std::span<const std::uint32_t> ends);
  /// One per polygon.
  void setStyles(std::span<const PolygonStyle> styles);
  bool empty() const { return tiles_.tiles.empty(); }

  /// At this place of the list; once a frame. `lineOpacity` scales that of all lines; 0 skips them.
  void draw(ImDrawList& list, const CanvasView& view, float lineOpacity);
  /// The same at once, on the framebuffer that is bound, with blending as it is set.
  void render(const CanvasView& view, const CanvasTarget& target, float lineOpacity);
  /// Why nothing is drawn, if this OpenGL cannot; else empty.
  const std::string& problem() const;

 private:
  struct Range {
    std::size_t first = 0, count = 0;
  };
  void renderFills(const CanvasView& view, const CanvasTarget& target);
  void renderLines(const CanvasView& view, const CanvasTarget& target, float opacity);

  GlProgram fill_{"polygon_fill.vert", "polygon_fill.frag"};
  GlProgram line_{"polygon_line.vert", "polygon_line.frag"};
  CanvasTiles tiles_;
  std::vector<Range> triangles_, edges_;  ///< of each tile: indices of corners, edges
  GlName<GlKind::vertexArray> fillArray_, lineArray_;
  GlName<GlKind::buffer> corners_, indices_, edgeData_;
  ColourTable table_;
  double widestLine_ = 1;
  bool anyFill_ = false;
  std::uint64_t shapes_ = 0;  ///< content of what setShapes was given
  CanvasRender pending_;
};

}  // namespace acentric::ui
