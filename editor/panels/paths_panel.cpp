#include "editor/panels/paths_panel.h"

#include <fmt/format.h>
#include <algorithm>

#include <array>
#include <cmath>
#include <utility>

#include "editor/actions/path_walk.h"
#include "editor/commands/walk_edits.h"
#include "editor/panels/toolbar_flow.h"
#include "engine/geometry/conventions.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr std::array<double, 5> kSpeeds{0.25, 0.5, 1, 2, 4};

/// Buttons in a row, and in the next where the pane ends.
void buttons(PanelContext& context, std::initializer_list<std::pair<const char*, const char*>> entries) {
  bool first = true;
  for (const auto& [id, label] : entries) {
    const float width = ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x;
    if (!std::exchange(first, false)) {
      ImGui::SameLine(0, kNear);
      if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
    }
    actionButton(context, id, ButtonLook::plain, {}, label);
  }
}

void drawRecording(PanelContext& context) {
  const WalkRecorder& recorder = context.state().recorder;
  actionButton(context, "walk.record", ButtonLook::toggle, {},
               recorder.recording() ? tr("Stop") : tr("Record walk"));
  ImGui::SameLine(0, kNear);
  actionButton(context, "bookmark.add", ButtonLook::plain, {}, tr("Bookmark here"));
  if (!recorder.recording()) return;
  ImGui::SameLine(0, 12);
  const double seconds = recorder.seconds(context.now);
  ImGui::AlignTextToFramePadding();
  ui::badge(ui::palette::danger,
            seconds > 0 ? trf("recording   {:.1f} s", seconds) : tr("walk: the first step begins it"));
  constexpr double kClockInterval = 0.1;
  context.window.pacer().requestAt(context.now + kClockInterval);
}

/// A line of the list; true if it was clicked.
bool row(PanelContext& context, const std::string& id, const std::string& name, const std::string& detail,
         const WalkSelection& what) {
  const WalkSelection& selected = context.state().walkSelection;
  const bool on = selected.kind == what.kind && selected.number == what.number;
  ImGui::PushID(id.c_str());
  const bool clicked = ImGui::Selectable("##row", on, ImGuiSelectableFlags_AllowDoubleClick);
  context.log.item(id);
  ImGui::PopID();
  ImGui::SameLine(6);
  ImGui::TextUnformatted(name.c_str());
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(detail.c_str()).x - 4);
  ui::mutedText(detail);
  if (clicked) selectWalk(context.actions, what);
  return clicked;
}

