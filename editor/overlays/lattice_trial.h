#pragma once
/// Cells of a layout that is tried and not laid: those in view, sent when it or the view changes.

#include <imgui.h>

#include <optional>

#include "engine/layout/layout.h"
#include "ui/polygon_mesh.h"

namespace acentric::editor {

class LatticeTrial {
 public:
  void draw(ImDrawList& list, const ui::CanvasView& view, const LayoutSpec& spec);

 private:
  void send(const ui::CanvasBox& visible);
  std::optional<LayoutSpec> shown_;
  ui::CanvasBox visible_;
  ui::PolygonMesh mesh_;
};

}  // namespace acentric::editor
