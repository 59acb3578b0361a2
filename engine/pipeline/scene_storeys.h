#pragma once
/// The storeys of a model file, or of a project's.

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "engine/bake/ray_scene.h"
#include "engine/base/progress.h"
#include "engine/inspect/storeys.h"
#include "engine/scene/import.h"

namespace acentric {

/// One storey, as a person names it: its number in the list, or about its height.
struct StoreyChoice {
  std::optional<int> number;     ///< into Storeys::planes
  std::optional<double> height;  ///< metres
  bool given() const { return number || height; }
};

/// "2" is the number, "3.2m" the height.
Result<StoreyChoice> parseStoreyChoice(std::string_view text);

/// The plane chosen; a height takes the nearest plane within half a metre. Messages list what there is.
Result<WalkPlane> chooseStorey(const Storeys& storeys, const StoreyChoice& choice);

/// "0: -0.02 m, 326.4 m2, 98 % covered, joined to 1 and 2": one line for a person.
std::string describeStorey(const Storeys& storeys, int number);

/// Corners to the thousandth of a metre: finer than any floor plan, and short in the file.
Outline tidied(Outline outline);

/// The walkable outline about one floor height, tidied.
Result<Outline> findOutlineAt(const RayScene& rays, double floorHeight, double eyeHeight);

Result<Storeys> findSceneStoreys(const RayScene& rays, const StoreyOptions& options);

/// Of a project file (*.json) with its import settings and effects, or of any model file with `import`.
Result<Storeys> findFileStoreys(const std::filesystem::path& file, const ImportOptions& import,
                                const StoreyOptions& options, const ImportHost& host,
                                const Progress& progress = {}, std::stop_token stop = {});

}  // namespace acentric
