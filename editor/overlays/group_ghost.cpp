#include "editor/overlays/group_ghost.h"

#include "editor/overlays/plan_layers.h"
#include "engine/base/contract.h"
#include "ui/canvas_draw.h"

namespace acentric::editor {
namespace {
namespace palette = ui::palette;
}

void GroupGhost::show(const LayoutSpec& spec, const CellGroup& group, const std::vector<LatticeStep>& steps,
                      bool leaving) {
  if (shown_ && steps == steps_) return;
  shown_ = true;
  steps_ = steps;
  blocked_ = places_ = 0;
  crosses_.clear();
  const auto lattice = Lattice::of(spec);
  require(lattice.has_value(), "a project's configuration has a lattice");
  std::vector<ConvexPolygon> polygons;
  std::vector<ui::PolygonStyle> styles;
  for (const LatticeStep& step : steps)
    for (const CellGroup::Landing& landing : group.landings(step, leaving)) {
      polygons.push_back(lattice->polygonOf(landing.to));
      const ui::Colour colour = landing.blocked ? palette::danger : palette::accent;
      styles.push_back({colour.withOpacity(0.28F).packed(), colour.packed(), 2});
      ++places_;
      if (!landing.blocked) continue;
      ++blocked_;
      crosses_.push_back(polygons.back().centroid());
    }
  std::vector<const ConvexPolygon*> shapes;
  shapes.reserve(polygons.size());
  for (const ConvexPolygon& polygon : polygons) shapes.push_back(&polygon);
  setPolygons(mesh_, shapes);
  mesh_.setStyles(styles);
}

void GroupGhost::clear() {
  shown_ = false;
  blocked_ = places_ = 0;
}

void GroupGhost::draw(ImDrawList& list, const ui::CanvasView& view) {
  if (!shown_) return;
  mesh_.draw(list, view, 1);
  constexpr float kArm = 6;
  for (const glm::dvec2& place : crosses_) {
    const glm::dvec2 screen = view.screenFromWorld(place);
    if (!view.contains(screen)) continue;
    const ImVec2 at = ui::imVec(screen);
    list.AddLine({at.x - kArm, at.y - kArm}, {at.x + kArm, at.y + kArm}, palette::danger.packed(), 2.4F);
    list.AddLine({at.x - kArm, at.y + kArm}, {at.x + kArm, at.y - kArm}, palette::danger.packed(), 2.4F);
  }
}

void ArrayGhost::draw(ImDrawList& list, const ui::CanvasView& view, const LayoutSpec& spec,
                      const std::set<CellId>& selection, const std::optional<CellArray>& array) {
  if (!array) {
    group_.reset();
    ghost_.clear();
    return;
  }
  if (!group_ || spec_ != spec || selection_ != selection) {
    group_.emplace(spec, selection);
    spec_ = spec;
    selection_ = selection;
    ghost_.clear();
  }
  ghost_.show(spec_, *group_, array->steps(), false);
  ghost_.draw(list, view);
}

}  // namespace acentric::editor
