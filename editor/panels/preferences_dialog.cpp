#include "editor/panels/preferences_dialog.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "editor/panels/dialog_frame.h"
#include "editor/panels/preference_fields.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr float kPreferencesLabelWidth = 168;
constexpr std::array<int, 9> kScales = {0, 75, 90, 100, 110, 125, 150, 175, 200};  ///< per cent; 0: automatic

void heading(PanelContext& context, const char* text) {
  ImGui::Dummy({0, ui::scaled(4)});
  ui::panelTitle(context.window.fonts().bold, text);
}

void saveIf(PanelContext& context, const ui::FieldEdit& edit, const char* logName) {
  context.log.item(logName);
  if (edit.finished) context.session().savePreferencesNow();
}

std::string nameOfLanguage(const std::string& code) {
  const auto found = std::ranges::find(languages(), code, &Language::code);
  return found == languages().end() ? code : found->name;
}

void drawLook(PanelContext& context) {
  Preferences& preferences = context.session().preferences();
  heading(context, tr("Look"));
  const std::array<ui::Choice, 2> kThemes = {ui::Choice{tr("Dark"), "", true, ""},
                                             ui::Choice{tr("Light"), "", true, ""}};
  int theme = int(preferences.theme);
  const ui::FieldEdit themed =
      ui::choiceField(tr("Theme"), kThemes, theme, kPreferencesLabelWidth, tr("Colours of the window."));
  if (themed.changed) preferences.theme = Theme(theme);
  saveIf(context, themed, "preferences.theme");

  std::vector<ui::Choice> tongues{{trf("System ({})", nameOfLanguage(systemLanguage())), "", true, ""}};
  int tongue = 0;
  for (const Language& each : languages()) {
    if (preferences.language == each.code) tongue = int(tongues.size());
    tongues.push_back({each.name, "", true, ""});
  }
  // Whoever cannot read the language finds the field by the English word.
  const std::string label = language() == "en" ? "Language" : fmt::format("{} / Language", tr("Language"));
  const ui::FieldEdit spoken =
      ui::choiceField(label.c_str(), tongues, tongue, kPreferencesLabelWidth,
                      tr("Of all texts; those of the scene's models stay as they are."));
  if (spoken.changed) preferences.language = tongue == 0 ? "" : languages()[std::size_t(tongue - 1)].code;
  saveIf(context, spoken, "preferences.language");

  std::vector<ui::Choice> choices;
  for (const int percent : kScales)
    choices.push_back(
        {percent == 0 ? tr("As the display asks") : fmt::format("{} %", percent), "", true, ""});
  const int now = preferences.scalePercent;
  int index = int(std::ranges::find(kScales, now) - kScales.begin());
  if (index == int(kScales.size())) {
    choices.push_back({fmt::format("{} %", now), "", true, ""});
  } else if (now == 0) {
    choices.front().label += fmt::format(" ({:.0f} %)", 100 * context.window.look().scale);
  }
  const ui::FieldEdit sized = ui::choiceField(
      tr("Interface"), choices, index, kPreferencesLabelWidth,
      tr("Size of texts, buttons and marks. Also with Ctrl+= and Ctrl+-; Ctrl+0: as the display asks."));
  if (sized.changed) preferences.scalePercent = kScales[std::size_t(index)];
  saveIf(context, sized, "preferences.scale");
}

void drawWork(PanelContext& context) {
  Preferences& preferences = context.session().preferences();
  heading(context, tr("Baking and saving"));
  bakeThreadsField(context, kPreferencesLabelWidth);
  bakeMemoryField(context, kPreferencesLabelWidth);
  saveIf(context,
         ui::numberField({tr("Autosave every"), "%.0f s", 0.5, Preferences::kLeastAutosaveSeconds,
                          Preferences::kMostAutosaveSeconds,
                          tr("Beside the project, never over it; offered again after a crash.")},
                         preferences.autosaveSeconds, kPreferencesLabelWidth),
         "preferences.autosave");
}

