#include "editor/session/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "editor/session/engine_texts.h"
#include "editor/session/screenshot.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace fs = std::filesystem;

Session::Session(SessionOptions options)
    : options_(std::move(options)),
      processors_(options_.processors > 0 ? options_.processors
                                          : std::max(1, int(std::thread::hardware_concurrency()))),
      inbox_(options_.wake),
      sweeping_(options_.program),
      proposing_(options_.program, SweepWatch::Kind::goals) {
  std::string problem;
  preferences_ = loadPreferences(options_.preferencesFile, &problem);
  if (!problem.empty()) messages_.add(MessageLevel::warning, problem);
  listUnsaved();
}

Session::~Session() { bakeGate_.open(); }  // a paused bake must see that it is to stop

bool onlyViewDiffers(const Project& a, const Project& b) {
  Project same = b;
  same.view = a.view;
  same.fovDegrees = a.fovDegrees;
  same.bookmarks = a.bookmarks;
  same.paths = a.paths;
  if (same.storeys.size() == a.storeys.size())
    for (std::size_t s = 0; s < a.storeys.size(); ++s) same.storeys[s].spawn = a.storeys[s].spawn;
  return same == a;
}

namespace {

/// In no more than can be changed of a walk?
bool onlyShownOtherwise(const Project& a, const Project& b) {
  Project same = b;
  same.view = a.view;
  same.fovDegrees = a.fovDegrees;
  same.storey = a.storey;
  return same == a;
}

}  // namespace

bool Session::walkRefuses(const std::string& what) {
  if (shipped_) messages_.add(MessageLevel::warning, what + ": " + tr(kIsWalk));
  return shipped_ != nullptr;
}

bool Session::poll(double now) {
  now_ = now;
  const bool delivered = inbox_.deliver();
  followStream();
  if (const int baked = bakeQueue_.finished() + bakeQueue_.previewed(); baked != bakedSeen_) {
    bakedSeen_ = baked;
    loadWanted_ = loadWanted_ || baking_.running();
  }
  lookAtDisk();
  constexpr double kLoadInterval = 1.0;  // captures appear in the walk soon, without loading after each
  if (loadWanted_ && built_ && now >= nextLoad_ && !loading_.running()) {
    nextLoad_ = now + kLoadInterval;
    loadCaptures();
  }
  autosave(now);
  lookAround(now);
  inspectWhenStill(now);
  followBakeCosts();
  const bool measured = int(sweeping_.poll(now)) + int(proposing_.poll(now)) > 0;
  publishing_.poll();
  return refreshProblems() || delivered || measured;
}

bool Session::working() const {
  return opening_.running() || rebuilding_.running() || baking_.running() || loading_.running() ||
         streaming() || drawingBackdrop_.running() || inspecting_.running() || measuringCoverage_.running() ||
         picking_.running() || searching_.running() || estimating_.running() || savingPicture_.running() ||
         reading_.running() || publishing_.job().running();
}

bool Session::apply(Edit edit) {
  if (!hasProject()) return false;
  if (const Status sound = edit.project.check(); !sound) {
    messages_.addFailure(edit.label, sound.error());
    return false;
  }
  if (!onlyShownOtherwise(project(), edit.project) && walkRefuses(edit.label)) return false;
  history_->push(std::move(edit.project), std::move(edit.label));
  projectChanged();
  return true;
}

void Session::applyLive(Edit edit, bool finished) {
  if (!hasProject()) return;
  if (shipped_ && !onlyShownOtherwise(project(), edit.project)) {
    if (finished) walkRefuses(edit.label);
    return;
  }
  // A value on its way may be out of range for a moment: wait for the next one.
  if (edit.project.check()) history_->preview(std::move(edit.project), std::move(edit.label));
  if (finished) history_->commitPreview();
  projectChanged();
}

void Session::finishLive() {
  if (hasProject()) history_->commitPreview();
}

void Session::cancelLive() {
  if (!hasProject() || !history_->previewing()) return;
  history_->rollbackPreview();
  projectChanged();
}