void drawList(PanelContext& context) {
  const Project& project = context.session().project();
  const auto storeyOf = [&](int storey) {
    return storey == project.storey ? std::string() : project.storeys[std::size_t(storey)].name;
  };
  if (!project.bookmarks.empty()) ui::mutedText(tr("Bookmarks"));
  for (std::size_t i = 0; i < project.bookmarks.size(); ++i) {
    const Bookmark& bookmark = project.bookmarks[i];
    if (row(context, fmt::format("bookmark.{}", i), bookmark.name, storeyOf(bookmark.storey),
            {WalkSelection::Kind::bookmark, i, {}}) &&
        ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
      return goToBookmark(context.actions, i);
  }
  if (!project.paths.empty()) ui::mutedText(tr("Paths"));
  for (std::size_t i = 0; i < project.paths.size(); ++i) {
    const WalkPath& path = project.paths[i];
    const std::string storey = storeyOf(path.storey);
    row(context, fmt::format("path.{}", i), path.name,
        fmt::format("{}{:.1f} s", storey.empty() ? "" : storey + "   ", path.path.seconds()),
        {WalkSelection::Kind::path, i, {}});
  }
}

void drawName(PanelContext& context, const std::string& current,
              Edit (*rename)(const Project&, std::size_t, std::string)) {
  if (context.session().shippedWalk()) return ImGui::TextUnformatted(current.c_str());
  const std::size_t number = context.state().walkSelection.number;
  std::array<char, 101> name{};
  current.copy(name.data(), name.size() - 1);
  ImGui::PushID(int(number));
  ImGui::SetNextItemWidth(-1);
  ImGui::InputText("##name", name.data(), name.size());
  ImGui::PopID();
  context.log.item("walks.name");
  const bool renamed = ImGui::IsItemDeactivatedAfterEdit() && current != name.data();
  ui::tooltip(tr("Its name: type another"));
  if (renamed) context.session().apply(rename(context.session().project(), number, name.data()));
}

void drawBookmark(PanelContext& context, const Bookmark& bookmark) {
  const std::string where =
      trf("({:.2f}, {:.2f}, {:.2f}) m   {:.0f}°, {:.0f}° up   view {:.0f}°", bookmark.eye.x, bookmark.eye.y,
          bookmark.eye.z, degrees(bookmark.yawRadians), degrees(bookmark.pitchRadians), bookmark.fovDegrees);
  drawName(context, bookmark.name, renameBookmark);
  buttons(context, {{"bookmark.go", tr("Go")},
                    {"bookmark.update", tr("Move here")},
                    {"walks.up", "↑"},
                    {"walks.down", "↓"},
                    {"walks.remove", tr("Remove")}});
  ui::wrappedText(ui::palette::muted, where);
}

void drawSpeed(PanelContext& context) {
  WalkReplay& replay = context.state().replay;
  ImGui::SetNextItemWidth(70);
  const bool open = ImGui::BeginCombo("##speed", fmt::format("{:g}×", replay.speed()).c_str());
  context.log.item("path.speed");
  if (open) {
    for (const double speed : kSpeeds) {
      if (ImGui::Selectable(fmt::format("{:g}×", speed).c_str(), speed == replay.speed()))
        replay.setSpeed(speed);
      context.log.item(fmt::format("path.speed.{:g}", speed));
    }
    ImGui::EndCombo();
  } else {
    ui::tooltip(tr("How fast it is played"));
  }
}

void drawTransport(PanelContext& context, const WalkPath& path) {
  const WalkReplay& replay = context.state().replay;
  {
    const AsTallAsIcons tall(context);
    actionIcon(context, "path.play", replay.playing() ? ui::Icon::pause : ui::Icon::play, ButtonLook::plain,
               replay.playing() ? tr("Pause") : tr("Play"));
    ImGui::SameLine(0, kNear);
    actionIcon(context, "path.stop", ui::Icon::stop, ButtonLook::plain, tr("Stop"));
    ImGui::SameLine(0, kNear);
    actionIcon(context, "path.loop", ui::Icon::repeat, ButtonLook::toggle, tr("Loop"));
    ImGui::SameLine(0, kNear);
    drawSpeed(context);
  }
  float seconds = float(replay.at());
  ImGui::SetNextItemWidth(-1);
  std::string format = trf("{} of {:.1f} s", "%.1f", path.path.seconds());
  if (std::ranges::count(format, '%') != 1) format = "%.1f s";  // a damaged catalogue
  const bool moved = ImGui::SliderFloat("##time", &seconds, 0, float(path.path.seconds()), format.c_str(),
                                        ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput);
  context.log.item("path.time");
  if (moved) scrub(context.actions, double(seconds));
}

void drawPath(PanelContext& context, const WalkPath& path) {
  drawName(context, path.name, renamePath);
  drawTransport(context, path);
  buttons(context, {{"walks.up", "↑"},
                    {"walks.down", "↓"},
                    {"walks.remove", tr("Remove")},
                    {"path.export", tr("Export…")}});
  const OpenProject& open = *context.session().built();
  const int outside = path.storey == open.project.storey ? posesOutside(path, open) : 0;
  if (outside > 0)
    ui::wrappedText(ui::palette::warning,
                    trf("{} of {} key poses stand where one cannot walk (red on the plan)", outside,
                        path.path.poses.size()));
  else
    ui::mutedText(trf("{} key poses", path.path.poses.size()));
  if (!context.state().replayReport.empty())
    ui::wrappedText(ui::palette::muted, trf("Replay: {}", context.state().replayReport));
}

}  // namespace

void drawPathsPanel(PanelContext& context) {
  if (!context.session().built()) {
    ui::wrappedText(ui::palette::faint, tr("Walks and places of an open project are kept here."));
    return;
  }
  drawRecording(context);
  const Project& project = context.session().project();
  if (project.bookmarks.empty() && project.paths.empty()) {
    if (context.session().shippedWalk())
      return ui::wrappedText(ui::palette::muted, tr("This walk has neither bookmarks nor paths."));
    ui::wrappedText(
        ui::palette::muted,
        tr("Press Record walk (Ctrl+R), walk with W A S D, and press it again: the walk becomes a path to "
           "play, change and measure. Bookmark here (Ctrl+Shift+B) keeps the view to come back to."));
    return;
  }
  const float width = std::floor(0.42F * ImGui::GetContentRegionAvail().x);
  ImGui::BeginChild("##walks", {width, 0});
  drawList(context);
  ImGui::EndChild();
  ImGui::SameLine(0, 12);
  ImGui::BeginChild("##walk", {0, 0});
  // The lists may change while they are drawn: copies.
  const WalkSelection& selected = context.state().walkSelection;
  if (const Bookmark* bookmark = selected.bookmark(context.session().project()))
    drawBookmark(context, Bookmark(*bookmark));
  else if (const WalkPath* path = selected.path(context.session().project()))
    drawPath(context, WalkPath(*path));
  else
    ui::wrappedText(ui::palette::faint, tr("Click a bookmark or a path."));
  ImGui::EndChild();
}

}  // namespace acentric::editor
