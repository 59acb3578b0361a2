#pragma once
/// What each configuration would give where the project's stands now, before it is laid: a patch of its
/// tiling, and densities. Pure.

#include <optional>

#include "engine/bake/bake_settings.h"
#include "engine/layout/layout.h"
#include "engine/scene/scene.h"

namespace acentric::editor {

/// When to use it, in one line.
const char* adviceOn(Configuration configuration);

/// Cells and cameras about the lattice's origin, as buildLayout lays them. `spec`: of the project.
Layout patchOf(const LayoutSpec& spec, Configuration configuration);

/// Per square metre of a floor that is covered all over; what lies at its border comes on top.
struct ConfigurationFacts {
  double regions = 0, cameras = 0;
  double pixels = 0;  ///< that are traced
};
ConfigurationFacts factsOf(const Layout& patch, const Bounds& scene, const BakeSettings& bake);

/// What a pixel that is traced becomes, as told by what is baked or was estimated.
struct PixelCost {
  std::optional<double> samples, bytes;
};
/// `bytes`: of each camera's capture on disk, 0 where there is none; `baked`: is it?
std::optional<double> bytesPerPixel(const Layout& layout, const std::vector<bool>& baked,
                                    const std::vector<std::uint64_t>& bytes, const Bounds& scene,
                                    const BakeSettings& bake);

/// Placed regions and cameras of the project's outline with this configuration; nothing where they are more
/// than `most`, by their density.
struct LaidCounts {
  std::size_t regions = 0, cameras = 0;
};
std::optional<LaidCounts> laidCounts(const LayoutSpec& spec, Configuration configuration,
                                     const ConfigurationFacts& facts, double most = 3000);

}  // namespace acentric::editor
