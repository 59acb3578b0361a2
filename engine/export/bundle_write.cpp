#include "engine/export/bundle_write.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <set>

#include "engine/base/file.h"
#include "engine/base/folder.h"
#include "engine/export/bundle_materials.h"
#include "engine/export/crop_light.h"
#include "engine/export/export_target.h"
#include "engine/export/former_bundle.h"
#include "engine/export/local_file.h"
#include "engine/export/region_order.h"
#include "engine/image/coarse_capture.h"
#include "engine/image/keep_samples.h"
#include "engine/image/plane_numbers.h"
#include "engine/image/png.h"
#include "engine/store/still_picture.h"

namespace acentric {
namespace {

/// Of columns and rows: what a page shows first is what it waits for.
constexpr int kBundleCoarseFactor = 8;
constexpr int kCoarseColourQuality = 85;
/// Of light on near surfaces: what is left is true to 1/64 of it, three quarters of a code as it is shown.
constexpr int kShippedUnusedBits = 5;

namespace fs = std::filesystem;

class BundleWriter {
 public:
  BundleWriter(const BundleInput& input, fs::path folder, TaskRunner& runner, const Progress& progress,
               const std::stop_token& stop)
      : input_(input),
        folder_(std::move(folder)),
        runner_(runner),
        progress_(progress),
        stop_(stop),
        former_(input.former) {}

  Result<BundleReport> write() {
    describe();
    for (const BundleStoreyInput& storey : input_.storeys) addStorey(storey);
    for (const auto& step :
         {&BundleWriter::writeCaptures, &BundleWriter::writeLocals, &BundleWriter::writeTextures,
          &BundleWriter::lookForFeatures, &BundleWriter::writeIndex})
      if (Status done = (this->*step)(); !done) return tl::unexpected(done.error());
    return report_;
  }

 private:
  struct CameraPlace {
    std::size_t storey, camera;
    std::uint8_t roles;  ///< that regions of the bundle draw
    bool taken = false;  ///< from the former bundle
  };
  struct RegionPlace {
    std::size_t storey, region;  ///< of the bundle
    int source;                  ///< of the layout
  };

  void describe() {
    bundle_.generator = input_.generator, bundle_.name = input_.name;
    bundle_.origin = input_.scene->origin;
    bundle_.exposure = input_.exposure, bundle_.fov = input_.fov;
    bundle_.view = input_.view;
    if (input_.plan.on(Effect::sky)) bundle_.sky = input_.scene->sky;
    bundle_.bounds = input_.scene->bounds;
    if (input_.mirrors) bundle_.mirrors = input_.mirrors->planes();
    bundle_.storey = input_.storey;
    bundle_.bookmarks = input_.bookmarks, bundle_.paths = input_.paths;
  }

  void addStorey(const BundleStoreyInput& storey) {
    BundleStorey out;
    out.name = storey.name;
    out.start = storey.start, out.startYaw = storey.startYaw;
    const Layout& layout = *storey.layout;
    out.layout.spec = layout.spec;
    out.layout.cameras = layout.cameras;
    const std::size_t place = bundle_.storeys.size();
    for (const int r : searchOrder(layout)) {
      regions_.push_back({place, out.layout.regions.size(), r});
      out.layout.regions.push_back(layout.regions[std::size_t(r)]);
      out.layout.panoramas.push_back(layout.panoramasFor(r));
    }
    out.neighbours = touching(out.layout.regions);
    out.local.resize(out.layout.regions.size());
    out.cameras.resize(layout.cameras.size());
    const std::vector<std::uint8_t> drawn = drawnRoles(out.layout);
    for (std::size_t c = 0; c < layout.cameras.size(); ++c) cameras_.push_back({place, c, drawn[c]});
    bundle_.storeys.push_back(std::move(out));
  }

  /// Of each camera the roles that some region draws.
  static std::vector<std::uint8_t> drawnRoles(const Layout& layout) {
    std::vector<std::uint8_t> drawn(layout.cameras.size());
    for (std::size_t r = 0; r < layout.regions.size(); ++r)
      for (const auto* covers : {&layout.regions[r].covers, &layout.panoramas[r]})
        for (const Cover& cover : *covers)
          for (const Piece& piece : cover.pieces)
            drawn[std::size_t(piece.camera)] |=
                roleBit(layout.cameras[std::size_t(piece.camera)], piece.role);
    return drawn;
  }

