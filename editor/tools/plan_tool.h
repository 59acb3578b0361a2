#pragma once
/// What the pointer does in the plan, as a state machine: pointer events in, intentions out. It changes
/// nothing itself.
///   cells:   click a free place to add a cell, a placed one to select it (Shift: add to the selection, Ctrl:
///            add or take off), drag a placed one to move it, with all others where it is selected; drag with
///            Shift or Ctrl to do the same to all cells that a box touches; drag the eye to put it elsewhere
///   eye:     press to put the eye there, drag to turn it
///   outline: see outline_tool.h
///   panorama: see panorama_tool.h
///   lattice:  see lattice_tool.h
///   measure:  see measure_tool.h
///   density:  see density_tool.h
///   path:     see path_tool.h; free ground pans, and selects no key pose
/// In every mode the middle or right button pans.

#include <glm/glm.hpp>
#include <optional>
#include <set>
#include <variant>

#include "editor/commands/group_edits.h"
#include "editor/commands/selection.h"
#include "editor/tools/density_tool.h"
#include "editor/tools/lattice_tool.h"
#include "editor/tools/measure_tool.h"
#include "editor/tools/outline_tool.h"
#include "editor/tools/panorama_tool.h"
#include "editor/tools/path_tool.h"
#include "editor/tools/pointer_event.h"
#include "engine/layout/layout.h"

namespace acentric::editor {

enum class PlanMode { cells, eye, outline, panorama, lattice, measure, path, density };

/// What the tool needs to know at the moment of an event.
struct PlanSituation {
  const LayoutSpec* spec = nullptr;
  const std::set<CellId>* selection = nullptr;
  glm::dvec2 eye{0};
  double pixelsPerMetre = 1;
  glm::dvec2 viewLow{-1e3}, viewHigh{1e3};  ///< what the plan shows, metres
  SnapTargets targets = {};
  PathSituation paths = {};
};

struct AddCellIntent {
  CellId cell;
};
struct RemoveCellIntent {
  CellId cell;
};
struct SelectIntent {
  std::set<CellId> cells;
};
/// Of all cells that a box touches.
struct MarqueeIntent {
  glm::dvec2 low{0}, high{0};  ///< plan, metres
  Combine how = Combine::add;
};
struct MoveCellsIntent {
  std::set<CellId> cells;
  LatticeStep step;
};
struct PanIntent {
  glm::dvec2 pixels;
};
struct PlaceEyeIntent {
  glm::dvec2 position;
};
struct TurnEyeIntent {
  double yawRadians;
};
using PlanIntent = std::variant<std::monostate, AddCellIntent, RemoveCellIntent, SelectIntent, MarqueeIntent,
                                MoveCellsIntent, PanIntent, PlaceEyeIntent, TurnEyeIntent, OutlineIntent,
                                FreeApvIntent, LatticeIntent, PathIntent, PaintDensityIntent>;

class PlanTool {
 public:
  PlanMode mode() const { return mode_; }
  void setMode(PlanMode mode);

  PlanIntent handle(const PointerEvent& event, const PlanSituation& situation);
  /// The pointer left, or the window lost the focus, or Escape: back to rest, nothing done. True if something
  /// was afoot.
  bool cancel();
  /// Enter in outline mode.
  PlanIntent closeOutline();

  /// A button is down: events belong to the plan wherever the pointer is.
  bool capturing() const { return state_ != State::rest; }
  struct CellDrag {
    std::set<CellId> cells;
    CellGroup group;
    LatticeStep step;
  };
  /// Null unless cells are on their way.
  const CellDrag* cellDrag() const { return drag_ ? &*drag_ : nullptr; }
  /// The box that is being drawn.
  std::optional<MarqueeIntent> marquee() const;
  const OutlineTool& outlineTool() const { return outline_; }
  const PanoramaTool& panoramaTool() const { return panorama_; }
  const LatticeTool& latticeTool() const { return lattice_; }
  const MeasureTool& measureTool() const { return measure_; }
  const DensityTool& densityTool() const { return density_; }

 private:
  /// `tool`: one of the other modes' tools has the pointer.
  enum class State { rest, pan, pressedFree, pressedCell, dragCell, marquee, dragEye, turnEye, tool };
  PlanIntent press(const PointerEvent& event, const PlanSituation& situation);
  PlanIntent move(const PointerEvent& event, const PlanSituation& situation);
  PlanIntent release(const PointerEvent& event, const PlanSituation& situation);
  PlanIntent beginDrag(const PointerEvent& event, const PlanSituation& situation);
  std::optional<PlanIntent> pressTool(const PointerEvent& event, const PlanSituation& situation);
  PlanIntent moveTool(const PointerEvent& event, const PlanSituation& situation);
  PlanIntent releaseTool(const PointerEvent& event, const PlanSituation& situation);
  PlanIntent clickCell(const PointerEvent& event, const PlanSituation& situation) const;

  PlanMode mode_ = PlanMode::cells;
  State state_ = State::rest;
  int button_ = 0;
  int modifiers_ = 0;  // as the button went down
  glm::dvec2 pressScreen_{0}, pressWorld_{0}, lastScreen_{0}, lastWorld_{0};
  CellId pressed_;
  std::optional<CellDrag> drag_;
  OutlineTool outline_;
  PanoramaTool panorama_;
  LatticeTool lattice_;
  MeasureTool measure_;
  PathTool path_;
  DensityTool density_;
};

}  // namespace acentric::editor
