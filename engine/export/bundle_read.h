#pragma once
/// Reads bundles (FORMAT.md) from wherever their files are. Nothing that a file says is believed before it is
/// checked: errors name the file, the place in it (a JSON pointer) and the reason.

#include <filesystem>
#include <memory>

#include "engine/export/bundle.h"
#include "engine/image/capture.h"
#include "engine/image/image.h"
#include "engine/scene/local_geometry.h"
#include "engine/view/walk_scene.h"

namespace acentric {

/// Files of a bundle by their paths in it. May be asked from several threads at once, if its user does so.
class BundleFiles {
 public:
  virtual ~BundleFiles() = default;
  /// The whole file; one of more than `mostBytes` is refused before it is read.
  virtual Result<std::vector<std::byte>> read(const std::string& path, std::uint64_t mostBytes) const = 0;
};

std::unique_ptr<BundleFiles> bundleFolder(const std::filesystem::path& folder);

/// `where` names the text in messages.
Result<Bundle> parseBundle(const std::string& text, const std::string& where);
Result<Bundle> readBundle(const BundleFiles& files);
Result<Bundle> readBundle(const std::filesystem::path& folder);

/// `capture` is one of `camera`'s, its number among the storey's.
Result<Capture> readBundleCapture(const BundleFiles& files, const BundleStorey& storey, std::size_t camera,
                                  const BundleCapture& capture);
/// Of one region; without triangles where nothing is near it.
Result<LocalGeometry> readBundleLocal(const BundleFiles& files, const Bundle& bundle,
                                      const BundleStorey& storey, std::size_t region);
Result<ColourImage> readBundleTexture(const BundleFiles& files, const BundleTexture& texture);

/// What of a scene near surfaces are drawn with: materials, textures, sky. `images`, by texture, are those of
/// readBundleTexture; null ones are white.
ScenePtr sceneOf(const Bundle& bundle, std::vector<std::shared_ptr<const ColourImage>> images);
/// A storey to be rendered: nothing is loaded yet, neither captures nor local geometry.
WalkScene walkSceneOf(const Bundle& bundle, std::shared_ptr<const Layout> layout, ScenePtr scene);

/// `bytes` of a local file (FORMAT.md, "Kind 4") that belongs to a bundle with so many materials and mirrors.
Result<LocalGeometry> readLocalFile(std::vector<std::byte> bytes, const std::string& name,
                                    std::size_t materials, std::size_t mirrors);

}  // namespace acentric
