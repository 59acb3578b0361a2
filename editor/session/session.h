#pragma once
/// The open project and all work on it: history, files, background jobs. No window: the panels show it, the
/// actions call it, and tests drive it directly. Everything here belongs to the main thread; jobs answer
/// through the inbox.

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "editor/commands/edit.h"
#include "editor/session/backdrop.h"
#include "editor/session/bake_costs.h"
#include "editor/session/bake_queue.h"
#include "editor/session/capture_status.h"
#include "editor/session/coverage.h"
#include "editor/session/eta.h"
#include "editor/session/file_watch.h"
#include "editor/session/history.h"
#include "editor/session/inbox.h"
#include "editor/session/inspection.h"
#include "editor/session/job.h"
#include "editor/session/messages.h"
#include "editor/session/picture_ask.h"
#include "editor/session/preferences.h"
#include "editor/session/problems.h"
#include "editor/session/publish.h"
#include "editor/session/scene_pick.h"
#include "editor/session/session_options.h"
#include "editor/session/sweep_watch.h"
#include "editor/session/truth_compare.h"
#include "editor/session/unsaved_work.h"
#include "editor/session/variant_compare.h"
#include "engine/bake/effect_costs.h"
#include "engine/base/gate.h"
#include "engine/inspect/estimates.h"
#include "engine/inspect/wall_slice.h"
#include "engine/pipeline/bake_forecast.h"
#include "engine/pipeline/bake_guard.h"
#include "engine/pipeline/collect_model.h"
#include "engine/pipeline/new_project.h"
#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/project_lock.h"
#include "engine/pipeline/shipped_walk.h"
#include "engine/pipeline/walk_stream.h"
#include "ui/translate.h"

namespace acentric::editor {

/// Why a project cannot simply be saved to its file.
enum class SaveObstacle { none, untitled, readOnly, changedOnDisk };

/// What the user wants with a project that another editor has open.
enum class LockAnswer { readOnly, copy, takeOver };

class Session {
 public:
  explicit Session(SessionOptions options);
  ~Session();

  /// Delivers what jobs sent, keeps time for autosave and for loading what a running bake has finished.
  /// True if anything may look different. `now` in seconds, monotonic.
  bool poll(double now);

  // Files
  // ------------------------------------------------------------------------------------------------------
  /// A project file, a model file for a new project, or a walk. What is open stays until the new one is
  /// ready.
  void open(const std::filesystem::path& file);
  /// A new project of a model, laid out as chosen.
  void openNew(const std::filesystem::path& model, const NewProjectOptions& options);
  void cancelOpening() { opening_.cancel(); }
  void close();
  /// Why save() would refuse. Looks at the file.
  SaveObstacle saveObstacle();
  /// Refused where there is an obstacle; `overwrite`: also over what another program has saved.
  Status save(bool overwrite = false);
  Status saveAs(const std::filesystem::path& file);
  /// What another program has saved, as an edit: what was here can be had back by undo.
  Status reload();
  /// One of the project's, as a file of its own that the command line plays.
  void exportPath(std::size_t path, const std::filesystem::path& file);
  /// Or a walk in its place.
  bool hasProject() const { return history_.has_value(); }
  /// The walk that is open, null while it is a project: what is shown is all that can be changed of it, and
  /// nothing is saved.
  const ShippedWalkPtr& shippedWalk() const { return shipped_; }
  bool untitled() const { return untitled_; }
  /// A new project just as it was made of its model.
  bool untouched() const { return untitled_ && recovered_.empty() && history_ && !history_->canUndo(); }
  bool dirty() const { return history_ && !shipped_ && history_->dirty(); }
  /// The project's file; for an untitled project, where it would be saved.
  const std::filesystem::path& file() const { return file_; }
  std::string title() const;
  /// An autosave that a crashed run left, until it is answered.
  bool recoveryOffered() const { return recovery_.has_value(); }
  void answerRecovery(bool recover);
  /// Autosaves what is unsaved now.
  void keepWork();
  /// Projects that crashed runs had not saved anywhere yet.
  const std::vector<UnsavedWork>& unsavedWork() const { return unsavedWork_; }
  /// Is what is around a place of the shown storey here? Of a walk that is read page by page it is read if
  /// not, in the background: ask again later.
  bool isAround(const glm::dvec2& place);
  /// Would closing lose work?
  bool worthAsking() const;

