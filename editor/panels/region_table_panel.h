#pragma once
/// The regions' figures against the budget, below the plan: sorted by a click on a column, shown in the plan
/// by a click on a row.

#include <memory>
#include <vector>

#include "editor/panels/panel_context.h"
#include "editor/session/region_table.h"

namespace acentric::editor {

class RegionTablePanel {
 public:
  /// At a place of the pane, pixels.
  void draw(PanelContext& context, const ImVec2& at, const ImVec2& size);

 private:
  void update(PanelContext& context);
  void drawHead(PanelContext& context);
  void drawRows(PanelContext& context, float height);
  void drawRow(PanelContext& context, const RegionRow& row, std::size_t budget);

  std::vector<RegionRow> rows_;
  RegionColumn column_ = RegionColumn::triangles;
  bool descending_ = true;
  bool sorted_ = false;
  // What the rows are of.
  std::shared_ptr<const Layout> layout_;
  std::shared_ptr<const CaptureStatus> captures_;
  std::shared_ptr<const Inspection> inspection_;
  CoveragePicturePtr coverage_;
};

}  // namespace acentric::editor
