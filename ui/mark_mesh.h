#pragma once
/// Marks of a constant size in pixels at many places of a plan: dots, and sectors that show where something
/// looks. As polygon_mesh.h: places and colours stay on the graphics card.

#include <string>
#include <vector>

#include "ui/canvas_gl.h"

namespace acentric::ui {

struct CanvasMark {
  glm::dvec2 place{0};     ///< world
  float lowRadians = 0;    ///< of the sector, counter-clockwise in the world
  float widthRadians = 0;  ///< less than half a turn
};

struct MarkLook {
  float dotPixels = 3;  ///< radius, with a rim of one pixel around it; 0: no dots
  ImVec4 rim{0, 0, 0, 1};
  float sectorPixels = 0;  ///< radius; 0: no sectors
  float opacity = 1;       ///< of everything; 0 skips it
};

class MarkMesh {
 public:
  void setPlaces(std::span<const CanvasMark> marks);
  /// One per mark, packed as ImGui does.
  void setColours(std::span<const ImU32> colours) { table_.upload(colours); }
  bool empty() const { return tiles_.tiles.empty(); }

  /// At this place of the list; once a frame. Sectors first, then all dots.
  void draw(ImDrawList& list, const CanvasView& view, const MarkLook& look);
  /// The same at once, on the framebuffer that is bound, with blending as it is set.
  void render(const CanvasView& view, const CanvasTarget& target, const MarkLook& look);
  const std::string& problem() const;

 private:
  void renderWith(GlProgram& program, const CanvasView& view, const CanvasTarget& target,
                  const MarkLook& look, float radius);

  GlProgram dot_{"mark.vert", "dot.frag"};
  GlProgram sector_{"mark.vert", "sector.frag"};
  CanvasTiles tiles_;
  GlName<GlKind::vertexArray> array_;
  GlName<GlKind::buffer> data_;
  ColourTable table_;
  std::uint64_t places_ = 0;  ///< content of what setPlaces was given
  CanvasRender pending_;
};

}  // namespace acentric::ui