  // Others on the same files
  // -------------------------------------------------------------------------------------------
  /// Another editor has the project open: it is read-only here, and save() is refused.
  bool readOnly() const { return lockedBy_.has_value(); }
  const std::optional<LockOwner>& lockedBy() const { return lockedBy_; }
  /// Until it is answered.
  bool lockQuestion() const { return lockQuestion_; }
  void answerLock(LockAnswer answer);
  /// The model and what it names, against what was imported.
  const SceneFiles& sceneFiles() const { return sceneFiles_; }
  void reimport();
  /// As an edit: the model was moved, or another one takes its place.
  void locateScene(const std::filesystem::path& model);
  /// Asked once after opening a project whose model is gone.
  bool locateQuestion() const { return locateQuestion_; }
  void answerLocate() { locateQuestion_ = false; }
  /// A project that was not opened because its model lies outside its folder, as older ones' may.
  struct OutsideModel {
    std::filesystem::path projectFile, scene;
  };
  const std::optional<OutsideModel>& outsideModel() const { return outsideModel_; }
  /// Brings the model in and opens the project; nothing: leaves both as they are.
  void answerOutside(std::optional<Collect> how);
  bool projectFileChanged() const { return projectFileChanged_; }
  /// Everything that is wrong, or deserves a look, the worst first.
  const std::vector<Problem>& problems() const { return problems_; }

  // Edits
  // ------------------------------------------------------------------------------------------------------
  const Project& project() const { return history_->current(); }
  const History& history() const { return *history_; }
  /// False, with a message, if the project would not be sound.
  bool apply(Edit edit);
  /// While a value is dragged; `finished` makes it one entry.
  void applyLive(Edit edit, bool finished);
  void finishLive();
  void cancelLive();
  void undo();
  void redo();
  /// The eye has walked onto another storey: no edit. Until the captures there are read, for a moment, the
  /// walk is that of the storey before.
  void walkInto(int storey);
  /// To an entry of the history.
  void goTo(std::size_t entry);
  /// The preference for the history's memory was changed.
  void historyMemoryChanged();

  // What was made of it
  // ----------------------------------------------------------------------------------------
  /// Null before the first open is done. May lag behind project() for a moment.
  const std::shared_ptr<const OpenProject>& built() const { return built_; }
  /// As much of it as is in memory now; grows while it is being read.
  const std::shared_ptr<const LoadedWalk>& walk() const { return walk_; }
  /// Where the eye is: what it needs next is read first. Called each frame.
  void walkAt(const Whereabouts& where);
  std::size_t walkBytes() const;  ///< for captures of the walk in memory
  /// Are captures being read that the eye may need, or is one that was not in walk() yet?
  bool streaming() const { return stream_ && (stream_->busy() || stream_->walk() != walk_); }
  /// The preference for the walk's memory was changed.
  void walkMemoryChanged();
  const std::shared_ptr<const CaptureStatus>& captures() const { return captures_; }
  const std::shared_ptr<const Backdrop>& backdrop() const { return backdrop_; }
  /// Of the layout that is built; null while it is being made, or if the plan does not ask for it.
  std::shared_ptr<const Inspection> inspection() const;
  /// Does the plan show it? Called each frame.
  void askForInspection(bool wanted);
  /// Corners and direction of the walls at eye height; null until they are found.
  std::shared_ptr<const WallSlice> walls() const { return wallsWanted_ ? walls_ : nullptr; }
  /// Does a tool land on them? Called each frame.
  void askForWalls(bool wanted);
  /// The newest picture of the layout that is built, as asked for; null until there is one.
  CoveragePicturePtr coverage() const;
  /// What the plan shows of it; called each frame. Measuring begins anew when this or the project changed.
  void askForCoverage(const std::optional<CoverageRequest>& wanted);
  /// The cameras that sample the picked point in the project as it is built; null while they are sought.
  ScenePickPtr scenePick() const;
  /// The point that the 3D view asks about. Called each frame.
  void askForPick(const std::optional<SurfacePoint>& wanted);
  /// Grows by one with each opened project: views start afresh.
  int generation() const { return generation_; }

