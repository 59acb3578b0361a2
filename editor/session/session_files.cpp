/// Session's dealings with files: opening, saving, autosave, recent files.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "editor/session/project_files.h"
#include "editor/session/session.h"

namespace acentric::editor {
namespace fs = std::filesystem;

Result<Session::Opened> Session::openNow(const fs::path& file, const Job::Context& context) const {
  std::error_code error;
  if (!fs::exists(file, error)) return fail(ErrorKind::notFound, "no such file", file.string());
  Opened opened;
  if (isProjectFile(file)) {
    auto open = openProject(file, options_.importHost, context.progress(), context.stop());
    if (!open) return tl::unexpected(open.error());
    opened.recovery = recoverableAutosave(file, open->project);
    opened.open = std::move(*open);
    return opened;
  }
  TaskRunner runner(processors_ - 1);
  const fs::path projectFile = suggestedProjectFile(file);
  const auto project =
      makeProject(file, projectFile, {}, options_.importHost, runner, context.progress(), context.stop());
  if (!project) return tl::unexpected(project.error());
  auto open = openUnsaved(projectFile, *project, options_.importHost, context.progress(), context.stop());
  if (!open) return tl::unexpected(open.error());
  opened.open = std::move(*open);
  opened.untitled = true;
  return opened;
}

void Session::open(const fs::path& given) {
  std::error_code error;
  const fs::path absolute = fs::absolute(given, error);
  const fs::path file = error ? given : absolute.lexically_normal();
  opening_.restart("Opening " + file.filename().string(), [this, file](const Job::Context& context) {
    auto result = openNow(file, context);
    context.post([this, file, result = std::make_shared<Result<Opened>>(std::move(result))] {
      if (*result) return opened(std::move(**result));
      messages_.addFailure("Opening " + file.filename().string(), result->error());
    });
  });
}

void Session::opened(Opened opened) {
  close();
  file_ = opened.open.file;
  untitled_ = opened.untitled;
  recovery_ = std::move(opened.recovery);
  history_.emplace(opened.open.project, !untitled_);
  ++generation_;
  remember(file_);
  const std::size_t regions = opened.open.layout->regions.size();
  const std::size_t cameras = opened.open.layout->cameras.size();
  show(std::move(opened.open));
  const std::string from = untitled_ ? "New project from " + built_->project.scene.filename().string()
                                     : "Opened " + file_.filename().string();
  messages_.add(MessageLevel::good, fmt::format("{}: {} regions, {} cameras", from, regions, cameras));
  loadCaptures();
  drawBackdropIfStale();
}

void Session::close() {
  baking_.abandon();
  bakeGate_.open();
  loading_.abandon();
  rebuilding_.abandon();
  drawingBackdrop_.abandon();
  inspecting_.abandon();
  searching_.abandon();
  estimating_.abandon();
  estimate_.reset();
  inspection_.reset();
  inspected_.reset();
  if (hasProject() && !untitled_ && !recovery_) removeAutosave(file_);
  history_.reset();
  built_.reset();
  dropStream();
  walk_.reset();
  simplifiedTold_.clear();
  captures_.reset();
  backdrop_.reset();
  backdropKey_ = {};
  recovery_.reset();
  lastBake_.reset();
  autosaved_.reset();
  loadWanted_ = false;
}

Status Session::save() {
  if (!hasProject()) return {};
  history_->commitPreview();
  if (Status saved = saveProject(project(), file_); !saved) return saved;
  untitled_ = false;
  history_->markSaved();
  removeAutosave(file_);
  autosaved_.reset();
  remember(file_);
  messages_.add(MessageLevel::good, "Saved " + file_.filename().string());
  return {};
}

Status Session::saveAs(const fs::path& target) {
  if (!hasProject()) return {};
  history_->commitPreview();
  std::error_code error;
  const fs::path file = fs::absolute(target, error).lexically_normal();
  const auto moved = movedProject(project(), file_, file);
  if (!moved) return tl::unexpected(moved.error());
  if (Status saved = saveProject(*moved, file); !saved) return saved;
  if (const auto shared = shareCaptures(file_, file); !shared)
    messages_.add(MessageLevel::warning,
                  "The captures stayed behind and have to be baked again. " + shared.error().describe());
  if (!untitled_) removeAutosave(file_);

  // The history speaks of the model's path as seen from the old folder: it begins anew when that changed.
  if (*moved != project())
    history_.emplace(*moved, true);
  else
    history_->markSaved();
  file_ = file;
  untitled_ = false;
  autosaved_.reset();
  if (built_) {
    OpenProject open = *built_;
    open.file = file_;
    open.project.scene = moved->scene;
    built_ = std::make_shared<const OpenProject>(std::move(open));
    projectChanged();
    loadCaptures();
  }
  remember(file_);
  messages_.add(MessageLevel::good, "Saved " + file_.filename().string());
  return {};
}

std::string Session::title() const {
  if (!hasProject()) return "Acentric";
  return fmt::format("{}{} – Acentric", dirty() ? "• " : "", file_.filename().string());
}

void Session::answerRecovery(bool recover) {
  if (!recovery_ || !hasProject()) return;
  const Project found = *std::exchange(recovery_, std::nullopt);
  if (recover) {
    apply({found, "Recover unsaved changes"});
  } else {
    removeAutosave(file_);
  }
}

void Session::remember(const fs::path& file) {
  preferences_.lastFolder = file.parent_path();
  if (!untitled_) preferences_.addRecent(file);
  savePreferencesNow();
}

void Session::savePreferencesNow() {
  if (const Status saved = savePreferences(preferences_, options_.preferencesFile); !saved)
    messages_.add(MessageLevel::warning, "Preferences are not kept. " + saved.error().describe());
}

void Session::autosave(double now) {
  // An unanswered recovery must not be overwritten, and an untitled project has no place of its own yet.
  if (!dirty() || untitled_ || recovery_ || now < nextAutosave_) return;
  nextAutosave_ = now + options_.autosaveSeconds;
  if (autosaved_ == project()) return;
  autosaved_ = project();
  if (const Status written = writeAutosave(project(), file_); !written)
    messages_.add(MessageLevel::warning, "Autosave failed. " + written.error().describe());
}

}  // namespace acentric::editor
