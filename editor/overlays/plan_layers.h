#pragma once
/// Regions and cameras of a layout on the plan, resident on the graphics card: shapes are sent when the
/// layout changes, colours when what they show changes, and a frame costs no more than the view.

#include <imgui.h>

#include <memory>
#include <set>
#include <vector>

#include "editor/session/capture_status.h"
#include "editor/session/inspection.h"
#include "editor/tools/editor_state.h"
#include "engine/layout/layout.h"
#include "ui/colour.h"
#include "ui/mark_mesh.h"
#include "ui/polygon_mesh.h"

namespace acentric::editor {

/// What the layers show. Compared by identity: what is pointed to never changes.
struct PlanContents {
  std::shared_ptr<const Layout> layout;
  std::shared_ptr<const CaptureStatus> captures;
  std::shared_ptr<const BakeMarks> marks;  ///< of a bake that runs or ran; null: none
  PlanOverlay overlay = PlanOverlay::bake;
  std::shared_ptr<const Inspection> inspection;        ///< with the overlay of triangles; null: not there yet
  std::size_t budget = 0;                              ///< triangles per region; 0: none
  const ui::Palette* palette = &ui::currentPalette();  ///< its colours are those that were sent
  bool operator==(const PlanContents&) const = default;
};

class PlanLayers {
 public:
  /// Sends what differs from the last call.
  void update(const PlanContents& contents);
  void drawRegions(ImDrawList& list, const ui::CanvasView& view);
  /// A sign in each region for how far it is baked, where there is room.
  void drawSigns(ImDrawList& list, const ui::CanvasView& view) const;
  const std::vector<BakeState>& states() const { return states_; }
  /// Of the captures that each region shows; empty unless that is the overlay.
  const std::vector<std::uint64_t>& bytes() const { return bytes_; }
  /// Where a region's density is not 1, by how much, where there is room.
  void drawDensities(ImDrawList& list, const ui::CanvasView& view, ImFont* font) const;
  void drawSelection(ImDrawList& list, const ui::CanvasView& view, const std::set<CellId>& selection);
  /// Dots at the centres of projection; sectors too where there is room.
  void drawCameras(ImDrawList& list, const ui::CanvasView& view);
  /// Why nothing is drawn; empty if it is.
  const std::string& problem() const;

 private:
  void sendShapes();
  void sendRegionColours();
  ui::PolygonStyle styleOf(std::size_t region, double most) const;
  void sendCameraColours();
  void sendSectors();
  double cellPixels(const ui::CanvasView& view) const;

  PlanContents shown_;
  std::vector<glm::dvec2> middles_;  ///< of the regions
  std::vector<double> densities_;    ///< of the regions
  std::vector<BakeState> states_;
  std::vector<std::uint64_t> bytes_;
  ui::PolygonMesh regions_, selected_;
  ui::MarkMesh sectors_;  ///< of all cameras; sent when they are first shown
  bool sectorsSent_ = false;
  ui::MarkMesh dots_;                 ///< at their centres of projection, one for all that stand there
  std::vector<std::size_t> dotEnds_;  ///< the cameras of each dot end here
  std::set<CellId> selection_;        ///< that selected_ is of
  const Layout* selectedIn_ = nullptr;
  const ui::Palette* selectedWith_ = nullptr;
};

/// 0 below `low`, 1 above `high`: what is smaller than a few pixels fades rather than fill the picture.
float fadeIn(double pixels, double low, double high);

/// Sends polygons to a mesh.
void setPolygons(ui::PolygonMesh& mesh, const std::vector<const ConvexPolygon*>& polygons);

}  // namespace acentric::editor
