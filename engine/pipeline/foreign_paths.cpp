#include "engine/pipeline/foreign_paths.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <sstream>

namespace acentric {
namespace {

PathPose poseOf(const glm::dvec3& eye, const glm::dvec3& forward) {
  const glm::dvec3 to = glm::normalize(forward);
  return {eye, std::atan2(to.y, to.x), std::asin(std::clamp(to.z, -1.0, 1.0)), 0};
}

Result<CameraPath> checked(CameraPath path, const std::string& where) {
  if (const Status sound = path.check(); !sound)
    return fail(ErrorKind::malformed, "poses" + sound.error().message, where);
  return path;
}

}  // namespace

bool isNerfstudio(const nlohmann::json& json) {
  return json.is_object() && json.contains("frames") && json["frames"].is_array() &&
         !json["frames"].empty() && json["frames"][0].is_object() &&
         json["frames"][0].contains("transform_matrix");
}

Result<CameraPath> pathFromNerfstudio(const nlohmann::json& json, const std::string& where) {
  CameraPath path;
  for (std::size_t i = 0; i < json["frames"].size(); ++i) {
    const auto bad = [&] {
      return fail(ErrorKind::malformed,
                  fmt::format("/frames/{}/transform_matrix: must be four rows of four numbers", i), where);
    };
    const nlohmann::json& frame = json["frames"][i];
    if (!frame.is_object() || !frame.contains("transform_matrix")) return bad();
    const nlohmann::json& rows = frame["transform_matrix"];
    if (!rows.is_array() || rows.size() < 3) return bad();
    glm::dvec3 back(0), eye(0);
    for (int r = 0; r < 3; ++r) {
      const nlohmann::json& row = rows[std::size_t(r)];
      if (!row.is_array() || row.size() != 4 || !row[2].is_number() || !row[3].is_number()) return bad();
      back[r] = row[2].get<double>(), eye[r] = row[3].get<double>();
    }
    if (!(glm::length(back) > 1e-6)) return bad();
    path.poses.push_back(poseOf(eye, -back));
  }
  return checked(std::move(path), where);
}

Result<CameraPath> pathFromColmap(const std::string& images, const std::string& where) {
  CameraPath path;
  std::istringstream lines(images);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    long id = 0, camera = 0;
    glm::dquat q(1, 0, 0, 0);
    glm::dvec3 t(0);
    std::string name;
    words >> id >> q.w >> q.x >> q.y >> q.z >> t.x >> t.y >> t.z >> camera >> name;
    if (!words || name.empty() || !(glm::length(q) > 1e-6))
      return fail(ErrorKind::malformed,
                  fmt::format("line {}: must be IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME", number),
                  where);
    const glm::dmat3 worldFromView = glm::transpose(glm::mat3_cast(glm::normalize(q)));
    path.poses.push_back(poseOf(-(worldFromView * t), worldFromView[2]));
    std::getline(lines, line);  // its points
    ++number;
  }
  return checked(std::move(path), where);
}

}  // namespace acentric
