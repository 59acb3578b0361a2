#pragma once
/// How meshes of a plan are drawn with OpenGL 3.3: where on the window, tile by tile, with colours from a
/// table that changes without the shapes. Needs the window's context; main thread only.

#include <imgui.h>

#include <cstdint>
#include <functional>
#include <span>

#include "ui/canvas_tiles.h"
#include "ui/canvas_view.h"
#include "ui/content_hash.h"
#include "ui/gl_names.h"

namespace acentric::ui {

/// What the viewport shows, window pixels, y down.
struct CanvasTarget {
  glm::dvec2 min{0}, size{1, 1};
};

/// 32-bit words that shaders read by number (canvas.glsl): a texture, so that its length is not bounded by
/// what buffers of texels are guaranteed to hold.
class ColourTable {
 public:
  void upload(std::span<const std::uint32_t> words);
  void bind() const;  ///< to texture unit 0
  bool empty() const { return rows_ == 0; }
  std::uint64_t content() const { return content_; }

 private:
  GlName<GlKind::texture> texture_;
  int rows_ = 0;
  std::uint64_t content_ = 0;
};

/// Adds what tells one view of a canvas from another.
void addView(ContentHash& hash, const CanvasView& view);

/// Calls `draw` for each tile that is on the screen, with the program's uniforms set for it. The program is
/// in use.
void forVisibleTiles(const GlProgram& program, const CanvasView& view, const CanvasTarget& target,
                     const CanvasTiles& tiles, double marginPixels,
                     const std::function<void(std::size_t tile)>& draw);

struct CanvasRender {
  std::function<void(const CanvasTarget& target)> render;
  std::uint64_t content = 0;  ///< of all that it draws (content_hash.h): the same pixels from the same number
};
/// Has `render` called when ImGui comes to this place of the list, clipped as the list is now; then restores
/// ImGui's own state. `*render` must live until the frame is shown.
void addRender(ImDrawList& list, CanvasRender* render);
/// Of a callback of addRender.
std::uint64_t contentOf(const ImDrawCmd& command);

/// Replaces what a buffer holds.
void uploadTo(GlName<GlKind::buffer>& buffer, unsigned target, const void* data, std::size_t bytes);

}  // namespace acentric::ui
