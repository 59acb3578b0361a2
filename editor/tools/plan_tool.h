#pragma once
/// What the pointer does in the plan, as a state machine: pointer events in, intentions out. It changes
/// nothing itself.
///   cells:   click a free place to add a cell, a placed one to select it (Shift: add to the selection, Ctrl:
///   remove it),
///            drag a placed one to move it; drag the eye to put it elsewhere
///   eye:     press to put the eye there, drag to turn it
///   outline: see outline_tool.h
///   panorama: see panorama_tool.h
/// In every mode the middle or right button pans.

#include <glm/glm.hpp>
#include <optional>
#include <set>
#include <variant>

#include "editor/tools/outline_tool.h"
#include "editor/tools/panorama_tool.h"
#include "editor/tools/pointer_event.h"
#include "engine/layout/layout.h"

namespace acentric::editor {

enum class PlanMode { cells, eye, outline, panorama };

/// What the tool needs to know at the moment of an event.
struct PlanSituation {
  const LayoutSpec* spec = nullptr;
  const std::set<CellId>* selection = nullptr;
  glm::dvec2 eye{0};
  double pixelsPerMetre = 1;
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
struct MoveCellIntent {
  CellId from, to;
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
using PlanIntent = std::variant<std::monostate, AddCellIntent, RemoveCellIntent, SelectIntent, MoveCellIntent,
                                PanIntent, PlaceEyeIntent, TurnEyeIntent, OutlineIntent, FreeApvIntent>;

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
    CellId from, to;
  };
  std::optional<CellDrag> cellDrag() const { return drag_; }
  const OutlineTool& outlineTool() const { return outline_; }
  const PanoramaTool& panoramaTool() const { return panorama_; }

 private:
  /// `tool`: the outline's or the panoramas' has the pointer.
  enum class State { rest, pan, pressedFree, pressedCell, dragCell, dragEye, turnEye, tool };
  PlanIntent press(const PointerEvent& event, const PlanSituation& situation);
  PlanIntent move(const PointerEvent& event, const PlanSituation& situation);
  PlanIntent release(const PointerEvent& event, const PlanSituation& situation);
  PlanIntent clickCell(const PointerEvent& event, const PlanSituation& situation) const;

  PlanMode mode_ = PlanMode::cells;
  State state_ = State::rest;
  int button_ = 0;
  glm::dvec2 pressScreen_{0}, pressWorld_{0}, lastScreen_{0};
  CellId pressed_;
  glm::dvec2 grabOffset_{0};  // from the pointer to the pressed cell's centre
  std::optional<CellDrag> drag_;
  OutlineTool outline_;
  PanoramaTool panorama_;
};

}  // namespace acentric::editor
