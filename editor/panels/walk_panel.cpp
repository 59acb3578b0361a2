#include "editor/panels/walk_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "editor/actions/path_walk.h"
#include "editor/panels/toolbar_flow.h"
#include "editor/panels/view_strip.h"
#include "editor/panels/walk_settings.h"
#include "engine/pipeline/walk_ground.h"
#include "ui/canvas_draw.h"
#include "ui/keys.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr double kRadiansPerPixel = 0.0035;
constexpr double kClickPixels = 4;  ///< a press and a release so near to each other are a click

WalkKeys keysHeld(const PanelContext& context) {
  namespace key = ui::key;
  if ((context.window.input().modifiers() & ui::modifier::control) != 0) return {};  // a shortcut
  // A tap shorter than a frame still counts for that frame.
  const auto held = [&](int code) {
    if (context.window.input().keyHeld(code)) return true;
    return std::any_of(context.events.begin(), context.events.end(), [code](const ui::InputEvent& event) {
      return event.kind == ui::InputEvent::Kind::keyPress && event.code == code &&
             (event.modifiers & ui::modifier::control) == 0;
    });
  };
  WalkKeys keys;
  const auto arrow = [&](int code) { return !context.keysOnWidgets && held(code); };
  keys.forward = held(key::w) || arrow(key::up);
  keys.back = held(key::s) || arrow(key::down);
  keys.left = held(key::a) || arrow(key::left);
  keys.right = held(key::d) || arrow(key::right);
  keys.turnLeft = held(key::q);
  keys.turnRight = held(key::e);
  keys.up = held(key::pageUp);
  keys.down = held(key::pageDown);
  keys.fast = held(key::leftShift) || held(key::rightShift);
  return keys;
}

}  // namespace

WalkPanel::WalkPanel(int threads, std::function<void()> wake)
    : threads_(threads),
      wake_([this, wake = std::move(wake)] {
        news_ = true;
        if (wake) wake();
      }),
      renderer_(threads, wake_),
      preview_(threads, wake_) {}

void WalkPanel::followProject(PanelContext& context) {
  Session& session = context.session();
  EditorState& state = context.state();
  const Layout& layout = *session.built()->layout;
  const bool fresh = generation_ != session.generation();
  const Spawn& spawn = session.project().spawn();
  if (fresh || (state.restart && session.isAround(spawn.position))) {
    const glm::dvec2 place = nearestStanding(layout, spawn.position);
    const double ground = footingOf(*session.built(), place).ground;
    state.walker.setPose({glm::dvec3(place, ground + layout.spec.eyeHeight), spawn.yawRadians, 0});
    state.restart = false;
  }
  if (fresh) {
    generation_ = session.generation();
    shown_ = {};
    preview_.clear();
    problem_.clear();
    trial_ = {};
    askAt_.reset();
    state.pointedFloor.reset();
    beginAfresh(context.actions);
  }
  // Cells may have gone from under the eye, or the eye height changed.
  const WalkPose pose = standing(*session.built(), state.walker.pose());
  if (pose != state.walker.pose()) state.walker.setPose(pose);
}

void WalkPanel::walk(PanelContext& context) {
  if (!context.session().built()) return;
  followProject(context);
  const bool typing = context.inputBlocked || ImGui::GetIO().WantTextInput ||
                      (context.window.input().modifiers() & ui::modifier::control) != 0;
  const WalkKeys keys = typing ? WalkKeys{} : keysHeld(context);
  Walker& walker = context.state().walker;
  if (followPath(context.actions, context.now, keys.any())) context.window.pacer().request(1);
  const double seconds = lastStep_ < 0 ? 1.0 / 60 : context.now - lastStep_;
  lastStep_ = -1;
  if (keys.any() || walker.moving()) {
    walkByKeys(context.actions, seconds, keys);
    lastStep_ = context.now;
    context.window.pacer().request(1);
  } else if (context.log.on() && walker.pose() != loggedPose_) {
    loggedPose_ = walker.pose();
    context.log.event("eye",
                      fmt::format("{:.3f} {:.3f} {:.3f} {:.4f} {:.4f}", loggedPose_.eye.x, loggedPose_.eye.y,
                                  loggedPose_.eye.z, loggedPose_.yawRadians, loggedPose_.pitchRadians));
  }
  recordEye(context.actions, context.now);
  context.session().walkAt({glm::dvec2(walker.pose().eye), walker.pose().yawRadians, walker.velocity()});
}

void WalkPanel::drawToolbar(PanelContext& context) {
  const ImVec2 at = ImGui::GetCursorPos(), margin = ui::scaled(ImVec2(8, 7));
  ImGui::SetCursorPos({at.x + margin.x, at.y + margin.y});
  ImGui::BeginGroup();
  drawButtons(context);
  ImGui::EndGroup();
  ImGui::SetCursorPos({at.x, at.y + ImGui::GetItemRectSize().y + 2 * margin.y});
}

