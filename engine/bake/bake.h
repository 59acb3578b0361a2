#pragma once
/// Bakes the captures of a layout. Camera by camera: what is finished is put into the sink at once and never
/// again.

#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "engine/bake/bake_settings.h"
#include "engine/bake/bake_watch.h"
#include "engine/bake/ray_scene.h"
#include "engine/bake/test_eyes.h"
#include "engine/base/memory_budget.h"
#include "engine/base/progress.h"
#include "engine/base/task_runner.h"
#include "engine/image/capture.h"
#include "engine/image/sample_counts.h"
#include "engine/layout/layout.h"

namespace acentric {

class EyeViews;
class FlatMirrors;
class TexturePyramids;
class RegionSkies;
class Shader;

/// Of a camera: the settings' samples per degree times its density, within what settings may have.
double samplesPerDegreeOf(const LayoutCamera& camera, const BakeSettings& settings);

/// The column camera by which a layout camera is baked: columns and rows from its samples per degree;
/// elevations from the scene's bounds: above and below them nothing that lies beyond the near band can be but
/// the background.
ColumnCamera columnCameraFor(const LayoutCamera& camera, double eyeZ, double nearBand,
                             const Bounds& sceneBounds, const BakeSettings& settings);

/// The same of one of a layout's cameras.
ColumnCamera columnCameraFor(const LayoutCamera& camera, const Layout& layout, const Bounds& sceneBounds,
                             const BakeSettings& settings);

/// Everything that can change the pixels: scene, plan, settings, column camera, served regions.
ContentKey captureKey(const Scene& scene, const EffectPlan& plan, const BakeSettings& settings,
                      const LayoutCamera& camera, const ColumnCamera& columnCamera);
/// The same in parts: program, the scene's (scene, geometry, materials, lights), effects, settings, place,
/// regions, image.
KeyParts captureKeyParts(const Scene& scene, const EffectPlan& plan, const BakeSettings& settings,
                         const LayoutCamera& camera, const ColumnCamera& columnCamera);
/// What every key begins with that depends on the scene and its effects, made by this version of the program.
KeyParts sceneKeyParts(std::string_view version, const Scene& scene, const EffectPlan& plan);

/// Keys of all cameras of a layout, in order of Layout::cameras.
std::vector<ContentKey> captureKeys(const Scene& scene, const EffectPlan& plan, const BakeSettings& settings,
                                    const Layout& layout);

/// What the parts of a capture take, seconds of work (WorkClock) on all threads together.
struct CaptureSeconds {
  double testEyes = 0;     ///< choosing where regions are looked from
  double eyeViews = 0;     ///< tracing what these see
  double march = 0;        ///< along the pixels' rays, with the light of what they meet
  double silhouettes = 0;  ///< where surfaces end in their pixels
  double edgeOn = 0;       ///< of facets seen edge on
  double rounding = 0;     ///< joining, numbering and rounding what was found
  double sight() const { return testEyes + eyeViews; }
  double total() const { return sight() + march + silhouettes + edgeOn + rounding; }
  CaptureSeconds& operator+=(const CaptureSeconds& other);
};

struct CaptureCounts {
  RayCounts rays;
  SampleCounts samples;
  std::uint64_t reflections = 0;  ///< samples of what flat mirrors show, besides those
  int eyeViews = 0;               ///< traced for pruning
  CaptureSeconds seconds;
  CaptureCounts& operator+=(const CaptureCounts& other);
};

/// Bakes captures one after the other, and remembers between them what the regions' eyes see.
class CameraBaker {
 public:
  /// Told of columns and rays traced so far, from any thread, every few columns.
  using Traced = std::function<void(int columns, std::uint64_t rays)>;

  /// Counts what it holds against `budget`, which outlives it; none given: one of its own. What the regions'
  /// eyes see is remembered up to a third of the limit.
  CameraBaker(const RayScene& scene, const BakeSettings& settings, MemoryBudget* budget = nullptr);
  ~CameraBaker();

