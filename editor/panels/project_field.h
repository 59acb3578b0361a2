#pragma once
/// Numbers of the project in one line each, for panels of settings.

#include <string>

#include "editor/panels/panel_context.h"

namespace acentric::editor {

inline constexpr float kLabelWidth = 144;

/// `makeEdit` from the new value; logged as settings.NAME.
template <class MakeEdit>
void number(PanelContext& context, const char* logName, const ui::NumberField& field, double value,
            MakeEdit makeEdit) {
  const ui::FieldEdit edit = ui::numberField(field, value, kLabelWidth);
  context.log.item(std::string("settings.") + logName);
  if (edit) applyFieldEdit(context, edit, makeEdit(value));
}

}  // namespace acentric::editor
