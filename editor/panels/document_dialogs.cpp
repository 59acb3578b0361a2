#include "editor/panels/document_dialogs.h"
#include "editor/panels/bake_panel.h"

#include <fmt/format.h>

#include <utility>

#include "editor/panels/import_fields.h"
#include "editor/session/engine_texts.h"
#include "engine/pipeline/new_project.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr float kDialogLabelWidth = 150;
constexpr float kWideButton = 128;

/// Buttons from left to right; logged as "dialog.NAME".
class ButtonRow {
 public:
  ButtonRow(PanelContext& context, int buttons, float width) : context_(context), width_(width) {
    alignButtons(buttons, width);
  }
  bool button(const char* label, const char* name, bool primary = false) {
    if (!std::exchange(first_, false)) ImGui::SameLine();
    const bool pressed = primary ? ui::primaryButton(label, {width_, 0}) : ui::button(label, {width_, 0});
    context_.log.item(std::string("dialog.") + name);
    return pressed;
  }

 private:
  PanelContext& context_;
  float width_;
  bool first_ = true;
};

/// What was derived for the model that has just been opened.
void fillDraft(NewProjectDraft& draft, const Session& session) {
  const LayoutSpec& spec = session.project().layout();
  draft.configuration = spec.configuration;
  draft.cellSize = spec.cellSize;
  draft.eyeHeight = spec.eyeHeight;
  draft.derived = true;
  draft.generation = session.generation();
}

/// As the project that was made has it, else as one of another configuration would, were all laid out.
double derivedCell(const Project& project, Configuration configuration) {
  if (configuration == project.layout().configuration) return project.layout().cellSize;
  return firstCellSize(project.layout().outline.area(), configuration);
}

/// Opens the model anew: what it is laid out on, and for, depends on these.
void importAgain(Session& session, const NewProjectDraft& draft, const ImportOptions& import) {
  NewProjectOptions options;
  options.import = import;
  session.openNew(draft.model, options);
}

/// How large the model is, whether that can be, and which way is up: nothing fits where these are wrong.
void drawModel(PanelContext& context, const NewProjectDraft& draft) {
  Session& session = context.session();
  const Scene& scene = *session.built()->scene;
  const glm::dvec3 size(scene.bounds.size());
  ui::keyValue(tr("Model"),
               trf("{} x {} in plan, {} high", ui::formatMetres(size.x), ui::formatMetres(size.y),
                   ui::formatMetres(size.z)),
               kDialogLabelWidth);
  ImportOptions import = session.project().import;
  bool again = upAxisField(import.up, kDialogLabelWidth).finished;
  context.log.item("new.up");
  double metres = scene.report.metresPerUnit;
  if (metresPerUnitField(metres, kDialogLabelWidth)) import.metresPerUnit = metres, again = true;
  context.log.item("new.metresPerUnit");
  const auto inspection = session.inspection();
  if (inspection && inspection->scale && session.project().import.metresPerUnit == 0) {
    const ScaleDoubt& doubt = *inspection->scale;
    ui::wrappedText(ui::palette::warning, trf("Is the scale right? {}.", engineText(doubt.text)));
    if (ui::button(trf("Scale to {:g}", doubt.metresPerUnit).c_str()))
      import.metresPerUnit = doubt.metresPerUnit, again = true;
    context.log.item("new.scale");
  }
  if (again) importAgain(session, draft, import);
}

/// What was found to walk on, how much of it is laid out, and what baking it takes.
void drawFound(const Session& session, const std::string& name) {
  const Storey& storey = session.project().current();
  const double laidOut = storey.layout.outline.area();
  const double all = storey.walkable.empty() ? laidOut : storey.walkable.area();
  std::string text = trf("{}: {} to walk on were found", name, ui::formatArea(all));
  if (!storey.walkable.empty() && session.project().storeys.size() > 1)
    text +=
        trf(", of which {} are laid out: as much as bakes in about {:g} minutes here, or a few cells of "
            "each storey. Draw a larger or another outline to have more",
            ui::formatArea(laidOut), kUsualBakeMinutes);
  else if (!storey.walkable.empty())
    text +=
        trf(", of which {} are laid out: as much as bakes in about {:g} minutes here, {} captures at "
            "most. Draw a larger or another outline to have more",
            ui::formatArea(laidOut), kUsualBakeMinutes, ui::formatCount(std::uint64_t(kUsualMostCameras)));
  else if (const std::size_t bare = storey.layout.removed.size(); bare > 0)
    text += trfMany("; {} cell with hardly any of it is left out",
                    "; {} cells with hardly any of it are left out", bare, bare);
  ui::wrappedText(ui::palette::muted, trf("{}. All of this can be changed later.", text));
  std::string plan = trf("{} captures", ui::formatCount(session.built()->layout->cameras.size()));
  if (const auto forecast = session.knownForecast())
    plan += trf(": about {} to bake with {}, {} on disk", ui::formatDuration(forecast->seconds()),
                threadsText(session.bakeThreads()), ui::formatBytes(std::uint64_t(forecast->bytes())));
  else if (session.estimating().running())
    plan += tr(": what baking them takes is being estimated…");
  ui::wrappedText(ui::palette::muted, plan);
}

