#include "editor/app.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "editor/panels/bake_panel.h"
#include "editor/panels/menu_bar.h"
#include "editor/panels/messages_panel.h"
#include "editor/panels/report_panel.h"
#include "editor/panels/settings_panel.h"
#include "editor/panels/status_bar.h"
#include "editor/panels/welcome.h"
#include "ui/keys.h"
#include "ui/splitter.h"

namespace acentric::editor {
namespace {

constexpr ImGuiWindowFlags kFixedWindow =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse;

SessionOptions sessionOptions(const AppOptions& options) {
  SessionOptions session;
  session.importHost = options.importHost;
  session.preferencesFile = preferencesFile();
  session.wake = &ui::Window::wake;
  return session;
}

ui::Tone toneOf(MessageLevel level) {
  switch (level) {
    case MessageLevel::info:
      return ui::Tone::info;
    case MessageLevel::good:
      return ui::Tone::good;
    case MessageLevel::warning:
      return ui::Tone::warning;
    case MessageLevel::error:
      return ui::Tone::danger;
  }
  return ui::Tone::info;
}

}  // namespace

tl::expected<std::unique_ptr<App>, std::string> App::create(const AppOptions& options) {
  auto window = ui::Window::open({"Acentric", options.width, options.height, false});
  if (!window) return tl::unexpected(window.error());
  std::unique_ptr<App> app(new App(options, std::move(*window)));
  if (!options.uiLog.empty() && !app->log_.open(options.uiLog))
    return tl::unexpected(fmt::format("{}: cannot be written", options.uiLog.string()));
  if (!options.frameTimes.empty()) {
    const std::shared_ptr<std::FILE> file(std::fopen(options.frameTimes.c_str(), "w"), [](std::FILE* open) {
      return open != nullptr ? std::fclose(open) : 0;
    });
    if (file == nullptr)
      return tl::unexpected(fmt::format("{}: cannot be written", options.frameTimes.string()));
    fmt::print(file.get(), "at_s,list_ms,render_ms\n");
    app->window_->measureFrames([file](const ui::FrameTime& time) {
      fmt::print(file.get(), "{:.3f},{:.3f},{:.3f}\n", time.beginSeconds, 1e3 * time.listSeconds,
                 1e3 * time.renderSeconds);
      std::fflush(file.get());
    });
  }
  if (!app->window_->missingFont().empty())
    app->session_.messages().add(MessageLevel::warning,
                                 "The font " + app->window_->missingFont() +
                                     " is missing; install fonts-dejavu-core for a better look.");
  if (!options.file.empty()) app->session_.open(options.file);
  return app;
}

App::App(const AppOptions& options, std::unique_ptr<ui::Window> window)
    : options_(options),
      window_(std::move(window)),
      table_(makeActionTable()),
      session_(sessionOptions(options)),
      walk_(session_.processors(), &ui::Window::wake) {}

App::~App() = default;

void App::run() {
  window_->run([this] { update(); }, [this] { draw(); });
  session_.savePreferencesNow();
}

void App::update() {
  const double now = ui::Window::seconds();
  if (session_.poll(now)) window_->pacer().request();
  if (walk_.takeNews()) window_->pacer().request();
  if (options_.exitAfterSeconds > 0 && now >= options_.exitAfterSeconds) window_->close();
  if (state_.quit) window_->close();
}

bool App::inputBlocked() const {
  const glm::dvec2& at = window_->input().pointer();
  return dialogs_.anyOpen() ||
         ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel) ||
         toasts_.covers({float(at.x), float(at.y)});
}

void App::runShortcuts(PanelContext& context) {
  if (context.inputBlocked) return;
  for (const ui::InputEvent& event : context.events) {
    if (event.kind != ui::InputEvent::Kind::keyPress) continue;
    const Shortcut pressed{event.code, event.modifiers & ui::modifier::all};
    // While a field takes text, only combinations with Ctrl that no text field uses may act.
    const bool typing = ImGui::GetIO().WantTextInput;
    const Action* action = findAction(table_, pressed);
    if (action == nullptr || (typing && action->id != "file.save" && action->id != "file.quit")) continue;
    runAction(context, *action);
  }
}

void App::takeDropped(PanelContext& context) {
  const auto dropped = window_->takeDropped();
  if (dropped.empty()) return;
  if (dropped.size() > 1)
    session_.messages().add(MessageLevel::warning, "Several files were dropped; the first is opened.");
  proceedAfterAsking(context.actions, {Continuation::Kind::open, dropped.front()});
}

void App::tellNews() {
  for (const Message& message : session_.messages().takeNew()) {
    log_.event(message.level == MessageLevel::error ? "failure" : "message", message.text);
    if (message.modal)
      dialogs_.showFailure(message.text);
    else
      toasts_.post(toneOf(message.level), message.text, ui::Window::seconds());
  }
  toasts_.expire(ui::Window::seconds());
}

