#pragma once
/// The colours of quantities on the plan.

#include "ui/colour.h"

namespace acentric::editor {

/// Dark blue to yellow, of even steps in lightness: also told apart by those who do not see all colours.
/// `t` from 0 to 1.
ui::Colour scaleColour(double t);

}  // namespace acentric::editor