void drawDraft(PanelContext& context, NewProjectDraft& draft) {
  std::vector<ui::Choice> choices;
  for (int i = 0; i <= int(Configuration::g); ++i)
    choices.push_back(
        {fmt::format("{}   {}", nameOf(Configuration(i)), tr(describe(Configuration(i)))), "", true});
  int index = int(draft.configuration);
  ui::choiceField(tr("Configuration"), choices, index, kDialogLabelWidth,
                  tr("How panoramas are placed: angle of a camera and the polygons of the lattice."));
  context.log.item("new.configuration");
  draft.configuration = Configuration(index);
  if (draft.derived) draft.cellSize = derivedCell(context.session().project(), draft.configuration);
  const ui::FieldEdit size = ui::numberField(
      {tr("Cell size"), "%.4g m", 0.01, kLeastCellSize, kLargestCellSize,
       tr("Edge length of the polygons. At first about a dozen rings fill the walkable area.")},
      draft.cellSize, kDialogLabelWidth);
  context.log.item("new.cellSize");
  if (size.changed) draft.derived = false;
  ui::numberField({tr("Eye height"), "%.2f m", 0.005, 0.05, 1000,
                   tr("Of every capture and of the walk, above the floor.")},
                  draft.eyeHeight, kDialogLabelWidth);
  context.log.item("new.eyeHeight");
  ui::checkField(tr("All storeys"), draft.everyStorey, kDialogLabelWidth,
                 tr("A layout on each floor that is found, not only on the largest."));
  context.log.item("new.everyStorey");
}

}  // namespace

void drawNewProject(PanelContext& context, const DialogKeys& keys) {
  EditorState& state = context.state();
  Session& session = context.session();
  NewProjectDraft& draft = state.draft;
  std::error_code error;
  const bool ready =
      session.hasProject() && session.untitled() &&
      std::filesystem::equivalent(sceneFileOf(session.file(), session.project()), draft.model, error);
  if (!ready) {  // opening it failed, or was cancelled
    state.dialog = Dialog::none;
    return;
  }
  if (draft.generation != session.generation()) {
    fillDraft(draft, session);
    session.glanceAtBake();
  }
  if (!beginDialog(trLater("New project"), 560)) return;
  drawFound(session, draft.model.filename().string());
  ImGui::Dummy({0, 4});
  drawModel(context, draft);
  drawDraft(context, draft);
  ButtonRow row(context, 2, dialogButtonWidth());
  const bool cancel = row.button(tr("Cancel"), "cancel") || keys.escape;
  const bool typed = keys.enter && !ImGui::GetIO().WantTextInput;  // else it ends what is typed
  const bool create = row.button(tr("Create"), "create", true) || typed;
  if (cancel) session.close();
  if (create) {
    NewProjectOptions options;
    options.import = session.project().import;
    options.configuration = draft.configuration;
    options.cellSize = draft.derived ? 0 : draft.cellSize;
    options.eyeHeight = draft.eyeHeight;
    options.everyStorey = draft.everyStorey;
    const LayoutSpec& spec = session.project().layout();
    const bool asDerived = draft.configuration == spec.configuration && draft.derived &&
                           draft.eyeHeight == spec.eyeHeight && !draft.everyStorey;
    if (!asDerived) session.openNew(draft.model, options);
  }
  if (cancel || create) state.dialog = Dialog::none;
  endDialog(cancel || create);
}

