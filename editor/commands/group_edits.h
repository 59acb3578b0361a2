#pragma once
/// Several cells at once: shifted by whole steps of the lattice, so that each lands on a place of its own
/// kind. Pure: project in, edit out.

#include <optional>
#include <set>
#include <vector>

#include "editor/commands/edit.h"
#include "engine/layout/lattice.h"

namespace acentric::editor {

/// From a cell (i, j) to the cell (i + this i, j + this j), of the largest cells in a group.
struct LatticeStep {
  int i = 0, j = 0;
  auto operator<=>(const LatticeStep&) const = default;
};

/// Cells that keep their places relative to one another; single APVs beside the lattice go along.
class CellGroup {
 public:
  /// Cells of the spec; those that it does not place are left out.
  CellGroup(const LayoutSpec& spec, const std::set<CellId>& cells);

  bool empty() const { return cells_.empty() && apvs_.empty(); }
  glm::dvec2 metresOf(const LatticeStep& step) const;
  /// The step that comes nearest to a way on the plan.
  LatticeStep nearestStep(const glm::dvec2& metres) const;
  /// To the next cell in about a direction; of two that are as near to it the one to its right.
  LatticeStep stepTowards(const glm::dvec2& direction) const;

  struct Landing {
    CellId from, to;
    bool blocked = false;  ///< another cell is there, or no place of this size
  };
  /// `leaving`: the group's own places count as free.
  std::vector<Landing> landings(const LatticeStep& step, bool leaving) const;
  bool fits(const LatticeStep& step, bool leaving) const;
  /// The shortest step by which the whole group finds free places beside itself; nothing within reach.
  std::optional<LatticeStep> nearestFreeStep() const;

 private:
  friend struct GroupEditing;
  CellId shifted(const CellId& cell, const LatticeStep& step) const;
  bool blocked(const CellId& to, bool leaving) const;

  LayoutSpec spec_;
  Lattice lattice_;
  std::set<CellId> cells_;
  std::vector<int> apvs_;
  int level_ = 0;  ///< of the largest cells
  glm::dvec2 stepI_{0}, stepJ_{0};
};

/// An edit, the cells that it leaves in hand, and how many places were taken and left as they are.
struct GroupEdit {
  Edit edit;
  std::set<CellId> cells;
  int skipped = 0;
};

/// Changes nothing where a place is taken.
GroupEdit moveCells(const Project& project, const std::set<CellId>& cells, const LatticeStep& step);
/// A copy for each step; places that are taken are left as they are.
GroupEdit copyCells(const Project& project, const std::set<CellId>& cells,
                    const std::vector<LatticeStep>& steps);

/// n x m copies, the first of which is the group itself.
struct CellArray {
  int countI = 2, countJ = 1;              ///< along the lattice's two directions, at least 1
  int everyI = 1, everyJ = 1;              ///< steps between copies; may be negative
  std::vector<LatticeStep> steps() const;  ///< without the group itself
  bool operator==(const CellArray&) const = default;
};
/// The least spacing at which copies of the group lie beside one another.
CellArray roomyArray(const LayoutSpec& spec, const std::set<CellId>& cells);

}  // namespace acentric::editor
