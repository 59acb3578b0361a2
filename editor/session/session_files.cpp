/// Session's dealings with files: opening, saving, autosave, recent files.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "editor/session/engine_texts.h"
#include "editor/session/project_files.h"
#include "editor/session/session.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace fs = std::filesystem;

Result<Session::Opened> Session::openNow(const fs::path& file, const NewProjectOptions& options,
                                         const Job::Context& context) const {
  std::error_code error;
  if (!fs::exists(file, error)) return fail(ErrorKind::notFound, tr("no such file"), file.string());
  if (const fs::path walk = shippedWalkOf(file); !walk.empty()) return openShipped(walk, context);
  Opened opened;
  fs::path projectFile = file;
  Result<Project> project = Project{};
  if (isProjectFile(file)) {
    opened.saved = stampOf(file);
    project = loadProject(file);
  } else if (isUnsavedWork(file)) {
    const auto work = readUnsavedWork(file);
    if (!work) return tl::unexpected(work.error());
    projectFile = work->projectFile;
    project = work->project;
    opened.recovered = file;
  } else {
    TaskRunner runner(processors_ - 1);
    auto made = makeProject(file, suggestedProjectFile(file), options, options_.importHost, runner,
                            context.progress(), context.stop());
    if (!made) return tl::unexpected(made.error());
    opened.open = std::move(made->open), opened.untitled = true;
    return opened;
  }
  if (!project) return tl::unexpected(project.error());
  opened.untitled = !isProjectFile(file);
  auto open = openUnsaved(projectFile, *project, options_.importHost, context.progress(), context.stop());
  if (!open && !fs::exists(sceneFileOf(projectFile, *project), error)) {
    opened.withoutModel = true;
    open = openWithoutModel(projectFile, *project, options_.importHost, context.progress(), context.stop());
  }
  if (!open) return tl::unexpected(open.error());
  opened.open = std::move(*open);
  return opened;
}

Result<Session::Opened> Session::openShipped(const fs::path& walk, const Job::Context& context) const {
  TaskRunner runner(processors_ - 1);
  auto shipped = openShippedWalk(walk, runner, context.progress(), context.stop(), options_.regionsAtOnce);
  if (!shipped) return tl::unexpected(shipped.error());
  Opened opened;
  opened.open = openProject(**shipped, projectOf(**shipped));
  opened.shipped = std::move(*shipped);
  return opened;
}

void Session::open(const fs::path& file) { openWith(file, {}); }

void Session::openNew(const fs::path& model, const NewProjectOptions& options) { openWith(model, options); }

void Session::openWith(const fs::path& given, const NewProjectOptions& options) {
  std::error_code error;
  const fs::path absolute = fs::absolute(given, error);
  const fs::path file = error ? given : absolute.lexically_normal();
  outsideModel_.reset();
  opening_.restart(
      trf("Opening {}", file.filename().string()), [this, file, options](const Job::Context& context) {
        auto result = openNow(file, options, context);
        const auto outside = !result && isProjectFile(file) ? sceneOutside(file) : std::nullopt;
        context.post([this, file, outside, result = std::make_shared<Result<Opened>>(std::move(result))] {
          if (*result) return opened(std::move(**result));
          if (outside) {
            outsideModel_ = {file, *outside};
            return;
          }
          messages_.addFailure(trf("Opening {}", file.filename().string()), result->error());
        });
      });
}

void Session::opened(Opened opened) {
  close();
  shipped_ = opened.shipped;
  file_ = opened.open.file;
  untitled_ = opened.untitled;
  savedStamp_ = opened.saved;
  for (SweepWatch* watch : {&sweeping_, &proposing_})
    watch->watch(untitled_ || shipped_ ? fs::path() : file_);
  recovered_ = opened.recovered;
  history_.emplace(opened.open.project, !untitled_, historyBytes());
  ++generation_;
  if (!shipped_) {
    takeLock(false);
    lookForAutosave();
  }
  remember(file_);
  const std::size_t cameras = opened.open.layout->cameras.size();
  std::string size = trf("{} regions, {} cameras", opened.open.layout->regions.size(), cameras);
  if (const std::size_t storeys = opened.open.project.storeys.size(); storeys > 1)
    size = trf("{} storeys; {}: {}", storeys, opened.open.project.current().name, size);
  if (shipped_ && shipped_->pages)
    size = trf("{} regions, of which those around the eye are shown",
               ui::formatCount(shipped_->regionCount(opened.open.project.storey)));
  show(std::move(opened.open));
  const std::string from = !untitled_ ? trf("Opened {}", file_.filename().string())
                           : recovered_.empty()
                               ? trf("New project from {}", built_->project.scene.filename().string())
                               : trf("Recovered {}", file_.filename().string());
  messages_.add(MessageLevel::good, fmt::format("{}{}: {}", from, shipped_ ? tr(", a walk") : "", size));
  if (shipped_)
    for (const std::string& warning : shipped_->warnings)
      messages_.add(MessageLevel::warning, engineText(warning));
  else
    watchScene(opened.withoutModel);
  locateQuestion_ = opened.withoutModel;
  loadCaptures();
  drawBackdropIfStale();
}

