#include "editor/panels/dialogs.h"

#include <array>
#include <utility>

#include "editor/panels/bake_panel.h"
#include "editor/session/project_files.h"
#include "ui/keys.h"

namespace acentric::editor {
namespace {

constexpr float kButtonWidth = 112;

/// A modal in the middle of the window; call endDialog() if true. `id` is also its title.
bool beginDialog(const char* id, float width) {
  if (!ImGui::IsPopupOpen(id)) ImGui::OpenPopup(id);
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({width, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {18, 14});
  const bool open = ImGui::BeginPopupModal(
      id, nullptr, ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove);
  ImGui::PopStyleVar();
  return open;
}

void endDialog(bool close) {
  if (close) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void alignRight(int buttons) {
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  ImGui::Dummy({0, 6});
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - float(buttons) * kButtonWidth -
                       float(buttons - 1) * spacing);
}

std::vector<std::string> modelEndings() {
  return {kProjectEnding, ".glb", ".gltf", ".obj", ".ply",   ".stl",
          ".fbx",         ".dae", ".off",  ".3ds", ".blend", ".x"};
}

}  // namespace

bool Dialogs::anyOpen() const { return open_ || browser_.isOpen() || !failures_.empty(); }

void Dialogs::handleKeys(std::vector<ui::InputEvent>& events) {
  enter_ = escape_ = false;
  std::erase_if(events, [this](const ui::InputEvent& event) {
    if (browser_.handleKey(event)) return true;
    if (!open_ || event.kind != ui::InputEvent::Kind::keyPress) return false;
    enter_ = enter_ || event.code == ui::key::enter || event.code == ui::key::keypadEnter;
    escape_ = escape_ || event.code == ui::key::escape;
    return true;
  });
}

void Dialogs::openFileDialogs(PanelContext& context) {
  EditorState& state = context.state();
  Session& session = context.session();
  if (browser_.isOpen()) return;
  if (state.dialog == Dialog::openFile) {
    state.dialog = Dialog::none;
    browser_.open({"Open a project or a model", false, session.preferences().lastFolder, "", modelEndings()},
                  [&session](const std::filesystem::path& file) { session.open(file); });
  } else if (state.dialog == Dialog::saveAs) {
    state.dialog = Dialog::none;
    const Continuation then = std::exchange(state.continuation, {});
    browser_.open({"Save the project",
                   true,
                   session.file().parent_path(),
                   session.file().filename().string(),
                   {kProjectEnding}},
                  [&session, &state, then](const std::filesystem::path& file) {
                    ActionContext actions{session, state};
                    saveAsThen(actions, file, then);
                  });
  }
}

void Dialogs::drawFailure(PanelContext& context) {
  if (!beginDialog("That did not work", 560)) return;
  ui::wrappedText(ui::palette::text, failures_.front());
  alignRight(1);
  const bool done = ui::primaryButton("OK", {kButtonWidth, 0}) || enter_ || escape_;
  context.log.item("dialog.ok");
  if (done) failures_.pop_front();
  endDialog(done);
}

void Dialogs::drawUnsavedChanges(PanelContext& context) {
  EditorState& state = context.state();
  if (!beginDialog("Unsaved changes", 520)) return;
  ui::wrappedText(ui::palette::text,
                  "Save the changes to " + context.session().file().filename().string() + " first?");
  alignRight(3);
  const bool cancel = ui::button("Cancel", {kButtonWidth, 0}) || escape_;
  context.log.item("dialog.cancel");
  ImGui::SameLine();
  const bool discard = ui::button("Discard", {kButtonWidth, 0});
  context.log.item("dialog.discard");
  ImGui::SameLine();
  const bool save = ui::primaryButton("Save", {kButtonWidth, 0}) || enter_;
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
  if (!beginDialog("Recover unsaved changes?", 560)) return;
  ui::wrappedText(
      ui::palette::text,
      "The last run ended without saving. Its last autosave differs from the file. The file itself is as you "
      "saved it.");
  alignRight(2);
  const bool discard = ui::button("Discard", {kButtonWidth, 0});
  context.log.item("dialog.discard");
  ImGui::SameLine();
  const bool recover = ui::primaryButton("Recover", {kButtonWidth, 0}) || enter_;
  context.log.item("dialog.recover");
  if (discard || recover) context.session().answerRecovery(recover);
  endDialog(discard || recover);
}

void Dialogs::drawOpening(PanelContext& context) {
  const Job& job = context.session().opening();
  if (!beginDialog("Opening", 520)) return;
  ui::wrappedText(ui::palette::text, job.label());
  ui::progressBar(progressFraction(job), progressText(job), context.now);
  alignRight(1);
  const bool cancel = ui::button("Cancel", {kButtonWidth, 0}, !job.cancelling()) || escape_;
  context.log.item("dialog.cancel");
  if (cancel) context.session().cancelOpening();
  endDialog(false);
}

void Dialogs::drawShortcuts(PanelContext& context) {
  if (!beginDialog("Keys and mouse", 620)) return;
  const auto row = [](const std::string& keys, const std::string& what) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ui::wrappedText(ui::palette::accent, keys);
    ImGui::TableNextColumn();
    ui::wrappedText(ui::palette::text, what);
  };
  if (ImGui::BeginTable("##keys", 2, ImGuiTableFlags_SizingStretchProp)) {
    ImGui::TableSetupColumn("", 0, 0.36F);
    ImGui::TableSetupColumn("", 0, 0.64F);
    row("W A S D, arrows", "walk; Shift: faster");
    row("Page Up, Page Down", "raise and lower the eye within the range that is baked");
    row("Q E, or drag in the walk", "look around");
    row("Wheel, right or middle drag", "zoom and pan the plan");
    row("Ctrl+click, Shift+click a cell", "remove it; add it to the selection");
    row("Double click a number", "type a value");
    for (const Action& action : context.table)
      if (action.shortcut.key != 0) row(describe(action.shortcut), action.label);
    ImGui::EndTable();
  }
  alignRight(1);
  const bool done = ui::primaryButton("Close", {kButtonWidth, 0}) || enter_ || escape_;
  context.log.item("dialog.ok");
  if (done) context.state().dialog = Dialog::none;
  endDialog(done);
}

void Dialogs::drawAbout(PanelContext& context) {
  if (!beginDialog("About Acentric", 520)) return;
  ui::wrappedText(ui::palette::text,
                  "Acentric: walkthroughs made of acentric panorama views. Lay a tessellation, bake, walk.");
  ImGui::Dummy({0, 2});
  ui::wrappedText(ui::palette::faint, context.window.graphicsDescription());
  alignRight(1);
  const bool done = ui::primaryButton("Close", {kButtonWidth, 0}) || enter_ || escape_;
  context.log.item("dialog.ok");
  if (done) context.state().dialog = Dialog::none;
  endDialog(done);
}

void Dialogs::draw(PanelContext& context) {
  openFileDialogs(context);
  open_ = false;
  if (browser_.isOpen()) return browser_.draw(context.log);
  open_ = true;
  if (!failures_.empty()) return drawFailure(context);
  if (context.session().opening().running()) return drawOpening(context);
  if (context.session().recoveryOffered()) return drawRecovery(context);
  switch (context.state().dialog) {
    case Dialog::unsavedChanges:
      return drawUnsavedChanges(context);
    case Dialog::shortcuts:
      return drawShortcuts(context);
    case Dialog::about:
      return drawAbout(context);
    case Dialog::none:
    case Dialog::openFile:
    case Dialog::saveAs:
      break;
  }
  open_ = false;
}

}  // namespace acentric::editor
