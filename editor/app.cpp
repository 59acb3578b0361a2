#include "editor/app.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "editor/panels/menu_bar.h"
#include "editor/panels/status_bar.h"
#include "editor/session/window_places.h"
#include "ui/keys.h"
#include "ui/translate.h"
#include "ui/widgets.h"

namespace acentric::editor {
namespace {

constexpr ImGuiWindowFlags kFixedWindow =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse |
    ImGuiWindowFlags_NoBackground;  // the window is cleared to the same colour

constexpr double kLitSeconds = 1.5;
constexpr int kFramesBetween = 4;  ///< two menus that arrows go from and to

SessionOptions sessionOptions(const AppOptions& options) {
  SessionOptions session;
  session.importHost = options.importHost;
  session.preferencesFile = preferencesFile();
  session.unsavedFolder = unsavedWorkFolder();
  session.inspectAlways = true;
  session.wake = &ui::Window::wake;
  return session;
}

/// Regions above the triangle budget, as far as they are counted.
std::size_t overBudget(const Session& session) {
  const auto inspection = session.inspection();
  const int most = session.project().budget.trianglesPerRegion;
  return inspection && most > 0 ? inspection->budgets.over(std::size_t(most)).size() : 0;
}

/// Letters from the Japanese ranges on, U+3000: in UTF-8 they begin with E3 to ED, or EF.
bool isJapanese(const std::string& text) {
  return std::ranges::any_of(text, [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte >= 0xe3 && byte <= 0xed) || byte == 0xef;
  });
}

bool hasJapaneseNames(const Session& session) {
  if (!session.hasProject()) return false;
  const Project& project = session.project();
  const auto named = [](const auto& each) { return isJapanese(each.name); };
  return isJapanese(session.file().string()) || isJapanese(project.scene.string()) ||
         std::ranges::any_of(project.storeys, named) || std::ranges::any_of(project.bookmarks, named) ||
         std::ranges::any_of(project.paths, named);
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
  auto window = ui::Window::open({"Acentric"});
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
  app->followPreferences();
  const Preferences& preferences = app->session_.preferences();
  app->window_->show(loadWindowPlaces(windowPlacesFile()), options.size);
  // Work that was not saved comes before what is opened by itself: the welcome offers it.
  const bool byItself = options.file.empty() && app->session_.unsavedWork().empty();
  const std::filesystem::path file = byItself ? startUpFile(preferences, options.sample) : options.file;
  if (!file.empty()) app->session_.open(file);
  app->guideWanted_ = options.file.empty() && !file.empty() && !preferences.guideSeen;
  return app;
}

App::App(const AppOptions& options, std::unique_ptr<ui::Window> window)
    : options_(options),
      window_(std::move(window)),
      table_(makeActionTable()),
      session_(sessionOptions(options)),
      centre_(session_.processors(), &ui::Window::wake),
      walk_(session_.processors(), &ui::Window::wake) {}

App::~App() = default;

void App::run() {
  const std::stop_callback wakes(options_.stop, &ui::Window::wake);
  window_->run([this] { update(); }, [this] { draw(); });
  if (options_.stop.stop_requested()) session_.keepWork();
  // Of a window whose size was asked for, nobody chose where it is. One that cannot be kept is no loss.
  if (const auto place = window_->place(); place && !options_.size)
    (void)keepWindowPlace(*place, windowPlacesFile());
  session_.savePreferencesNow();
}

void App::update() {
  const double now = ui::Window::seconds();
  if (session_.poll(now)) window_->pacer().request();
  if (walk_.takeNews() || centre_.takeNews()) window_->pacer().request();
  if (options_.exitAfterSeconds > 0 && now >= options_.exitAfterSeconds) window_->close();
  if (state_.quit || options_.stop.stop_requested()) window_->close();
  followPreferences();
  window_->setFullScreen(state_.fullScreen);
  startGuide();
}

bool App::popupOpen() const {
  return dialogs_.anyOpen() ||
         ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

bool App::inputBlocked() const {
  const glm::dvec2& at = window_->input().pointer();
  return popupOpen() || toasts_.covers({float(at.x), float(at.y)}) ||
         guideCard_.covers({float(at.x), float(at.y)});
}

void App::runShortcuts(PanelContext& context) {
  if (popupOpen()) return;  // not inputBlocked: keys reach past what lies under the pointer
  for (std::size_t i = 0; i < events_.size(); ++i) {
    const ui::InputEvent& event = events_[i];
    if (event.kind != ui::InputEvent::Kind::keyPress) continue;
    if (event.code == ui::key::escape) state_.fullScreen = false;
    const Shortcut pressed{event.code, event.modifiers & ui::modifier::all};
    // While a field takes text, only combinations with Ctrl that no text field uses may act.
    const bool typing = ImGui::GetIO().WantTextInput;
    const Action* action = findAction(table_, pressed);
    if (action == nullptr || (typing && action->id != "file.save" && action->id != "file.quit")) continue;
    runAction(context, *action);
    if (state_.dialog == Dialog::none) continue;
    // What follows is meant for the dialog, which is there in the next frame.
    const auto rest = events_.begin() + std::ptrdiff_t(i) + 1;
    window_->input().putBack({rest, events_.end()});
    events_.erase(rest, events_.end());
    window_->pacer().request(1);
  }
}

void App::takeDropped(PanelContext& context) {
  const auto dropped = window_->takeDropped();
  if (dropped.empty()) return;
  if (dropped.size() > 1)
    session_.messages().add(MessageLevel::warning, tr("Several files were dropped; the first is opened."));
  proceedAfterAsking(context.actions, {Continuation::Kind::open, dropped.front()});
}

void App::tellNews() {
  for (const std::string& missing : window_->missingFonts())
    if (fontsTold_.insert(missing).second) session_.messages().add(MessageLevel::warning, missing);
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
  const auto tell = [&](const char* name, const SweepWatch& watch, std::string& logged) {
    const auto& sweep = watch.sweep();
    std::string measured =
        fmt::format("running {} points {}", int(watch.running()), sweep ? sweep->points.size() : 0);
    if (measured != logged) log_.event(name, logged = std::move(measured));
  };
  tell("sweep", session_.sweeping(), loggedSweep_);
  tell("goals", session_.proposing(), loggedGoals_);
  std::string now = "empty";
  if (session_.built() && session_.captures())
    now = fmt::format("regions {} captures {} baked {} working {} dirty {} undo {} problems {} over {}",
                      session_.built()->layout->regions.size(), session_.captures()->cameras.size(),
                      session_.captures()->baked, int(session_.working()), int(session_.dirty()),
                      session_.history().cursor(), session_.problems().size(), overBudget(session_));
  if (now != loggedState_) {
    log_.event("state", now);
    loggedState_ = now;
  }
  if (const int finished = session_.bakeQueue().finished(); finished != loggedFinished_) {
    log_.event("bakequeue", fmt::format("finished {} of {}", finished, session_.bakeQueue().toBake()));
    loggedFinished_ = finished;
  }
  if (!ready_) {
    ready_ = true;
    log_.event("READY", context.window.graphicsDescription());
  }
}

void App::keepDrawing(PanelContext& context) {
  constexpr double kWorkingInterval = 0.1;  // bars move, times count down
  if (session_.working()) context.window.pacer().requestAt(context.now + kWorkingInterval);
  constexpr double kSweepInterval = 1;
  if (session_.sweeping().running() || session_.proposing().running())
    context.window.pacer().requestAt(context.now + kSweepInterval);
  if (const auto change = toasts_.nextChange()) context.window.pacer().requestAt(*change);
}

void App::drawStatus(PanelContext& context, float top) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetCursorPos({0, display.y - top - statusBarPixels()});
  if (beginPane("##statusPane", {std::max(1.0F, display.x), statusBarPixels()}, false))
    drawStatusBar(context);
  endPane();
}

/// Arrows and Space to widgets or to the walk; Alt and F10 to the menus.
void App::giveKeys() {
  const bool popup = popupOpen();
  for (const ui::InputEvent& event : events_) keyFocus_.handle(event, popup);
  if (keyFocus_.takeAltTap()) state_.openMenus = true;
  const bool inMenus = popup || menuBar_.focused;
  if (inMenus && menusByKey_ > 0) menusByKey_ = kFramesBetween;
  menusByKey_ = dialogs_.anyOpen() ? 0 : std::max(0, menusByKey_ - 1);
  if (menusByKey_ > 0 && !inMenus) window_->pacer().request(1);
  const bool list = popup && !dialogs_.anyOpen();  // of choices, or a menu, however it was opened
  const bool byKeys = menusByKey_ > 0 || list || dialogs_.navigable() || keyFocus_.onWidgets();
  window_->navigateByKeys(byKeys);
  const bool escape = std::ranges::any_of(events_, [](const ui::InputEvent& event) {
    return event.kind == ui::InputEvent::Kind::keyPress && event.code == ui::key::escape;
  });
  if (escape && popup && !dialogs_.anyOpen() && !byKeys) ui::closeTopPopup();
}

void App::speak() {
  const std::string& chosen = session_.preferences().language;
  const std::string wanted = chosen.empty() ? systemLanguage() : chosen;
  if (wanted == tongue_) return;
  tongue_ = wanted;
  if (const auto spoken = setLanguage(wanted); !spoken)
    session_.messages().add(MessageLevel::warning, spoken.error());
  log_.event("language", language());
  window_->pacer().request();
}

void App::followPreferences() {
  const Preferences& preferences = session_.preferences();
  speak();
  const ui::Look look{preferences.theme == Theme::light, float(preferences.scalePercent) / 100,
                      language() == "ja" || hasJapaneseNames(session_), language()};
  if (look == lookAsked_) return;
  lookAsked_ = look;
  window_->setLook(look);
}

void App::startGuide() {
  if (!guideWanted_ || !session_.built() || session_.shippedWalk() || session_.opening().running()) return;
  guideWanted_ = false;
  const ActionContext actions{session_, state_};
  state_.guide.start(guideFacts(actions));
}

float App::drawMain(PanelContext& context, float top) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::SetNextWindowPos({0, top});
  ImGui::SetNextWindowSize({std::max(1.0F, display.x), std::max(1.0F, display.y - top)});
  ImGui::Begin("##main", nullptr, kFixedWindow);
  ImGui::PopStyleVar(3);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});  // panes touch; each restores the spacing inside
  const float middleEnds = drawLayout(context, top);
  ImGui::PopStyleVar();
  if (!state_.fullScreen) drawStatus(context, top);
  ImGui::End();
  return middleEnds;
}