void Session::close() {
  baking_.abandon();
  bakeGate_.open();
  loading_.abandon();
  counting_.abandon();
  rebuilding_.abandon();
  drawingBackdrop_.abandon();
  inspecting_.abandon();
  searching_.abandon();
  estimating_.abandon();
  watching_.abandon();
  comparing_.follow(std::nullopt);
  asking_.clear();
  variants_.forget();
  sweeping_.watch({}), proposing_.watch({});
  publishing_.close();
  estimate_.reset();
  inspection_.reset();
  inspected_.reset();
  if (hasProject() && !recovery_) forgetAutosave();
  history_.reset();
  shipped_.reset();
  reading_.abandon();
  lookedFor_.reset();
  readFrom_.clear();
  leaveFiles();
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

SaveObstacle Session::saveObstacle() {
  if (untitled_) return SaveObstacle::untitled;
  lookAtLock();
  if (readOnly()) return SaveObstacle::readOnly;
  // A file that is gone is simply written again.
  projectFileChanged_ = lookAt(file_).exists && differs(savedStamp_);
  return projectFileChanged_ ? SaveObstacle::changedOnDisk : SaveObstacle::none;
}

Status Session::save(bool overwrite) {
  if (!hasProject()) return {};
  if (shipped_) return fail(ErrorKind::invalidArgument, tr(kIsWalk), file_.string());
  history_->commitPreview();
  const SaveObstacle obstacle = saveObstacle();
  if (obstacle == SaveObstacle::readOnly)
    return fail(ErrorKind::unreadable, tr("is open in another editor: save under another name"),
                file_.string());
  if (obstacle == SaveObstacle::changedOnDisk && !overwrite)
    return fail(ErrorKind::unreadable, tr("was changed by another program meanwhile"), file_.string());
  if (Status saved = saveProject(project(), file_); !saved) return saved;
  forgetAutosave();
  untitled_ = false;
  savedNow();
  return {};
}

void Session::savedNow() {
  history_->markSaved();
  savedStamp_ = stampOf(file_);
  projectFileChanged_ = false;
  if (!lock_) takeLock(true);
  remember(file_);
  messages_.add(MessageLevel::good, trf("Saved {}", file_.filename().string()));
}

Status Session::reload() {
  if (!hasProject() || untitled_) return {};
  if (shipped_) return fail(ErrorKind::invalidArgument, tr(kIsWalk), file_.string());
  const FileStamp stamp = stampOf(file_);
  const auto found = loadProject(file_);
  if (!found) return tl::unexpected(found.error());
  if (!apply({*found, tr("Reload what another program saved")})) return {};
  history_->markSaved();
  savedStamp_ = stamp;
  projectFileChanged_ = false;
  return {};
}

Status Session::saveAs(const fs::path& target) {
  if (!hasProject()) return {};
  if (shipped_) return fail(ErrorKind::invalidArgument, tr(kIsWalk), file_.string());
  history_->commitPreview();
  std::error_code error;
  const fs::path file = fs::absolute(target, error).lexically_normal();
  const auto moved = movedProject(project(), file_, file, options_.importHost);
  if (!moved) return tl::unexpected(moved.error());
  if (const auto other = readLock(file); other && !isStale(*other) && !(lock_ && file == file_))
    return fail(ErrorKind::unreadable, trf("is open in another editor, at {}", engineText(describe(*other))),
                file.string());
  if (Status saved = saveProject(*moved, file); !saved) return saved;
  if (const auto shared = shareCaptures(file_, file); !shared)
    messages_.add(MessageLevel::warning, trf("The captures stayed behind and have to be baked again. {}",
                                             engineText(shared.error())));
  forgetAutosave();

  if (moved->scene != project().scene)
    messages_.add(MessageLevel::info, trf("The project's model is now {}", moved->scene.string()));
  // The history speaks of the model's path as seen from the old folder: it begins anew when that changed.
  if (*moved != project()) history_.emplace(*moved, true, historyBytes());
  leaveLock();
  file_ = file;
  untitled_ = false;
  sweeping_.watch(file_), proposing_.watch(file_);
  if (built_) {
    OpenProject open = *built_;
    open.file = file_;
    open.project.scene = moved->scene;
    built_ = std::make_shared<const OpenProject>(std::move(open));
    projectChanged();
    loadCaptures();
  }
  savedNow();
  return {};
}

void Session::exportPath(std::size_t path, const fs::path& file) {
  if (walkRefuses(tr("Exporting a path"))) return;
  const WalkPath& walk = project().paths[path];
  if (const Status saved = savePath(walk.path, file); !saved)
    return messages_.addFailure(trf("Exporting {}", walk.name), saved.error());
  messages_.add(MessageLevel::good,
                trf("Exported {} as {}: acentric walk {} --path {}", walk.name, file.filename().string(),
                    file_.filename().string(), file.filename().string()));
}

std::string Session::title() const {
  if (!hasProject()) return "Acentric";
  return fmt::format("{}{}{} – Acentric", dirty() ? "• " : "", file_.filename().string(),
                     shipped_     ? tr(" (walk)")
                     : readOnly() ? tr(" (read-only)")
                                  : "");
}

bool Session::worthAsking() const {
  // A new project of a model that was not touched is made again in a moment.
  return dirty() && !(untitled_ && !history_->canUndo() && recovered_.empty());
}

void Session::answerRecovery(bool recover) {
  if (!recovery_ || !hasProject()) return;
  const Project found = *std::exchange(recovery_, std::nullopt);
  if (recover) {
    apply({found, tr("Recover unsaved changes")});
    nextAutosave_ = 0;  // from now on this editor's own autosave keeps it
  } else {
    forgetAutosave();
  }
}

void Session::remember(const fs::path& file) {
  preferences_.lastFolder = file.parent_path();
  if (!untitled_) preferences_.addRecent(file);
  savePreferencesNow();
}

void Session::savePreferencesNow() {
  if (const Status saved = savePreferences(preferences_, options_.preferencesFile); !saved)
    messages_.add(MessageLevel::warning, trf("Preferences are not kept. {}", engineText(saved.error())));
}

/// Beside the project, unless it has no file yet or the file is another editor's.
fs::path Session::autosaveFile() const {
  if (shipped_) return {};
  if (!untitled_ && !readOnly()) return autosaveFileFor(file_);
  return options_.unsavedFolder.empty() ? fs::path() : unsavedWorkFile(options_.unsavedFolder, file_);
}

void Session::forgetAutosave() {
  std::error_code error;  // one that is not there is as good as removed
  if (const fs::path own = autosaveFile(); !own.empty()) fs::remove(own, error);
  if (!recovered_.empty()) fs::remove(recovered_, error);
  recovered_.clear();
  autosaved_.reset();
}

void Session::lookForAutosave() {
  if (readOnly()) return;  // another editor's, which is at work on it
  if (untitled_) {
    if (!recovered_.empty()) return;
    for (UnsavedWork& work : unsavedWork_)
      if (work.projectFile == file_ && work.project != project()) {
        recovery_ = std::move(work.project);
        recovered_ = work.autosave;
        return;
      }
    return;
  }
  auto found = recoverableAutosave(file_, project());
  if (found) {
    recovery_ = std::move(*found);
    return;
  }
  const fs::path aside = putAside(autosaveFileFor(file_));
  messages_.add(MessageLevel::warning,
                trf("What the last run autosaved cannot be read, and is kept as {}. {}",
                    aside.filename().string(), engineText(found.error())));
}

void Session::autosave(double now) {
  // What it held was undone: there is nothing to recover.
  if (autosaved_ && recovered_.empty() && !dirty()) forgetAutosave();
  if (!worthAsking() || now < nextAutosave_) return;
  nextAutosave_ = now + options_.autosaveSeconds.value_or(preferences_.autosaveSeconds);
  keepWork();
}

void Session::keepWork() {
  // An unanswered recovery must not be overwritten.
  if (!worthAsking() || recovery_ || autosaveFile().empty() || autosaved_ == project()) return;
  const Status written = untitled_ || readOnly() ? writeUnsavedWork(options_.unsavedFolder, file_, project())
                                                 : writeAutosave(project(), file_);
  notKept_.clear();
  if (written) {
    autosaved_ = project();
    std::error_code error;  // it is in this editor's own autosave now
    if (!recovered_.empty() && recovered_ != autosaveFile()) fs::remove(recovered_, error);
    return;
  }
  notKept_ = trf("Unsaved changes are not autosaved: {}", engineText(written.error()));
  messages_.add(MessageLevel::warning, trf("Autosave failed. {}", engineText(written.error())));
}

}  // namespace acentric::editor
