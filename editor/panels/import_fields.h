#pragma once
/// Fields for what a model's file may not say, or say wrongly: which way is up, and how long a unit is.

#include "engine/scene/import.h"
#include "ui/fields.h"

namespace acentric::editor {

ui::FieldEdit upAxisField(UpAxis& up, float labelWidth);
/// Typed, not dragged live: each value is a new import. 0 = by the file. True once Enter is pressed on
/// another.
bool metresPerUnitField(double& metres, float labelWidth);

}  // namespace acentric::editor