void Session::undo() {
  if (!hasProject() || !history_->canUndo()) return;
  messages_.add(MessageLevel::info, trf("Undone: {}", history_->undoLabel()));
  history_->undo();
  projectChanged();
}

void Session::redo() {
  if (!hasProject() || !history_->canRedo()) return;
  messages_.add(MessageLevel::info, trf("Done again: {}", history_->redoLabel()));
  history_->redo();
  projectChanged();
}

void Session::goTo(std::size_t entry) {
  if (!hasProject() || entry >= history_->size() || entry == history_->cursor()) return;
  history_->goTo(entry);
  messages_.add(MessageLevel::info, trf("Gone to: {}", history_->label(history_->cursor())));
  projectChanged();
}

void Session::walkInto(int storey) {
  if (!hasProject() || !built_ || history_->previewing() || storey == project().storey) return;
  history_->walkInto(storey);
  constexpr double kMostSeconds = 1;  // that the walk of the storey before stays
  keepWalkUntil_ = now_ + kMostSeconds;
  if (shipped_ || rebuilding_.running()) return rebuild();
  auto open = reopenProject(*built_, project(), options_.importHost);
  if (!open) return messages_.addFailure(trf("Walking to {}", project().current().name), open.error());
  show(std::move(*open));
  loadCaptures();
  drawBackdropIfStale();
}

void Session::historyMemoryChanged() {
  if (hasProject()) history_->setMostBytes(historyBytes());
}

void Session::projectChanged() {
  if (!built_ || built_->project == project()) {
    if (built_ && rebuilding_.running()) rebuild();  // what is being built is no longer wanted
    return;
  }
  if (onlyViewDiffers(built_->project, project()) && !rebuilding_.running()) {
    OpenProject open = *built_;
    open.project = project();
    built_ = std::make_shared<const OpenProject>(std::move(open));
    return;
  }
  rebuild();
}

void Session::rebuild() {
  if (shipped_) {  // of which another storey is shown
    show(openProject(*shipped_, project()));
    return loadCaptures();
  }
  rebuilding_.restart(
      tr("Laying the tessellation"),
      [this, former = built_, wanted = project(), host = options_.importHost](const Job::Context& context) {
        auto result = reopenProject(*former, wanted, host, context.progress(), context.stop());
        std::error_code error;
        const bool gone = !fs::exists(sceneFileOf(former->file, wanted), error);
        const bool withoutModel = !result && gone;
        if (withoutModel)
          result = openWithoutModel(former->file, wanted, host, context.progress(), context.stop());
        context.post([this, gone, result = std::make_shared<Result<OpenProject>>(std::move(result))] {
          if (*result) return rebuilt(std::move(**result), gone);
          if (result->error().kind != ErrorKind::cancelled) giveUpBuilding(result->error());
        });
      });
}

void Session::giveUpBuilding(const Error& error) {
  messages_.addFailure(history_->undoLabel().empty() ? tr("The change") : history_->undoLabel(), error);
  if (!history_->canRedo() && history_->canUndo())
    history_->discardCurrent();
  else if (const auto shown = history_->find(built_->project))
    history_->goTo(*shown);
  else
    return;
  projectChanged();
}

void Session::rebuilt(OpenProject open, bool withoutModel) {
  show(std::move(open));
  watchScene(withoutModel);
  loadCaptures();
  drawBackdropIfStale();
}

void Session::show(OpenProject open) {
  const bool sameLayout = built_ && built_->layout == open.layout;
  open.file = file_;
  built_ = std::make_shared<const OpenProject>(std::move(open));
  compareWithBake();
  // What is baked is asked of the disk in the background; until then regions of a new layout count as
  // missing.
  if (!sameLayout || !captures_)
    captures_ = std::make_shared<const CaptureStatus>(emptyStatus(*built_->layout));
}

