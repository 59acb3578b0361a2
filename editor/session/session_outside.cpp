/// Session's dealings with what others do to its files: locks, a model or a project that changes on disk. And
/// the list of problems.

#include <fmt/format.h>

#include "editor/commands/setting_edits.h"
#include "editor/session/engine_texts.h"
#include "editor/session/project_files.h"
#include "editor/session/session.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace fs = std::filesystem;

void Session::takeLock(bool force) {
  if (untitled_) return;
  ProjectLock::Attempt attempt = ProjectLock::take(file_, force);
  lock_ = std::move(attempt.lock);
  lockedBy_ = std::move(attempt.heldBy);
  lockQuestion_ = lockedBy_.has_value();
  if (!attempt.note.empty()) messages_.add(MessageLevel::warning, engineText(attempt.note));
}

void Session::leaveLock() {
  lock_.reset();
  lockedBy_.reset();
  lockQuestion_ = false;
}

void Session::leaveFiles() {
  leaveLock();
  savedStamp_ = {};
  projectFileChanged_ = false;
  recovered_.clear();
  notKept_.clear();
  locateQuestion_ = false;
  sceneWatch_.reset();
  watchedScene_.reset();
  sceneFiles_ = {};
  listUnsaved();
}

void Session::listUnsaved() {
  UnsavedWorks found = listUnsavedWork(options_.unsavedFolder);
  unsavedWork_ = std::move(found.works);
  for (const fs::path& file : found.damaged) {
    const fs::path aside = putAside(file);
    messages_.add(MessageLevel::warning,
                  aside.empty() ? tr("An autosave cannot be read.")
                                : trf("An autosave cannot be read, and is kept as {}", aside.string()));
  }
}

bool Session::isUnsavedWork(const fs::path& file) const {
  return !options_.unsavedFolder.empty() && file.parent_path() == options_.unsavedFolder;
}

void Session::answerLock(LockAnswer answer) {
  if (!std::exchange(lockQuestion_, false) || !hasProject()) return;
  if (answer == LockAnswer::takeOver) {
    takeLock(true);
    return lookForAutosave();
  }
  if (answer == LockAnswer::copy)
    if (const Status saved = saveAs(freeCopyName(file_)); !saved)
      messages_.addFailure(tr("Making a copy"), saved.error());
}

void Session::lookAtLock() {
  if (!lock_) return;
  auto other = lock_->lostTo();
  if (!other) return;
  lock_.reset();
  messages_.add(MessageLevel::warning, trf("{} was taken over by {}. It is read-only here now; save "
                                           "it under another name to keep your changes.",
                                           file_.filename().string(), describe(*other)));
  lockedBy_ = std::move(other);
}

void Session::lookAround(double now) {
  if (!hasProject() || shipped_ || now < nextLook_) return;
  nextLook_ = now + options_.watchSeconds;
  lookAtLock();
  if (!untitled_ && !projectFileChanged_ && lookAt(file_).exists && differs(savedStamp_)) {
    projectFileChanged_ = true;
    messages_.add(
        MessageLevel::warning,
        trf("Another program has changed {} on disk; saving will ask what to do", file_.filename().string()));
  }
  if (!sceneWatch_ || watching_.running() || rebuilding_.running() || !sceneWatch_->look()) return;
  watching_.restart(tr("Comparing the model's files"),
                    [this, watch = *sceneWatch_](const Job::Context& context) {
                      context.post([this, different = watch.different()] { sceneCompared(different); });
                    });
}

/// What the model was made of is read again in the background, to be compared with from now on.
void Session::watchScene(bool missing) {
  const bool known =
      watchedScene_ == built_->scene && missing == (sceneFiles_.state == SceneFiles::State::missing);
  if (known) return;
  watchedScene_ = built_->scene;
  sceneWatch_.reset();
  sceneFiles_ = {};
  const fs::path model = sceneFileOf(file_, built_->project);
  if (missing) {
    sceneFiles_.state = SceneFiles::State::missing;
    sceneFiles_.fromCache = built_->scene->placedCount() > 0;
    sceneWatch_.emplace(std::vector{FileStamp{model, {}, {}}});
    return;
  }
  watching_.restart(tr("Looking at the model's files"),
                    [this, model, import = built_->project.import,
                     host = options_.importHost](const Job::Context& context) {
                      std::vector<fs::path> files = importedFiles(model, import, host);
                      if (files.empty()) files.push_back(model);
                      std::vector<FileStamp> stamps;
                      for (const fs::path& file : files) {
                        if (context.stop().stop_requested()) return;
                        stamps.push_back(stampOf(file));
                      }
                      context.post([this, stamps] { sceneWatch_.emplace(stamps); });
                    });
}