  /// One capture: along each pixel's ray the surfaces beyond the regions that the camera serves, each for the
  /// roles that need it: it lies beyond the role's grown polygon and within its part, and (with pruning) its
  /// region sees it. What is behind everything is a sample without distance. Where a plane mirror is met,
  /// what it shows is kept at its virtual place, for the roles whose part holds that. Counts are added. A
  /// stop gives the error `cancelled`, never part of a capture. What is traced is counted until it is handed
  /// out; while there is no room, tracing waits for what others hold and will give back by themselves.
  Result<Capture> bake(const LayoutCamera& camera, const ColumnCamera& columns, TaskRunner& runner,
                       CaptureCounts& counts, std::stop_token stop = {}, const Traced& traced = {});

  /// Of the regions served so far.
  TestEyeSummary testEyes() const;

 private:
  const RayScene& scene_;
  BakeSettings settings_;
  std::unique_ptr<MemoryBudget> ownBudget_;
  MemoryBudget& budget_;
  std::unique_ptr<Shader> shader_;
  std::stop_token shaderStop_;
  std::unique_ptr<FlatMirrors> mirrors_;
  std::unique_ptr<TexturePyramids> textures_;
  std::unique_ptr<TestEyes> testEyes_;
  std::unique_ptr<EyeViews> views_;
  std::unique_ptr<RegionSkies> skies_;
};

/// Traces the first ray of every pixel of a capture and does nothing with what it hits: what the ray tracer
/// alone takes. How many hit something.
std::uint64_t traceFirstRays(const RayScene& scene, const LayoutCamera& camera, const ColumnCamera& columns,
                             TaskRunner& runner);

/// Where captures go. `put` may be called from another thread than bake's caller, one call at a time; `has`
/// may be called meanwhile. A stop of `put` means that the rest of this capture is not worth the time: it
/// gives `cancelled` soon, and keeps nothing of the capture.
class CaptureSink {
 public:
  virtual ~CaptureSink() = default;
  virtual bool has(const ContentKey& key) const = 0;
  virtual Status put(const ContentKey& key, const Capture& capture, const std::stop_token& stop) = 0;
  /// Comes before a capture is put, on bake's thread.
  virtual void tell(const ContentKey& key, const SampleCounts& samples) {
    static_cast<void>(key), static_cast<void>(samples);
  }
  /// Asked when a capture could not be put: is that this capture's trouble alone, so that the others are
  /// baked all the same?
  virtual bool passesOver(const ContentKey& key, const Error& error) {
    static_cast<void>(key), static_cast<void>(error);
    return false;
  }
};

struct BakedCamera {
  int camera = 0;
  ContentKey key;
  bool reused = false;
  double seconds = 0;  ///< tracing
  SampleCounts samples;
};

struct BakeReport {
  std::vector<BakedCamera> cameras;
  int baked = 0;
  int reused = 0;
  double seconds = 0;
  CaptureCounts counts;
  TestEyeSummary testEyes;    ///< of the regions that the baked cameras serve, where the bake prunes
  std::size_t peakBytes = 0;  ///< the most that was held of what `memoryBytes` limits
};

/// Bakes `which` cameras (indices, in this order), those that the sink has are skipped. Progress counts
/// cameras and their columns. Stopped, it returns within a second; what was traced before is written as far
/// as half of it allows.
///
/// `memoryBytes` limits all that grows with the captures: what the regions' eyes see (at most a third), the
/// capture being traced (what there is of it; twice while its columns are joined), and those that wait to be
/// written or are being written (three times each: samples, planes, files). Tracing waits where the limit
/// would be exceeded. A capture that needs more by itself is baked alone: no more is held then than its own
/// eyes' views, three times its samples, and what was traced of the next. The scene with its ray tracer, and
/// light gathered on its surfaces (gathered_light.h), come on top.
Result<BakeReport> bake(const RayScene& scene, const Layout& layout, const std::vector<int>& which,
                        const BakeSettings& settings, CaptureSink& sink, TaskRunner& runner,
                        const Progress& progress = {}, std::stop_token stop = {},
                        std::size_t memoryBytes = MemoryBudget::kUsual, const BakeWatch& watch = {});

}  // namespace acentric
