#pragma once
/// Which cameras sample a picked point of a surface, asked in the background.

#include <memory>

#include "engine/inspect/point_sampling.h"
#include "engine/pipeline/pipeline.h"

namespace acentric::editor {

struct ScenePick {
  std::shared_ptr<const OpenProject> of;
  SurfacePoint point;
  PointSampling sampling;
  int held = 0;  ///< of sampling.cameras: they come first
};
using ScenePickPtr = std::shared_ptr<const ScenePick>;

ScenePick pickOf(std::shared_ptr<const OpenProject> open, const SurfacePoint& point);

}  // namespace acentric::editor
