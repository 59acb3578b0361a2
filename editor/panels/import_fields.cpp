#include "editor/panels/import_fields.h"

#include <imgui.h>

#include <array>

#include "ui/theme.h"
#include "ui/translate.h"
#include "ui/widgets.h"

namespace acentric::editor {

ui::FieldEdit upAxisField(UpAxis& up, float labelWidth) {
  const std::array<ui::Choice, 3> axes = {ui::Choice{tr("By the file"), "", true, ""},
                                          ui::Choice{tr("Y up"), "", true, ""},
                                          ui::Choice{tr("Z up"), "", true, ""}};
  int axis = int(up);
  const ui::FieldEdit edit = ui::choiceField(tr("Up axis"), axes, axis, labelWidth);
  up = UpAxis(axis);
  return edit;
}

bool metresPerUnitField(double& metres, float labelWidth) {
  ImGui::AlignTextToFramePadding();
  ui::mutedText(tr("Metres per unit"));
  ImGui::SameLine(ui::scaled(labelWidth));
  ImGui::SetNextItemWidth(-1);
  const double before = metres;
  const bool typed =
      ImGui::InputDouble("##metresPerUnit", &metres, 0, 0, metres == 0 ? trPrintf("by the file") : "%.6g",
                         ImGuiInputTextFlags_EnterReturnsTrue);
  ui::tooltip(tr("0: by the file, else guessed. Press Enter to import again."));
  return typed && metres != before;
}

}  // namespace acentric::editor
