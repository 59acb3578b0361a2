#pragma once
/// The only place that wires all stages. Values in, values out; the command line and the editor call the same
/// functions.

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/bake/bake.h"
#include "engine/bake/truth.h"
#include "engine/base/task_runner.h"
#include "engine/pipeline/near_instances.h"
#include "engine/pipeline/project.h"
#include "engine/pipeline/scene_storeys.h"
#include "engine/scene/simplify.h"
#include "engine/store/capture_store.h"
#include "engine/view/render.h"
#include "engine/view/walk_scene.h"

namespace acentric {

class StoreyGround;

/// A project opened: scene imported and traceable, plan and layout made. Immutable; edits make a new one,
/// sharing what did not change.
struct OpenProject {
  std::filesystem::path file;
  Project project;
  ScenePtr imported;   ///< as the model is
  NearInstances near;  ///< of `imported`: what reaches into a region of some storey
  ScenePtr scene;      ///< that rays meet: `imported` with near mirrors and lamps as meshes
  /// What regions draw of it: also the rest of what is near. With too much of that (checkNear) its meshes
  /// alone.
  DrawnScenePtr drawn;
  EffectPlan plan;
  RayScenePtr rays;
  std::shared_ptr<const FlatMirrors> mirrors;  ///< null: none
  std::shared_ptr<const Layout> layout;
  std::vector<std::shared_ptr<const Layout>> layouts;  ///< of all storeys; null where one cannot be laid out
  std::shared_ptr<const StoreyGround> ground;          ///< of these
  std::vector<ContentKey> keys;                        ///< of Layout::cameras
  ContentKey surfaceLightKey;
};

/// What a capture's key is made of (engine/bake/bake.h).
KeyParts captureKeyParts(const OpenProject& open, int camera);
/// What the key of the surfaces' light is made of: it depends on which triangles some region draws as local
/// geometry, and from where mirrors are seen.
KeyParts surfaceLightKeyParts(const OpenProject& open);

Result<OpenProject> openProject(const std::filesystem::path& file, const ImportHost& host,
                                const Progress& progress = {}, std::stop_token stop = {});
/// The same for a project that is not (or not as it is) in the file.
Result<OpenProject> openUnsaved(const std::filesystem::path& file, const Project& project,
                                const ImportHost& host, const Progress& progress = {},
                                std::stop_token stop = {});
/// The same after an edit of `project`; reuses scene and rays of `former` where they still fit.
Result<OpenProject> reopenProject(const OpenProject& former, const Project& project, const ImportHost& host,
                                  const Progress& progress = {}, std::stop_token stop = {});

/// A project whose model is gone: with the scene as it was last imported on this machine, so that its
/// captures can be walked and baked; where the cache has none, with an empty scene around the layout.
Result<OpenProject> openWithoutModel(const std::filesystem::path& file, const Project& project,
                                     const ImportHost& host, const Progress& progress = {},
                                     std::stop_token stop = {});
/// Where a project's model is looked for.
std::filesystem::path sceneFileOf(const std::filesystem::path& projectFile, const Project& project);

/// Each storey of a project opened, in order; what they have in common is shared.
Result<std::vector<OpenProject>> openStoreys(const OpenProject& open, const ImportHost& host,
                                             const Progress& progress = {}, std::stop_token stop = {});
/// The storey whose regions are nearest to an eye.
std::size_t storeyAt(std::span<const OpenProject> storeys, const glm::dvec3& eye);

/// Is the storey at this plane's height, with an outline that holds most of its corners?
bool liesOn(const Storey& storey, const WalkPlane& plane);
/// Has the project such a storey?
bool hasStoreyOn(const Project& project, const WalkPlane& plane);
/// With the bookmarks and paths on it; if it was the current one, the one before it is now. The last one
/// stays.
void removeStorey(Project& project, int storey);
/// Adds a storey for each plane that has none, with a name of its own. How many were added.
Result<int> addStoreys(Project& project, const OpenProject& open, std::span<const WalkPlane> planes,
                       bool ignoredSides, std::stop_token stop = {});

struct BakeRequest {
  std::optional<std::vector<int>> cameras;  ///< indices, baked in this order; none given: all of them
  bool surfaceLight = true;
  std::size_t memoryBytes = MemoryBudget::kUsual;  ///< for all that grows with the captures (bake.h)
  bool verify = false;  ///< reads what is there to its end first, instead of believing sizes and times
  /// Begins with all of the first view, from `from`: previews of the cameras that it is painted from, their
  /// captures, and light on its local geometry. Then previews of all others that have nothing yet, the
  /// surfaces' light, and the other captures.
  bool coarseFirst = false;
  std::optional<glm::dvec2> from;  ///< on the plan; none: the spawn
  BakeWatch watch;
  /// Asked before anything is stored, by any thread, and once more at the end; a failure ends the bake with
  /// it.
  std::function<Status()> mayGoOn;
};
struct ProjectBakeReport {
  BakeReport captures;
  std::vector<std::string> damaged;  ///< what was found damaged and baked again; each names its file
  /// What was baked and could not be put in place, though other files could: each names its file.
  std::vector<std::string> refused;
  bool surfaceLightBaked = false;
  bool surfaceLightReused = false;
  double surfaceLightSeconds = 0;
  std::uint64_t surfaceLightResumed = 0;  ///< samples that a bake before this one had left
  std::uint64_t bytes = 0;                ///< on disk, of all this project's captures
  /// What was missing was expected to take when the bake began, previews too, and what there was.
  double neededBytes = 0;
  std::uint64_t freeBytes = 0;
  /// Of another storey. Which cameras were baked is not kept: each storey numbers them for itself.
  void add(const ProjectBakeReport& other);
};
/// Where a project's captures are kept; makes the folder.
Result<CaptureStore> openCaptures(const std::filesystem::path& projectPath);
/// Into `store`, or into the project's own.
Result<ProjectBakeReport> bakeProject(const OpenProject& open, const BakeRequest& request,
                                      const CaptureStore& store, TaskRunner& runner,
                                      const Progress& progress = {}, std::stop_token stop = {});
Result<ProjectBakeReport> bakeProject(const OpenProject& open, const BakeRequest& request, TaskRunner& runner,
                                      const Progress& progress = {}, std::stop_token stop = {});

/// The same project to be baked at a lower quality: its captures have keys of their own. Its surface light is
/// that of the full quality.
OpenProject atQuality(const OpenProject& open, Quality quality);
/// Of each camera the key of the best capture that is on disk; nothing where there is none.
std::vector<std::optional<ContentKey>> bestKeys(const OpenProject& open, const CaptureStore& store);

/// Which cameras are on disk, at full quality.
std::vector<bool> bakedCameras(const OpenProject& open);
bool surfaceLightBaked(const OpenProject& open);

/// The cameras that views from a place on the plan are painted from, nearest first; outside all regions none.
std::vector<int> firstViewCameras(const OpenProject& open, const glm::dvec2& from);
/// Light on the local geometry of the region where a bake began, until the whole of it is there: under this
/// key. What lies in other regions has the mean of it.
ContentKey firstLightKey(const ContentKey& surfaceLightKey);

/// Cameras in baking order: first all that views from the spawn's region are painted from, then the rest,
/// each nearest to the spawn first.
std::vector<int> bakingOrder(const OpenProject& open);
/// The same, from a place on the plan.
std::vector<int> bakingOrder(const OpenProject& open, const glm::dvec2& from);

/// What is baked, loaded for the walk: as a whole, or as much as was there at some moment (walk_stream.h).
/// Damaged files are reported in `warnings`.
struct LoadedWalk {
  WalkScene walk;
  std::vector<ContentKey> keys;  ///< of walk.captures
  std::vector<bool> standsIn;    ///< by camera: a coarser rendition is shown for the capture of its key
  ContentKey surfaceLightKey;    ///< OpenProject's, or its firstLightKey
  std::vector<std::string> warnings;
  int missing = 0;  ///< cameras not on disk
  int coarse = 0;   ///< cameras of which only a preview or a draft is
  /// Regions whose local geometry is simplified, because it is above the project's budget.
  struct Simplified {
    int region = 0;
    SimplifyReport report;
    bool fromStore = false;  ///< else it was made just now
  };
  std::vector<Simplified> simplified;
  TriangleBudget budget;  ///< that walk.local keeps to
  /// Counts walk.captures while anybody uses them, also those that a later walk takes over.
  std::shared_ptr<MemoryBudget> captureMemory = std::make_shared<MemoryBudget>();
};
/// "12 of 126 cameras are previews or drafts so far"; nothing if none is.
std::string coarseText(const LoadedWalk& loaded);
/// What was simplified, by how much; nothing if nothing is. Never a walk through simplified geometry without
/// a word.
std::string simplifiedText(const LoadedWalk& loaded);

/// All of it. `former` gives parts that did not change.
Result<LoadedWalk> loadWalk(const OpenProject& open, const LoadedWalk* former, TaskRunner& runner,
                            const Progress& progress = {}, std::stop_token stop = {});

/// Eye moved into the nearest region; its height is kept.
glm::dvec3 clampToLayout(const Layout& layout, const glm::dvec3& eye);

}  // namespace acentric
