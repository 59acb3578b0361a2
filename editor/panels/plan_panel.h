#pragma once
/// The plan: backdrop, lattice, cameras and eye, with the tools that edit them.

#include "editor/commands/outline_edits.h"
#include "editor/overlays/coverage_layer.h"
#include "editor/overlays/free_cells.h"
#include "editor/overlays/group_ghost.h"
#include "editor/overlays/lattice_trial.h"
#include "editor/overlays/plan_layers.h"
#include "editor/panels/panel_context.h"
#include "editor/panels/region_table_panel.h"
#include "ui/canvas_view.h"
#include "ui/texture.h"

namespace acentric::editor {

class PlanPanel {
 public:
  void draw(PanelContext& context);

 private:
  void handleEvents(PanelContext& context);
  void act(PanelContext& context, const PlanIntent& intent);
  void handleKey(PanelContext& context, const ui::InputEvent& event);
  PlanSituation situation(PanelContext& context) const;
  bool contains(const glm::dvec2& screen) const;
  void askForFigures(PanelContext& context, const std::optional<CellId>& hovered);
  void fulfilWish(PanelContext& context);
  void frame(PanelContext& context);
  void drawCanvas(PanelContext& context, const ImVec2& at, const ImVec2& size);
  void drawContents(PanelContext& context, ImDrawList& list);
  void drawWalks(PanelContext& context, ImDrawList& list) const;
  void drawTools(PanelContext& context, ImDrawList& list);
  void drawOutlineTools(PanelContext& context, ImDrawList& list);
  void drawBackdrop(PanelContext& context, ImDrawList& list);
  void drawLegend(PanelContext& context, ImDrawList& list);
  void log(PanelContext& context);
  void logCells(PanelContext& context) const;
  void fit(const Session& session);
  /// An eye that walks out of the plan's view takes it along.
  void followEye(const EditorState& state);
  void drawLayout(PanelContext& context, ImDrawList& list, const std::optional<CellId>& hovered);
  void drawCounts(ImDrawList& list, const Layout& layout, ImFont* font) const;
  std::optional<CellId> hoveredCell(const PanelContext& context) const;
  /// What lies under the pointer, in words.
  void tellHovered(PanelContext& context, ImDrawList& list, const std::optional<CellId>& hovered) const;

  ui::CanvasView view_;
  glm::dvec2 eye_{0};  ///< of the last frame
  ui::Texture backdropTexture_;
  std::shared_ptr<const Backdrop> shownBackdrop_;
  PlanLayers layers_;
  FreeCells freeCells_;
  CoverageLayer coverage_;
  GroupGhost ghost_;
  ArrayGhost array_;
  LatticeTrial trial_;
  RegionTablePanel table_;
  Outline checkedOutline_;
  std::vector<OutlineFault> faults_;  ///< of it
  std::vector<LoopArea> areas_;
  std::shared_ptr<const BakeMarks> marks_ = std::make_shared<const BakeMarks>();
  std::vector<glm::dvec2> snapCorners_;    ///< of walls and outline
  glm::dvec2 arrayLow_{0}, arrayHigh_{0};  ///< of the panel over the plan, pixels
  bool problemTold_ = false;
  std::size_t loggedSelection_ = 0;
  glm::dvec2 pointer_{0};
};

}  // namespace acentric::editor
