#include "editor/panels/corner_section.h"

#include "editor/commands/layout_edits.h"
#include "ui/translate.h"

namespace acentric::editor {

void drawCornerSection(PanelContext& context, float labelWidth) {
  const EditorState& state = context.state();
  const Outline& outline = context.session().project().layout().outline;
  const auto place = placeOf(outline, state.scene3d.corner);
  if (!place || state.centreView != View::scene3d || !state.selection.empty()) return;
  if (!ui::section((std::string(tr("Corner of the outline")) + "###corner").c_str())) return;
  for (int k = 0; k < 2; ++k) {
    double value = (*place)[k];
    const ui::FieldEdit edit =
        ui::numberField({k == 0 ? "x" : "y", "%.3f m", 0.01, -1e6, 1e6}, value, labelWidth);
    context.log.item(k == 0 ? "corner.x" : "corner.y");
    if (!edit) continue;
    Outline changed = outline;
    changed.loops[state.scene3d.corner->loop][state.scene3d.corner->corner][k] = value;
    applyFieldEdit(context, edit, setOutline(context.session().project(), std::move(changed)));
  }
}

}  // namespace acentric::editor
