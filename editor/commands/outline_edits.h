#pragma once
/// Edits of the walkable outline, and what is wrong with one. Pure.

#include <string>
#include <vector>

#include "editor/commands/edit.h"
#include "engine/geometry/outline.h"

namespace acentric::editor {

/// Corners within `metres` of the result (Douglas-Peucker).
Edit simplifyOutline(const Project& project, double metres);
std::size_t cornersOf(const Outline& outline);

struct OutlineFault {
  glm::dvec2 place{0};  ///< plan, metres
  std::string text;     ///< what is wrong there, for a person
};
/// Sides that cross or touch others, corners that lie on one another, loops without area. At most `most`.
std::vector<OutlineFault> outlineFaults(const Outline& outline, std::size_t most = 50);

/// Of a loop: its own area, square metres, and whether it is taken off (a hole).
struct LoopArea {
  double squareMetres = 0;
  bool hole = false;
  glm::dvec2 place{0};  ///< of its lettering
};
std::vector<LoopArea> loopAreas(const Outline& outline);

}  // namespace acentric::editor
