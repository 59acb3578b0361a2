#include "ui/widgets.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "ui/theme.h"

namespace acentric::ui {
namespace {

bool colouredButton(const char* label, const ImVec2& size, bool enabled, const Colour& fill,
                    const Colour& hover, const Colour& press) {
  ImGui::BeginDisabled(!enabled);
  ImGui::PushStyleColor(ImGuiCol_Button, fill.vec());
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, hover.vec());
  ImGui::PushStyleColor(ImGuiCol_ButtonActive, press.vec());
  const bool clicked = ImGui::Button(label, size);
  ImGui::PopStyleColor(3);
  ImGui::EndDisabled();
  return clicked && enabled;
}

}  // namespace

bool primaryButton(const char* label, const ImVec2& size, bool enabled) {
  ImGui::PushStyleColor(ImGuiCol_Text, palette::onAccent.vec());
  const bool clicked =
      colouredButton(label, size, enabled, palette::accentDeep, palette::accentHover, palette::accentDeep);
  ImGui::PopStyleColor();
  return clicked;
}

bool button(const char* label, const ImVec2& size, bool enabled) {
  return colouredButton(label, size, enabled, palette::raised, palette::hovered, palette::pressed);
}

bool toggleButton(const char* label, bool on, const ImVec2& size) {
  return on ? primaryButton(label, size) : button(label, size);
}

ImVec2 iconButtonSize() { return scaled(ImVec2(30, 28)); }

bool iconButton(ImFont* icons, const char* id, Icon icon, Pressed pressed, bool enabled) {
  const bool chosen = pressed == Pressed::chosen, shown = pressed == Pressed::shown;
  const Colour& fill = chosen ? palette::accentDeep : palette::selected;
  const Colour& hover = chosen ? palette::accentHover : palette::hovered;
  const bool clicked =
      colouredButton(id, iconButtonSize(), enabled, pressed == Pressed::no ? fill.withOpacity(0) : fill,
                     hover, chosen ? palette::accentDeep : palette::pressed);
  const ImFontGlyph* glyph = icons->FindGlyph(ImWchar(icon));
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  ImVec4 ink = (chosen ? palette::onAccent : shown ? palette::accent : palette::text).vec();
  if (!enabled) ink.w *= ImGui::GetStyle().DisabledAlpha;
  // By what is seen of it: the glyphs lie differently in their boxes.
  icons->RenderChar(
      ImGui::GetWindowDrawList(), icons->FontSize,
      {(low.x + high.x - glyph->X0 - glyph->X1) / 2, (low.y + high.y - glyph->Y0 - glyph->Y1) / 2},
      ImGui::GetColorU32(ink), ImWchar(icon));
  return clicked;
}

bool checkBox(const char* label, bool* value) {
  ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, scaled(1));
  ImGui::PushStyleColor(ImGuiCol_Border, palette::faint.vec());
  const bool clicked = ImGui::Checkbox(label, value);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  return clicked;
}

void closeTopPopup() {
  const int open = GImGui->OpenPopupStack.Size;
  if (open > 0) ImGui::ClosePopupToLevel(open - 1, true);
}

void panelTitle(ImFont* bold, const char* text) {
  ImGui::PushFont(bold);
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddLine({at.x, at.y - 2}, {at.x + ImGui::GetContentRegionAvail().x, at.y - 2},
                                      palette::border.packed());
  ImGui::Dummy({0, 2});
}

bool section(const char* label, bool openAtFirst) {
  ImGui::Dummy({0, 1});
  ImGui::PushStyleColor(ImGuiCol_Header, palette::raised.withOpacity(0.55F).vec());
  const bool open =
      ImGui::CollapsingHeader(label, openAtFirst ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None);
  ImGui::PopStyleColor();
  return open;
}

void mutedText(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, palette::muted.vec());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

void wrappedText(const Colour& colour, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour.vec());
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void keyValue(const char* label, const std::string& value, float valueX) {
  mutedText(label);
  ImGui::SameLine(scaled(valueX));
  wrappedText(palette::text, value);
}

void progressBar(double fraction, const std::string& text, double seconds, const Colour& colour) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size(std::max(scaled(20), ImGui::GetContentRegionAvail().x), ImGui::GetFrameHeight());
  ImGui::Dummy(size);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end(at.x + size.x, at.y + size.y);
  list.AddRectFilled(at, end, palette::raised.packed(), scaled(4));
  float from = 0;
  float to = float(std::clamp(fraction, 0.0, 1.0));
  if (fraction < 0) {
    const double phase = std::fmod(seconds * 0.6, 1.0);
    from = float(std::max(0.0, phase * 1.3 - 0.3));
    to = float(std::min(1.0, phase * 1.3));
  }
  if (to > from && (to - from) * size.x >= 2)
    list.AddRectFilled({at.x + from * size.x, at.y}, {at.x + to * size.x, end.y},
                       colour.withOpacity(0.55F).packed(), scaled(4));
  const ImVec2 textSize = ImGui::CalcTextSize(text.c_str());
  list.PushClipRect(at, end, true);
  list.AddText({at.x + std::max(scaled(8), (size.x - textSize.x) / 2), at.y + (size.y - textSize.y) / 2},
               palette::text.packed(), text.c_str());
  list.PopClipRect();
}

void badge(const Colour& colour, const std::string& text, Mark mark) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float line = ImGui::GetTextLineHeight();
  ImGui::SetCursorScreenPos({at.x + scaled(15), at.y});
  ImGui::TextUnformatted(text.c_str());
  const float top = ImGui::GetItemRectMin().y;  // lower than `at` beside buttons
  const ImVec2 centre(at.x + scaled(5), top + line / 2 + 0.5F);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (mark == Mark::disc) return list.AddCircleFilled(centre, scaled(4), colour.packed());
  list.AddCircle(centre, scaled(3.5F), colour.packed(), 0, scaled(1.4F));
  if (mark == Mark::ring) return;
  constexpr float kQuarter = 1.5707963F;
  list.PathArcTo(centre, scaled(4), -kQuarter, kQuarter, 12);
  list.PathFillConvex(colour.packed());
}

void tooltip(const std::string& text) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, scaled(ImVec2(10, 8)));
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

}  // namespace acentric::ui
