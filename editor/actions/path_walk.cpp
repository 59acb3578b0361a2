#include "editor/actions/path_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "editor/commands/storey_edits.h"
#include "editor/commands/walk_edits.h"
#include "engine/pipeline/walk_ground.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

/// Is the storey that is worked on also the one that is laid out?
bool settled(const Session& session) {
  return session.built() && session.built()->project.storey == session.project().storey &&
         session.built()->project.storeys.size() == session.project().storeys.size();
}

void showStoreyOf(ActionContext& c, const WalkPath& path) {
  const Project& project = c.session.project();
  if (path.storey == project.storey) return;
  c.state.selection.clear();
  c.session.apply(showStorey(project, path.storey));
}

/// The storey that a pose of a path over stairs is on.
void enterStoreyOf(ActionContext& c, const PathPose& pose) {
  const OpenProject& open = *c.session.built();
  if (!open.ground->rises()) return;
  const int storey = open.ground->storeyAt(pose.eye);
  if (storey != c.session.project().storey) c.session.walkInto(storey);
}

void placeOnPath(ActionContext& c, const WalkPath& path) {
  Walker& walker = c.state.walker;
  const WalkPose before = walker.pose();
  enterStoreyOf(c, poseAt(path.path, c.state.replay.at()));
  walker.standAt(standing(*c.session.built(), walkPose(poseAt(path.path, c.state.replay.at()))));
  c.state.replayed = walker.pose();
  if (walker.pose() == before) c.state.replay.resting();
}

/// May the path be followed on the storey that is shown? Over stairs a path is on several.
bool leadsOver(const ActionContext& c, const WalkPath& path) {
  const OpenProject& open = *c.session.built();
  return path.storey == c.session.project().storey || open.ground->rises();
}

/// Is what is around the place where the eye goes next known? Of a walk that is read page by page.
bool isAroundNext(const ActionContext& c) {
  if (c.state.goTo) return c.session.isAround(glm::dvec2(c.state.goTo->eye));
  const WalkPath* path = c.state.walkSelection.path(c.session.project());
  if (path == nullptr || !c.state.replay.playing()) return true;
  return c.session.isAround(glm::dvec2(poseAt(path->path, c.state.replay.at()).eye));
}

void tellReplay(ActionContext& c, const std::string& name) {
  if (const auto report = c.state.replay.takeReport()) {
    c.state.replayReport = describe(*report);
    c.session.messages().add(MessageLevel::info, trf("Replay of {}: {}", name, c.state.replayReport));
  }
}

}  // namespace

Footing footingOf(const OpenProject& open, const glm::dvec2& place) {
  const int storey = open.project.storey;
  return open.ground->on(storey, place).value_or(Footing{storey, place, open.layout->spec.groundAt(place)});
}

EyeHeights eyeHeights(const OpenProject& open, const glm::dvec2& place) {
  const double z = footingOf(open, place).ground + open.layout->spec.eyeHeight;
  const double range = open.project.bake.eyeRange;
  return {z - range, z + range};
}

WalkPose standing(const OpenProject& open, WalkPose pose) {
  const glm::dvec2 place = nearestStanding(*open.layout, glm::dvec2(pose.eye));
  const EyeHeights heights = eyeHeights(open, place);
  pose.eye = glm::dvec3(place, std::clamp(pose.eye.z, heights.low, heights.high));
  return pose;
}

void walkByKeys(ActionContext& c, double seconds, const WalkKeys& keys) {
  const OpenProject& open = *c.session.built();
  Walker& walker = c.state.walker;
  const glm::dvec2 place(walker.pose().eye);
  const Footing from = footingOf(open, place);
  Footing at = from;
  walker.setSpeed(c.session.preferences().walkMetresPerSecond);
  walker.step(seconds, keys, eyeHeights(open, place), [&](const glm::dvec2&, const glm::dvec2& to) {
    at = open.ground->walk(from, to);
    return at.place;
  });
  WalkPose pose = walker.pose();
  pose.eye.z += at.ground - from.ground;
  if (at != from) walker.setPose(pose);
  if (at.storey != from.storey) c.session.walkInto(at.storey);
}

