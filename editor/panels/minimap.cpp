#include "editor/panels/minimap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "editor/overlays/plan_layers.h"
#include "editor/overlays/plan_overlays.h"
#include "engine/geometry/conventions.h"
#include "ui/canvas_draw.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {
namespace palette = ui::palette;

/// A layout that is larger than so many cells is shown around the eye alone.
constexpr double kMostCells = 24;

ui::Colour colourOf(const Rgba8& colour) {
  return {float(colour.r) / 255, float(colour.g) / 255, float(colour.b) / 255, 1};
}

void drawCamera(ImDrawList& list, const ui::CanvasView& view, const LayoutCamera& camera,
                const UsedImage& image, const ui::Colour& colour, bool highlighted) {
  const float size = highlighted ? 30.0F : 13.0F;
  const ImVec2 at = ui::imVec(view.screenFromWorld(camera.position));
  const auto from = float(-(camera.lowAzimuth + camera.fovRadians)), to = float(-camera.lowAzimuth);
  list.PathLineTo(at);
  list.PathArcTo(at, size, from, to, 8);
  list.PathFillConvex(colour.withOpacity(highlighted ? 0.75F : 0.40F).packed());
  const float dot = highlighted ? 5.0F : 3.4F;
  const bool behind = image.role == SourceRole::otherHand;  // hollow
  list.AddCircleFilled(at, dot, (behind ? palette::backdrop : colour).packed());
  list.AddCircle(at, dot, (behind ? colour : palette::text).packed(), 0, 1.2F);
}

}  // namespace

void Minimap::send(const std::shared_ptr<const Layout>& layout) {
  if (layout == sent_) return;
  sent_ = layout;
  std::vector<const ConvexPolygon*> polygons;
  low_ = glm::dvec2(std::numeric_limits<double>::max()), high_ = -low_;
  for (const Region& region : layout->regions) {
    polygons.push_back(&region.polygon);
    for (const glm::dvec2& corner : region.polygon.corners)
      low_ = glm::min(low_, corner), high_ = glm::max(high_, corner);
  }
  setPolygons(regions_, polygons);
  regions_.setStyles(std::vector<ui::PolygonStyle>(
      polygons.size(),
      {palette::muted.withOpacity(0.16F).packed(), palette::muted.withOpacity(0.45F).packed(), 1}));
}

void Minimap::place(const Layout& layout, const glm::dvec2& eye, const ImVec2& low, const ImVec2& high) {
  view_.setArea(ui::fromIm(low), ui::fromIm(high) - ui::fromIm(low));
  const double reach = 0.5 * kMostCells * layout.spec.cellSize;
  const glm::dvec2 half = glm::min(0.5 * (high_ - low_), glm::dvec2(reach));
  const glm::dvec2 centre = glm::clamp(eye, low_ + half, high_ - half);
  view_.fit(centre - half, centre + half, 0.07);
}

void Minimap::draw(PanelContext& context, ImDrawList& list, const ImVec2& low, const ImVec2& high,
                   const std::shared_ptr<const Layout>& shown, const std::vector<UsedImage>& images,
                   const SourceColours& colours, std::optional<int> highlighted) {
  const Layout& layout = *shown;
  context.log.rect("walk.minimap", low.x, low.y, high.x, high.y);
  list.AddRectFilled(low, high, palette::backdrop.withOpacity(0.9F).packed(), 4);
  list.PushClipRect(low, high, true);
  if (layout.regions.empty()) {
    list.AddText({low.x + 10, low.y + 8}, palette::muted.packed(), tr("No cells."));
  } else {
    send(shown);
    const WalkPose& pose = context.state().walker.pose();
    place(layout, glm::dvec2(pose.eye), low, high);
    regions_.draw(list, view_, fadeIn(layout.spec.cellSize * view_.pixelsPerMetre(), 3, 8));
    if (const auto here = layout.regionAt(glm::dvec2(pose.eye)))
      ui::drawConvex(list, view_, layout.regions[std::size_t(*here)].polygon.corners,
                     palette::accent.withOpacity(0.25F), palette::accent, 1.5F);
    drawOutline(list, view_, layout.spec.outline);
    for (const bool standsOut : {false, true})  // what stands out lies on top
      for (const UsedImage& image : images)
        if ((image.camera == highlighted) == standsOut)
          drawCamera(list, view_, layout.cameras[std::size_t(image.camera)], image,
                     colourOf(colours.of(sourceOfCamera(image.camera))), standsOut);
    drawEye(list, view_, pose, radians(context.session().project().fovDegrees), nullptr, 0.6F);
  }
  list.PopClipRect();
  list.AddRect(low, high, palette::border.packed(), 4);
}

}  // namespace acentric::editor
