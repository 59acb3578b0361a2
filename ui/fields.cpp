#include "ui/fields.h"

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ui/colour.h"
#include "ui/text_format.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace acentric::ui {
namespace {

/// Label at the left, the widget fills the rest of the line.
void beginField(const char* label, float labelWidth, const char* help) {
  ImGui::PushID(label);
  ImGui::AlignTextToFramePadding();
  mutedText(label);
  tooltip(help);
  ImGui::SameLine(scaled(labelWidth));
  ImGui::SetNextItemWidth(-1);
}

FieldEdit endField(bool changed, const char* help) {
  const FieldEdit edit{changed, ImGui::IsItemDeactivatedAfterEdit()};
  if (!ImGui::IsItemActive()) tooltip(help);
  ImGui::PopID();
  return edit;
}

}  // namespace

FieldEdit numberField(const NumberField& field, double& value, float labelWidth) {
  beginField(field.label, labelWidth, field.help);
  double edited = std::abs(value) < 1e-9 ? 0.0 : value;  // no "-0.00"
  const bool touched =
      ImGui::DragScalar("##value", ImGuiDataType_Double, &edited, float(field.speed), &field.least,
                        &field.most, withDigits(field.format, edited).c_str(), ImGuiSliderFlags_AlwaysClamp);
  const bool changed = touched && std::isfinite(edited) && edited != value;
  if (changed) value = std::clamp(edited, field.least, field.most);
  return endField(changed, field.help);
}

FieldEdit numberField(const NumberField& field, int& value, float labelWidth) {
  beginField(field.label, labelWidth, field.help);
  int edited = value;
  const int least = int(field.least);
  const int most = int(field.most);
  const bool touched = ImGui::DragInt("##value", &edited, float(field.speed), least, most, field.format,
                                      ImGuiSliderFlags_AlwaysClamp);
  const bool changed = touched && edited != value;
  if (changed) value = std::clamp(edited, least, most);
  return endField(changed, field.help);
}

void ReadyTextField::begin(bool instead) {
  ++number_;
  instead_ = instead;
  focus_ = early_ = true;
}

bool ReadyTextField::draw(const char* hint, std::string& text) {
  const std::string before = text;
  if (early_)
    for (const ImWchar letter : ImGui::GetIO().InputQueueCharacters) {
      std::array<char, 5> utf8{};
      if (letter < ' ') continue;
      if (std::exchange(instead_, false)) text.clear();
      text += ImTextCharToUtf8(utf8.data(), letter);
    }
  const auto placeCaret = [](ImGuiInputTextCallbackData* field) {
    field->CursorPos = field->SelectionStart = field->SelectionEnd = field->BufTextLen;
    if (*static_cast<const bool*>(field->UserData)) field->SelectAll();
    return 0;
  };
  ImGui::PushID(number_);
  if (std::exchange(focus_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##text", hint, &text, early_ ? ImGuiInputTextFlags_CallbackAlways : 0, placeCaret,
                           &instead_);
  ImGui::PopID();
  early_ = early_ && !ImGui::IsItemActive();
  return text != before;
}

FieldEdit checkField(const char* label, bool& value, float labelWidth, const char* help) {
  beginField(label, labelWidth, help);
  const bool changed = checkBox("##value", &value);
  FieldEdit edit = endField(changed, help);
  edit.finished = changed;
  return edit;
}

FieldEdit choiceField(const char* label, std::span<const Choice> choices, int& index, float labelWidth,
                      const char* help) {
  beginField(label, labelWidth, help);
  const bool valid = index >= 0 && index < int(choices.size());
  FieldEdit edit;
  const Choice* shown = valid ? &choices[std::size_t(index)] : nullptr;
  const char* preview = shown == nullptr            ? ""
                        : shown->shortLabel.empty() ? shown->label.c_str()
                                                    : shown->shortLabel.c_str();
  if (ImGui::BeginCombo("##value", preview)) {
    for (int i = 0; i < int(choices.size()); ++i) {
      const Choice& choice = choices[std::size_t(i)];
      const auto flags = choice.enabled ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
      if (ImGui::Selectable(choice.label.c_str(), i == index, flags) && i != index) {
        index = i;
        edit = {true, true};
      }
      tooltip(choice.help);
      if (i == index) ImGui::SetItemDefaultFocus();
    }
    ImGui::EndCombo();
  } else {
    tooltip(help);
  }
  ImGui::PopID();
  return edit;
}

}  // namespace acentric::ui