void Session::loadCaptures() {
  if (loading_.running()) {  // it will be asked again, with what that has loaded
    loadWanted_ = true;
    nextLoad_ = 0;
    return;
  }
  loadWanted_ = false;
  FormerPages before;
  if (shipped_ && shipped_->pages && stream_ && streamedStorey_ == built_->project.storey)
    before = {stream_->walk(), stream_->held()};
  dropStream();
  WalkStreamOptions streaming;
  streaming.memoryBytes = walkBytes();
  streaming.panoramas = project().view.secondaryCover;
  streaming.where = where_;
  streaming.wake = options_.wake;
  loading_.restart(tr("Looking for captures"), [this, open = built_, former = walk_, shipped = shipped_,
                                                before, streaming](const Job::Context& context) {
    tellCaptures(open, shipped, context);
    Result<WalkStart> start =
        shipped ? startWalk(shipped, open->project.storey, former.get()) : startWalk(*open, former.get());
    if (!start) {
      context.post(
          [this, error = start.error()] { messages_.addFailure(tr("Loading the captures"), error); });
      return;
    }
    if (before.walk && before.walk->walk.layout != open->layout) takeOver(*before.walk, before.held, *start);
    const auto stream = std::make_shared<WalkStream>(std::move(*start), streaming);
    context.post([this, open, stream] { loaded(stream, *open); });
  });
}

std::size_t Session::walkBytes() const {
  return preferences_.walkMegabytes > 0 ? std::size_t(preferences_.walkMegabytes) * 1'000'000
                                        : usualWalkMemory();
}

void Session::countCaptures() {
  counting_.restart(tr("Counting captures"),
                    [this, open = built_, shipped = shipped_](const Job::Context& context) {
                      tellCaptures(open, shipped, context);
                    });
}

void Session::tellCaptures(const std::shared_ptr<const OpenProject>& open, const ShippedWalkPtr& shipped,
                           const Job::Context& context) {
  auto status = std::make_shared<const CaptureStatus>(captureStatus(
      *open->layout, shipped ? capturesOf(*shipped, open->project.storey) : capturesOnDisk(*open)));
  context.post([this, open, status] {
    if (built_->layout == open->layout) captures_ = status;
  });
}

void Session::loaded(std::shared_ptr<WalkStream> stream, const OpenProject& from) {
  stream_ = std::move(stream);
  streamedStorey_ = from.project.storey;
  stream_->go(where_);
  if (!keepsWalk()) walk_ = stream_->walk();
  for (const std::string& warning : stream_->walk()->warnings)
    messages_.add(MessageLevel::warning, engineText(warning));
  if (built_->layout != from.layout || built_->keys != from.keys) loadWanted_ = true;
}

void Session::followStream() {
  if (!stream_ || keepsWalk()) return;
  walk_ = stream_->walk();
  if (const auto warnings = stream_->takeWarnings(); !warnings.empty()) {
    constexpr std::size_t kEach = 3;  // of a whole damaged folder, the first ones say enough
    for (std::size_t w = 0; w < std::min(kEach, warnings.size()); ++w)
      messages_.add(MessageLevel::warning, engineText(warnings[w]));
    if (warnings.size() > kEach)
      messages_.add(MessageLevel::warning, trf("... and {} more like these", warnings.size() - kEach));
    countCaptures();  // what could not be read is no longer there
  }
  if (walk_->simplified.empty() || stream_->busy()) return;
  if (std::string text = simplifiedText(*walk_); text != simplifiedTold_) {
    messages_.add(MessageLevel::warning, engineText(text));
    simplifiedTold_ = std::move(text);
  }
}

void Session::dropStream() {
  if (stream_)
    dropping_.restart(tr("Closing the walk"),
                      [old = std::move(stream_)](const Job::Context&) mutable { old.reset(); });
  stream_.reset();
}

void Session::walkAt(const Whereabouts& where) {
  where_ = where;
  if (stream_) stream_->go(where);
  followPages();
}

