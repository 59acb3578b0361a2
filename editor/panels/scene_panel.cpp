#include "editor/panels/scene_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/actions/plan_intents.h"
#include "editor/overlays/pick_table.h"
#include "editor/panels/plan_toolbar.h"
#include "editor/panels/toolbar_flow.h"
#include "editor/session/scene_view.h"
#include "editor/tools/scene_hits.h"
#include "ui/canvas_draw.h"
#include "ui/keys.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr double kDollyStep = 0.84;  ///< of the distance, per notch of the wheel

}  // namespace

bool ScenePanel::Area::holds(const glm::dvec2& at) const {
  return at.x >= min.x && at.y >= min.y && at.x < min.x + size.x && at.y < min.y + size.y;
}

ScenePanel::ScenePanel(int threads, std::function<void()> wake)
    : wake_([this, wake = std::move(wake)] {
        news_ = true;
        if (wake) wake();
      }),
      stream_(threads, wake_),
      look_(threads, wake_) {}

void ScenePanel::drawToolbar(PanelContext& context) const {
  using enum ButtonLook;
  static constexpr ToolbarEntry kFirst[] = {
      {"scene3d.select", trLater("Select"), ui::Icon::pointer, 0, tool},
      {"scene3d.place", trLater("Place cells"), ui::Icon::grid, kNear, tool}};
  static constexpr ToolbarEntry kShown[] = {
      {"scene3d.pick", trLater("Pick"), ui::Icon::crosshairs, kApart, ButtonLook::tool},
      {"scene3d.lookThrough", trLater("Look through"), ui::Icon::binoculars, kNear, ButtonLook::tool},
      {"scene3d.cut", trLater("Cut ceiling"), ui::Icon::scissors, kApart},
      {"view.cameras", trLater("Cameras"), ui::Icon::videoCamera, kNear},
      {"scene3d.frusta", trLater("All sectors"), ui::Icon::sector, kNear},
      {"view.fit", trLater("Frame"), ui::Icon::expand, kApart, ButtonLook::plain}};
  toolbar(context, kFirst);
  drawPlanTools(context);
  toolbar(context, kShown);
  drawDensityRow(context);
}

void ScenePanel::followProject(PanelContext& context) {
  Session& session = context.session();
  Scene3dState& state = context.state().scene3d;
  const OpenProject& open = *session.built();
  const bool fresh = generation_ != session.generation();
  if (fresh) {
    generation_ = session.generation();
    openedAt_ = context.now;
    stream_.clear();
    texture_.clear();
    layers_.clearDistances();
    look_.close();
    editing_ = {};
    state = {};
    asked_.reset();
  }
  if (std::exchange(storey_, session.project().storey) != session.project().storey) state.corner.reset();
  if (!tracer_ || tracer_->rays().sharedScene() != open.scene || &tracer_->rays() != open.rays.get())
    tracer_ = std::make_shared<const PreviewTracer>(open.rays);
  if (asked_ != open.layout) {
    asked_ = open.layout;
    state.ceiling = underCeiling(*open.rays, *open.layout);
    if (state.lookThrough && !cameraAtPlace(*open.layout, *state.lookThrough)) state.lookThrough.reset();
  }
  if (std::exchange(state.frame, false)) {
    const OrbitCamera before = camera_;
    const auto frame = [&](const std::set<CellId>& cells) {
      const SceneBox box = boxToFrame(open.scene->bounds, *open.layout, cells);
      camera_.frame(box.low, box.high, fresh);
    };
    frame(context.state().selection);
    if (camera_ == before) frame({});  // asked again: all of it
  }
}

double ScenePanel::cutHeight(const PanelContext& context) const {
  const OpenProject& open = *context.actions.session.built();
  const Scene3dState& state = context.actions.state.scene3d;
  const bool cut = state.cutCeiling.value_or(state.ceiling);
  return cut ? ceilingCut(*open.layout, open.project.bake.eyeRange) : kNoCut;
}

PreviewSeen ScenePanel::seenAt(const PanelContext& context, const glm::dvec2& pixel) const {
  return tracer_->along({glm::vec3(camera_.eye()), glm::vec3(camera_.rayThrough(pixel))}, cutHeight(context));
}

glm::dvec3 ScenePanel::holdAt(const PanelContext& context, const glm::dvec2& pixel) const {
  const PreviewSeen seen = seenAt(context, pixel);
  return seen.found() ? camera_.eye() + double(seen.distance) * camera_.rayThrough(pixel)
                      : camera_.besideTarget(pixel);
}

bool ScenePanel::pointing(const PanelContext& context) const {
  return area_.holds(pointer_) && !context.inputBlocked && !tool_.capturing() &&
         !editing_.capturing(context.actions) &&
         std::ranges::none_of(panels_, [&](const Area& panel) { return panel.holds(pointer_); });
}

