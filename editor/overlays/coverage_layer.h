#pragma once
/// Sampling coverage on the plan: a raster of counts, or the surfaces' points seen from above, each by its
/// rate; with what the colours mean and what lies under the pointer, in words.

#include <imgui.h>

#include <string>
#include <vector>

#include "editor/session/coverage.h"
#include "editor/tools/editor_state.h"
#include "ui/canvas_view.h"
#include "ui/colour.h"
#include "ui/mark_mesh.h"
#include "ui/texture.h"

namespace acentric::editor {

/// What the state asks for: of the selected cell if there is just one, else of the hovered one.
std::optional<CoverageRequest> wantedCoverage(const EditorState& state, const std::optional<CellId>& hovered);

class CoverageLayer {
 public:
  /// The raster, below the regions' borders. Takes the picture over; null: nothing is shown.
  void drawBelow(ImDrawList& list, const ui::CanvasView& view, const CoveragePicturePtr& picture);
  /// The points, above them.
  void drawAbove(ImDrawList& list, const ui::CanvasView& view);
  /// `picture` null: it is being measured, or there is nothing to measure.
  void drawLegend(ImDrawList& list, const ui::CanvasView& view, const CoveragePicture* picture,
                  CoverageKind kind, ImFont* font) const;
  /// The number under the pointer; empty where there is none.
  std::string textAt(const ui::CanvasView& view, const CoveragePicture* picture,
                     const glm::dvec2& pointer) const;

 private:
  void sendRaster();
  void sendPoints();
  float pointPixels(const ui::CanvasView& view) const;

  CoveragePicturePtr shown_;
  const ui::Palette* palette_ = nullptr;  ///< with whose colours it was sent
  ui::Texture raster_;
  ui::MarkMesh points_;
};

}  // namespace acentric::editor
