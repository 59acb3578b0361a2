#pragma once
/// Bakes the captures of a layout. Camera by camera: what is finished is put into the sink at once and never
/// again.

#include <atomic>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/bake/bake_settings.h"
#include "engine/bake/ray_scene.h"
#include "engine/base/progress.h"
#include "engine/base/task_runner.h"
#include "engine/image/capture.h"
#include "engine/layout/layout.h"

namespace acentric {

/// The column camera by which a layout camera is baked: columns and rows from the settings; elevation range
/// from the scene's bounds: nothing steeper than what lies beyond the near band needs to be seen.
ColumnCamera columnCameraFor(const LayoutCamera& camera, double eyeZ, double nearBand,
                             const Bounds& sceneBounds, bool skyVisible, const BakeSettings& settings);

/// Everything that can change the pixels: scene, plan, settings, column camera, served regions.
ContentKey captureKey(const Scene& scene, const EffectPlan& plan, const BakeSettings& settings,
                      const LayoutCamera& camera, const ColumnCamera& columnCamera);

/// Keys of all cameras of a layout, in order of Layout::cameras.
std::vector<ContentKey> captureKeys(const Scene& scene, const EffectPlan& plan, const BakeSettings& settings,
                                    const Layout& layout);

/// One capture: for every served region the first surface beyond its grown polygon, and the blended surfaces
/// in front of it. Empty samples (stop requested) are never returned as a result: the Result is `cancelled`.
Result<Capture> bakeCamera(const RayScene& scene, const LayoutCamera& camera,
                           const ColumnCamera& columnCamera, const BakeSettings& settings, TaskRunner& runner,
                           RayCounts& rays, std::stop_token stop = {});

/// Where captures go. `put` may be called from another thread than bake's caller, one call at a time; `has`
/// may be called meanwhile.
class CaptureSink {
 public:
  virtual ~CaptureSink() = default;
  virtual bool has(const ContentKey& key) const = 0;
  virtual Status put(const ContentKey& key, const Capture& capture) = 0;
};

struct BakedCamera {
  int camera = 0;
  ContentKey key;
  bool reused = false;
  double seconds = 0;  ///< tracing
  std::size_t samples = 0;
};

struct BakeReport {
  std::vector<BakedCamera> cameras;
  int baked = 0;
  int reused = 0;
  double seconds = 0;
  std::size_t samples = 0;
  RayCounts rays;
};

/// Bakes `which` cameras (indices, in this order), those that the sink has are skipped. Progress counts
/// cameras.
Result<BakeReport> bake(const RayScene& scene, const Layout& layout, const std::vector<int>& which,
                        const BakeSettings& settings, CaptureSink& sink, TaskRunner& runner,
                        const Progress& progress = {}, std::stop_token stop = {});

}  // namespace acentric
