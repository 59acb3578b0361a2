#include "editor/panels/status_bar.h"

#include <algorithm>
#include <cmath>

#include "editor/panels/bake_panel.h"
#include "editor/panels/problems_panel.h"
#include "editor/panels/walk_facts.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

const char* hintOf(PlanMode mode, bool selected) {
  switch (mode) {
    case PlanMode::cells:
      return selected ? tr("Drag or Ctrl+arrows move the selection, Ctrl+D copies it, Del removes it, Esc "
                           "clears it  "
                           " "
                           "·   Shift+drag adds, Ctrl+drag toggles")
                      : tr("Click adds or selects a cell, drag moves it, Shift+drag selects   ·   right drag "
                           "pans, "
                           "wheel zooms   ·   WASD walks");
    case PlanMode::eye:
      return tr("Press to put the eye there, drag to turn it   ·   WASD walks");
    case PlanMode::outline:
      return tr(
          "Click for corners (Enter closes) or drag a rectangle, inside for a hole; drag corners and "
          "sides, "
          "Ctrl+click takes a corner away");
    case PlanMode::panorama:
      return tr(
          "Click or drag free ground to place a panorama; click one to select it, drag moves it, "
          "Ctrl+click "
          "removes it");
    case PlanMode::lattice:
      return tr(
          "Drag the middle to move the lattice, the handle on the circle to turn it, the square for the "
          "cells' size   ·   Shift snaps");
    case PlanMode::measure:
      return tr("Drag to measure, corners attract (Alt: anywhere)   ·   Esc clears, and again ends");
    case PlanMode::path:
      return tr(
          "Click a path or key pose to select it, drag poses and ticks, press on the line for a new pose, "
          "Del removes");
    case PlanMode::density:
      return tr(
          "Press or drag over cells to paint, Ctrl takes back   ·   ] and [ change the selected cells, or "
          "the one you stand in");
  }
  return "";
}

constexpr const char* kAccuracyHint =
    trLater("Point at a mark for its worst frame and its figures, click to keep it");
constexpr const char* kSceneHint = trLater(
    "Drag orbits, right drag pans, wheel comes nearer   ·   click selects, arrows move what is selected   ·  "
    " "
    "Alt+click asks a surface, double click centres or opens a camera");

constexpr const char* kWalkHint = trLater(
    "WASD walks, dragging looks around   ·   right click for what can be done here   ·   Alt+click asks what "
    "painted a pixel");

const char* hintOf(const EditorState& state) {
  const bool walk = state.whole == WholeView::walk || (state.walkPointed && state.whole == WholeView::none);
  const PlanMode mode = state.planTool.mode();
  if (walk) return tr(kWalkHint);
  if (state.centreView == View::accuracy) return tr(kAccuracyHint);
  if (state.centreView == View::scene3d && mode == PlanMode::cells) return tr(kSceneHint);
  return hintOf(mode, !state.selection.empty());
}

/// The first that runs, of those that are worth waiting for; null if none.
const Job* workOf(const Session& session) {
  const Job* jobs[] = {&session.opening(),         &session.rebuilding(),        &session.baking(),
                       &session.estimating(),      &session.searching(),         &session.loading(),
                       &session.drawingBackdrop(), &session.measuringCoverage(), &session.inspecting(),
                       &session.publishing().job()};
  for (const Job* job : jobs)
    if (job->running()) return job;
  return nullptr;
}

/// A thin bar of its own, behind the words.
void drawShare(double share) {
  const ImVec2 size = ui::scaled(ImVec2(90, 4));
  ImGui::SameLine(0, ui::scaled(10));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float y = std::floor(at.y + (ImGui::GetTextLineHeight() - size.y) / 2);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({at.x, y}, {at.x + size.x, y + size.y}, ui::palette::border.packed(), size.y / 2);
  const float done = size.x * float(std::clamp(share, 0.0, 1.0));
  if (done >= 1)
    list.AddRectFilled({at.x, y}, {at.x + done, y + size.y}, ui::palette::accent.packed(), size.y / 2);
  ImGui::Dummy({size.x, ImGui::GetTextLineHeight()});
}

void drawWork(const Session& session, const Job& job) {
  const bool baking = &job == &session.baking();
  const bool paused = baking && session.bakePaused();
  std::string text = paused             ? tr("bake paused")
                     : job.cancelling() ? tr("stopping…")
                     : baking           ? bakeProgressText(session)
                                        : progressText(job);
  ui::badge(paused ? ui::palette::warning : ui::palette::accent, text);
  const double share =
      baking && !session.bakeQueue().cameras().empty() ? session.bakeQueue().share() : progressFraction(job);
  if (share >= 0) drawShare(share);
}

void drawSaved(const Session& session) {
  if (!session.hasProject()) return ui::badge(ui::palette::faint, tr("ready"));
  if (session.shippedWalk()) return ui::badge(ui::palette::good, tr("a walk, not edited"));
  const char* text = session.untitled() ? tr("not saved yet")
                     : session.dirty()  ? tr("unsaved changes")
                                        : tr("saved");
  ui::badge(session.dirty() ? ui::palette::warning : ui::palette::good, text);
}

/// A click opens the list.
void drawProblemCount(PanelContext& context) {
  const ProblemMark mark = problemMark(context.session());
  if (mark.text.empty()) return;
  ImGui::SameLine(0, 18);
  ImGui::BeginGroup();
  ui::badge(mark.colour, trfMany("{} problem", "{} problems", mark.text == "1" ? 1 : 2, mark.text));
  ImGui::EndGroup();
  context.log.item("status.problems");
  ui::tooltip(tr("Click for the list"));
  if (ImGui::IsItemClicked()) runAction(context, *findAction(context.table, std::string("tab.problems")));
}

}  // namespace

float statusBarPixels() { return ui::scaled(26); }

void drawStatusBar(PanelContext& context) {
  Session& session = context.session();
  const float margin = ui::scaled(12);
  ImGui::SetCursorPos({margin, (statusBarPixels() - ImGui::GetTextLineHeight()) / 2});
  if (const Job* job = workOf(session))
    drawWork(session, *job);
  else
    drawSaved(session);
  if (!session.hasProject()) return;
  drawProblemCount(context);
  ImGui::SameLine(0, 2 * margin);
  // What has no room is left out: the file first, then the hint.
  const std::string& readout = context.state().scene3d.readout;
  const char* hint = readout.empty() ? hintOf(context.state()) : readout.c_str();
  const float from = std::max(ImGui::GetCursorPosX(), ui::scaled(324));
  const float to = ImGui::GetWindowSize().x - margin;
  const float hintEnd = from + ImGui::CalcTextSize(hint).x;
  if (hintEnd > to) return;
  ImGui::SameLine(from);
  ui::mutedText(hint);
  const std::string file =
      session.shippedWalk() ? walkLine(*session.shippedWalk()) : ui::shortenPath(session.file().string(), 52);
  const float fileFrom = to - ImGui::CalcTextSize(file.c_str()).x;
  if (fileFrom < hintEnd + 2 * margin) return;
  ImGui::SameLine(fileFrom);
  ui::mutedText(file);
  ui::tooltip(session.file().string());
}

}  // namespace acentric::editor
