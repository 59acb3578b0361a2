/// What the 3D view shows: the picture, the layout over it, and words.
#include <fmt/format.h>

#include "editor/overlays/pick_table.h"
#include "editor/panels/scene_panel.h"
#include "editor/session/engine_texts.h"
#include "editor/tools/scene_hits.h"
#include "engine/geometry/conventions.h"
#include "engine/measure/source_colours.h"
#include "ui/canvas_draw.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {

/// Once, in the frame after the one that showed it.
void ScenePanel::tellFirst(PanelContext& context) {
  if (openedAt_ < 0 || stream_.shown() == nullptr) return;
  const PreviewShown& shown = *stream_.shown();
  context.log.event(
      "scene3d", fmt::format("first {:.1f} ms {}x{} traced {:.1f} ms", 1e3 * (context.now - openedAt_),
                             shown.picture.colour.width, shown.picture.colour.height, 1e3 * shown.seconds));
  openedAt_ = -1;
}

void ScenePanel::takePicture(PanelContext& context) {
  if (!(stream_.shown() ? stream_.take() : stream_.takeWithin(PreviewStream::kFirstWait))) return;
  const PreviewShown& shown = *stream_.shown();
  const ColourImage& colour = shown.picture.colour;
  texture_.upload(colour.width, colour.height,
                  {&colour.pixels.front().x, colour.pixels.size() * sizeof(Rgba8)});
  layers_.setDistances(shown.picture.rayDistance);
  context.window.pacer().request(1);
  if (!context.log.on() || shown.scale < 1) return;
  const PerspectiveView view = camera_.view();
  context.log.event("scene3d", fmt::format("frame {}x{} {:.1f} ms eye {:.3f} {:.3f} {:.3f} yaw {:.4f}",
                                           colour.width, colour.height, 1e3 * shown.seconds, view.eye.x,
                                           view.eye.y, view.eye.z, view.yawRadians));
}

void ScenePanel::drawPicture(PanelContext& context, ImDrawList& list) {
  tellFirst(context);
  stream_.want({tracer_, camera_.view(), cutHeight(context)});
  takePicture(context);
  if (stream_.shown() == nullptr || texture_.empty()) return;
  list.AddImage(texture_.imguiId(), ui::imVec(area_.min), ui::imVec(area_.min + area_.size));
}

void ScenePanel::drawLayers(PanelContext& context, ImDrawList& list) {
  Session& session = context.session();
  const EditorState& state = context.state();
  const Layout& layout = *session.built()->layout;
  layers_.update(
      {session.built(), session.captures(), state.selection, state.showCameras, state.scene3d.allFrusta});
  ScenePassing passing;
  passing.walk = state.walker.pose();
  passing.walkFovRadians = radians(session.project().fovDegrees);
  passing.walkAspect = 9.0 / 16;
  const bool selects = state.planTool.mode() == PlanMode::cells && !state.scene3d.picking;
  if (pointing(context) && selects) {
    const glm::dvec2 pixel = pointer_ - area_.min;
    passing.hovered =
        cellUnder(layout, camera_.eye(), camera_.rayThrough(pixel), seenAt(context, pixel).distance);
  }
  passing.camera = LookThrough::cameraOf(context);
  passing.picked = state.scene3d.picked;
  passing.pick = session.scenePick();
  layers_.updatePassing(passing);
  // Over the picture as it was traced: nothing swims while the next one is on its way.
  const PerspectiveView view =
      stream_.shown() != nullptr ? std::get<PerspectiveView>(stream_.shown()->whole.camera) : camera_.view();
  layers_.draw(list, view, area_.min, area_.size);
  if (!session.shippedWalk()) drawEditing(context, list, view);
  if (!layers_.problem().empty() && !std::exchange(problemTold_, true))
    session.messages().add(MessageLevel::error,
                           trf("The layout cannot be drawn in 3D on this OpenGL. {}", layers_.problem()));
}

