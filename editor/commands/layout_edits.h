#pragma once
/// Edits of the layout. Pure: project in, edit out. A cell is placed if the outline places it or it was
/// added, unless it was removed; edits keep the added and removed sets free of what says nothing.

#include <set>

#include "editor/commands/edit.h"
#include "engine/layout/layout.h"

namespace acentric::editor {

/// Where a cell stands, in a spec: what other edits are made of.
void placeCell(LayoutSpec& spec, const CellId& cell);
/// A free APV too.
void takeCell(LayoutSpec& spec, const CellId& cell);

Edit addCell(const Project& project, const CellId& cell);
/// Free APVs among them too.
Edit removeCells(const Project& project, const std::set<CellId>& cells);
/// Into four of half the size each; those that cannot be split are left.
Edit splitCells(const Project& project, const std::set<CellId>& cells);
/// Undoes the splits that the cells came from, and all splits within.
Edit joinCells(const Project& project, const std::set<CellId>& cells);
bool canSplitCell(const LayoutSpec& spec, const CellId& cell);

/// Beside the lattice.
Edit addFreeApv(const Project& project, const Apv& apv);
Edit setFreeApv(const Project& project, int number, const Apv& apv);
int nextFreeNumber(const LayoutSpec& spec);

/// Cells are addressed within the old lattice, so added and removed ones are dropped.
Edit setConfiguration(const Project& project, Configuration configuration);
Edit setCellSize(const Project& project, double metres);
Edit setLatticeOrigin(const Project& project, const glm::dvec2& origin);
Edit setRotation(const Project& project, double radiansValue);
/// How the lattice lies in the plan.
struct LatticePlace {
  glm::dvec2 origin{0};  ///< metres
  double rotationRadians = 0;
  double cellSize = 1;  ///< metres
  bool operator==(const LatticePlace&) const = default;
};
LatticePlace latticePlaceOf(const LayoutSpec& spec);
void placeLattice(LayoutSpec& spec, const LatticePlace& place);
Edit setLattice(const Project& project, const LatticePlace& place, std::string label);
Edit setOutline(const Project& project, Outline outline);
Edit setEyeHeight(const Project& project, double metres);
Edit setFloorHeight(const Project& project, double metres);
Edit setNearBand(const Project& project, double metres);

/// The cell of the same kind (slot) and size nearest to `centre`.
CellId nearestSlot(const LayoutSpec& spec, const CellId& like, const glm::dvec2& centre);

}  // namespace acentric::editor