  // Bake
  // -------------------------------------------------------------------------------------------------------
  /// Of all storeys, the current one first, and of each what is nearest to `from` (to the start of the walk).
  /// `takeOver`: though another process bakes this project, which then ends.
  void startBake(const std::optional<glm::dvec2>& from = {}, bool takeOver = false);
  void cancelBake();
  /// What was begun of a camera is kept, and gone on with.
  void pauseBake(bool paused);
  bool bakePaused() const { return baking_.running() && bakeGate_.closed(); }
  /// The cameras of the running bake, or of the last one.
  const BakeQueue& bakeQueue() const { return bakeQueue_; }
  /// Of the disk that captures go to, while a project is open; and what those of the bake that runs were
  /// expected to take when it began.
  std::optional<std::uint64_t> freeBytes() const { return freeBytes_; }
  std::optional<double> neededBytes() const { return neededBytes_; }
  /// What the bake that runs, or ran last, was to take: known a second or two after it was begun, before the
  /// first camera.
  const std::optional<BakeForecast>& bakeForecast() const { return bakeForecast_; }
  /// Of the captures that the running bake is for, how many the project no longer uses as it was edited
  /// since.
  int outdatedInBake() const { return baking_.running() ? outdatedInBake_ : 0; }
  /// Of the bake that runs: by its pace, or by the forecast while that is not known.
  std::optional<double> bakeSecondsLeft() const;
  /// Of what the current storey lacks, by baking a little of it.
  void estimateBake();
  /// The same of fewer probes, for a first idea.
  void glanceAtBake();
  /// Null until asked for, when something has changed since, and after a glance once bakeCosts() knows
  /// better.
  const BakeEstimate* estimate() const;
  /// What the last estimate, or else the costs of settings, say of all that there is to bake.
  std::optional<BakeForecast> knownForecast() const;
  /// What each effect costs, measured with the last estimate; null where effects or settings are others now.
  const EffectCosts* effectCosts() const;
  const Job& estimating() const { return estimating_; }
  /// What baking all of it takes, with each preset and as it is set.
  const BakeCosts& bakeCosts() const { return bakeCosts_; }
  /// Called each frame.
  void showBakeCosts(bool shown) { costsShown_ = shown; }
  /// The resolution at which the whole of it takes so many bytes: bakeCosts().proposal().
  void proposeSize(double bytes) { bakeCosts_.propose(bytes); }
  const std::optional<ProjectBakeReport>& lastBake() const { return lastBake_; }
  int bakeThreads() const;
  int processors() const { return processors_; }

  /// Adds a storey for each walk plane found in the scene that has none.
  void findStoreys();
  /// Adds storeys for the stairs and ramps between those of the project that have none.
  void findStairs();
  /// The walkable area about the current floor, as `acentric new` finds it.
  void outlineFromScene();
  /// The lattice where few cameras serve much of the floor and stand well, as `acentric new` lays it.
  void fitToFloor();
  /// The largest cells whose regions all keep to the project's triangle budget.
  void fitCells();
  /// Splits the cells of e and g that exceed the budget.
  void splitOverBudget();

  /// The walk against ray-traced truth.
  TruthCompare& comparing() { return comparing_; }
  VariantCompare& variants() { return variants_; }
  const VariantCompare& variants() const { return variants_; }
  PictureAsk& asking() { return asking_; }
  /// What accuracy costs in time.
  SweepWatch& sweeping() { return sweeping_; }
  const SweepWatch& sweeping() const { return sweeping_; }
  /// The search for settings that keep to goals.
  SweepWatch& proposing() { return proposing_; }
  const SweepWatch& proposing() const { return proposing_; }
  /// For browsers: what is written, served and shown of the project. publish() begins it.
  Publisher& publishing() { return publishing_; }
  const Publisher& publishing() const { return publishing_; }
  /// Where it was published last, or would be.
  PublishPlace publishPlace() const;
  void keepPublishPlace(const PublishPlace& place);
  /// The published page, where the walk begins: its public address, else this machine's; empty: there is
  /// none.
  std::string linkToWalk() const;
  /// What is open, as it is; keeps the place.
  void publish(const PublishPlace& place, bool allowMissing);
  /// Writes what the walk shows beside the project, under a new name, and tells where.
  void savePicture(ColourImage picture);
  const Job& savingPicture() const { return savingPicture_; }

  const Job& opening() const { return opening_; }
  const Job& rebuilding() const { return rebuilding_; }
  const Job& baking() const { return baking_; }
  const Job& loading() const { return loading_; }
  const Job& drawingBackdrop() const { return drawingBackdrop_; }
  const Job& inspecting() const { return inspecting_; }
  const Job& measuringCoverage() const { return measuringCoverage_; }
  /// For storeys, an outline, or for cells that fit: one at a time.
  const Job& searching() const { return searching_; }
  void cancelSearch() { searching_.cancel(); }
  bool working() const;

  Messages& messages() { return messages_; }
  Preferences& preferences() { return preferences_; }
  const Preferences& preferences() const { return preferences_; }
  void savePreferencesNow();

