#pragma once
/// Regions and cameras of a layout on the plan, resident on the graphics card: shapes are sent when the
/// layout changes, colours when what they show changes, and a frame costs no more than the view.

#include <imgui.h>

#include <memory>
#include <set>
#include <vector>

#include "editor/session/capture_status.h"
#include "editor/session/inspection.h"
#include "engine/layout/layout.h"
#include "ui/mark_mesh.h"
#include "ui/polygon_mesh.h"

namespace acentric::editor {

/// What the layers show. Compared by identity: what is pointed to never changes.
struct PlanContents {
  std::shared_ptr<const Layout> layout;
  std::shared_ptr<const CaptureStatus> captures;
  /// Colours regions by their triangles; null: by what is baked.
  std::shared_ptr<const Inspection> triangles;
  std::size_t budget = 0;  ///< triangles per region; 0: none
  bool faint = false;      ///< borders alone: something else is shown below
  bool operator==(const PlanContents&) const = default;
};

class PlanLayers {
 public:
  /// Sends what differs from the last call.
  void update(const PlanContents& contents);
  void drawRegions(ImDrawList& list, const ui::CanvasView& view);
  void drawSelection(ImDrawList& list, const ui::CanvasView& view, const std::set<CellId>& selection);
  /// Dots at the centres of projection; sectors too where there is room.
  void drawCameras(ImDrawList& list, const ui::CanvasView& view);
  /// Why nothing is drawn; empty if it is.
  const std::string& problem() const;

 private:
  void sendShapes();
  void sendRegionColours();
  void sendCameraColours();
  void sendSectors();
  double cellPixels(const ui::CanvasView& view) const;

  PlanContents shown_;
  ui::PolygonMesh regions_, selected_;
  ui::MarkMesh sectors_;  ///< of all cameras; sent when they are first shown
  bool sectorsSent_ = false;
  ui::MarkMesh dots_;                 ///< at their centres of projection, one for all that stand there
  std::vector<std::size_t> dotEnds_;  ///< the cameras of each dot end here
  std::set<CellId> selection_;        ///< that selected_ is of
  const Layout* selectedIn_ = nullptr;
};

/// 0 below `low`, 1 above `high`: what is smaller than a few pixels fades rather than fill the picture.
float fadeIn(double pixels, double low, double high);

/// Sends polygons to a mesh.
void setPolygons(ui::PolygonMesh& mesh, const std::vector<const ConvexPolygon*>& polygons);

}  // namespace acentric::editor