void App::draw() {
  events_ = window_->input().take();
  tellNews();
  log_.beginFrame();
  giveKeys();
  dialogs_.handleKeys(events_);
  PanelContext context{{session_, state_},
                       table_,
                       *window_,
                       log_,
                       events_,
                       inputBlocked(),
                       ui::Window::seconds(),
                       keyFocus_.onWidgets() || popupOpen()};
  if (window_->takeCloseRequest()) proceedAfterAsking(context.actions, {Continuation::Kind::quit, {}});
  takeDropped(context);
  runShortcuts(context);
  walk_.walk(context);
  if (state_.openMenus) menusByKey_ = kFramesBetween;

  menuBar_ = state_.fullScreen ? MenuBar() : drawMenuBar(context);
  const float middleEnds = drawMain(context, menuBar_.height);

  dialogs_.draw(context);
  guideCard_.draw(context);
  // Over the walk, not over the panes below, which are clicked more.
  if (toasts_.draw({ImGui::GetIO().DisplaySize.x - ui::scaled(16), middleEnds - ui::scaled(14)}, log_))
    state_.messagesLitUntil = context.now + kLitSeconds;
  window_->setTitle(session_.title());
  logNews(context);
  log_.endFrame();
  keepDrawing(context);
}

}  // namespace acentric::editor
