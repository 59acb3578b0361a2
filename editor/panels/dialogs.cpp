#include "editor/panels/dialogs.h"

#include <utility>

#include "editor/panels/bake_panel.h"
#include "editor/panels/dialog_frame.h"
#include "editor/panels/document_dialogs.h"
#include "editor/panels/preferences_dialog.h"
#include "editor/panels/publish_panel.h"
#include "editor/session/project_files.h"
#include "engine/export/bundle.h"
#include "ui/keys.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

std::vector<std::string> modelEndings() {
  return {".glb", ".gltf", ".obj", ".ply", ".stl", ".fbx", ".dae", ".off", ".3ds", ".blend", ".x"};
}

std::vector<std::string> allEndings() {
  std::vector<std::string> endings = modelEndings();
  endings.insert(endings.begin(), {kProjectEnding, kWalkEnding, kBundleIndex});
  return endings;
}

void giveClipboard(PanelContext& context) {
  const std::string text = std::exchange(context.state().toClipboard, {});
  if (text.empty()) return;
  ImGui::SetClipboardText(text.c_str());
  context.log.event("clipboard", text);
  context.session().messages().add(MessageLevel::info, trf("Copied {}", text));
}

}  // namespace

bool Dialogs::anyOpen() const {
  return open_ || browser_.isOpen() || commands_.isOpen() || !failures_.empty();
}

void Dialogs::handleKeys(std::vector<ui::InputEvent>& events) {
  enter_ = escape_ = false;
  std::erase_if(events, [this](const ui::InputEvent& event) {
    if (browser_.handleKey(event) || commands_.handleKey(event)) return true;
    if (!open_ || event.kind != ui::InputEvent::Kind::keyPress) return false;
    const bool enter = event.code == ui::key::enter || event.code == ui::key::keypadEnter;
    enter_ = enter_ || (enter && !ImGui::GetIO().NavVisible);  // else it presses what is lit
    escape_ = escape_ || event.code == ui::key::escape;
    return true;
  });
}

void Dialogs::openFileDialogs(PanelContext& context) {
  EditorState& state = context.state();
  Session& session = context.session();
  if (browser_.isOpen()) return;
  const auto browse = [&](const char* title, const std::filesystem::path& folder,
                          std::vector<std::string> endings, ui::FileBrowser::Chosen chosen) {
    state.dialog = Dialog::none;
    browser_.open({title, false, folder, "", std::move(endings)}, std::move(chosen));
  };
  const std::filesystem::path& last = session.preferences().lastFolder;
  if (state.dialog == Dialog::openFile) {
    browse(tr("Open a project, a walk or a model"), last, allEndings(),
           [&session](const std::filesystem::path& file) { session.open(file); });
  } else if (state.dialog == Dialog::newFile) {
    browse(tr("Choose a model for a new project"), last, modelEndings(),
           [&session, &state](const std::filesystem::path& file) {
             session.open(file);
             state.draft = {file};
             state.dialog = Dialog::newProject;
           });
  } else if (state.dialog == Dialog::locateScene) {
    browse(tr("Where is the model?"), session.file().parent_path(), modelEndings(),
           [&session](const std::filesystem::path& file) { session.locateScene(file); });
  } else if (state.dialog == Dialog::exportPath) {
    state.dialog = Dialog::none;
    const WalkPath* path = state.walkSelection.path(session.project());
    if (path == nullptr) return;
    browser_.open(
        {trf("Export {}", path->name), true, session.file().parent_path(), path->name + ".json", {".json"}},
        [&session, number = state.walkSelection.number](const std::filesystem::path& file) {
          session.exportPath(number, file);
        });
  } else if (state.dialog == Dialog::saveAs) {
    state.dialog = Dialog::none;
    const Continuation then = std::exchange(state.continuation, {});
    const bool baking = then.kind == Continuation::Kind::bake;
    browser_.open({tr(baking ? trLater("Save the project first: captures are kept beside it")
                             : trLater("Save the project")),
                   true,
                   session.file().parent_path(),
                   session.readOnly() ? freeCopyName(session.file()).filename().string()
                                      : session.file().filename().string(),
                   {kProjectEnding}},
                  [&session, &state, then](const std::filesystem::path& file) {
                    ActionContext actions{session, state};
                    saveAsThen(actions, file, then);
                  });
  }
}

/// A model that was opened straight away is asked about like a new project where its scale is in doubt.
void Dialogs::askAboutScale(PanelContext& context) {
  EditorState& state = context.state();
  const Session& session = context.session();
  if (!session.hasProject()) return judged_.clear();
  if (!session.untouched()) return;
  const std::filesystem::path model = sceneFileOf(session.file(), session.project());
  if (state.dialog == Dialog::newProject) judged_ = model;
  const auto inspection = session.inspection();
  if (!inspection || judged_ == model || state.dialog != Dialog::none) return;
  judged_ = model;
  if (!inspection->scale || session.project().import.metresPerUnit != 0) return;
  state.draft = {model};
  state.dialog = Dialog::newProject;
}

void Dialogs::drawFailure(PanelContext& context) {
  if (!beginDialog(trLater("That did not work"), 560)) return;
  ui::wrappedText(ui::palette::text, failures_.front());
  alignButtons(1);
  const bool done = ui::primaryButton(tr("OK"), {dialogButtonWidth(), 0}) || enter_ || escape_;
  context.log.item("dialog.ok");
  if (done) failures_.pop_front();
  endDialog(done);
}

