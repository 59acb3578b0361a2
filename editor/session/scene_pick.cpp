#include "editor/session/scene_pick.h"

#include <algorithm>

#include "editor/session/coverage.h"
#include "engine/pipeline/coverage.h"

namespace acentric::editor {

ScenePick pickOf(std::shared_ptr<const OpenProject> open, const SurfacePoint& point) {
  const ProjectReach reach(*open);
  const SurfaceJudge judge(*reach, coverageOptions(*open));
  ScenePick pick{std::move(open), point, samplingOfPoint(*reach, judge, point), 0};
  pick.held = int(std::ranges::count_if(pick.sampling.cameras, &CameraSampling::held));
  return pick;
}

}  // namespace acentric::editor