  /// body(index) for all; the first error by number.
  template <class Body>
  Status forAll(std::size_t count, const std::string& stage, const Body& body) {
    std::vector<Status> done(count);
    std::atomic<bool> failed = false;
    std::size_t finished = 0;
    runner_.parallelFor(count, [&](std::size_t i) {
      if (failed) return;
      if (stop_.stop_requested())
        done[i] = fail(ErrorKind::cancelled, "writing the bundle was stopped");
      else
        done[i] = body(i);
      if (!done[i]) failed = true;
      const std::lock_guard lock(mutex_);
      if (progress_) progress_({double(++finished), double(count), stage});
    });
    for (const Status& status : done)
      if (!status) return status;
    return {};
  }

  Result<BundleFile> fileOf(const std::string& path) const {
    const auto hash = hashFile(folder_ / path);
    if (!hash) return tl::unexpected(hash.error());
    return BundleFile{path, fs::file_size(folder_ / path), *hash};
  }

  Result<BundleCapture> described(const Capture& capture, const std::string& path) const {
    const auto file = fileOf(path);
    if (!file) return tl::unexpected(file.error());
    return BundleCapture{*file, capture.camera.columns, capture.camera.rows, capture.sampleCount(),
                         capture.reflections.sampleCount()};
  }

  void note(const Capture& capture) {
    const bool layered = capture.maxLayers() > 1;
    const bool blended =
        std::ranges::any_of(capture.colour, [](const HalfColour& c) { return c.a < 0x3c00; });
    const std::lock_guard lock(mutex_);
    BundleFeatures& features = bundle_.features;
    features.layered |= layered, features.blended |= blended;
    features.mirrors |= capture.hasReflections();
    features.background |= capture.background.runCount() > 0;
  }

  Status writePack(const Capture& capture, const ContentKey& key, const std::string& path,
                   int quality) const {
    const fs::path file = folder_ / path;
    return quality < kLosslessColours ? writeDisplayPack(capture, key, file, quality, input_.exposure, stop_)
                                      : writeCodedPack(capture, key, file, kLosslessColours, stop_);
  }

  /// Captures also hold what lattice regions need that are not placed. Without it planes may be coarser; and
  /// bakes of earlier programs left samples a step away from theirs.
  static void shrink(Capture& capture, std::uint8_t roles) {
    keepRoles(capture, roles);
    for (CaptureSamples* list : {static_cast<CaptureSamples*>(&capture), &capture.reflections})
      roundPlanes(*list, capture.camera, capture.distanceStep);
  }

  /// Of captures that were taken over it is not known which of them has what the former bundle's had.
  Status lookForFeatures() {
    constexpr bool BundleFeatures::*kOfCaptures[] = {&BundleFeatures::layered, &BundleFeatures::blended,
                                                     &BundleFeatures::mirrors, &BundleFeatures::background};
    for (const CameraPlace& place : cameras_) {
      if (!place.taken) continue;
      if (std::ranges::none_of(kOfCaptures, [&](bool BundleFeatures::*feature) {
            return former_.features().*feature && !(bundle_.features.*feature);
          }))
        break;
      if (stop_.stop_requested()) return fail(ErrorKind::cancelled, "writing the bundle was stopped");
      const auto capture = readCapture(place);
      if (!capture) return tl::unexpected(capture.error());
      note(*capture);
    }
    return {};
  }

  /// From the store, as it is written; of a camera that has one.
  Result<Capture> readCapture(const CameraPlace& place) const {
    const BundleStoreyInput& storey = input_.storeys[place.storey];
    const std::optional<ContentKey>& full = storey.full[place.camera];
    auto capture =
        input_.store->get(full ? *full : *storey.coarse[place.camera]);  // as a whole: nothing damaged
    if (capture && input_.colourQuality < kLosslessColours) shrink(*capture, place.roles);
    return capture;
  }

