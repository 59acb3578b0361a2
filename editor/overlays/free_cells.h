#pragma once
/// The places of the lattice where no cell is placed, around what the plan shows. They are sought again when
/// the layout changed or the view left what was sought, not in every frame.

#include <imgui.h>

#include <memory>
#include <vector>

#include "engine/layout/layout.h"
#include "ui/colour.h"
#include "ui/polygon_mesh.h"

namespace acentric::editor {

class FreeCells {
 public:
  void update(const std::shared_ptr<const Layout>& layout, const ui::CanvasView& view);
  void draw(ImDrawList& list, const ui::CanvasView& view);
  const std::vector<LatticeCell>& cells() const { return cells_; }

 private:
  std::shared_ptr<const Layout> layout_;
  const ui::Palette* palette_ = nullptr;
  ui::CanvasBox sought_;
  std::vector<LatticeCell> cells_;
  ui::PolygonMesh mesh_;
};

inline constexpr double kLeastCellPixels = 9;  ///< smaller cells are not worth drawing, and cannot be hit

}  // namespace acentric::editor
