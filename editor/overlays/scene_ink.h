#pragma once
/// Draws lines, dots and polygons of the world over a picture of it, as wide on the window at any distance.
/// What lies behind the eye is cut off.

#include <imgui.h>

#include <optional>
#include <span>

#include "editor/tools/ray_math.h"
#include "ui/colour.h"

namespace acentric::editor {

class SceneInk {
 public:
  /// `areaMin`: where the picture's upper left corner is on the window.
  SceneInk(ImDrawList& list, const PerspectiveView& view, const glm::dvec2& areaMin)
      : list_(list), view_(view), areaMin_(areaMin) {}

  ImDrawList& list() const { return list_; }
  const PerspectiveView& view() const { return view_; }
  ImVec2 onWindow(const glm::dvec2& pixel) const;
  /// Of a place before the eye.
  std::optional<ImVec2> at(const glm::dvec3& place) const;

  void line(const glm::dvec3& from, const glm::dvec3& to, const ui::Colour& colour, float thickness) const;
  void dashed(const glm::dvec3& from, const glm::dvec3& to, const ui::Colour& colour, float thickness) const;
  /// Closed, on a level plane.
  void loop(std::span<const glm::dvec2> corners, double height, const ui::Colour& colour, float thickness,
            bool dashes = false) const;
  /// Convex.
  void fill(std::span<const glm::dvec2> corners, double height, const ui::Colour& colour) const;
  /// With a dark rim.
  void dot(const glm::dvec3& place, const ui::Colour& colour, float radius) const;
  void square(const glm::dvec3& place, const ui::Colour& colour, float half, bool filled) const;
  /// A ring with a plus in it: a press puts something there.
  void plus(const glm::dvec3& place, const ui::Colour& colour) const;

 private:
  ImDrawList& list_;
  PerspectiveView view_;
  glm::dvec2 areaMin_;
};

}  // namespace acentric::editor