  Status writeCamera(CameraPlace& place) {
    const BundleStoreyInput& storey = input_.storeys[place.storey];
    BundleCamera& camera = bundle_.storeys[place.storey].cameras[place.camera];
    const std::optional<ContentKey>& full = storey.full[place.camera];
    const std::optional<ContentKey>& key = full ? full : storey.coarse[place.camera];
    if (!key) return {};
    const std::string name = captureName(*key, place.roles, input_.colourQuality, input_.exposure);
    const std::string path = fmt::format("captures/{}.pack", name),
                      coarsePath = fmt::format("coarse/{}.pack", name);
    place.taken = former_.give(full ? path : coarsePath, folder_, camera);
    if (place.taken) return {};
    const auto capture = readCapture(place);
    if (!capture) return tl::unexpected(capture.error());
    note(*capture);
    camera.topElevation = capture->camera.topElevation;
    camera.bottomElevation = capture->camera.bottomElevation;
    if (!full) {
      if (Status written = writePack(*capture, *key, coarsePath, input_.colourQuality); !written)
        return written;
      return describeInto(*capture, coarsePath, camera.coarse);
    }
    if (Status written = writePack(*capture, *key, path, input_.colourQuality); !written) return written;
    if (Status described = describeInto(*capture, path, camera.full); !described) return described;
    const Capture coarse = coarsened(*capture, kBundleCoarseFactor);
    const int quality = std::min(input_.colourQuality, kCoarseColourQuality);
    if (Status written = writePack(coarse, *key, coarsePath, quality); !written) return written;
    return describeInto(coarse, coarsePath, camera.coarse);
  }

  Status describeInto(const Capture& capture, const std::string& path, std::optional<BundleCapture>& into) {
    auto found = described(capture, path);
    if (!found) return tl::unexpected(found.error());
    into = std::move(*found);
    return {};
  }

  Status writeCaptures() {
    if (Status done = forAll(cameras_.size(), "writing captures",
                             [&](std::size_t i) { return writeCamera(cameras_[i]); });
        !done)
      return done;
    report_.reused = std::size_t(std::ranges::count(cameras_, true, &CameraPlace::taken));
    for (const BundleStorey& storey : bundle_.storeys)
      for (const BundleCamera& camera : storey.cameras) {
        ++report_.cameras;
        report_.missing += camera.full ? 0 : 1;
        report_.samples += camera.full ? camera.full->samples : 0;
        report_.fullBytes += camera.full ? camera.full->file.bytes : 0;
        report_.coarseBytes += camera.coarse ? camera.coarse->file.bytes : 0;
      }
    return {};
  }

  Status writeLocal(std::size_t index) {
    const RegionPlace& place = regions_[index];
    const BundleStoreyInput& storey = input_.storeys[place.storey];
    const auto local = storey.local(place.source);
    if (!local) return tl::unexpected(local.error());
    if ((*local)->triangles.empty()) return {};
    const LocalGeometry own = croppedLight(
        selfContained(**local, *input_.scene, input_.plan, storey.light.get(), input_.mirrors.get()),
        input_.colourQuality < kLosslessColours ? kShippedUnusedBits : 0);
    const std::string path = fmt::format("regions/{}.local", index);
    if (Status written = writeLocalFile(own, folder_ / path); !written) return written;
    auto file = fileOf(path);
    if (!file) return tl::unexpected(file.error());
    bundle_.storeys[place.storey].local[place.region] = BundleLocal{std::move(*file), own.triangles.size()};
    const std::lock_guard lock(mutex_);
    for (const Mesh& mesh : own.surfaces->meshes) usedMaterials_.insert(mesh.material);
    bundle_.features.light |= !own.surfaces->light.empty();
    return {};
  }

  Status writeLocals() {
    if (Status done =
            forAll(regions_.size(), "writing local geometry", [&](std::size_t i) { return writeLocal(i); });
        !done)
      return done;
    for (const BundleStorey& storey : bundle_.storeys)
      for (const auto& local : storey.local) {
        ++report_.regions;
        if (!local) continue;
        report_.triangles += local->triangles;
        report_.localBytes += local->file.bytes;
      }
    return {};
  }