bool followPath(ActionContext& c, double now, bool walking) {
  EditorState& state = c.state;
  if (!settled(c.session) || !isAroundNext(c)) {
    if (state.replay.playing()) state.replay.play();  // no time passes until there is something to walk on
    return false;
  }
  if (const auto there = std::exchange(state.goTo, std::nullopt)) {
    state.replay.pause();
    state.walker.standAt(standing(*c.session.built(), *there));
    return true;
  }
  if (!state.replay.playing()) return false;
  const WalkPath* path = state.walkSelection.path(c.session.project());
  const bool takenOver = walking || (state.replayed && state.walker.pose() != *state.replayed);
  if (path == nullptr || !leadsOver(c, *path) || takenOver) {
    state.replay.pause();
    return false;
  }
  state.replay.picturesShown(now, state.picturesShown);
  state.replay.advance(now, path->path.seconds());
  placeOnPath(c, *path);
  tellReplay(c, path->name);
  return state.replay.playing();
}

void recordEye(ActionContext& c, double now) {
  WalkRecorder& recorder = c.state.recorder;
  if (!recorder.recording()) return;
  const bool walked = c.session.built() && c.session.built()->ground->rises();
  if (recorder.full() || (!walked && recorder.storey() != c.session.project().storey))
    return startOrStopRecording(c);
  recorder.take(now, c.state.walker.pose());
}

void startOrStopRecording(ActionContext& c) {
  WalkRecorder& recorder = c.state.recorder;
  c.state.bottomTab = BottomTab::paths;
  if (!recorder.recording()) {
    c.state.replay.pause();
    return recorder.start(c.session.project().storey);
  }
  const int storey = recorder.storey();
  const CameraPath path = recorder.stop();
  if (path.poses.size() < 2) {
    c.session.messages().add(MessageLevel::warning, tr("Nothing was recorded: the eye did not move"));
    return;
  }
  if (!c.session.apply(addPath(c.session.project(), path, storey))) return;
  const std::vector<WalkPath>& paths = c.session.project().paths;
  selectWalk(c, {WalkSelection::Kind::path, paths.size() - 1, {}});
  c.session.messages().add(MessageLevel::good, trf("Recorded {}: {:.1f} s, {} key poses", paths.back().name,
                                                   path.seconds(), path.poses.size()));
}

void playOrPause(ActionContext& c) {
  if (c.state.replay.playing()) return c.state.replay.pause();
  const WalkPath* path = c.state.walkSelection.path(c.session.project());
  if (path == nullptr) return;
  c.state.replayed.reset();
  c.state.replay.play();
  showStoreyOf(c, *path);  // the path may be another one now
}

void stopReplay(ActionContext& c) {
  c.state.replay.stop();
  if (const WalkPath* path = c.state.walkSelection.path(c.session.project())) tellReplay(c, path->name);
}

void scrub(ActionContext& c, double seconds) {
  const WalkPath* path = c.state.walkSelection.path(c.session.project());
  if (path == nullptr) return;
  c.state.replay.seek(std::clamp(seconds, 0.0, path->path.seconds()));
  const WalkPose there = walkPose(poseAt(path->path, c.state.replay.at()));
  if (settled(c.session) && leadsOver(c, *path) && c.session.isAround(glm::dvec2(there.eye)))
    return placeOnPath(c, *path);
  c.state.goTo = there;
  showStoreyOf(c, *path);
}

void goToBookmark(ActionContext& c, std::size_t bookmark) {
  const Project& project = c.session.project();
  const Bookmark& there = project.bookmarks[bookmark];
  c.state.goTo = WalkPose{there.eye, there.yawRadians, there.pitchRadians};
  if (there.storey != project.storey) c.state.selection.clear();
  c.session.apply(goToBookmark(project, bookmark));
}

void selectWalk(ActionContext& c, const WalkSelection& selection) {
  WalkSelection& selected = c.state.walkSelection;
  if (selected.kind != selection.kind || selected.number != selection.number) {
    stopReplay(c);
    c.state.replayReport.clear();
  }
  selected = selection;
}

PathSituation pathSituation(const ActionContext& c) {
  const Project& project = c.session.project();
  return {project.paths, project.storey, c.state.walkSelection};
}

void takePathIntent(ActionContext& c, const PathIntent& intent) {
  if (!intent.path) return c.state.walkSelection.pose.reset();
  selectWalk(c, {WalkSelection::Kind::path, *intent.path, intent.pose});
  if (intent.changed)
    c.session.applyLive(setPath(c.session.project(), *intent.path, *intent.changed), intent.finished);
}

int posesOutside(const WalkPath& path, const OpenProject& open) {
  return int(std::ranges::count_if(path.path.poses, [&](const PathPose& pose) {
    return !open.ground->holds(open.project.storey, pose.eye);
  }));
}

}  // namespace acentric::editor
