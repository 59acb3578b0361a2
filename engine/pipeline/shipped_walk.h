#pragma once
/// A walk as it was shipped, a bundle's folder or a walk's file (export/FORMAT.md), opened to be looked at in
/// place of a project. It has no model: nothing of it can be laid, baked or measured against the truth.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/export/walk_pages.h"
#include "engine/pipeline/bake_plan.h"
#include "engine/pipeline/walk_source.h"

namespace acentric {

struct ShippedWalk {
  std::filesystem::path file;  ///< the walk's, or the bundle's folder
  std::shared_ptr<const BundleFiles> files;
  Bundle bundle;
  std::uint64_t bytes = 0;  ///< of the walk's file, or of those that the bundle names
  ScenePtr scene;           ///< materials, textures and sky; no triangle
  RayScenePtr rays;         ///< of that
  std::vector<std::shared_ptr<const Layout>> layouts;  ///< of storeys: ids number regions and cameras
  std::vector<std::string> warnings;                   ///< textures that cannot be read, and are white
};
using ShippedWalkPtr = std::shared_ptr<const ShippedWalk>;

/// Reads the index and the textures.
Result<ShippedWalkPtr> openShippedWalk(const std::filesystem::path& file, TaskRunner& runner,
                                       const Progress& progress = {}, const std::stop_token& stop = {});

/// One place of a walk that is read page by page: regions and cameras of one storey are those of the page,
/// their ids number them in the storey. `former`: of another place of the same walk, whose textures it has.
Result<ShippedWalkPtr> shippedPlace(const BundlePlace& place, const std::filesystem::path& file,
                                    const ShippedWalk* former, TaskRunner& runner,
                                    const std::stop_token& stop = {});

/// What a project would say of it: storeys, how it is shown, bookmarks and paths.
Project projectOf(const ShippedWalk& walk);
/// The storey that `project`, one of these, shows.
OpenProject openProject(const ShippedWalk& walk, const Project& project);
CapturesOnDisk capturesOf(const ShippedWalk& walk, int storey);

/// Errors of the source name the walk and what is damaged. `former`: of the same walk; gives what it has of
/// the same storey.
WalkStart startWalk(const ShippedWalkPtr& walk, int storey, const LoadedWalk* former);

}  // namespace acentric
