#pragma once
/// The test eyes of a region: places that stand for all the others. Some are placed evenly, without a look at
/// the scene. Behind furniture and through doors these miss things, so random looks tell what pruning by them
/// loses, and where that is too much, eyes are added that see it.

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <vector>

#include "engine/bake/bake_settings.h"
#include "engine/bake/pruning_loss.h"
#include "engine/bake/ray_scene.h"
#include "engine/base/task_runner.h"
#include "engine/layout/layout.h"

namespace acentric {

/// `settings.testEyes` of them: the corners first, where surfaces shift most against each other, then the
/// centre, the middles of the edges, and places spread evenly inside. Heights lie within `settings.eyeRange`
/// of `eyeZ`, and follow from the place alone, so that regions share the eyes at their corners.
std::vector<glm::dvec3> placedEyes(const ConvexPolygon& polygon, double eyeZ, const BakeSettings& settings);

struct RegionEyes {
  std::vector<glm::dvec3> eyes;  ///< those placed, then those found
  std::size_t placed = 0;
  /// Of looks that no eye was chosen by. Without `settings.pruningLoss` there are none.
  PruningLoss loss;
};

/// Adds eyes until, with 95 % confidence, no more than `settings.pruningLoss` of the looks lose what they
/// see, or there are kMostTestEyes. Each round takes fresh looks; of the eyes that lost something those are
/// added that see most of what was lost. The same scene, region and settings give the same eyes on any number
/// of threads. Meaningless when stopped.
RegionEyes findTestEyes(const RayScene& scene, const ConvexPolygon& polygon, const ConvexPolygon& grown,
                        double eyeZ, const BakeSettings& settings, TaskRunner& runner, RayCounts& rays,
                        const std::stop_token& stop = {});

/// Of several regions.
struct TestEyeSummary {
  std::size_t regions = 0, eyes = 0;
  std::size_t most = 0;  ///< in one region
  PruningLoss loss;
  double worstLimit = 0;  ///< of one region: PruningLoss::atMost; 0 where nobody looked

  void add(const RegionEyes& region);
  TestEyeSummary& operator+=(const TestEyeSummary& other);
};

/// Eyes of regions, found when they are asked for first. May be asked from several threads, each with its own
/// runner.
class TestEyes {
 public:
  TestEyes(const RayScene& scene, const BakeSettings& settings) : scene_(scene), settings_(settings) {}

  /// Null when stopped. Rays are counted by who finds them.
  std::shared_ptr<const RegionEyes> of(const ConvexPolygon& polygon, const ConvexPolygon& grown, double eyeZ,
                                       TaskRunner& runner, RayCounts& rays, const std::stop_token& stop = {});
  /// Of all found so far.
  TestEyeSummary summary() const;

 private:
  const RayScene& scene_;
  BakeSettings settings_;
  mutable std::mutex mutex_;
  std::map<std::vector<double>, std::shared_ptr<const RegionEyes>> found_;  ///< by height and corners
};

}  // namespace acentric
