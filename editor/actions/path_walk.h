#pragma once
/// Recording, replay and bookmarks as the walk goes on.

#include "editor/actions/action.h"
#include "engine/pipeline/walk_ground.h"

namespace acentric::editor {

/// Where the feet are of who is at a place of the storey that is laid out; where one may not stand, as high.
Footing footingOf(const OpenProject& open, const glm::dvec2& place);
/// Of an eye there, that captures are baked for.
EyeHeights eyeHeights(const OpenProject& open, const glm::dvec2& place);
/// A pose as one may stand there: within the walkable ground and the heights that captures are baked for.
WalkPose standing(const OpenProject& open, WalkPose pose);
/// Moves the eye by what the keys say, over stairs up and down too; the storey becomes the one that it is on.
void walkByKeys(ActionContext& c, double seconds, const WalkKeys& keys);

/// Called in each frame before the eye walks: takes it to where it was asked to go, and along the path that
/// is replayed. `walking`: keys move it; that takes over. True while it is being moved.
bool followPath(ActionContext& c, double now, bool walking);
/// Called in each frame after the eye walked.
void recordEye(ActionContext& c, double now);

/// What was recorded becomes a path of the project, and is selected.
void startOrStopRecording(ActionContext& c);
/// Of the selected path.
void playOrPause(ActionContext& c);
void stopReplay(ActionContext& c);
/// The eye goes to where the selected path is after so many seconds.
void scrub(ActionContext& c, double seconds);
void goToBookmark(ActionContext& c, std::size_t bookmark);
/// A bookmark or path and a key pose; a replay of another path ends.
void selectWalk(ActionContext& c, const WalkSelection& selection);
/// What the path tool needs to know, and what it asks for.
PathSituation pathSituation(const ActionContext& c);
void takePathIntent(ActionContext& c, const PathIntent& intent);
/// How many key poses of a path on the storey that is laid out stand where one may not.
int posesOutside(const WalkPath& path, const OpenProject& open);

}  // namespace acentric::editor
