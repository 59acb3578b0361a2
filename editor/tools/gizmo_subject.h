#pragma once
/// What the 3D view's gizmo is at: selected cells, a single APV beside the lattice, a corner of the outline,
/// or a key pose of a path; and what its moves make of the project. Pure.

#include <optional>
#include <set>
#include <variant>

#include "editor/commands/edit.h"
#include "editor/commands/group_edits.h"
#include "editor/tools/gizmo.h"
#include "editor/tools/walk_selection.h"

namespace acentric::editor {

struct OutlineCorner {
  std::size_t loop = 0, corner = 0;
  bool operator==(const OutlineCorner&) const = default;
};
/// Where it is; nothing where the outline has no such corner.
std::optional<glm::dvec2> placeOf(const Outline& outline, const std::optional<OutlineCorner>& corner);

struct CellsSubject {
  std::set<CellId> cells;
  glm::dvec2 middle{0};  ///< plan, metres
};
struct ApvSubject {
  int number = 0;
  Apv apv;
};
struct CornerSubject {
  OutlineCorner corner;
  glm::dvec2 place{0};
};
struct PoseSubject {
  std::size_t path = 0, pose = 0;
  PathPose was;
};
using GizmoSubject = std::variant<CellsSubject, ApvSubject, CornerSubject, PoseSubject>;

/// What is selected, as the project has it now.
std::optional<GizmoSubject> cellsSubject(const LayoutSpec& spec, const std::set<CellId>& cells);
std::optional<GizmoSubject> cornerSubject(const LayoutSpec& spec, const std::optional<OutlineCorner>& corner);
std::optional<GizmoSubject> poseSubject(const Project& project, const WalkSelection& selection);

/// At what height flat things are drawn: `floor`. Cells' arrows lie along the lattice.
Gizmo gizmoOf(const GizmoSubject& subject, const LayoutSpec& spec, double floor);
/// The subject after a move, as an edit of a project that still has it; of cells nothing, which go by steps
/// of the lattice.
std::optional<Edit> edited(const GizmoSubject& subject, const Project& project, const GizmoMove& move);

}  // namespace acentric::editor
