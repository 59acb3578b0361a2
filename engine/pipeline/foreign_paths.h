#pragma once
/// Camera poses of other programs as paths to walk: nerfstudio's transforms.json and COLMAP's images.txt.
/// Their places are taken for ours: metres, Z up, relative to the project's origin. What a camera is rolled
/// about its axis is left out.

#include <nlohmann/json.hpp>

#include "engine/pipeline/camera_path.h"

namespace acentric {

/// Does it have poses as nerfstudio writes them?
bool isNerfstudio(const nlohmann::json& json);
Result<CameraPath> pathFromNerfstudio(const nlohmann::json& json, const std::string& where);
Result<CameraPath> pathFromColmap(const std::string& images, const std::string& where);

}  // namespace acentric
