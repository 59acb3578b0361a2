#include "editor/panels/guide_card.h"

#include <fmt/format.h>

#include <algorithm>

#include "ui/translate.h"

namespace acentric::editor {
namespace {

/// Beside the widget, where there is room; in a corner of it where it is large.
ImVec2 placeBeside(const ui::UiLog::Rect& widget, const ImVec2& card, const ImVec2& display) {
  const float gap = ui::scaled(12);
  ImVec2 at(widget.x0, widget.y1 + gap);  // below
  if (at.y + card.y > display.y) at = {widget.x0, widget.y0 - gap - card.y};
  if (at.y < 0) at = {widget.x1 - gap - card.x, widget.y1 - 4 * gap - card.y};
  return {std::clamp(at.x, 0.0F, std::max(0.0F, display.x - card.x)),
          std::clamp(at.y, 0.0F, std::max(0.0F, display.y - card.y))};
}

void drawFrame(const ui::UiLog::Rect& r) {
  const float out = ui::scaled(3);
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  list.AddRect({r.x0 - out, r.y0 - out}, {r.x1 + out, r.y1 + out},
               ui::palette::accent.withOpacity(0.35F).packed(), ui::scaled(6), 0, ui::scaled(6));
  list.AddRect({r.x0 - out, r.y0 - out}, {r.x1 + out, r.y1 + out}, ui::palette::accent.packed(),
               ui::scaled(6), 0, ui::scaled(2));
}

void end(PanelContext& context, bool finished) {
  if (finished) context.session().preferences().guideSeen = true;
  context.session().savePreferencesNow();
}

}  // namespace

bool GuideCard::covers(const ImVec2& place) const {
  return place.x >= low_.x && place.y >= low_.y && place.x < high_.x && place.y < high_.y;
}

void GuideCard::draw(PanelContext& context) {
  Guide& guide = context.state().guide;
  const GuideFacts facts = guideFacts(context.actions);
  if (guide.observe(facts)) {
    context.window.pacer().request();
    if (!guide.running()) end(context, true);
  }
  context.log.watch(guide.running() ? guide.step().widget : "");
  low_ = high_ = {0, 0};
  if (!guide.running()) return;
  const auto widget = context.log.watched();
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const ImVec2 size(std::min(ui::scaled(380), std::max(1.0F, display.x)), 0);
  ImGui::SetNextWindowSize(size);
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                                      ImGuiWindowFlags_NoFocusOnAppearing;
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui::palette::popup.vec());
  ImGui::PushStyleColor(ImGuiCol_Border, ui::palette::accent.vec());
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ui::scaled(ImVec2(16, 12)));
  ImGui::Begin("##guide", nullptr, kFlags);
  ImGui::PopStyleVar();
  const GuideStep& step = guide.step();
  ui::mutedText(trf("Guided start, {} of {}", guide.index() + 1, guideSteps().size()));
  ImGui::PushFont(context.window.fonts().bold);
  ImGui::TextUnformatted(tr(step.title));
  ImGui::PopFont();
  ui::wrappedText(ui::palette::text, tr(step.text));
  ImGui::Dummy({0, ui::scaled(2)});
  bool unwanted = context.session().preferences().guideSeen;
  if (ui::checkBox(tr("Do not show again"), &unwanted)) context.session().preferences().guideSeen = unwanted;
  context.log.item("guide.never");
  ui::tooltip(tr("At the next start. It stays in the Help menu."));
  const bool skip = ui::button(tr("Skip the guide"));
  context.log.item("guide.skip");
  ui::tooltip(tr("Ends it; it is in the Help menu."));
  ImGui::SameLine();
  const bool back = ui::button(tr("Back"), {0, 0}, !guide.first());
  context.log.item("guide.back");
  ImGui::SameLine();
  const bool next = ui::primaryButton(guide.last() ? tr("Done") : tr("Next"));
  context.log.item("guide.next");
  ui::tooltip(tr("The guide goes on by itself once the step is done."));
  const ImVec2 whole = ImGui::GetWindowSize();
  const ImVec2 at = widget ? placeBeside(*widget, whole, display)
                           : ImVec2(std::max(0.0F, (display.x - whole.x) / 2), display.y * 0.3F);
  ImGui::SetWindowPos(at);
  low_ = at;
  high_ = {at.x + whole.x, at.y + whole.y};
  ImGui::End();
  ImGui::PopStyleColor(2);
  if (widget) drawFrame(*widget);
  if (back) guide.back(facts);
  if (next) guide.next(facts);
  if (skip) guide.stop();
  if (back || next || skip) context.window.pacer().request();
  if (!guide.running()) end(context, !skip);
}

}  // namespace acentric::editor
