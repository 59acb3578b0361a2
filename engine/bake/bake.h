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
#include "engine/bake/ray_scene.h"
#include "engine/base/progress.h"
#include "engine/base/task_runner.h"
#include "engine/image/capture.h"
#include "engine/image/sample_counts.h"
#include "engine/layout/layout.h"

namespace acentric {

class EyeViews;
class FlatMirrors;
class Shader;

/// The column camera by which a layout camera is baked: columns and rows from the settings; elevations from
/// the scene's bounds: above and below them nothing that lies beyond the near band can be but the background.
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

struct CaptureCounts {
  RayCounts rays;
  SampleCounts samples;
  std::uint64_t reflections = 0;  ///< samples of what flat mirrors show, besides those
  int eyeViews = 0;               ///< traced for pruning
  double eyeViewSeconds = 0;      ///< that it took
  CaptureCounts& operator+=(const CaptureCounts& other);
};

/// Bakes captures one after the other, and remembers between them what the regions' eyes see.
class CameraBaker {
 public:
  /// `memory` bounds what is remembered, bytes.
  CameraBaker(const RayScene& scene, const BakeSettings& settings, std::size_t memory = kSightMemory);
  ~CameraBaker();

  /// One capture: along each pixel's ray the surfaces beyond the regions that the camera serves, each for the
  /// roles that need it: it lies beyond the role's grown polygon and within its part, and (with pruning) its
  /// region sees it. What is behind everything is a sample without distance. Where a plane mirror is met,
  /// what it shows is kept at its virtual place, for the roles whose part holds that. Counts are added. A
  /// stop gives the error `cancelled`, never part of a capture.
  Result<Capture> bake(const LayoutCamera& camera, const ColumnCamera& columns, TaskRunner& runner,
                       CaptureCounts& counts, std::stop_token stop = {});

  static constexpr std::size_t kSightMemory = std::size_t(512) << 20;

 private:
  const RayScene& scene_;
  BakeSettings settings_;
  std::size_t memory_;
  std::unique_ptr<Shader> shader_;
  std::unique_ptr<FlatMirrors> mirrors_;
  std::unique_ptr<EyeViews> views_;
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
};

/// Of finished captures that wait to be written, unless told otherwise.
inline constexpr std::size_t kBakeMemory = std::size_t(1) << 30;

/// Bakes `which` cameras (indices, in this order), those that the sink has are skipped. Progress counts
/// cameras. Finished captures that wait to be written take at most `memoryBytes`, or are a single one.
/// Stopped, it returns within a second; what was traced before is written as far as half of it allows.
Result<BakeReport> bake(const RayScene& scene, const Layout& layout, const std::vector<int>& which,
                        const BakeSettings& settings, CaptureSink& sink, TaskRunner& runner,
                        const Progress& progress = {}, std::stop_token stop = {},
                        std::size_t memoryBytes = kBakeMemory);

}  // namespace acentric