void ScenePanel::handleKey(PanelContext& context, int code) {
  EditorState& state = context.state();
  if (state.centreView != View::scene3d) return;
  if (state.planTool.mode() == PlanMode::outline && (code == ui::key::enter || code == ui::key::keypadEnter))
    takePlanIntent(context.actions, state.planTool.closeOutline());
  if (code != ui::key::escape || editing_.cancel(context.actions)) return;
  if (state.scene3d.lookThrough)
    state.scene3d.lookThrough.reset();
  else if (state.scene3d.picked)
    state.scene3d.picked.reset();
  else if (state.scene3d.picking)
    state.scene3d.picking = false;
  else if (state.planTool.mode() == PlanMode::measure)
    state.planTool.setMode(PlanMode::cells);
  else
    state.selection.clear(), state.scene3d.corner.reset(), state.walkSelection.pose.reset();
}

void ScenePanel::handleEvents(PanelContext& context) {
  using Kind = ui::InputEvent::Kind;
  for (const ui::InputEvent& event : context.events) {
    const bool inside =
        area_.holds(event.position) && !context.inputBlocked &&
        std::ranges::none_of(panels_, [&](const Area& panel) { return panel.holds(event.position); });
    const bool capturing = tool_.capturing() || editing_.capturing(context.actions);
    const glm::dvec2 pixel = event.position - area_.min;
    if (event.kind == Kind::scroll && inside)
      camera_.dolly(std::pow(kDollyStep, event.scroll.y), holdAt(context, pixel));
    if (event.kind == Kind::keyPress && !context.inputBlocked) handleKey(context, event.code);
    ScenePointer pointer{ScenePointer::Kind::move, event.code, event.modifiers, pixel, event.seconds};
    if (event.kind == Kind::buttonPress && inside)
      pointer.kind = ScenePointer::Kind::press;
    else if (event.kind == Kind::buttonRelease && capturing)
      pointer.kind = ScenePointer::Kind::release;
    else if (event.kind != Kind::move || !capturing)
      continue;
    const auto taken = tool_.capturing() ? std::nullopt : editing_.handle(context.actions, pointer, sight());
    act(context, taken ? *taken : tool_.handle(pointer, context.state().scene3d.picking));
  }
}

void ScenePanel::act(PanelContext& context, const SceneIntent& intent) {
  EditorState& state = context.state();
  const Layout& layout = *context.session().built()->layout;
  if (const auto* orbit = std::get_if<OrbitIntent>(&intent)) {
    camera_.orbit(orbit->pixels);
  } else if (const auto* hold = std::get_if<HoldIntent>(&intent)) {
    held_ = holdAt(context, hold->pixel);
  } else if (const auto* pan = std::get_if<PanViewIntent>(&intent)) {
    camera_.pan(pan->pixels, held_);
  } else if (const auto* select = std::get_if<SelectAtIntent>(&intent)) {
    editing_.select(context.actions, *select,
                    cellUnder(layout, camera_.eye(), camera_.rayThrough(select->pixel),
                              seenAt(context, select->pixel).distance),
                    sight());
  } else if (const auto* pick = std::get_if<PickAtIntent>(&intent)) {
    const PreviewSeen seen = seenAt(context, pick->pixel);
    state.scene3d.picked.reset();
    if (!seen.found() || seen.cap) return;
    state.scene3d.picked =
        SurfacePoint{camera_.eye() + double(seen.distance) * camera_.rayThrough(pick->pixel),
                     glm::dvec3(seen.normal), seen.mesh, seen.triangle};
  } else if (const auto* opened = std::get_if<OpenAtIntent>(&intent)) {
    open(context, opened->pixel);
  }
}

void ScenePanel::open(PanelContext& context, const glm::dvec2& pixel) {
  EditorState& state = context.state();
  const Layout& layout = *context.session().built()->layout;
  const PreviewSeen seen = seenAt(context, pixel);
  const auto camera =
      state.showCameras ? cameraUnder(layout, camera_.view(), pixel, seen.distance) : std::nullopt;
  if (camera) {
    const auto preferred = state.selection.empty() ? std::nullopt : std::optional(*state.selection.begin());
    state.scene3d.lookThrough = placeOf(layout, *camera, preferred);
  } else if (seen.found()) {
    camera_.centreOn(camera_.eye() + double(seen.distance) * camera_.rayThrough(pixel));
  }
}

void ScenePanel::draw(PanelContext& context) {
  ImGui::SetCursorPos(ui::scaled(ImVec2(8, 7)));
  ImGui::BeginGroup();
  drawToolbar(context);
  ImGui::EndGroup();
  ImGui::SetCursorPos({0, ImGui::GetItemRectSize().y + ui::scaled(14)});
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size = ImGui::GetContentRegionAvail();
  if (size.x < 40 || size.y < 40) return;
  area_ = {ui::fromIm(at), ui::fromIm(size)};
  camera_.setSize(glm::ivec2(area_.size));
  ImGui::InvisibleButton("##scene3d", size);
  ImGui::SetItemAllowOverlap();
  context.log.item("scene3d");
  pointer_ = context.window.input().pointer();

  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(at, {at.x + size.x, at.y + size.y}, true);
  list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, ui::palette::backdrop.packed());
  if (context.session().built()) {
    followProject(context);
    handleEvents(context);
    context.session().askForPick(context.state().scene3d.picked);
    drawPicture(context, list);
    drawLayers(context, list);
    drawTexts(context, list);
    logPlaces(context);
  }
  list.PopClipRect();
  if (context.session().built()) drawPanels(context);
}

}  // namespace acentric::editor
