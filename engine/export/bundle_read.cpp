#include "engine/export/bundle_read.h"

#include <fmt/format.h>

#include <cmath>
#include <new>

#include "engine/base/file.h"
#include "engine/geometry/conventions.h"
#include "engine/image/png.h"
#include "engine/store/keyed.h"
#include "engine/store/still_picture.h"

namespace acentric {
namespace {

constexpr double kSameAngle = 1e-9;
constexpr std::uint64_t kMostIndexBytes = std::uint64_t(128) << 20;

class FolderFiles final : public BundleFiles {
 public:
  explicit FolderFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}
  Result<std::vector<std::byte>> read(const std::string& path, std::uint64_t mostBytes) const override {
    return readFile(folder_ / path, mostBytes);
  }

 private:
  std::filesystem::path folder_;
};

/// The file as the index describes it.
Result<std::vector<std::byte>> readChecked(const BundleFiles& files, const BundleFile& file) {
  auto bytes = files.read(file.path, file.bytes);
  if (!bytes) return bytes;
  if (bytes->size() != file.bytes)
    return fail(ErrorKind::malformed,
                fmt::format("has {} bytes, and the index says {}", bytes->size(), file.bytes), file.path);
  if (Hasher().bytes(bytes->data(), bytes->size()).finish() != file.hash)
    return fail(ErrorKind::malformed, "is damaged, or of another bundle: its hash differs", file.path);
  return bytes;
}

/// Does the pack hold what the index says of it?
Status agree(const PackHead& head, const BundleCapture& described, const LayoutCamera& camera,
             const BundleCamera& renditions) {
  const ColumnCamera& c = head.camera;
  const auto differ = [&](const char* what) {
    return fail(ErrorKind::malformed, std::string("has another ") + what + " than the index says",
                described.file.path);
  };
  if (glm::dvec2(c.centreOfProjection) != camera.position) return differ("place");
  if (std::abs(std::remainder(c.lowAzimuth - camera.lowAzimuth, kTwoPi)) > kSameAngle ||
      std::abs(c.fovRadians - camera.fovRadians) > kSameAngle)
    return differ("sector");
  if (c.topElevation != renditions.topElevation || c.bottomElevation != renditions.bottomElevation)
    return differ("height");
  if (c.columns != described.columns || c.rows != described.rows) return differ("resolution");
  if (head.samples != described.samples || head.reflections != described.reflections)
    return differ("number of samples");
  return {};
}

EffectPlan everythingOn() {
  EffectPlan plan;
  for (EffectState& effect : plan.effects) effect.on = true;
  return plan;
}

}  // namespace

std::unique_ptr<BundleFiles> bundleFolder(const std::filesystem::path& folder) {
  return std::make_unique<FolderFiles>(folder);
}

Result<Bundle> readBundle(const BundleFiles& files) {
  const auto bytes = files.read(kBundleIndex, kMostIndexBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  return parseBundle(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()), kBundleIndex);
}

Result<Bundle> readBundle(const std::filesystem::path& folder) { return readBundle(*bundleFolder(folder)); }

Result<Capture> readBundleCapture(const BundleFiles& files, const BundleStorey& storey, std::size_t camera,
                                  const BundleCapture& capture) {
  auto bytes = readChecked(files, capture.file);
  if (!bytes) return tl::unexpected(bytes.error());
  return withoutKey(keyedCaptureOf(std::move(*bytes), capture.file.path, [&](const PackHead& head) {
    return agree(head, capture, storey.layout.cameras[camera], storey.cameras[camera]);
  }));
}

Result<LocalGeometry> readBundleLocal(const BundleFiles& files, const Bundle& bundle,
                                      const BundleStorey& storey, std::size_t region) {
  const ConvexPolygon& grown = storey.layout.regions[region].grown;
  const std::optional<BundleLocal>& file = storey.local[region];
  if (!file) return LocalGeometry{grown, {}, {}, std::make_shared<const LocalSurfaces>()};
  auto bytes = readChecked(files, file->file);
  if (!bytes) return tl::unexpected(bytes.error());
  auto local =
      readLocalFile(std::move(*bytes), file->file.path, bundle.materials.size(), bundle.mirrors.size());
  if (!local) return local;
  if (local->triangles.size() != file->triangles)
    return fail(ErrorKind::malformed, "has another number of triangles than the index says", file->file.path);
  local->polygon = grown;
  return local;
}

Result<ColourImage> readBundleTexture(const BundleFiles& files, const BundleTexture& texture) {
  const auto bytes = readChecked(files, texture.file);
  if (!bytes) return tl::unexpected(bytes.error());
  try {
    if (!isStill(*bytes)) return decodePng(*bytes, texture.width, texture.height, texture.file.path);
    auto image = decodeStillColours(*bytes, texture.width, texture.height);
    if (!image) return fail(image.error().kind, image.error().message, texture.file.path);
    return image;
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory for this picture", texture.file.path);
  }
}

ScenePtr sceneOf(const Bundle& bundle, std::vector<std::shared_ptr<const ColourImage>> images) {
  auto scene = std::make_shared<Scene>();
  scene->name = bundle.name, scene->origin = bundle.origin;
  scene->materials = bundle.materials;
  images.resize(bundle.textures.size());
  for (std::size_t t = 0; t < bundle.textures.size(); ++t) {
    const BundleTexture& from = bundle.textures[t];
    scene->textures.push_back(
        {from.file.path, images[t] ? int(t) : -1, from.wrapU, from.wrapV, from.nearest});
  }
  scene->images = std::move(images);
  scene->sky = bundle.sky, scene->bounds = bundle.bounds;
  return scene;
}

WalkScene walkSceneOf(const Bundle& bundle, std::shared_ptr<const Layout> layout, ScenePtr scene) {
  WalkScene walk;
  walk.scene = std::move(scene);
  walk.captures.resize(layout->cameras.size());
  walk.local.resize(layout->regions.size());
  walk.layout = std::move(layout);
  walk.plan = everythingOn();  // materials say what is left of each
  walk.exposure = bundle.exposure;
  if (!bundle.mirrors.empty()) walk.mirrors = std::make_shared<const FlatMirrors>(bundle.mirrors);
  return walk;
}

}  // namespace acentric