void Dialogs::drawUnsavedChanges(PanelContext& context) {
  EditorState& state = context.state();
  if (!beginDialog(trLater("Unsaved changes"), 520)) return;
  ui::wrappedText(ui::palette::text,
                  trf("Save the changes to {} first?", context.session().file().filename().string()));
  alignButtons(3);
  const bool cancel = ui::button(tr("Cancel"), {dialogButtonWidth(), 0}) || escape_;
  context.log.item("dialog.cancel");
  ImGui::SameLine();
  const bool discard = ui::button(tr("Discard"), {dialogButtonWidth(), 0});
  context.log.item("dialog.discard");
  ImGui::SameLine();
  const bool save = ui::primaryButton(tr("Save"), {dialogButtonWidth(), 0}) || enter_;
  context.log.item("dialog.save");
  if (cancel || discard || save) {
    state.dialog = Dialog::none;
    const Continuation then = std::exchange(state.continuation, {});
    if (save)
      saveThen(context.actions, then);
    else if (discard)
      proceed(context.actions, then);
  }
  endDialog(cancel || discard || save);
}

void Dialogs::drawRecovery(PanelContext& context) {
  if (!beginDialog(trLater("Recover unsaved changes?"), 560)) return;
  ui::wrappedText(ui::palette::text, tr("The last run ended without saving. Its last autosave differs from "
                                        "the file. The file itself is as you "
                                        "saved it."));
  alignButtons(2);
  const bool discard = ui::button(tr("Discard"), {dialogButtonWidth(), 0});
  context.log.item("dialog.discard");
  ImGui::SameLine();
  const bool recover = ui::primaryButton(tr("Recover"), {dialogButtonWidth(), 0}) || enter_;
  context.log.item("dialog.recover");
  if (discard || recover) context.session().answerRecovery(recover);
  endDialog(discard || recover);
}

void Dialogs::drawOpening(PanelContext& context) {
  const Job& job = context.session().opening();
  if (!beginDialog(trLater("Opening"), 520)) return;
  ui::wrappedText(ui::palette::text, job.label());
  ui::progressBar(progressFraction(job), progressText(job), context.now);
  alignButtons(1);
  const bool cancel = ui::button(tr("Cancel"), {dialogButtonWidth(), 0}, !job.cancelling()) || escape_;
  context.log.item("dialog.cancel");
  if (cancel) context.session().cancelOpening();
  endDialog(false);
}

void Dialogs::drawPreferencesDialog(PanelContext& context) {
  if (!beginDialog(trLater("Preferences"), 560)) return;
  const bool done = drawPreferences(context) || escape_;
  if (done) context.state().dialog = Dialog::none;
  endDialog(done);
}

void Dialogs::drawAbout(PanelContext& context) {
  if (!beginDialog(trLater("About Acentric"), 520)) return;
  ui::wrappedText(
      ui::palette::text,
      tr("Acentric: walkthroughs made of acentric panorama views. Lay a tessellation, bake, walk."));
  ImGui::Dummy({0, 2});
  ui::wrappedText(ui::palette::faint, context.window.graphicsDescription());
  if (context.window.fonts().icons != nullptr)
    ui::wrappedText(ui::palette::faint, tr("Icons: Fork Awesome, forkaweso.me, SIL Open Font License 1.1."));
  alignButtons(1);
  const bool done = ui::primaryButton(tr("Close"), {dialogButtonWidth(), 0}) || enter_ || escape_;
  context.log.item("dialog.ok");
  if (done) context.state().dialog = Dialog::none;
  endDialog(done);
}

void Dialogs::draw(PanelContext& context) {
  giveClipboard(context);
  openFileDialogs(context);
  askAboutScale(context);
  open_ = false;
  if (browser_.isOpen()) return browser_.draw(context.log);
  open_ = true;
  if (!failures_.empty()) return drawFailure(context);
  if (context.session().opening().running()) return drawOpening(context);
  if (context.session().recoveryOffered()) return drawRecovery(context);
  const DialogKeys keys{enter_, escape_};
  if (context.session().lockQuestion()) return drawLockQuestion(context, keys);
  if (context.session().locateQuestion()) return drawMissingModel(context, keys);
  if (context.session().outsideModel()) return drawOutsideModel(context, keys);
  switch (context.state().dialog) {
    case Dialog::newProject:
      return drawNewProject(context, keys);
    case Dialog::changedOnDisk:
      return drawChangedOnDisk(context, keys);
    case Dialog::unsavedChanges:
      return drawUnsavedChanges(context);
    case Dialog::preferences:
      return drawPreferencesDialog(context);
    case Dialog::publish:
      return drawPublishDialog(context, keys);
    case Dialog::about:
      return drawAbout(context);
    case Dialog::none:
    case Dialog::openFile:
    case Dialog::newFile:
    case Dialog::locateScene:
    case Dialog::exportPath:
    case Dialog::saveAs:
    case Dialog::commands:
    case Dialog::shortcuts:
      break;
  }
  open_ = false;
  commands_.draw(context);
}

}  // namespace acentric::editor
