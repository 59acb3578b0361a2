#include "editor/panels/preference_fields.h"

#include "editor/tools/walker.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

void saveIf(PanelContext& context, const ui::FieldEdit& edit) {
  if (edit.finished) context.session().savePreferencesNow();
}

}  // namespace

void bakeThreadsField(PanelContext& context, float labelWidth) {
  int threads = context.session().bakeThreads();
  const ui::FieldEdit edit =
      ui::numberField({tr("Threads"), "%.0f", 0.05, 1, double(context.session().processors()),
                       tr("For baking and loading. One fewer than the processors keeps the window quick.")},
                      threads, labelWidth);
  context.log.item("preferences.threads");
  if (edit.changed) context.session().preferences().bakeThreads = threads;
  saveIf(context, edit);
}

void bakeMemoryField(PanelContext& context, float labelWidth) {
  saveIf(context,
         ui::numberField(
             {tr("Memory"), "%.0f MB", 16, 16, 65536,
              tr("That captures may take from when they are traced until they are written, with what regions "
                 "see. More: less waiting, less traced twice. The scene itself comes on top.")},
             context.session().preferences().bakeMegabytes, labelWidth));
}

void walkMemoryField(PanelContext& context, float labelWidth) {
  int& megabytes = context.session().preferences().walkMegabytes;
  const ui::FieldEdit edit = ui::numberField(
      {tr("Memory"), megabytes == 0 ? trPrintf("half of the machine's") : "%.0f MB", 32, 0, 1'000'000,
       tr("For captures of the walk; what has no room is shown coarsely until the eye comes near. 0: "
          "half of the machine's. Remembered for all projects.")},
      megabytes, labelWidth);
  saveIf(context, edit);
  if (edit.finished) context.session().walkMemoryChanged();
}

void walkSpeedField(PanelContext& context, float labelWidth) {
  saveIf(context, ui::numberField({tr("Walking speed"), trPrintf("%.1f m/s"), 0.02,
                                   Walker::kLeastMetresPerSecond, Walker::kMostMetresPerSecond,
                                   tr("Shift walks three times as fast. Remembered for all projects.")},
                                  context.session().preferences().walkMetresPerSecond, labelWidth));
}

}  // namespace acentric::editor