void Session::followPages() {
  if (!shipped_ || !shipped_->pages || reading_.running()) return;
  const int storey = built_->project.storey;
  const auto region = built_->layout->regionAt(where_.eye);
  if (!region || shipped_->isOwn(storey, *region)) return;
  const int number = built_->layout->regions[std::size_t(*region)].id.i;
  if (!readFrom_.contains({storey, number})) readAround(where_.eye);
}

bool Session::isAround(const glm::dvec2& place) {
  if (!shipped_ || !shipped_->pages || lookedFor_ == place) return true;
  if (reading_.running()) return false;
  if (built_->layout->regionAt(place)) return true;
  readAround(place);
  return false;
}

void Session::readAround(const glm::dvec2& place) {
  reading_.restart(tr("Reading the walk"), [this, shipped = shipped_, storey = built_->project.storey,
                                            place](const Job::Context& context) {
    const auto there = placeAround(shipped, storey, place);
    context.post([this, shipped, storey, place, there] {
      if (shipped_ != shipped) return;
      lookedFor_ = place;
      if (there && *there != shipped) return arrived(*there);
      if (!there) messages_.addFailure(tr("Reading the walk"), there.error());
      const Layout& layout = *shipped->layouts[std::size_t(storey)];
      if (const auto region = layout.regionAt(place))
        readFrom_.emplace(storey, layout.regions[std::size_t(*region)].id.i);
    });
  });
}

void Session::arrived(const ShippedWalkPtr& place) {
  for (const std::string& warning : place->warnings)
    messages_.add(MessageLevel::warning, engineText(warning));
  shipped_ = place;
  show(openProject(*shipped_, project()));
  loadCaptures();
}

void Session::walkMemoryChanged() {
  if (built_) loadCaptures();
}

void Session::savePicture(ColourImage picture) {
  savingPicture_.restart(tr("Writing the picture"), [this, file = file_, picture = std::move(picture)](
                                                        const Job::Context& context) {
    auto written = writeScreenshot(picture, file);
    context.post([this, written] {
      if (written)
        messages_.add(MessageLevel::good, trf("The picture is in {}", written->string()));
      else
        messages_.addFailure(tr("Writing the picture"), written.error());
    });
  });
}

void Session::drawBackdropIfStale() {
  if (shipped_) return;
  const Layout& layout = *built_->layout;
  BackdropKey key{built_->scene, layout.eyeZ(),
                  planBoxOf(built_->scene->bounds, layout, project().current().walkable)};
  // Small edits of the layout stay within a backdrop that is there.
  const bool inside = backdropKey_.scene == key.scene && backdropKey_.cutHeight == key.cutHeight &&
                      key.box.min.x >= backdropKey_.box.min.x && key.box.min.y >= backdropKey_.box.min.y &&
                      key.box.max.x <= backdropKey_.box.max.x && key.box.max.y <= backdropKey_.box.max.y;
  if (inside) return;
  backdropKey_ = key;
  drawingBackdrop_.restart(tr("Drawing the plan"), [this, key, rays = built_->rays,
                                                    threads = bakeThreads()](const Job::Context& context) {
    TaskRunner runner(threads - 1);
    for (const int pixels : {256, 1400}) {  // a coarse one at once, then the fine one
      auto drawn = drawBackdrop(*rays, key.cutHeight, key.box, pixels, runner, context.stop());
      if (!drawn) return;
      context.post(
          [this, backdrop = std::make_shared<const Backdrop>(std::move(*drawn))] { backdrop_ = backdrop; });
    }
  });
}

std::shared_ptr<const Inspection> Session::inspection() const {
  const bool current = inspection_ && built_ && inspection_->layout == built_->layout;
  return current && (inspectionWanted_ || options_.inspectAlways) ? inspection_ : nullptr;
}

void Session::askForInspection(bool wanted) {
  inspectionWanted_ = wanted;
  if (wanted) inspectIfStale();
}