void drawWalk(PanelContext& context) {
  Preferences& preferences = context.session().preferences();
  heading(context, tr("Walk"));
  ImGui::PushID("walk");
  walkSpeedField(context, kPreferencesLabelWidth);
  saveIf(context,
         ui::numberField({tr("Mouse sensitivity"), "%.2f", 0.01, Preferences::kLeastLookSensitivity,
                          Preferences::kMostLookSensitivity, tr("1 turns a fifth of a degree a pixel.")},
                         preferences.lookSensitivity, kPreferencesLabelWidth),
         "preferences.sensitivity");
  saveIf(context,
         ui::checkField(tr("Inverted look"), preferences.invertLook, kPreferencesLabelWidth,
                        tr("Moving the mouse up looks down, as in aircraft.")),
         "preferences.invert");
  walkMemoryField(context, kPreferencesLabelWidth);
  const std::array<ui::Choice, 3> kChoices = {ui::Choice{tr("Graphics card, if it does well"), "", true, ""},
                                              ui::Choice{tr("Processor"), "", true, ""},
                                              ui::Choice{tr("Graphics card"), "", true, ""}};
  int graphics = int(preferences.graphics);
  const ui::FieldEdit drawn = ui::choiceField(tr("Drawn by"), kChoices, graphics, kPreferencesLabelWidth,
                                              tr("Walks with list priority. The card does well if it draws a "
                                                 "frame of the walk as the processor does, and "
                                                 "in less time; that is tried for each project."));
  if (drawn.changed) preferences.graphics = Graphics(graphics);
  saveIf(context, drawn, "preferences.graphics");
  ImGui::PopID();
}

void drawStart(PanelContext& context) {
  Preferences& preferences = context.session().preferences();
  heading(context, tr("Start"));
  const std::array<ui::Choice, 3> kChoices = {
      ui::Choice{tr("The sample project"),
                 tr("Where one is installed, or the program was started with one, as by ./run."), true, ""},
      ui::Choice{tr("The last project"), tr("The sample, while there is none."), true, ""},
      ui::Choice{tr("Nothing"), "", true, ""}};
  int startUp = int(preferences.startUp);
  const ui::FieldEdit edit = ui::choiceField(tr("Open at start"), kChoices, startUp, kPreferencesLabelWidth,
                                             tr("When no file is named on the command line."));
  if (edit.changed) preferences.startUp = StartUp(startUp);
  saveIf(context, edit, "preferences.startUp");
  bool guide = !preferences.guideSeen;
  const ui::FieldEdit guided = ui::checkField(tr("Guided start"), guide, kPreferencesLabelWidth,
                                              tr("Shown at the next start. It is in the Help menu, too."));
  if (guided.changed) preferences.guideSeen = !guide;
  saveIf(context, guided, "preferences.guide");
}

}  // namespace

bool drawPreferences(PanelContext& context) {
  const float footer = ImGui::GetFrameHeightWithSpacing() + ui::scaled(14);
  const float most = std::max(ui::scaled(60), ImGui::GetIO().DisplaySize.y - ui::scaled(90) - footer);
  ImGui::BeginChild("##fields", {0, std::min(most, ui::scaled(520))});
  drawLook(context);
  drawWork(context);
  drawWalk(context);
  drawStart(context);
  ImGui::EndChild();
  ImGui::Dummy({0, ui::scaled(4)});
  if (ui::button(tr("Reset to defaults"))) {
    context.session().preferences().resetSettings();
    context.session().savePreferencesNow();
    context.session().walkMemoryChanged();
  }
  context.log.item("preferences.reset");
  ui::tooltip(tr("All of the above as at the first start. Recent projects and the window's layout stay."));
  ImGui::SameLine();
  actionButton(context, "window.resetLayout", ButtonLook::plain);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - dialogButtonWidth());
  const bool close = ui::primaryButton(tr("Close"), {dialogButtonWidth(), 0});
  context.log.item("dialog.ok");
  return close;
}

}  // namespace acentric::editor