 private:
  struct Opened {
    OpenProject open;
    bool untitled = false;
    bool withoutModel = false;
    std::filesystem::path recovered;  ///< the autosave that it comes from
    FileStamp saved;                  ///< of the project file, as it was read
    ShippedWalkPtr shipped;           ///< it is this walk
  };
  Result<Opened> openNow(const std::filesystem::path& file, const NewProjectOptions& options,
                         const Job::Context& context) const;
  Result<Opened> openShipped(const std::filesystem::path& walk, const Job::Context& context) const;
  void openWith(const std::filesystem::path& file, const NewProjectOptions& options);
  void opened(Opened opened);
  /// Is a walk open, which cannot do `what`? Tells so.
  bool walkRefuses(const std::string& what);
  void projectChanged();
  void rebuild();
  void rebuilt(OpenProject open, bool withoutModel);
  /// The project that was to be built cannot be: back to what is shown.
  void giveUpBuilding(const Error& error);
  void show(OpenProject open);
  /// What pages of a walk that were there before have in memory.
  struct FormerPages {
    std::shared_ptr<const LoadedWalk> walk;
    WalkStream::Held held;
  };
  void loadCaptures();
  void loaded(std::shared_ptr<WalkStream> stream, const OpenProject& from);
  void followStream();
  /// Of a walk that is read page by page, reads on where the eye is about to leave what is known.
  void followPages();
  void readAround(const glm::dvec2& place);
  void arrived(const ShippedWalkPtr& place);
  bool keepsWalk() const { return walk_ && now_ < keepWalkUntil_ && stream_->busy(); }
  /// Asks the disk again which captures are there.
  void countCaptures();
  /// The same, in a job of that.
  void tellCaptures(const std::shared_ptr<const OpenProject>& open, const ShippedWalkPtr& shipped,
                    const Job::Context& context);
  /// Waits for what it is reading, elsewhere.
  void dropStream();
  void drawBackdropIfStale();
  void inspectIfStale();
  /// Of the project as it is set, with as many threads; null: not known (yet).
  const BakeCost* costAsSet() const;
  /// Counts the captures of the running bake that the project, just edited, no longer uses.
  void compareWithBake();
  void bakeEnded(const Result<ProjectBakeReport>& report);
  Result<ProjectBakeReport> bakeStoreys(const OpenProject& open, const std::optional<glm::dvec2>& from,
                                        const std::optional<BakeForecast>& known, std::size_t memoryBytes,
                                        const ImportHost& host, const BakeGuard& guard, TaskRunner& runner,
                                        const Job::Context& context);
  void lookAtDisk();
  void followBakeCosts();
  /// As an edit, unless the layout is no longer what was searched with.
  void offerLayout(const OpenProject& from, const LayoutSpec& spec, const std::string& label,
                   const std::string& found);
  void remember(const std::filesystem::path& file);
  void autosave(double now);
  std::filesystem::path autosaveFile() const;
  void forgetAutosave();
  void lookForAutosave();
  void savedNow();
  std::size_t historyBytes() const { return std::size_t(preferences_.historyMegabytes) * 1'000'000; }
  bool isUnsavedWork(const std::filesystem::path& file) const;
  void listUnsaved();
  void takeLock(bool force);
  void leaveLock();
  void leaveFiles();
  void lookAround(double now);
  void lookAtLock();
  void inspectWhenStill(double now);
  void watchScene(bool missing);
  void sceneCompared(const std::vector<std::filesystem::path>& different);
  /// True if they are others now.
  bool refreshProblems();
  ProblemFacts problemFacts() const;

  SessionOptions options_;
  int processors_;
  Inbox inbox_;
  Messages messages_;
  Preferences preferences_;

  std::optional<History> history_;
  ShippedWalkPtr shipped_;
  std::filesystem::path file_;
  bool untitled_ = false;
  std::optional<Project> recovery_;
  int generation_ = 0;

  std::vector<UnsavedWork> unsavedWork_;
  std::filesystem::path recovered_;  // another process's autosave, removed once this one keeps the work
  std::string notKept_;              // why there is no autosave; empty: there is one, or no need
  FileStamp savedStamp_;             // of the project file as it was read or written
  bool projectFileChanged_ = false;
  std::optional<ProjectLock> lock_;
  std::optional<LockOwner> lockedBy_;
  bool lockQuestion_ = false;
  std::optional<FileWatch> sceneWatch_;
  ScenePtr watchedScene_;
  SceneFiles sceneFiles_;
  bool locateQuestion_ = false;
  std::optional<OutsideModel> outsideModel_;
  double nextLook_ = 0;
  std::optional<ProblemFacts> problemFacts_;
  std::vector<Problem> problems_;

