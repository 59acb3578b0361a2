#pragma once
/// The plan: backdrop, lattice, cameras and eye, with the tools that edit them.

#include "editor/overlays/coverage_layer.h"
#include "editor/overlays/free_cells.h"
#include "editor/overlays/plan_layers.h"
#include "editor/panels/panel_context.h"
#include "ui/canvas_view.h"
#include "ui/texture.h"

namespace acentric::editor {

class PlanPanel {
 public:
  void draw(PanelContext& context);

 private:
  void drawToolbar(PanelContext& context);
  void handleEvents(PanelContext& context);
  void act(PanelContext& context, const PlanIntent& intent);
  void drawContents(PanelContext& context, ImDrawList& list);
  void logCells(PanelContext& context) const;
  void fit(const Session& session);
  void drawLayout(PanelContext& context, ImDrawList& list, const std::optional<CellId>& hovered);
  void drawCounts(ImDrawList& list, const Layout& layout, ImFont* font) const;
  std::optional<CellId> hoveredCell(const PanelContext& context) const;
  /// What lies under the pointer, in words.
  void tellInspection(PanelContext& context, ImDrawList& list, const Inspection& inspection,
                      const std::optional<CellId>& hovered) const;

  ui::CanvasView view_;
  ui::Texture backdropTexture_;
  std::shared_ptr<const Backdrop> shownBackdrop_;
  PlanLayers layers_;
  FreeCells freeCells_;
  CoverageLayer coverage_;
  bool problemTold_ = false;
  glm::dvec2 pointer_{0};
};

}  // namespace acentric::editor
