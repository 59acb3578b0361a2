#include "engine/export/posed_images.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "engine/base/contract.h"
#include "engine/base/file.h"
#include "engine/base/json_text.h"
#include "engine/image/png.h"

namespace acentric {
namespace {

using Json = nlohmann::ordered_json;

/// Camera to world with OpenGL's axes: right, up, backwards. Rows.
Json worldFromEye(const PerspectiveView& view) {
  const glm::dmat3 axes = glm::transpose(view.viewFromWorld());  // columns: right, down, forward
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row)
    rows.push_back({axes[0][row], -axes[1][row], -axes[2][row], view.eye[row]});
  rows.push_back({0, 0, 0, 1});
  return rows;
}

Json flat(const Json& rows) {
  Json out = Json::array();
  for (const Json& row : rows)
    for (const Json& value : row) out.push_back(value);
  return out;
}

}  // namespace

std::string nerfstudioTransforms(std::span<const PosedImage> images, double depthUnit,
                                 const std::string& points) {
  require(!images.empty(), "there is a picture");
  const PerspectiveView& view = images.front().view;
  Json json{{"camera_model", "OPENCV"},
            {"w", view.width},
            {"h", view.height},
            {"fl_x", view.focalPixels()},
            {"fl_y", view.focalPixels()},
            {"cx", 0.5 * view.width},
            {"cy", 0.5 * view.height},
            {"k1", 0},
            {"k2", 0},
            {"p1", 0},
            {"p2", 0},
            {"depth_unit_scale_factor", depthUnit},
            {"ply_file_path", points},
            {"frames", Json::array()}};
  for (const PosedImage& image : images)
    json["frames"].push_back({{"file_path", image.colour},
                              {"depth_file_path", image.depth},
                              {"transform_matrix", worldFromEye(image.view)}});
  return jsonText(json, 1) + "\n";
}

Status writeColmap(std::span<const PosedImage> images, std::span<const ColouredPoint> points,
                   const std::filesystem::path& folder) {
  require(!images.empty(), "there is a picture");
  const PerspectiveView& first = images.front().view;
  const std::string camera = fmt::format(
      "# CAMERA_ID MODEL WIDTH HEIGHT fx fy cx cy\n1 PINHOLE {} {} {} {} {} {}\n", first.width, first.height,
      first.focalPixels(), first.focalPixels(), 0.5 * first.width, 0.5 * first.height);
  std::string poses = "# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, then its points (none)\n";
  for (std::size_t i = 0; i < images.size(); ++i) {
    const glm::dmat3 axes = images[i].view.viewFromWorld();
    const glm::dquat q = glm::quat_cast(axes);
    const glm::dvec3 t = -(axes * images[i].view.eye);
    poses += fmt::format("{} {} {} {} {} {} {} {} 1 {}\n\n", i + 1, q.w, q.x, q.y, q.z, t.x, t.y, t.z,
                         images[i].colour);
  }
  std::string cloud = "# POINT3D_ID X Y Z R G B ERROR TRACK (empty)\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ColouredPoint& p = points[i];
    cloud += fmt::format("{} {} {} {} {} {} {} 0\n", i + 1, p.place.x, p.place.y, p.place.z, p.colour.r,
                         p.colour.g, p.colour.b);
  }
  const std::pair<const char*, const std::string&> files[] = {
      {"cameras.txt", camera}, {"images.txt", poses}, {"points3D.txt", cloud}};
  for (const auto& [name, text] : files)
    if (Status written = writeTextAtomically(folder / name, text); !written) return written;
  return {};
}

std::string seuratManifest(std::span<const PosedImage> images, const glm::dvec3& headBoxCentre) {
  constexpr double kNear = 0.01, kFar = 1000;  // of the clip matrix alone: depth is along the axis
  Json groups = Json::array();
  int place = -1;
  for (const PosedImage& image : images) {
    if (groups.empty() || image.place != place) groups.push_back({{"views", Json::array()}});
    place = image.place;
    const PerspectiveView& view = image.view;
    const double f = view.focalPixels();
    const Json clip{{2 * f / view.width, 0, 0, 0},
                    {0, 2 * f / view.height, 0, 0},
                    {0, 0, -(kFar + kNear) / (kFar - kNear), -2 * kFar * kNear / (kFar - kNear)},
                    {0, 0, -1, 0}};
    groups.back()["views"].push_back({{"projective_camera",
                                       {{"image_width", view.width},
                                        {"image_height", view.height},
                                        {"clip_from_eye_matrix", flat(clip)},
                                        {"world_from_eye_matrix", flat(worldFromEye(view))},
                                        {"depth_type", "EYE_Z"}}},
                                      {"depth_image_file",
                                       {{"color",
                                         {{"path", image.colour},
                                          {"channel_0", "R"},
                                          {"channel_1", "G"},
                                          {"channel_2", "B"},
                                          {"channel_alpha", "CONSTANT_ONE"}}},
                                        {"depth", {{"path", image.depth}, {"channel_0", "Z"}}}}}});
  }
  const Json json{{"headbox_center", {headBoxCentre.x, headBoxCentre.y, headBoxCentre.z}},
                  {"view_groups", std::move(groups)}};
  return jsonText(json, 1) + "\n";
}

std::string panoramaList(std::span<const PosedPanorama> panoramas, double exposure) {
  Json json{
      {"format", "acentric-panoramas"},
      {"version", 1},
      {"projection", "equirectangular: the middle along +x, +y to the left of it, zenith on top"},
      {"axes", "Z up, right-handed, metres"},
      {"channels", {{"R, G, B", "linear radiance, Rec.709"}, {"Z", "metres along the ray, or infinity"}}},
      {"exposure", exposure},
      {"panoramas", Json::array()}};
  for (const PosedPanorama& panorama : panoramas)
    json["panoramas"].push_back({{"file", panorama.file},
                                 {"region", panorama.region},
                                 {"position", {panorama.eye.x, panorama.eye.y, panorama.eye.z}}});
  return jsonText(json, 1) + "\n";
}

Status writePointsPly(std::span<const ColouredPoint> points, const std::filesystem::path& file) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
      points.size());
  for (const ColouredPoint& p : points)
    text += fmt::format("{} {} {} {} {} {}\n", p.place.x, p.place.y, p.place.z, p.colour.r, p.colour.g,
                        p.colour.b);
  return writeTextAtomically(file, text);
}

Status writeDepthPng(const FloatImage& metres, double unit, const std::filesystem::path& file) {
  std::vector<std::uint16_t> steps;
  steps.reserve(metres.pixels.size());
  for (const float distance : metres.pixels) {
    const double step = std::round(double(distance) / unit);
    steps.push_back(step >= 1 && step <= 65535 ? std::uint16_t(step) : std::uint16_t(0));
  }
  const auto bytes = encodePng(metres.width, metres.height, steps);
  if (!bytes) return tl::unexpected(bytes.error());
  return writeFileAtomically(file, *bytes);
}

}  // namespace acentric
