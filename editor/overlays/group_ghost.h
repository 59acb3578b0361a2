#pragma once
/// Where cells on their way would land: free places in the accent colour, taken ones in red with a cross.
/// Sent when the steps change, not in every frame.

#include <imgui.h>

#include <optional>
#include <vector>

#include "editor/commands/group_edits.h"
#include "ui/polygon_mesh.h"

namespace acentric::editor {

class GroupGhost {
 public:
  /// `group` stays as it is until clear(). `leaving`: see CellGroup::landings.
  void show(const LayoutSpec& spec, const CellGroup& group, const std::vector<LatticeStep>& steps,
            bool leaving);
  void clear();
  void draw(ImDrawList& list, const ui::CanvasView& view);
  int blocked() const { return blocked_; }
  int places() const { return places_; }

 private:
  bool shown_ = false;
  std::vector<LatticeStep> steps_;
  std::vector<glm::dvec2> crosses_;  ///< middles of taken places
  int blocked_ = 0, places_ = 0;
  ui::PolygonMesh mesh_;
};

/// The same for an array of the selection, laid out anew when one of these changes.
class ArrayGhost {
 public:
  void draw(ImDrawList& list, const ui::CanvasView& view, const LayoutSpec& spec,
            const std::set<CellId>& selection, const std::optional<CellArray>& array);
  const GroupGhost& ghost() const { return ghost_; }

 private:
  std::optional<CellGroup> group_;
  std::optional<CellArray> array_;
  LayoutSpec spec_;
  std::set<CellId> selection_;
  GroupGhost ghost_;
};

}  // namespace acentric::editor