/// One line whenever what the session holds changed, for tests to wait on.
void App::logNews(PanelContext& context) {
  if (!log_.on()) return;
  std::string now = "empty";
  if (session_.built() && session_.captures())
    now = fmt::format("regions {} captures {} baked {} working {} dirty {} undo {}",
                      session_.built()->layout->regions.size(), session_.captures()->cameras.size(),
                      session_.captures()->baked, int(session_.working()), int(session_.dirty()),
                      session_.history().cursor());
  if (now != loggedState_) {
    log_.event("state", now);
    loggedState_ = now;
  }
  if (!ready_) {
    ready_ = true;
    log_.event("READY", context.window.graphicsDescription());
  }
}

void App::keepDrawing(PanelContext& context) {
  constexpr double kWorkingInterval = 0.1;  // bars move, times count down
  if (session_.working()) context.window.pacer().requestAt(context.now + kWorkingInterval);
  if (const auto change = toasts_.nextChange()) context.window.pacer().requestAt(*change);
}

void App::drawBottom(PanelContext& context, float height) {
  const float width = ImGui::GetContentRegionAvail().x;
  const float gap = 2;
  const float bake = std::floor(width * 0.36F);
  const float report = std::floor(width * 0.34F);
  if (beginPane("##bakePane", {bake, height})) drawBakePanel(context);
  endPane();
  ImGui::SameLine(0, gap);
  if (beginPane("##reportPane", {report, height})) drawReportPanel(context);
  endPane();
  ImGui::SameLine(0, gap);
  if (beginPane("##messagesPane", {width - bake - report - 2 * gap, height})) drawMessagesPanel(context);
  endPane();
}

void App::drawLayout(PanelContext& context, float top) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float height = display.y - top - kStatusBarPixels;
  Preferences& sizes = session_.preferences();
  if (beginPane("##settingsPane", {sizes.settingsWidth, height})) drawSettingsPanel(context);
  endPane();
  ImGui::SameLine(0, 0);
  ui::splitter("##split1", ui::SplitDirection::horizontal, height, sizes.settingsWidth, 220,
               display.x * 0.4F);
  ImGui::SameLine(0, 0);

  ImGui::BeginGroup();
  const float width = display.x - sizes.settingsWidth - ui::kSplitterPixels;
  const float upper = height - sizes.bottomHeight - ui::kSplitterPixels;
  if (!session_.hasProject()) {
    if (beginPane("##welcomePane", {width, upper})) drawWelcome(context);
    endPane();
  } else {
    if (beginPane("##planPane", {width - sizes.walkWidth - ui::kSplitterPixels, upper}, false))
      plan_.draw(context);
    endPane();
    ImGui::SameLine(0, 0);
    ui::splitter("##split2", ui::SplitDirection::horizontal, upper, sizes.walkWidth, 240, width - 300, true);
    ImGui::SameLine(0, 0);
    if (beginPane("##walkPane", {0, upper}, false)) walk_.draw(context);
    endPane();
  }
  ui::splitter("##split3", ui::SplitDirection::vertical, width, sizes.bottomHeight, 120, height * 0.6F, true);
  drawBottom(context, sizes.bottomHeight);
  ImGui::EndGroup();
}

void App::draw() {
  events_ = window_->input().take();
  tellNews();
  log_.beginFrame();
  dialogs_.handleKeys(events_);
  PanelContext context{{session_, state_},   table_, *window_, log_, events_, inputBlocked(),
                       ui::Window::seconds()};
  if (window_->takeCloseRequest()) proceedAfterAsking(context.actions, {Continuation::Kind::quit, {}});
  takeDropped(context);
  runShortcuts(context);
  walk_.walk(context);

  const float top = drawMenuBar(context);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui::palette::backdrop.vec());
  ImGui::SetNextWindowPos({0, top});
  ImGui::SetNextWindowSize({display.x, display.y - top});
  ImGui::Begin("##main", nullptr, kFixedWindow);
  ImGui::PopStyleVar(3);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});  // panes touch; each restores the spacing inside
  drawLayout(context, top);
  ImGui::PopStyleVar();
  ImGui::SetCursorPos({0, display.y - top - kStatusBarPixels});
  if (beginPane("##statusPane", {display.x, kStatusBarPixels}, false)) drawStatusBar(context);
  endPane();
  ImGui::End();
  ImGui::PopStyleColor();

  dialogs_.draw(context);
  toasts_.draw({display.x - 16, display.y - kStatusBarPixels - 14});
  window_->setTitle(session_.title());
  logNews(context);
  log_.endFrame();
  keepDrawing(context);
}

}  // namespace acentric::editor