void drawLockQuestion(PanelContext& context, const DialogKeys& keys) {
  Session& session = context.session();
  if (!beginDialog(trLater("Open in another editor"), 600)) return;
  ui::wrappedText(ui::palette::text,
                  trf("{} is open at {}. What both save would overwrite each other.",
                      session.file().filename().string(), engineText(describe(*session.lockedBy()))));
  ButtonRow row(context, 3, ui::scaled(kWideButton));
  const bool takeOver = row.button(tr("Take over"), "takeOver");
  ui::tooltip(tr("The other editor becomes read-only. For one that no longer answers."));
  const bool copy = row.button(tr("Open a copy"), "copy");
  ui::tooltip(tr("Saved beside it under a name of its own, with the captures."));
  const bool readOnly = row.button(tr("Read-only"), "readOnly", true) || keys.enter || keys.escape;
  if (takeOver) session.answerLock(LockAnswer::takeOver);
  if (copy) session.answerLock(LockAnswer::copy);
  if (readOnly) session.answerLock(LockAnswer::readOnly);
  endDialog(takeOver || copy || readOnly);
}

void drawChangedOnDisk(PanelContext& context, const DialogKeys& keys) {
  EditorState& state = context.state();
  if (!beginDialog(trLater("Changed by another program"), 620)) return;
  ui::wrappedText(
      ui::palette::text,
      context.session().file().filename().string() +
          tr(" was changed on disk since it was opened or saved here. Reloading takes that state as an "
             "edit: undo brings yours back."));
  ButtonRow row(context, 4, ui::scaled(kWideButton));
  const bool cancel = row.button(tr("Cancel"), "cancel") || keys.escape;
  const bool overwrite = row.button(tr("Overwrite"), "overwrite");
  const bool reloading = row.button(tr("Reload"), "reload");
  const bool elsewhere = row.button(tr("Save as…"), "saveAs", true) || keys.enter;
  if (cancel || overwrite || reloading || elsewhere) {
    state.dialog = elsewhere ? Dialog::saveAs : Dialog::none;
    const Continuation then = elsewhere ? state.continuation : std::exchange(state.continuation, {});
    if (overwrite) overwriteThen(context.actions, then);
    if (reloading) reload(context.actions);
  }
  endDialog(cancel || overwrite || reloading || elsewhere);
}

void drawMissingModel(PanelContext& context, const DialogKeys& keys) {
  Session& session = context.session();
  if (!beginDialog(trLater("The model is missing"), 600)) return;
  ui::wrappedText(
      ui::palette::text,
      trf("{} is not there. {}", sceneFileOf(session.file(), session.project()).string(),
          session.sceneFiles().fromCache ? tr("The project is shown with the model as it was last "
                                              "imported: it can be edited, baked and walked.")
                                         : tr("The layout can be edited, but there is nothing to bake "
                                              "or to walk through until the model is found.")));
  ButtonRow row(context, 2, ui::scaled(kWideButton));
  const bool later = row.button(tr("Not now"), "later") || keys.escape;
  const bool locate = row.button(tr("Locate…"), "locate", true) || keys.enter;
  if (later || locate) session.answerLocate();
  if (locate) context.state().dialog = Dialog::locateScene;
  endDialog(later || locate);
}

void drawOutsideModel(PanelContext& context, const DialogKeys& keys) {
  Session& session = context.session();
  const Session::OutsideModel& outside = *session.outsideModel();
  if (!beginDialog(trLater("The model lies outside the project"), 640)) return;
  ui::wrappedText(ui::palette::text,
                  trf("{} names its model as {}. A project's model now lies in the project's folder, so "
                      "that the folder can be moved and shared as a whole.",
                      outside.projectFile.filename().string(), outside.scene.string()));
  ButtonRow row(context, 3, ui::scaled(kWideButton));
  const bool cancel = row.button(tr("Cancel"), "cancel") || keys.escape;
  const bool link = row.button(tr("Link to it"), "link");
  ui::tooltip(tr("Makes a link to the model where it lies. The project works on this machine only."));
  const bool bring = row.button(tr("Bring it in"), "bring", true) || keys.enter;
  ui::tooltip(
      tr("Puts the model and the files it names into a folder 'models' beside the project. The originals "
         "stay."));
  if (bring || link || cancel)
    session.answerOutside(bring  ? std::optional(Collect::files)
                          : link ? std::optional(Collect::link)
                                 : std::nullopt);
  endDialog(bring || link || cancel);
}

}  // namespace acentric::editor
