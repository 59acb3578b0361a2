#pragma once
/// Whether a scene's scale is in doubt, and a project brought to another scale.

#include <optional>
#include <string>

#include "engine/bake/ray_scene.h"
#include "engine/inspect/scale_doubt.h"
#include "engine/pipeline/project.h"

namespace acentric {

ScaleMeasures measureScale(const RayScene& rays);

struct ScaleDoubt {
  double metresPerUnit = 1;  ///< that would fit
  double factor = 1;         ///< times what the scene has now
  std::string text;  ///< one sentence: what speaks against the scale, and what the new one makes of it
  bool operator==(const ScaleDoubt&) const = default;
};

/// Nothing where the scale may well be right, or was chosen by a person.
std::optional<ScaleDoubt> doubtScale(const RayScene& rays, const ImportOptions& chosen);

/// The project with its model at another scale: outlines, floors, spawns, bookmarks and paths stay where they
/// are on the model, and so do cells if some were added, removed or split. People keep their size: eye
/// height, other layouts' cell size and bake settings stay. `scene` is the project's, as imported so far.
Project atScale(const Project& project, const Scene& scene, double metresPerUnit);

}  // namespace acentric
