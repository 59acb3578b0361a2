#pragma once
/// A stretch of a walk in a folder of its own: all that pictures along one path read, and nothing else, so
/// that renderers can be timed on another machine. Reading it needs neither the model file nor the libraries
/// that import and bake.
///
/// The folder holds project.acentric.json, scene.acscene (as the import cache keeps scenes), path.json,
/// camera-N.pack for each camera that the path sees, surface.light if light is baked to the surfaces, and
/// region-N.simplified for regions of simplified geometry.

#include <cstdint>
#include <filesystem>

#include "engine/base/task_runner.h"
#include "engine/pipeline/camera_path.h"
#include "engine/pipeline/project.h"
#include "engine/view/walk_scene.h"

namespace acentric {

struct OpenProject;

/// Once round in the middle of a region: the eye goes along a circle and looks out of it, `frames` poses.
CameraPath roundIn(const Layout& layout, int region, int frames);

struct PackReport {
  CameraPath path;  ///< what was kept of it, in order
  int cameras = 0;
  std::uint64_t bytes = 0;  ///< of the folder
};

/// Packs what is on disk for the poses of `path`, from the first on, that fit into `mostBytes` with all that
/// they see at `pixels` (the size of pictures). Poses that see a capture that is not there are left out.
/// `folder` is made; it must not hold anything. Fails when not even one pose fits.
Result<PackReport> packWalk(const OpenProject& open, const CameraPath& path, glm::ivec2 pixels,
                            std::uint64_t mostBytes, const std::filesystem::path& folder);

struct PackedWalk {
  Project project;
  WalkScene walk;  ///< captures that the path does not see are null
  CameraPath path;
};
Result<PackedWalk> readPackedWalk(const std::filesystem::path& folder, TaskRunner& runner);

namespace packed_walk {
std::filesystem::path projectFile(const std::filesystem::path& folder);
std::filesystem::path sceneFile(const std::filesystem::path& folder);
std::filesystem::path pathFile(const std::filesystem::path& folder);
std::filesystem::path lightFile(const std::filesystem::path& folder);
std::filesystem::path captureFile(const std::filesystem::path& folder, std::size_t camera);
std::filesystem::path simplifiedFile(const std::filesystem::path& folder, std::size_t region);
}  // namespace packed_walk

}  // namespace acentric