  std::shared_ptr<const OpenProject> built_;
  std::shared_ptr<const LoadedWalk> walk_;
  std::shared_ptr<WalkStream> stream_;  // makes walk_
  int streamedStorey_ = 0;
  std::optional<glm::dvec2> lookedFor_;     // the place that was read around last
  std::set<std::pair<int, int>> readFrom_;  // regions, by storey and number, where no other page was had
  Whereabouts where_;
  double keepWalkUntil_ = 0;  // seconds: that of the storey before is shown
  std::string simplifiedTold_;
  std::shared_ptr<const CaptureStatus> captures_;
  std::shared_ptr<const Backdrop> backdrop_;
  struct BackdropKey {
    ScenePtr scene;
    double cutHeight = 0;
    PlanBox box;
    bool operator==(const BackdropKey&) const = default;
  };
  BackdropKey backdropKey_;
  bool inspectionWanted_ = false;
  std::shared_ptr<Inspector> inspector_ = std::make_shared<Inspector>();  // used by the job alone
  std::shared_ptr<const Inspection> inspection_;
  std::shared_ptr<const Layout> inspected_;    // what the job was last asked for
  std::shared_ptr<const Layout> stillLayout_;  // inspected without being asked, once it has kept still
  double inspectAt_ = 0;

  bool wallsWanted_ = false;
  std::shared_ptr<const WallSlice> walls_;
  struct WallsKey {
    ScenePtr scene;
    double height = 0;
    bool operator==(const WallsKey&) const = default;
  };
  WallsKey wallsKey_;  // what the job was last asked for

  /// All that a picture of the coverage depends on.
  struct CoverageKey {
    std::shared_ptr<const Layout> layout;
    ScenePtr scene;
    BakeSettings bake;
    RayScenePtr rays;
    double fovDegrees = 0;
    bool everyCover = false;
    CoverageRequest request;
    bool operator==(const CoverageKey&) const = default;
  };
  std::optional<CoverageKey> coverageKey_;  // what the job was last asked for
  CoveragePicturePtr coverage_;
  CoveragePicturePtr foretold_;  // the newest exact one of surfaces

  struct PickKey {
    std::shared_ptr<const OpenProject> of;
    glm::dvec3 position{0};
    bool operator==(const PickKey&) const = default;
  };
  std::optional<PickKey> pickKey_;  // what the job was last asked for
  ScenePickPtr pick_;

  struct Estimate {
    std::shared_ptr<const OpenProject> of;
    int threads = 0;
    BakeEstimate figures;
    EffectCosts costs;
    bool glance = false;
  };
  void estimateBake(bool glance);
  std::optional<Estimate> estimate_;
  std::optional<BakeForecast> bakeForecast_;
  BakeQueue bakeQueue_;
  int outdatedInBake_ = 0;
  std::optional<std::uint64_t> freeBytes_;
  std::optional<double> neededBytes_;
  double nextLookAtDisk_ = 0, now_ = 0;
  Gate bakeGate_;  // outlives the job
  bool costsShown_ = false;
  std::optional<ProjectBakeReport> lastBake_;
  int bakedSeen_ = 0;
  double nextLoad_ = 0;
  bool loadWanted_ = false;
  double nextAutosave_ = 0;
  std::optional<Project> autosaved_;

  SweepWatch sweeping_, proposing_;

  // Last: they are stopped and joined first.
  Job opening_{inbox_};
  Job rebuilding_{inbox_};
  Job baking_{inbox_};
  Job loading_{inbox_};
  Job reading_{inbox_};
  Job counting_{inbox_};
  Job dropping_{inbox_};
  Job drawingBackdrop_{inbox_};
  Job inspecting_{inbox_};
  Job watching_{inbox_};
  Job measuringCoverage_{inbox_};
  Job picking_{inbox_};
  Job slicingWalls_{inbox_};
  Job searching_{inbox_};
  Job estimating_{inbox_};
  Job savingPicture_{inbox_};
  TruthCompare comparing_{inbox_, processors_};
  VariantCompare variants_{inbox_, processors_};
  PictureAsk asking_{inbox_, processors_, options_.importHost};
  Publisher publishing_{inbox_, messages_, options_.page};
  BakeCosts bakeCosts_{inbox_};
};

/// Do two projects differ only in how the walk is shown? Then nothing has to be laid or loaded anew.
bool onlyViewDiffers(const Project& a, const Project& b);

/// Why what needs a project cannot be done.
inline constexpr const char* kIsWalk = trLater("this is a walk: open its project to edit it");

}  // namespace acentric::editor
