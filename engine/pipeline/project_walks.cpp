#include "engine/pipeline/project_walks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxName = 100;

Json toJson(const Bookmark& bookmark, const Project& project) {
  return {{"name", bookmark.name},
          {"storey", project.storeys[std::size_t(bookmark.storey)].name},
          {"eye", {bookmark.eye.x, bookmark.eye.y, bookmark.eye.z}},
          {"yawDegrees", tidyDegrees(bookmark.yawRadians)},
          {"pitchDegrees", tidyDegrees(bookmark.pitchRadians)},
          {"fovDegrees", bookmark.fovDegrees}};
}

Json toJson(const WalkPath& path, const Project& project) {
  Json poses = Json::array();
  for (const PathPose& pose : path.path.poses)
    poses.push_back({pose.seconds, pose.eye.x, pose.eye.y, pose.eye.z, tidyDegrees(pose.yawRadians),
                     tidyDegrees(pose.pitchRadians)});
  return {{"name", path.name},
          {"storey", project.storeys[std::size_t(path.storey)].name},
          {"poses", std::move(poses)}};
}

/// Of `json`, which is at `pointer`.
int storeyOf(const Json& json, const Project& project, const std::string& pointer) {
  if (!json.contains("storey")) return 0;
  const auto found = std::ranges::find(project.storeys, json["storey"].get<std::string>(), &Storey::name);
  if (found == project.storeys.end())
    throw std::runtime_error(pointer + "/storey: names none of the storeys");
  return int(found - project.storeys.begin());
}

Bookmark bookmarkFrom(const Json& json, const Project& project, const std::string& pointer) {
  const Json& eye = json.at("eye");
  return {json.at("name").get<std::string>(),
          storeyOf(json, project, pointer),
          {eye[0].get<double>(), eye[1].get<double>(), eye[2].get<double>()},
          radians(json.value("yawDegrees", 0.0)),
          radians(json.value("pitchDegrees", 0.0)),
          json.value("fovDegrees", Bookmark().fovDegrees)};
}

WalkPath pathFrom(const Json& json, const Project& project, const std::string& pointer) {
  WalkPath path{json.at("name").get<std::string>(), storeyOf(json, project, pointer), {}};
  for (const Json& pose : json.at("poses")) {
    std::array<double, 6> values{};
    std::ranges::transform(pose, values.begin(), [](const Json& value) { return value.get<double>(); });
    const auto& [seconds, x, y, z, yaw, pitch] = values;
    path.path.poses.push_back({{x, y, z}, radians(yaw), radians(pitch), seconds});
  }
  return path;
}

/// Of bookmarks or of paths, `key` in the file.
template <class Place>
Status checkNames(const std::vector<Place>& places, std::size_t most, const Project& project,
                  const char* key) {
  if (places.size() > most) return fail(ErrorKind::malformed, fmt::format("/{}: more than {}", key, most));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto refuse = [&](std::string_view what) {
      return fail(ErrorKind::malformed, fmt::format("/{}/{}{}", key, i, what));
    };
    const Place& place = places[i];
    if (place.name.empty() || place.name.size() > kMaxName)
      return refuse(fmt::format("/name: must have 1 to {} bytes", kMaxName));
    if (std::ranges::count(places, place.name, &Place::name) > 1)
      return refuse(fmt::format("/name: '{}' is the name of another one too", place.name));
    if (place.storey < 0 || place.storey >= int(project.storeys.size()))
      return refuse(fmt::format("/storey: there is no storey {}", place.storey));
  }
  return {};
}

}  // namespace

double tidyDegrees(double angleRadians) { return std::round(degrees(angleRadians) * 1e9) / 1e9; }

void addWalks(const Project& project, Json& json) {
  for (const Bookmark& bookmark : project.bookmarks) json["bookmarks"].push_back(toJson(bookmark, project));
  for (const WalkPath& path : project.paths) json["paths"].push_back(toJson(path, project));
}

void readWalks(const Json& json, Project& project) {
  if (const auto bookmarks = json.find("bookmarks"); bookmarks != json.end())
    for (std::size_t i = 0; i < bookmarks->size(); ++i)
      project.bookmarks.push_back(bookmarkFrom((*bookmarks)[i], project, fmt::format("/bookmarks/{}", i)));
  if (const auto paths = json.find("paths"); paths != json.end())
    for (std::size_t i = 0; i < paths->size(); ++i)
      project.paths.push_back(pathFrom((*paths)[i], project, fmt::format("/paths/{}", i)));
}

Status checkWalks(const Project& project) {
  if (Status named = checkNames(project.bookmarks, kMaxBookmarks, project, "bookmarks"); !named) return named;
  for (std::size_t i = 0; i < project.bookmarks.size(); ++i) {
    const Bookmark& bookmark = project.bookmarks[i];
    const PathPose pose{bookmark.eye, bookmark.yawRadians, bookmark.pitchRadians};
    if (const Status sound = pose.check(); !sound)
      return fail(ErrorKind::malformed, fmt::format("/bookmarks/{}: {}", i, sound.error().message));
    if (!(bookmark.fovDegrees >= 1 && bookmark.fovDegrees <= 179))
      return fail(ErrorKind::malformed, fmt::format("/bookmarks/{}/fovDegrees: must lie in 1..179", i));
  }
  if (Status named = checkNames(project.paths, kMaxPaths, project, "paths"); !named) return named;
  for (std::size_t i = 0; i < project.paths.size(); ++i) {
    const CameraPath& path = project.paths[i].path;
    const auto refuse = [&](const std::string& what) {
      return fail(ErrorKind::malformed, fmt::format("/paths/{}/poses{}", i, what));
    };
    if (path.poses.size() > kMaxPathPoses) return refuse(fmt::format(": more than {}", kMaxPathPoses));
    if (const Status sound = path.check(); !sound) return refuse(sound.error().message);
    if (path.poses.size() > 1 && !path.timed()) return refuse("/1: needs a time after the pose before it");
  }
  return {};
}

}  // namespace acentric
