#pragma once
/// The scene file as the cache keeps it: a Scene and the files that it was made from. Private to this folder.
///
/// Layout, little-endian: 8 bytes "ACSCENE\n"; u32 version; u32 zero; u64 bytes of the dependency block; u64
/// bytes packed; u64 bytes unpacked; u64 bytes of the geometry; 16 bytes XXH3-128 of all that follows, then
/// of version and sizes; the dependency block; the scene, zstd, with the lengths of its arrays of vertices
/// and triangles; zeros up to a multiple of 16; the geometry: those arrays, meshes first, each filled up with
/// at least 16 zeros to a multiple of 16. Any other version is refused: the file can always be made again.
///
/// The geometry is mapped, not read: its pages come from the file when they are looked at, and go when memory
/// is short. It is written in pieces.

#include <functional>

#include "engine/scene/references.h"
#include "engine/scene/scene.h"

namespace acentric {

inline constexpr std::uint32_t kSceneFileVersion = 7;

struct SceneFile {
  Scene scene;
  std::vector<Dependency> dependencies;
};

Status writeSceneFile(const SceneFile& file, const std::filesystem::path& path);
/// `accept` looks at the dependencies before the scene is unpacked; if it says no, the scene stays empty.
Result<SceneFile> readSceneFile(const std::filesystem::path& path,
                                const std::function<bool(const std::vector<Dependency>&)>& accept);

}  // namespace acentric
