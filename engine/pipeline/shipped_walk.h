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
#include "engine/pipeline/walk_stream.h"

namespace acentric {

/// A walk of more regions is read page by page: what is in memory is what is around the eye.
inline constexpr std::uint64_t kRegionsAtOnce = 20'000;

struct ShippedWalk {
  std::filesystem::path file;  ///< the walk's, or the bundle's folder
  std::shared_ptr<const BundleFiles> files;
  Bundle bundle;
  std::uint64_t bytes = 0;  ///< of the walk's file, or of those that the bundle names
  ScenePtr scene;           ///< materials, textures and sky; no triangle
  RayScenePtr rays;         ///< of that
  std::vector<std::shared_ptr<const Layout>> layouts;  ///< of storeys: ids number regions and cameras
  std::vector<std::string> warnings;                   ///< textures that cannot be read, and are white
  /// Of a walk that is read page by page: its index, and the pages that are here, by storey (null: it has no
  /// region). Layouts and `bundle` are those of the pages then.
  std::shared_ptr<WalkPages> pages;
  std::vector<BundlePlacePtr> places;

  std::uint64_t regionCount(int storey) const;  ///< with those that are not here
  /// Has this region all around it? Beside one that has not, another page knows more.
  bool isOwn(int storey, int region) const;
};
using ShippedWalkPtr = std::shared_ptr<const ShippedWalk>;

/// Reads the index and the textures; of a walk of more regions than `regionsAtOnce` what is around the start.
Result<ShippedWalkPtr> openShippedWalk(const std::filesystem::path& file, TaskRunner& runner,
                                       const Progress& progress = {}, const std::stop_token& stop = {},
                                       std::uint64_t regionsAtOnce = kRegionsAtOnce);

/// What pages, by storey (null: none), tell of. The ids of regions and cameras number them in their storey.
/// `former`: of other pages of the same walk, whose textures it has.
Result<ShippedWalkPtr> shippedPlaces(std::vector<BundlePlacePtr> places, const std::filesystem::path& file,
                                     const ShippedWalk* former, TaskRunner& runner,
                                     const std::stop_token& stop = {});

/// Of a walk with `pages`: what is around a place of a storey, and beside that on the others; `walk` itself
/// where that has the same pages. Its warnings are of pages that cannot be read.
Result<ShippedWalkPtr> placeAround(const ShippedWalkPtr& walk, int storey, const glm::dvec2& point);

/// What a project would say of it: storeys, how it is shown, bookmarks and paths.
Project projectOf(const ShippedWalk& walk);
/// The storey that `project`, one of these, shows.
OpenProject openProject(const ShippedWalk& walk, const Project& project);
CapturesOnDisk capturesOf(const ShippedWalk& walk, int storey);

/// Errors of the source name the walk and what is damaged. `former`: of the same walk; gives what it has of
/// the same storey.
WalkStart startWalk(const ShippedWalkPtr& walk, int storey, const LoadedWalk* former);

/// Gives a start what other pages of the same storey have in memory, by the numbers of cameras and regions.
/// How many captures `start` has no use for.
int takeOver(const LoadedWalk& from, WalkStream::Held held, WalkStart& start);

}  // namespace acentric