void Session::sceneCompared(const std::vector<fs::path>& different) {
  if (!built_) return;
  const fs::path model = sceneFileOf(file_, built_->project);
  const bool gone = !lookAt(model).exists;
  if (sceneFiles_.state == SceneFiles::State::missing && !gone && !different.empty()) {
    messages_.add(MessageLevel::good, trf("{} is there again", model.filename().string()));
    return reimport();
  }
  if (different == sceneFiles_.changed) return;
  sceneFiles_ = {gone                ? SceneFiles::State::missing
                 : different.empty() ? SceneFiles::State::asImported
                                     : SceneFiles::State::changed,
                 different, gone};
  if (different.empty()) return;
  const std::string name = different.size() == 1 ? different.front().filename().string()
                                                 : trf("{} files of the model", different.size());
  if (gone)
    return messages_.add(MessageLevel::warning,
                         trf("{} is gone; what was imported is still shown", model.string()));
  if (preferences_.reimportAutomatically) {
    messages_.add(MessageLevel::info, trf("{} changed on disk: importing it again", name));
    return reimport();
  }
  messages_.add(MessageLevel::warning,
                trf("{} changed on disk. File, Import again shows the new state.", name));
}

void Session::reimport() {
  if (!hasProject() || !built_ || walkRefuses(tr("Importing the model again"))) return;
  rebuilding_.restart(
      tr("Importing the model again"),
      [this, file = file_, wanted = project(), host = options_.importHost](const Job::Context& context) {
        auto result = openUnsaved(file, wanted, host, context.progress(), context.stop());
        context.post([this, result = std::make_shared<Result<OpenProject>>(std::move(result))] {
          if (!*result) return messages_.addFailure(tr("Importing the model again"), result->error());
          const bool same = built_ && built_->scene->key == (*result)->scene->key;
          watchedScene_.reset();  // also where nothing that can be seen has changed
          rebuilt(std::move(**result), false);
          messages_.add(MessageLevel::good,
                        same
                            ? tr("Imported the model again: nothing that shows has changed")
                            : tr("Imported the model again; captures of what changed have to be baked anew"));
        });
      });
}

void Session::locateScene(const fs::path& model) {
  if (!hasProject() || walkRefuses(tr("Locating the model"))) return;
  locateQuestion_ = false;
  const auto located = collectModel(model, file_, {}, Collect::link);
  if (!located) return messages_.addFailure(tr("Locating the model"), located.error());
  if (!located->folder.empty())
    messages_.add(MessageLevel::info, trf("{} links to {}; `acentric collect` brings the files themselves",
                                          located->scene.string(), model.string()));
  if (located->scene == project().scene) return reimport();
  apply(setScene(project(), located->scene));
}

void Session::answerOutside(std::optional<Collect> how) {
  if (!outsideModel_) return;
  const fs::path file = std::exchange(outsideModel_, std::nullopt)->projectFile;
  if (!how) return;
  opening_.restart(trf("Bringing the model of {}", file.filename().string()),
                   [this, file, how = *how, host = options_.importHost](const Job::Context& context) {
                     auto collected = collectProject(file, how, host, context.progress(), context.stop());
                     context.post([this, file, collected = std::move(collected)] {
                       if (!collected)
                         return messages_.addFailure(
                             trf("Bringing the model of {}", file.filename().string()), collected.error());
                       open(file);
                     });
                   });
}

ProblemFacts Session::problemFacts() const {
  ProblemFacts facts;
  facts.language = language();
  if (shipped_) return facts;  // of which nothing can be mended here
  facts.built = built_;
  if (!built_) return facts;
  if (inspection_ && inspection_->layout == built_->layout) facts.inspection = inspection_;
  if (!baking_.running()) facts.captures = captures_;  // while it bakes, the list would change all the time
  if (walk_ && !baking_.running()) facts.previews = walk_->coarse;
  if (bakeQueue_.count(CameraStage::failed) > 0)
    for (const QueuedCamera& camera : bakeQueue_.cameras())
      if (camera.stage == CameraStage::failed)
        facts.failed.push_back({camera.storey, camera.camera, camera.error});
  if (foretold_ && foretold_->layout == built_->layout)
    facts.foretoldHoles = foretold_->surfaces->all.missingShare();
  facts.scene = sceneFiles_;
  facts.projectFileChanged = projectFileChanged_;
  facts.lockedBy = lockedBy_;
  std::optional<double> needed = neededBytes_ && baking_.running()
                                     ? std::optional(*neededBytes_ * (1 - bakeQueue_.share()))
                                     : std::nullopt;
  if (const BakeEstimate* foreseen = estimate()) needed = foreseen->bytes.value;
  facts.diskShort = needed && freeBytes_ && *needed > 0.9 * double(*freeBytes_);
  if (facts.diskShort) facts.freeBytes = *freeBytes_ / 100'000'000 * 100'000'000;
  if (!notKept_.empty()) facts.lost = notKept_;
  return facts;
}

bool Session::refreshProblems() {
  ProblemFacts facts = problemFacts();
  if (problemFacts_ == facts) return false;
  problems_ = findProblems(facts);
  problemFacts_ = std::move(facts);
  return true;
}

}  // namespace acentric::editor