void WalkPanel::drawButtons(PanelContext& context) {
  using enum ButtonLook;
  static constexpr ToolbarEntry kEntries[] = {
      {"view.holes", trLater("Holes"), ui::Icon::eyeSlashed, 0, tool},
      {"view.sources", trLater("Sources"), ui::Icon::brush, kNear, tool},
      {"view.split", trLater("Split"), ui::Icon::columns, kNear, tool},
      {"view.difference", trLater("Difference"), ui::Icon::adjust, kNear, tool},
      {"view.variant", trLater("Variant"), ui::Icon::clone, kNear, tool},
      {"walk.ask", trLater("Ask"), ui::Icon::question, kApart},
      {"view.minimap", trLater("Map"), ui::Icon::map, kNear},
      {"view.images", trLater("Images"), ui::Icon::files, kNear},
      {"view.frameTimes", trLater("Times"), ui::Icon::barChart, kNear},
      {nullptr, trLater("Settings…"), ui::Icon::sliders, kApart},
      {"walk.screenshot", trLater("Save picture"), ui::Icon::camera, kNear, plain},
      {"walk.restart", trLater("To start"), ui::Icon::home, kApart, plain},
      {"walk.setStart", trLater("Start here"), ui::Icon::flag, kNear, plain}};
  toolbar(context, kEntries,
          [&](const ToolbarEntry& entry) { drawWalkSettingsButton(context, entry, glProblem_); });
  if (!needsTruth(context.state().walkLook)) return;
  ImGui::AlignTextToFramePadding();
  ui::mutedText(tr("Rays per pixel"));
  for (const int rays : kTruthRays) {
    ImGui::SameLine(0, rays == kTruthRays[0] ? ui::scaled(10) : ui::scaled(kNear));
    actionButton(context, fmt::format("compare.rays.{}", rays).c_str(), ButtonLook::toggle);
  }
  if (context.state().walkLook != WalkLook::difference) return;
  for (const int gain : kDifferenceGains) {
    const bool first = gain == kDifferenceGains[0];  // all of them on one line
    flow(first ? ui::scaled(180) : 0, first ? kApart : kNear);
    actionButton(context, fmt::format("compare.gain.{}", gain).c_str(), ButtonLook::toggle);
  }
}

void WalkPanel::look(PanelContext& context, const ImVec2& low, const ImVec2& high) {
  using Kind = ui::InputEvent::Kind;
  for (const ui::InputEvent& event : context.events) {
    if (!looking_ && compare_.handle(context, event)) continue;
    const bool inside = event.position.x >= double(low.x) && event.position.y >= double(low.y) &&
                        event.position.x < double(high.x) && event.position.y < double(high.y) &&
                        !overlays_.cover(event.position) && !onAnswer(event.position);
    if (event.kind == Kind::buttonRelease && pressedAt_) {
      if (glm::distance(event.position, *pressedAt_) < kClickPixels) askAt_ = *pressedAt_;
      pressedAt_.reset();
    }
    if (event.kind == Kind::keyPress && event.code == ui::key::escape && !context.inputBlocked)
      context.session().asking().clear();
    if (event.kind == Kind::buttonPress && inside && !context.inputBlocked) {
      const bool alt = (event.modifiers & ui::modifier::alt) != 0;
      if (alt || (context.state().asking && event.code == ui::mouse::left)) pressedAt_ = event.position;
      if (alt) continue;
      if (event.code == ui::mouse::right) menuAt_ = event.position;
      looking_ = true;
      lookFrom_ = event.position;
      context.window.capturePointer(true);
    } else if (event.kind == Kind::buttonRelease && looking_) {
      looking_ = false;
      context.window.capturePointer(false);
      const auto at = std::exchange(menuAt_, std::nullopt);
      if (at && event.code == ui::mouse::right && glm::distance(event.position, *at) < kClickPixels) {
        menuFor_ = *at;
        openMenu(context, (*at - ui::fromIm(low)) / (ui::fromIm(high) - ui::fromIm(low)));
      }
    } else if (event.kind == Kind::move && looking_) {
      // The mouse turns the head: to the right looks right.
      const Preferences& preferences = context.session().preferences();
      glm::dvec2 pixels = event.position - lookFrom_;
      if (preferences.invertLook) pixels.y = -pixels.y;
      context.state().walker.look(pixels, kRadiansPerPixel * preferences.lookSensitivity);
      lookFrom_ = event.position;
    }
  }
}

void WalkPanel::draw(PanelContext& context) {
  if (!context.state().fullScreen) {
    static constexpr ViewTab kTab{"view.walk", trLater("Walk")};
    drawViewStrip(context, {&kTab, 1}, kTab.id, true);
    drawToolbar(context);
  }
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 size = ImGui::GetContentRegionAvail();
  if (size.x < 40 || size.y < 40) return;
  const ImVec2 density = ImGui::GetIO().DisplayFramebufferScale;  // pixels of the screen; above 1 on Wayland
  area_ = {int(size.x * density.x), int(size.y * density.y)};
  ImGui::InvisibleButton("##walk", size);
  context.state().walkPointed = ImGui::IsItemHovered();
  context.log.item("walk");
  if (!context.session().built()) {
    ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + size.x, low.y + size.y},
                                              ui::palette::backdrop.packed());
    return;
  }
  look(context, low, {low.x + size.x, low.y + size.y});
  times_.presented(context.window.lastFrame().renderSeconds);
  takePicture(context);
  requestFrame(context);
  keepRested(context);
  askForTruth(context);
  savePicture(context);
  askThePicture(context);
  drawPicture(context, low, size);
  compare_.draw(context, *ImGui::GetWindowDrawList(), place_, rested_);
  nameSource(ui::fromIm(ImGui::GetMousePos()));
  if (!context.state().fullScreen)
    drawStatistics(context, low, {size.x, size.y - overlays_.graphHeight(context, size.y)});
  drawOverlays(context, low, size);
  drawAnswer(context, low, size);
  drawNotice(context, low, size);
  drawMenu(context);
}

}  // namespace acentric::editor