void Session::inspectWhenStill(double now) {
  constexpr double kStill = 0.7;  // seconds: a drag in between is not slowed down
  if (!options_.inspectAlways || !built_ || inspected_ == built_->layout) return;
  if (stillLayout_ != built_->layout || rebuilding_.running() || history_->previewing()) {
    stillLayout_ = built_->layout;
    inspectAt_ = now + kStill;
  }
  if (now >= inspectAt_) inspectIfStale();
}

void Session::inspectIfStale() {
  if (!built_ || shipped_ || inspected_ == built_->layout) return;
  inspected_ = built_->layout;
  inspecting_.restart(tr("Inspecting the layout"), [this, open = built_, inspector = inspector_,
                                                    threads = bakeThreads()](const Job::Context& context) {
    TaskRunner runner(threads - 1);
    auto made = inspector->inspect(*open, runner, context.progress(), context.stop());
    context.post([this, made = std::make_shared<Result<Inspection>>(std::move(made))] {
      if (*made)
        inspection_ = std::make_shared<const Inspection>(std::move(**made));
      else if (made->error().kind != ErrorKind::cancelled)
        messages_.addFailure(tr("Inspecting the layout"), made->error());
    });
  });
}

void Session::askForWalls(bool wanted) {
  wallsWanted_ = wanted;
  if (!wanted || !built_) return;
  const WallsKey key{built_->scene, built_->layout->eyeZ()};
  if (wallsKey_ == key) return;
  wallsKey_ = key;
  walls_.reset();
  slicingWalls_.restart(tr("Looking for walls"), [this, key](const Job::Context& context) {
    auto walls = std::make_shared<const WallSlice>(sliceWalls(*key.scene, key.height, context.stop()));
    context.post([this, walls] { walls_ = walls; });
  });
}

CoveragePicturePtr Session::coverage() const {
  const bool current = coverage_ && coverageKey_ && built_ && coverage_->layout == built_->layout &&
                       coverage_->request == coverageKey_->request;
  return current ? coverage_ : nullptr;
}

void Session::askForCoverage(const std::optional<CoverageRequest>& wanted) {
  if (!wanted || !built_ || shipped_) {
    if (coverageKey_) measuringCoverage_.abandon();
    coverageKey_.reset();
    coverage_.reset();
    return;
  }
  const Project& project = built_->project;
  const CoverageKey key{built_->layout, built_->scene,      project.bake,
                        built_->rays,   project.fovDegrees, project.view.secondaryCover,
                        *wanted};
  if (coverageKey_ == key) return;
  coverageKey_ = key;
  measuringCoverage_.restart(
      tr("Measuring coverage"),
      [this, open = built_, request = *wanted, threads = bakeThreads()](const Job::Context& context) {
        TaskRunner runner(threads - 1);
        const Status measured = measureCoverage(
            *open, request, runner,
            [&](const CoveragePicturePtr& picture) {
              context.post([this, picture] {
                coverage_ = picture;
                if (picture->exact && picture->surfaces) foretold_ = picture;
              });
            },
            context.stop());
        if (!measured && measured.error().kind != ErrorKind::cancelled)
          context.post(
              [this, error = measured.error()] { messages_.addFailure(tr("Measuring coverage"), error); });
      });
}

ScenePickPtr Session::scenePick() const {
  return pick_ && pickKey_ && pick_->of == pickKey_->of && pick_->point.position == pickKey_->position
             ? pick_
             : nullptr;
}

void Session::askForPick(const std::optional<SurfacePoint>& wanted) {
  if (!wanted || !built_) {
    if (pickKey_) picking_.abandon();
    pickKey_.reset();
    pick_.reset();
    return;
  }
  const PickKey key{built_, wanted->position};
  if (pickKey_ == key) return;
  pickKey_ = key;
  picking_.restart(tr("Asking the cameras"),
                   [this, open = built_, point = *wanted](const Job::Context& context) {
                     auto pick = std::make_shared<const ScenePick>(pickOf(open, point));
                     context.post([this, pick] { pick_ = pick; });
                   });
}

}  // namespace acentric::editor
