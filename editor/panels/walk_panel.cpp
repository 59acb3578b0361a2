#include "editor/panels/walk_panel.h"

#include <fmt/format.h>

#include <algorithm>

#include "editor/commands/setting_edits.h"
#include "engine/pipeline/walk_ground.h"
#include "ui/canvas_draw.h"
#include "ui/keys.h"

namespace acentric::editor {
namespace {

constexpr double kRadiansPerPixel = 0.0035;

const char* labelOf(Renderer renderer) {
  switch (renderer) {
    case Renderer::list:
      return "List priority";
    case Renderer::scalar:
      return "Scalar reference";
    case Renderer::zbuffer:
      return "Depth buffer";
    case Renderer::gl:
      return "OpenGL";
    case Renderer::glZbuffer:
      return "OpenGL, depth test";
    case Renderer::glMesh:
      return "OpenGL, meshes";
  }
  return "";
}

const char* helpFor(Renderer renderer) {
  switch (renderer) {
    case Renderer::list:
      return "List priority without a depth buffer: the fast one on the processor.";
    case Renderer::scalar:
      return "List priority, one sample at a time: the reference.";
    case Renderer::zbuffer:
      return "The same splats with a depth buffer, for comparison.";
    case Renderer::gl:
      return "List priority on the graphics card.";
    case Renderer::glZbuffer:
      return "The same splats on the graphics card with a depth test, for comparison.";
    case Renderer::glMesh:
      return "Captures as triangles, within the mesh error: no cracks near walls; points until they are "
             "built.";
  }
  return "";
}

WalkKeys keysHeld(const PanelContext& context) {
  namespace key = ui::key;
  // A tap shorter than a frame still counts for that frame.
  const auto held = [&](int code) {
    if (context.window.input().keyHeld(code)) return true;
    return std::any_of(context.events.begin(), context.events.end(), [code](const ui::InputEvent& event) {
      return event.kind == ui::InputEvent::Kind::keyPress && event.code == code &&
             (event.modifiers & ui::modifier::control) == 0;
    });
  };
  WalkKeys keys;
  keys.forward = held(key::w) || held(key::up);
  keys.back = held(key::s) || held(key::down);
  keys.left = held(key::a) || held(key::left);
  keys.right = held(key::d) || held(key::right);
  keys.turnLeft = held(key::q);
  keys.turnRight = held(key::e);
  keys.up = held(key::pageUp);
  keys.down = held(key::pageDown);
  keys.fast = held(key::leftShift) || held(key::rightShift);
  return keys;
}

/// Those that captures are baked for.
EyeHeights eyeHeights(const OpenProject& open) {
  const double z = open.layout->eyeZ(), range = open.project.bake.eyeRange;
  return {z - range, z + range};
}

}  // namespace

WalkPanel::WalkPanel(int threads, std::function<void()> wake)
    : threads_(threads),
      wake_([this, wake = std::move(wake)] {
        news_ = true;
        if (wake) wake();
      }),
      renderer_(threads, wake_) {}

void WalkPanel::followProject(PanelContext& context) {
  Session& session = context.session();
  EditorState& state = context.state();
  const Layout& layout = *session.built()->layout;
  const bool fresh = generation_ != session.generation();
  if (fresh || state.restart) {
    const Spawn& spawn = session.project().spawn();
    state.walker.setPose(
        {glm::dvec3(nearestStanding(layout, spawn.position), layout.eyeZ()), spawn.yawRadians, 0});
    state.restart = false;
  }
  if (fresh) {
    generation_ = session.generation();
    shown_ = {};
    problem_.clear();
    state.fitPlan = true;
    state.selection.clear();
  }
  // Cells may have gone from under the eye, or the eye height changed.
  WalkPose pose = state.walker.pose();
  const EyeHeights heights = eyeHeights(*session.built());
  pose.eye = glm::dvec3(nearestStanding(layout, glm::dvec2(pose.eye)),
                        std::clamp(pose.eye.z, heights.low, heights.high));
  if (pose != state.walker.pose()) state.walker.setPose(pose);
}

void WalkPanel::walk(PanelContext& context) {
  if (!context.session().built()) return;
  followProject(context);
  const bool typing = context.inputBlocked || ImGui::GetIO().WantTextInput ||
                      (context.window.input().modifiers() & ui::modifier::control) != 0;
  const WalkKeys keys = typing ? WalkKeys{} : keysHeld(context);
  Walker& walker = context.state().walker;
  const double seconds = lastStep_ < 0 ? 1.0 / 60 : context.now - lastStep_;
  lastStep_ = -1;
  if (keys.any() || walker.moving()) {
    const OpenProject& open = *context.session().built();
    walker.setSpeed(context.session().preferences().walkMetresPerSecond);
    walker.step(seconds, keys, eyeHeights(open),
                [&](const glm::dvec2& from, const glm::dvec2& to) { return walkTo(*open.layout, from, to); });
    lastStep_ = context.now;
    context.window.pacer().request(1);
  } else if (context.log.on() && walker.pose() != loggedPose_) {
    loggedPose_ = walker.pose();
    context.log.event("eye",
                      fmt::format("{:.3f} {:.3f} {:.3f} {:.4f} {:.4f}", loggedPose_.eye.x, loggedPose_.eye.y,
                                  loggedPose_.eye.z, loggedPose_.yawRadians, loggedPose_.pitchRadians));
  }
  context.session().walkAt({glm::dvec2(walker.pose().eye), walker.pose().yawRadians, walker.velocity()});
}

void WalkPanel::drawToolbar(PanelContext& context) {
  const Project& project = context.session().project();
  ImGui::SetNextItemWidth(150);
  const bool open = ImGui::BeginCombo("##renderer", labelOf(project.view.renderer));
  context.log.item("walk.renderer");
  if (open) {
    for (const Renderer renderer : kRenderers) {
      const bool broken = onOpenGl(renderer) && !glProblem_.empty();
      const auto flags = broken ? ImGuiSelectableFlags_Disabled : ImGuiSelectableFlags_None;
      if (ImGui::Selectable(labelOf(renderer), renderer == project.view.renderer, flags)) {
        ViewSettings view = project.view;
        view.renderer = renderer;
        context.session().apply(setViewSettings(project, view, "renderer"));
      }
      context.log.item(std::string("walk.renderer.") + nameOf(renderer));
      ui::tooltip(broken ? glProblem_ : helpFor(renderer));
    }
    ImGui::EndCombo();
  } else {
    ui::tooltip("Renderer of the walk");
  }
  ImGui::SameLine();
  actionButton(context, "view.holes", ButtonLook::toggle);
  ImGui::SameLine(0, 3);
  actionButton(context, "view.sources", ButtonLook::toggle);
  ImGui::SameLine(0, 16);
  actionButton(context, "walk.restart");
  ImGui::SameLine(0, 3);
  actionButton(context, "walk.setStart");
}

void WalkPanel::look(PanelContext& context, const ImVec2& low, const ImVec2& high) {
  using Kind = ui::InputEvent::Kind;
  for (const ui::InputEvent& event : context.events) {
    const bool inside = event.position.x >= double(low.x) && event.position.y >= double(low.y) &&
                        event.position.x < double(high.x) && event.position.y < double(high.y);
    if (event.kind == Kind::buttonPress && inside && !context.inputBlocked) {
      looking_ = true;
      lookFrom_ = event.position;
      context.window.capturePointer(true);
    } else if (event.kind == Kind::buttonRelease && looking_) {
      looking_ = false;
      context.window.capturePointer(false);
    } else if (event.kind == Kind::move && looking_) {
      // The mouse turns the head: to the right looks right.
      context.state().walker.look(event.position - lookFrom_, kRadiansPerPixel);
      lookFrom_ = event.position;
    }
  }
}

void WalkPanel::draw(PanelContext& context) {
  ImGui::SetCursorPos({8, 7});
  if (context.session().hasProject()) {
    ImGui::BeginGroup();
    drawToolbar(context);
    ImGui::EndGroup();
  }
  ImGui::SetCursorPos({0, ImGui::GetFrameHeight() + 14});
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 size = ImGui::GetContentRegionAvail();
  if (size.x < 40 || size.y < 40) return;
  area_ = {int(size.x), int(size.y)};
  ImGui::InvisibleButton("##walk", size);
  context.log.item("walk");
  if (!context.session().built()) {
    ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + size.x, low.y + size.y},
                                              ui::palette::backdrop.packed());
    return;
  }
  look(context, low, {low.x + size.x, low.y + size.y});
  takePicture(context);
  requestFrame(context);
  drawPicture(context, low, size);
  nameSource(ui::fromIm(ImGui::GetMousePos()));
  drawStatistics(context, low, size);
}

}  // namespace acentric::editor
