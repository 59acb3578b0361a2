#include "engine/pipeline/camera_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/pipeline/foreign_paths.h"

namespace acentric {
namespace {

constexpr std::size_t kMaxPoses = 1'000'000;
constexpr double kMostMetres = 1e9;

Result<PathPose> poseFrom(const nlohmann::json& json, const std::string& pointer, const std::string& where) {
  const auto bad = [&](const char* what) { return fail(ErrorKind::malformed, pointer + ": " + what, where); };
  if (!json.is_object() || !json.contains("eye")) return bad("needs \"eye\": [x, y, z]");
  const auto& eye = json["eye"];
  if (!eye.is_array() || eye.size() != 3) return bad("\"eye\" must be three numbers in metres");
  PathPose pose;
  for (int k = 0; k < 3; ++k) {
    if (!eye[std::size_t(k)].is_number()) return bad("\"eye\" must be three numbers in metres");
    pose.eye[k] = eye[std::size_t(k)].get<double>();
  }
  for (const auto& [key, target] :
       {std::pair{"yaw", &pose.yawRadians}, std::pair{"pitch", &pose.pitchRadians}}) {
    if (!json.contains(key)) continue;
    if (!json[key].is_number()) return bad("\"yaw\" and \"pitch\" must be numbers in degrees");
    *target = radians(json[key].get<double>());
  }
  if (json.contains("seconds")) {
    if (!json["seconds"].is_number()) return bad("\"seconds\" must be a number");
    pose.seconds = json["seconds"].get<double>();
  }
  return pose;
}

/// Centres of the regions, without those that lie outside the walkable outline (in a wall, say).
std::vector<glm::dvec2> standingPlaces(const Layout& layout) {
  std::vector<glm::dvec2> inside, all;
  for (const Region& region : layout.regions) {
    all.push_back(region.polygon.centroid());
    if (layout.spec.outline.contains(all.back())) inside.push_back(all.back());
  }
  return inside.empty() ? all : inside;
}

/// Azimuth in which one can walk farthest from a point: there is most to see that way.
double longestWalk(const Layout& layout, const glm::dvec2& point) {
  constexpr int kDirections = 36;
  const double step = 0.25 * layout.spec.cellSize;
  const auto walkable = [&](const glm::dvec2& p) {
    return layout.regionAt(p) && (layout.spec.outline.empty() || layout.spec.outline.contains(p));
  };
  double best = 0;
  int bestSteps = -1;
  for (int k = 0; k < kDirections; ++k) {
    const double azimuth = kTwoPi * k / kDirections;
    int steps = 0;
    while (steps < 400 && walkable(point + (steps + 1) * step * directionOf(azimuth))) ++steps;
    if (steps > bestSteps) best = azimuth, bestSteps = steps;
  }
  return best;
}

/// The shorter way from one azimuth towards another, at most `most` radians.
double turnTowards(double from, double to, double most) {
  const double difference = std::remainder(to - from, kTwoPi);
  return wrapAngle(from + std::clamp(difference, -most, most));
}

}  // namespace

Status PathPose::check() const {
  const auto bad = [](const char* what) { return fail(ErrorKind::malformed, what); };
  for (int k = 0; k < 3; ++k)
    if (!(std::abs(eye[k]) <= kMostMetres)) return bad("\"eye\" is out of range");
  if (!(std::abs(yawRadians) < 1e6)) return bad("\"yaw\" is out of range");
  if (!(std::abs(pitchRadians) <= kPi / 2 + 1e-9)) return bad("\"pitch\" must lie in -90..90 degrees");
  if (!(seconds >= 0 && seconds <= kMostPathSeconds))
    return bad("\"seconds\" must lie in 0..21600 (6 hours)");
  return {};
}

Status CameraPath::check() const {
  if (poses.empty()) return fail(ErrorKind::malformed, ": holds no pose");
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (const Status sound = poses[i].check(); !sound)
      return fail(ErrorKind::malformed, fmt::format("/{}: {}", i, sound.error().message));
    if (i == 0 && poses[0].seconds != 0)
      return fail(ErrorKind::malformed, "/0: a path begins at 0 \"seconds\"");
    if (i > 0 && timed() && !(poses[i].seconds > poses[i - 1].seconds))
      return fail(ErrorKind::malformed,
                  fmt::format("/{}: \"seconds\" must be more than those of the pose before", i));
    if (!timed() && poses[i].seconds != 0)
      return fail(ErrorKind::malformed, fmt::format("/{}: either all poses have \"seconds\" or none", i));
  }
  return {};
}

PathPose between(const PathPose& from, const PathPose& to, double share) {
  return {glm::mix(from.eye, to.eye, share),
          from.yawRadians + share * std::remainder(to.yawRadians - from.yawRadians, kTwoPi),
          glm::mix(from.pitchRadians, to.pitchRadians, share), glm::mix(from.seconds, to.seconds, share)};
}

PathPose poseAt(const CameraPath& path, double seconds) {
  const auto after = std::ranges::upper_bound(path.poses, seconds, {}, &PathPose::seconds);
  if (after == path.poses.begin()) return path.poses.front();
  if (after == path.poses.end()) return path.poses.back();
  const PathPose& before = *std::prev(after);
  return between(before, *after, (seconds - before.seconds) / (after->seconds - before.seconds));
}

CameraPath framesOf(const CameraPath& path) {
  if (!path.timed()) return path;
  constexpr double kSlack = 1e-6;  // of a frame: a whole number of them stays one
  const int steps = std::max(1, int(std::ceil(path.seconds() * kPathRate - kSlack)));
  CameraPath frames;
  for (int i = 0; i <= steps; ++i) {
    frames.poses.push_back(poseAt(path, double(i) / kPathRate));
    frames.poses.back().seconds = 0;
  }
  return frames;
}

