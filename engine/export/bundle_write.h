#pragma once
/// Writes a bundle (FORMAT.md): the same input gives the same bytes. All of it is written to a folder beside
/// the target, flushed, and renamed: whoever looks sees the old bundle or the new one.

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <stop_token>

#include "engine/base/progress.h"
#include "engine/base/task_runner.h"
#include "engine/export/bundle.h"
#include "engine/scene/effect_plan.h"
#include "engine/store/capture_store.h"

namespace acentric {

struct BundleStoreyInput {
  std::string name;
  std::shared_ptr<const Layout> layout;
  glm::dvec2 start{0};
  double startYaw = 0;
  std::vector<std::optional<ContentKey>> full;    ///< by camera, in the store; none: not baked
  std::vector<std::optional<ContentKey>> coarse;  ///< what stands in for one that is not baked, if anything
  std::shared_ptr<const SurfaceLight> light;      ///< null: not baked
  /// Of one region, from several threads at once.
  std::function<Result<std::shared_ptr<const LocalGeometry>>(int region)> local;
};

struct BundleInput {
  std::string generator, name;
  ScenePtr scene;
  EffectPlan plan;
  std::shared_ptr<const FlatMirrors> mirrors;  ///< null: none
  float exposure = 1;
  double fov = 0;  ///< radians
  ViewSettings view;
  const CaptureStore* store = nullptr;
  int colourQuality = kUsualColourQuality;  ///< of captures (colour_quality.h); below 100 as they are shown
  std::vector<BundleStoreyInput> storeys;
  int storey = 0;
  std::vector<BundleBookmark> bookmarks;
  std::vector<BundlePath> paths;
  std::filesystem::path
      former;  ///< a bundle's folder whose captures are taken where they are the same; may be empty
};

struct BundleReport {
  std::size_t cameras = 0, missing = 0;  ///< missing: without full captures
  std::size_t reused = 0;                ///< of the cameras: their files are those of the former bundle
  std::size_t regions = 0, textures = 0;
  std::uint64_t fullBytes = 0, coarseBytes = 0, localBytes = 0, textureBytes = 0, indexBytes = 0;
  std::uint64_t samples = 0, triangles = 0;  ///< of full captures; of local geometry
  std::uint64_t bytes() const { return fullBytes + coarseBytes + localBytes + textureBytes + indexBytes; }
};

/// `folder` is made, or replaced if it is empty or holds a bundle; anything else is refused. Damaged captures
/// are named, and nothing is written then.
Result<BundleReport> writeBundle(const BundleInput& input, const std::filesystem::path& folder,
                                 TaskRunner& runner, const Progress& progress = {},
                                 std::stop_token stop = {});

/// May writeBundle put a bundle there?
Status checkBundleTarget(const std::filesystem::path& folder);

}  // namespace acentric
