#include "editor/commands/walk_edits.h"

#include <fmt/format.h>

#include <algorithm>

#include "editor/commands/stored_angle.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

/// "place 3": the first number that no other has.
template <class Place>
std::string freeName(const std::vector<Place>& places, const char* word) {
  for (std::size_t n = 1;; ++n) {
    std::string name = fmt::format("{} {}", word, n);
    if (std::ranges::find(places, name, &Place::name) == places.end()) return name;
  }
}

void view(Bookmark& bookmark, const Project& project, const PathPose& here) {
  bookmark.storey = project.storey;
  bookmark.eye = here.eye;
  bookmark.yawRadians = storedAngle(here.yawRadians);
  bookmark.pitchRadians = storedAngle(here.pitchRadians);
  bookmark.fovDegrees = project.fovDegrees;
}

CameraPath stored(CameraPath path) {
  for (PathPose& pose : path.poses) {
    pose.yawRadians = storedAngle(pose.yawRadians);
    pose.pitchRadians = storedAngle(pose.pitchRadians);
  }
  return path;
}

template <class Place>
Edit renamed(const Project& project, std::vector<Place> Project::*list, std::size_t index, std::string name) {
  Edit edit{project, trf("Rename {} to {}", (project.*list)[index].name, name)};
  (edit.project.*list)[index].name = std::move(name);
  return edit;
}

template <class Place>
Edit removed(const Project& project, std::vector<Place> Project::*list, std::size_t index) {
  Edit edit{project, trf("Remove {}", (project.*list)[index].name)};
  (edit.project.*list).erase((edit.project.*list).begin() + std::ptrdiff_t(index));
  return edit;
}

template <class Place>
Edit moved(const Project& project, std::vector<Place> Project::*list, std::size_t index, int steps) {
  Edit edit{project, steps < 0 ? trf("Move {} up", (project.*list)[index].name)
                               : trf("Move {} down", (project.*list)[index].name)};
  auto& places = edit.project.*list;
  const auto to = std::clamp<std::ptrdiff_t>(std::ptrdiff_t(index) + steps, 0, std::ssize(places) - 1);
  Place place = std::move(places[index]);
  places.erase(places.begin() + std::ptrdiff_t(index));
  places.insert(places.begin() + to, std::move(place));
  return edit;
}

}  // namespace

Edit addBookmark(const Project& project, const PathPose& here) {
  Bookmark bookmark;
  bookmark.name = freeName(project.bookmarks, trIn("name of a new bookmark", "place"));
  view(bookmark, project, here);
  Edit edit{project, trf("Bookmark {}", bookmark.name)};
  edit.project.bookmarks.push_back(std::move(bookmark));
  return edit;
}

Edit renameBookmark(const Project& project, std::size_t bookmark, std::string name) {
  return renamed(project, &Project::bookmarks, bookmark, std::move(name));
}

Edit updateBookmark(const Project& project, std::size_t bookmark, const PathPose& here) {
  Edit edit{project, trf("Move {} here", project.bookmarks[bookmark].name)};
  view(edit.project.bookmarks[bookmark], project, here);
  return edit;
}

Edit removeBookmark(const Project& project, std::size_t bookmark) {
  return removed(project, &Project::bookmarks, bookmark);
}

Edit moveBookmark(const Project& project, std::size_t bookmark, int steps) {
  return moved(project, &Project::bookmarks, bookmark, steps);
}

Edit goToBookmark(const Project& project, std::size_t bookmark) {
  const Bookmark& there = project.bookmarks[bookmark];
  Edit edit{project, trf("Go to {}", there.name)};
  edit.project.storey = there.storey;
  edit.project.fovDegrees = there.fovDegrees;
  return edit;
}

Edit addPath(const Project& project, const CameraPath& path, int storey) {
  WalkPath added{freeName(project.paths, trIn("name of a new path", "walk")), storey, stored(path)};
  Edit edit{project, trf("Keep {}", added.name)};
  edit.project.paths.push_back(std::move(added));
  return edit;
}

Edit renamePath(const Project& project, std::size_t path, std::string name) {
  return renamed(project, &Project::paths, path, std::move(name));
}

Edit removePath(const Project& project, std::size_t path) { return removed(project, &Project::paths, path); }

Edit movePath(const Project& project, std::size_t path, int steps) {
  return moved(project, &Project::paths, path, steps);
}

Edit setPath(const Project& project, std::size_t path, CameraPath changed) {
  Edit edit{project, trf("Change {}", project.paths[path].name)};
  edit.project.paths[path].path = stored(std::move(changed));
  return edit;
}

CameraPath withPose(CameraPath path, std::size_t pose, PathPose changed) {
  const bool last = pose + 1 == path.poses.size();
  const double least = pose == 0 ? 0 : path.poses[pose - 1].seconds + kLeastKeySeconds;
  const double most = pose == 0 ? 0
                      : last    ? kMostPathSeconds
                                : path.poses[pose + 1].seconds - kLeastKeySeconds;
  changed.seconds = std::clamp(changed.seconds, least, std::max(least, most));
  path.poses[pose] = changed;
  return path;
}

std::pair<CameraPath, std::size_t> withPoseAt(CameraPath path, double seconds) {
  const PathPose pose = poseAt(path, seconds);
  const auto after = std::ranges::upper_bound(path.poses, pose.seconds, {}, &PathPose::seconds);
  const std::size_t number = std::size_t(after - path.poses.begin());
  for (const std::size_t near : {number - 1, number})
    if (near < path.poses.size() && std::abs(path.poses[near].seconds - pose.seconds) < 2 * kLeastKeySeconds)
      return {std::move(path), near};
  path.poses.insert(after, pose);
  return {std::move(path), number};
}

CameraPath withPoseAfter(CameraPath path, const glm::dvec2& place, double metresPerSecond) {
  if (path.poses.empty()) return path;
  PathPose pose = path.poses.back();
  const glm::dvec2 way = place - glm::dvec2(pose.eye);
  pose.eye = glm::dvec3(place, pose.eye.z);
  const bool timed = path.timed() || path.poses.size() == 1;
  if (timed) pose.seconds += std::max(kLeastKeySeconds, glm::length(way) / metresPerSecond);
  if (pose.seconds > kMostPathSeconds) return path;
  if (way != glm::dvec2(0)) pose.yawRadians = std::atan2(way.y, way.x);
  pose.pitchRadians = 0;
  path.poses.push_back(pose);
  return path;
}

CameraPath withoutPose(CameraPath path, std::size_t pose) {
  if (path.poses.size() < 2) return path;
  path.poses.erase(path.poses.begin() + std::ptrdiff_t(pose));
  const double begins = path.poses.front().seconds;
  for (PathPose& each : path.poses) each.seconds -= begins;
  return path;
}

}  // namespace acentric::editor