PerspectiveView viewAt(const PathPose& pose, double fovDegrees, glm::ivec2 pixels) {
  PerspectiveView view;
  view.eye = pose.eye;
  view.yawRadians = pose.yawRadians;
  view.pitchRadians = pose.pitchRadians;
  view.fovRadians = radians(fovDegrees);
  view.width = pixels.x;
  view.height = pixels.y;
  return view;
}

Result<CameraPath> loadPath(const std::filesystem::path& path) {
  const auto text = readText(path);
  if (!text) return tl::unexpected(text.error());
  const std::string where = path.string();
  if (path.filename() == "images.txt") return pathFromColmap(*text, where);
  const auto parsed = parseJson(*text, where);
  if (!parsed) return tl::unexpected(parsed.error());
  const nlohmann::json& json = *parsed;
  try {
    if (isNerfstudio(json)) return pathFromNerfstudio(json, where);
    if (!json.is_object() || json.value("version", 0) != 1 || !json.contains("frames") ||
        !json["frames"].is_array())
      return fail(ErrorKind::malformed,
                  "a camera path is {\"version\": 1, \"frames\": [{\"eye\": [x, y, z], \"yaw\": degrees, "
                  "\"pitch\": degrees}, ...]}, each with \"seconds\" or none",
                  where);
    if (json["frames"].empty()) return fail(ErrorKind::malformed, "/frames: holds no frame", where);
    if (json["frames"].size() > kMaxPoses)
      return fail(ErrorKind::tooLarge, fmt::format("/frames: more than {} frames", kMaxPoses), where);
    CameraPath out;
    for (std::size_t i = 0; i < json["frames"].size(); ++i) {
      auto pose = poseFrom(json["frames"][i], fmt::format("/frames/{}", i), where);
      if (!pose) return tl::unexpected(pose.error());
      out.poses.push_back(*pose);
    }
    if (const Status sound = out.check(); !sound)
      return fail(ErrorKind::malformed, "/frames" + sound.error().message, where);
    return out;
  } catch (const nlohmann::json::exception& problem) {
    return fail(ErrorKind::malformed, fmt::format("is not JSON that can be read: {}", problem.what()), where);
  }
}

Status savePath(const CameraPath& path, const std::filesystem::path& file) {
  nlohmann::ordered_json frames = nlohmann::ordered_json::array();
  const auto tidy = [](double value) { return std::round(value * 1e6) / 1e6; };
  for (const PathPose& pose : path.poses) {
    frames.push_back({{"eye", {tidy(pose.eye.x), tidy(pose.eye.y), tidy(pose.eye.z)}},
                      {"yaw", tidy(degrees(pose.yawRadians))},
                      {"pitch", tidy(degrees(pose.pitchRadians))}});
    if (path.timed()) frames.back()["seconds"] = tidy(pose.seconds);
  }
  const nlohmann::ordered_json json = {{"version", 1}, {"frames", std::move(frames)}};
  return writeTextAtomically(file, jsonText(json, 1) + "\n");
}

CameraPath tourOf(const Layout& layout, const glm::dvec2& start, int frames) {
  CameraPath path;
  if (layout.regions.empty() || frames < 1) return path;
  // Nearest-neighbour order through the places to stand: neighbours mostly touch, so the tour stays in the
  // layout.
  std::vector<glm::dvec2> places = standingPlaces(layout);
  std::vector<glm::dvec2> stops{clampToPlan(layout, start)};
  while (!places.empty()) {
    const auto nearest = std::min_element(places.begin(), places.end(), [&](const auto& p, const auto& q) {
      return glm::distance(p, stops.back()) < glm::distance(q, stops.back());
    });
    stops.push_back(*nearest);
    places.erase(nearest);
  }
  std::vector<double> travelled{0};
  for (std::size_t i = 1; i < stops.size(); ++i)
    travelled.push_back(travelled.back() + glm::distance(stops[i - 1], stops[i]));
  const auto at = [&](double s) {
    const auto after = std::upper_bound(travelled.begin() + 1, travelled.end() - 1, s);
    const std::size_t i = std::size_t(after - travelled.begin());
    const double length = travelled[i] - travelled[i - 1];
    return length > 0
               ? glm::mix(stops[i - 1], stops[i], std::clamp((s - travelled[i - 1]) / length, 0.0, 1.0))
               : stops[i];
  };
  const double mostTurn = std::max(radians(12.0), kTwoPi * 4 / frames);
  double yaw = longestWalk(layout, clampToPlan(layout, at(0)));
  for (int f = 0; f < frames; ++f) {
    const glm::dvec2 here = clampToPlan(layout, at(travelled.back() * f / std::max(frames - 1, 1)));
    yaw = turnTowards(yaw, longestWalk(layout, here), mostTurn);
    path.poses.push_back({{here, layout.eyeZ()}, yaw, 0});
  }
  return path;
}

glm::dvec2 clampToPlan(const Layout& layout, const glm::dvec2& point) {
  if (layout.regionAt(point)) return point;
  const Layout::Nearest nearest = layout.nearestRegion(point);
  if (nearest.region < 0) return point;
  // A little way in from the border, so that rounding cannot put the point outside again.
  const glm::dvec2 centre = layout.regions[std::size_t(nearest.region)].polygon.centroid();
  return glm::mix(nearest.point, centre, 1e-6);
}

}  // namespace acentric