  /// Into `textures`, once each; gives the use its number there.
  Status takeTexture(TextureUse& use) {
    if (!use.used()) return {};
    const Scene& scene = *input_.scene;
    const Texture& texture = scene.textures[std::size_t(use.texture)];
    const bool known = texture.image >= 0 && std::size_t(texture.image) < scene.images.size() &&
                       scene.images[std::size_t(texture.image)] != nullptr &&
                       !scene.images[std::size_t(texture.image)]->empty();
    if (!known) {
      use = {};
      return {};
    }
    auto [place, isNew] = textureOf_.emplace(use.texture, int(bundle_.textures.size()));
    use.texture = place->second;
    if (!isNew) return {};
    const ColourImage& image = *scene.images[std::size_t(texture.image)];
    auto [file, unwritten] = imageOf_.emplace(texture.image, BundleFile{});
    if (unwritten) {
      const bool nearest = std::ranges::any_of(scene.textures, [&](const Texture& other) {
        return other.image == texture.image && other.nearest;
      });
      auto written = writeTexture(image, nearest);
      if (!written) return tl::unexpected(written.error());
      file->second = std::move(*written);
    }
    bundle_.textures.push_back(
        {file->second, image.width, image.height, texture.wrapU, texture.wrapV, texture.nearest});
    return {};
  }

  /// As AVIF where that is smaller: not of quality 100, and not of pictures that are read texel by texel.
  Result<std::vector<std::byte>> codedTexture(const ColourImage& image, bool nearest) const {
    auto png = encodePng(image);
    if (!png || nearest || input_.colourQuality == kLosslessColours ||
        std::max(image.width, image.height) > kMostPictureSide)
      return png;
    auto avif = encodeStill(image, input_.colourQuality);
    return avif && avif->size() >= png->size() ? std::move(png) : std::move(avif);
  }

  /// Named after its content, so that equal pictures are one file.
  Result<BundleFile> writeTexture(const ColourImage& image, bool nearest) {
    const auto bytes = codedTexture(image, nearest);
    if (!bytes) return tl::unexpected(bytes.error());
    const char* ending = isStill(*bytes) ? "avif" : "png";
    const ContentKey hash = Hasher().bytes(bytes->data(), bytes->size()).finish();
    BundleFile file{fmt::format("textures/{}.{}", hash.toHex(), ending), bytes->size(), hash};
    if (Status written = writeFileAtomically(folder_ / file.path, *bytes); !written)
      return tl::unexpected(written.error());
    return file;
  }

  Status writeTextures() {
    for (std::size_t m = 0; m < input_.scene->materials.size(); ++m) {
      Material material = localMaterial(input_.scene->materials[m], input_.plan);
      const bool used = usedMaterials_.contains(int(m));
      if (!used) material.baseColourTexture = material.emissiveTexture = {};
      for (TextureUse* use : {&material.baseColourTexture, &material.emissiveTexture})
        if (Status taken = takeTexture(*use); !taken) return taken;
      bundle_.features.blended |=
          used && (material.alphaMode == AlphaMode::blend || (material.transmission > 0 && !material.unlit));
      bundle_.materials.push_back(std::move(material));
    }
    std::set<std::string> files;
    for (const BundleTexture& texture : bundle_.textures)
      if (files.insert(texture.file.path).second) report_.textureBytes += texture.file.bytes;
    report_.textures = files.size();
    return {};
  }

  Status writeIndex() {
    const std::string text = formatBundle(bundle_);
    report_.indexBytes = text.size();
    return writeTextAtomically(folder_ / kBundleIndex, text);
  }

  const BundleInput& input_;
  const fs::path folder_;
  TaskRunner& runner_;
  const Progress& progress_;
  const std::stop_token& stop_;
  std::mutex mutex_;  ///< of features, materials and progress
  Bundle bundle_;
  BundleReport report_;
  const FormerBundle former_;
  std::vector<CameraPlace> cameras_;
  std::vector<RegionPlace> regions_;  ///< their place here names their files
  std::set<int> usedMaterials_;
  std::map<int, int> textureOf_;       ///< by texture of the scene
  std::map<int, BundleFile> imageOf_;  ///< by image of the scene
};

}  // namespace

Status checkBundleTarget(const fs::path& folder) {
  return checkExportTarget(folder, kBundleIndex, kBundleFormat, "bundle");
}

Result<BundleReport> writeBundle(const BundleInput& input, const fs::path& folder, TaskRunner& runner,
                                 const Progress& progress, std::stop_token stop) {
  if (Status free = checkBundleTarget(folder); !free) return tl::unexpected(free.error());
  return writeFolderAtomically(folder, [&](const fs::path& temporary) {
    return BundleWriter(input, temporary, runner, progress, stop).write();
  });
}

}  // namespace acentric
