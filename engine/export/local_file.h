#pragma once
/// Local geometry of one region with everything that it takes to draw it: a file of a bundle (FORMAT.md,
/// "Kind 4"). Nothing of the scene but its materials is needed to read it.

#include <filesystem>
#include <vector>

#include "engine/base/result.h"
#include "engine/scene/effect_plan.h"
#include "engine/scene/flat_mirrors.h"
#include "engine/scene/local_geometry.h"

namespace acentric {

/// The same geometry with meshes, light and mirrors of its own: the source triangles that it is cut from,
/// with the attributes that their materials read. `light` and `mirrors` are the scene's, null where there are
/// none. Pictures of both are the same.
LocalGeometry selfContained(const LocalGeometry& local, const Scene& scene, const EffectPlan& plan,
                            const SurfaceLight* light, const FlatMirrors* mirrors);

/// `local` is self-contained.
Result<std::vector<std::byte>> localFileBytes(const LocalGeometry& local);
Status writeLocalFile(const LocalGeometry& local, const std::filesystem::path& path);

}  // namespace acentric
