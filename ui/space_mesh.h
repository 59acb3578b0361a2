#pragma once
/// Lines, dots and faces in space over a picture of it, resident on the graphics card: all lines are one
/// instanced draw, all faces another, and a frame sends the view alone. What lies behind the surfaces of the
/// picture is faded, told by the distances that came with the picture. Needs the window's context; main
/// thread only.

#include <imgui.h>

#include <array>
#include <span>
#include <string>
#include <vector>

#include "ui/canvas_gl.h"

namespace acentric::ui {

/// From `from` to `to`, so many pixels wide; a dot of that diameter where both are the same.
struct SpaceLine {
  glm::dvec3 from{0}, to{0};  ///< world, metres
  ImU32 colour = 0;           ///< packed as ImGui does
  float pixels = 1;
};
struct SpaceFace {
  std::array<glm::dvec3, 3> corners;
  ImU32 colour = 0;
};
struct SpaceShapes {
  std::vector<SpaceLine> lines;  ///< later ones over earlier ones
  std::vector<SpaceFace> faces;  ///< below all lines
};

/// A pinhole view and where on the window it is shown.
struct SpaceView {
  glm::dvec3 eye{0};
  glm::dmat3 viewFromWorld{1};         ///< rows: right, down, forward
  glm::dvec2 tangents{1};              ///< of half the field of view, across and down
  glm::dvec2 areaMin{0}, areaSize{1};  ///< window pixels, y down
};

class SpaceMesh {
 public:
  /// What stays from frame to frame, near `origin` (world, metres).
  void setLasting(const SpaceShapes& shapes, const glm::dvec3& origin);
  /// What is drawn over it and changes more often; a few thousand at most, more are not
  /// drawn.
  void setPassing(const SpaceShapes& shapes);
  /// Metres from the eye to the surface in each pixel of the picture, row 0 on top; infinity = none.
  void setDistances(int width, int height, std::span<const float> metres);
  /// No surface hides anything, until distances are set again.
  void clearDistances() { measured_ = false, distanceContent_ = 0; }

  /// At this place of the list; once a frame. `hidden`: opacity of what lies behind surfaces.
  void draw(ImDrawList& list, const SpaceView& view, float hidden);
  /// The same at once, on the framebuffer that is bound, with blending as it is set.
  void render(const SpaceView& view, const CanvasTarget& target, float hidden);
  /// Why nothing is drawn, if this OpenGL cannot; else empty.
  const std::string& problem() const;

  std::size_t lineCount() const { return lines_.total(); }

 private:
  /// Instances of one kind: the lasting ones, then the passing ones, in one buffer.
  struct Instances {
    GlName<GlKind::vertexArray> array;
    GlName<GlKind::buffer> data;
    std::size_t lasting = 0, passing = 0, room = 0;  ///< in instances; room: that the buffer holds
    std::size_t total() const { return lasting + passing; }
  };
  template <class Instance>
  void sendLasting(Instances& to, const std::vector<Instance>& instances);
  template <class Instance>
  void sendPassing(Instances& to, const std::vector<Instance>& instances);
  void setUniforms(const GlProgram& program, const SpaceView& view, const CanvasTarget& target,
                   float hidden) const;

  GlProgram line_{"space_line.vert", "space_line.frag"};
  GlProgram face_{"space_face.vert", "space_face.frag"};
  Instances lines_, faces_;
  glm::dvec3 origin_{0};
  GlName<GlKind::texture> distances_;
  bool measured_ = false;
  std::uint64_t lasting_ = 0, passing_ = 0, distanceContent_ = 0;  ///< contents of what was set
  CanvasRender pending_;
};

}  // namespace acentric::ui
