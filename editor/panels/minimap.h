#pragma once
/// The plan in a corner of the walk: regions, outline, the eye with what it sees and the region where it is,
/// and the cameras that the picture is painted from. Regions are sent to the graphics card when the layout
/// changes; a frame sends the view alone.

#include <optional>
#include <vector>

#include "editor/panels/panel_context.h"
#include "editor/session/used_images.h"
#include "ui/canvas_view.h"
#include "ui/polygon_mesh.h"

namespace acentric::editor {

class Minimap {
 public:
  /// Between two corners on the window. `images` are of the layout that is shown; `highlighted`: a camera
  /// that stands out.
  void draw(PanelContext& context, ImDrawList& list, const ImVec2& low, const ImVec2& high,
            const std::shared_ptr<const Layout>& shown, const std::vector<UsedImage>& images,
            const SourceColours& colours, std::optional<int> highlighted);

 private:
  void send(const std::shared_ptr<const Layout>& layout);
  void place(const Layout& layout, const glm::dvec2& eye, const ImVec2& low, const ImVec2& high);

  std::shared_ptr<const Layout> sent_;
  glm::dvec2 low_{0}, high_{0};  ///< of all regions of sent_
  ui::PolygonMesh regions_;
  ui::CanvasView view_;
};

}  // namespace acentric::editor