void ScenePanel::drawTexts(PanelContext& context, ImDrawList& list) const {
  const Session& session = context.session();
  ImFont* small = context.window.fonts().small;
  const ImVec2 low = ui::imVec(area_.min), high = ui::imVec(area_.min + area_.size);
  const float base = high.y - small->FontSize - 11;
  if (const PreviewShown* shown = stream_.shown())
    ui::drawLabel(
        list, small, {low.x + 12, base}, ui::palette::text,
        fmt::format("{}×{}   {:.0f} ms{}", shown->picture.colour.width, shown->picture.colour.height,
                    1e3 * shown->seconds, cutHeight(context) < kNoCut ? tr("   ceiling cut away") : "")
            .c_str());
  else
    ui::drawLabel(list, small, {low.x + 12, base}, ui::palette::muted, tr("Tracing the scene…"));
  if (!pointing(context)) return;
  const glm::dvec2 pixel = pointer_ - area_.min;
  const PreviewSeen seen = seenAt(context, pixel);
  const Layout& layout = *session.built()->layout;
  if (const auto camera = context.state().showCameras
                              ? cameraUnder(layout, camera_.view(), pixel, seen.distance)
                              : std::nullopt)
    ui::tooltip(
        trf("{}\nDouble click to look through it", engineText(sourceName(layout, sourceOfCamera(*camera)))));
  if (!seen.found()) return;
  const glm::dvec3 at = camera_.eye() + double(seen.distance) * camera_.rayThrough(pixel);
  const std::string text = fmt::format("x {:.2f} m   y {:.2f} m   z {:.2f} m", at.x, at.y, at.z);
  const float width = small->CalcTextSizeA(small->FontSize, 1e6F, 0, text.c_str()).x;
  ui::drawLabel(list, small, {high.x - width - 14, base}, ui::palette::text, text.c_str());
}

void ScenePanel::drawPanels(PanelContext& context) {
  const ImVec2 low = ui::imVec(area_.min), high = ui::imVec(area_.min + area_.size);
  panels_.clear();
  const auto keep = [this](const std::pair<ImVec2, ImVec2>& place) {
    panels_.push_back({ui::fromIm(place.first), ui::fromIm(place.second) - ui::fromIm(place.first)});
  };
  if (const auto camera = LookThrough::cameraOf(context))
    keep(look_.draw(context, tracer_, *camera, low, high));
  else
    look_.close();
  if (!context.state().scene3d.picked) return;
  const ScenePickPtr pick = context.session().scenePick();
  if (pick && pick != toldPick_) {
    const glm::dvec3& at = pick->point.position;
    context.log.event("scenepick", fmt::format("{:.3f} {:.3f} {:.3f} seen {} held {}", at.x, at.y, at.z,
                                               pick->sampling.coverage.seenFrom.size(), pick->held));
  }
  toldPick_ = pick;
  keep(drawPickTable(context, low, high, pick.get()));
}

void ScenePanel::logPlaces(PanelContext& context) const {
  if (!context.log.on()) return;
  const PerspectiveView view = camera_.view();
  const auto logPoint = [&](const glm::dvec3& place, const std::string& name) {
    const Projected seen = project(view, place);
    const glm::dvec2 at = area_.min + seen.pixel;
    if (seen.depth > 0 && area_.holds(at))
      context.log.rect(name, float(at.x), float(at.y), float(at.x), float(at.y));
  };
  constexpr std::size_t kMostLogged = 400;
  const Layout& layout = *context.session().built()->layout;
  if (layout.regions.size() > kMostLogged) return;
  for (const Region& region : layout.regions)
    logPoint({region.polygon.centroid(), latticeHeight(layout)},
             fmt::format("cell3d.{}.{}.{}", region.id.i, region.id.j, region.id.slot));
  for (std::size_t c = 0; c < std::min(kMostLogged, layout.cameras.size()); ++c)
    logPoint({layout.cameras[c].position, layout.eyeZ()}, fmt::format("camera3d.{}", c));
}

}  // namespace acentric::editor
