#include "engine/export/bundle_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/layout/storey_choice.h"
#include "engine/view/view_cameras.h"

namespace acentric {
namespace {

template <class T>
std::uint64_t bytesIn(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

std::uint64_t bytesOf(const LocalGeometry& local) {
  const SurfaceLight& light = local.surfaces->light;
  std::uint64_t bytes = bytesIn(local.vertices) + bytesIn(local.triangles) + bytesIn(light.firstSample) +
                        bytesIn(light.resolution) + bytesIn(light.hasBack) + bytesIn(light.light);
  for (const Mesh& mesh : local.surfaces->meshes)
    bytes += bytesIn(mesh.positions) + bytesIn(mesh.normals) + bytesIn(mesh.uv[0]) + bytesIn(mesh.uv[1]) +
             bytesIn(mesh.colours) + bytesIn(mesh.triangles);
  for (const auto& planes : local.surfaces->mirrorPlanes) bytes += bytesIn(planes);
  return bytes;
}

std::uint64_t bytesOf(const ColourImage& image) { return bytesIn(image.pixels); }

}  // namespace

Status BundlePlayer::open(std::unique_ptr<BundleFiles> files) {
  auto bundle = readBundle(*files);
  if (!bundle) return tl::unexpected(bundle.error());
  open(std::move(files), std::move(*bundle));
  return {};
}

void BundlePlayer::open(std::shared_ptr<const BundleFiles> files, Bundle bundle) {
  files_ = std::move(files);
  bundle_ = std::move(bundle);
  images_.resize(bundle_.textures.size());
  const ScenePtr scene = sceneOf(bundle_, images_);
  for (const BundleStorey& storey : bundle_.storeys) {
    StoreyState state;
    state.cameras.resize(storey.cameras.size());
    state.regions.resize(storey.local.size());
    state.walk = walkSceneOf(bundle_, storey, scene);
    storeys_.push_back(std::move(state));
  }
}

void BundlePlayer::setThreads(int threads) { runner_ = std::make_unique<TaskRunner>(threads - 1); }

std::size_t BundlePlayer::storeyAt(const glm::dvec3& eye) const {
  std::size_t best = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; storeys_.size() > 1 && s < storeys_.size(); ++s) {
    const double misfit = misfitOf(bundle_.storeys[s].layout, eye);
    if (misfit < nearest) nearest = misfit, best = s;
  }
  return best;
}

Result<BundlePlayer::Needs> BundlePlayer::needsOf(const PerspectiveView& view,
                                                  const ViewSettings& settings) const {
  for (const Status& sound : {view.check(), settings.check()})
    if (!sound) return tl::unexpected(sound.error());
  Needs needs;
  needs.storey = storeyAt(view.eye);
  const Layout& layout = bundle_.storeys[needs.storey].layout;
  const auto region = layout.regionAt(glm::dvec2(view.eye));
  if (!region)
    return fail(ErrorKind::notFound,
                fmt::format("the eye ({:.3f}, {:.3f}) stands in no region", view.eye.x, view.eye.y), "view");
  needs.region = *region;
  needs.cameras = paintingOrder(layout, view, settings);
  return needs;
}

std::shared_ptr<const DisplayCapture>& BundlePlayer::slot(std::size_t storey, std::size_t camera,
                                                          Loaded detail) {
  Camera& of = storeys_[storey].cameras[camera];
  return detail == Loaded::full ? of.full : of.coarse;
}

const DisplayCapture* BundlePlayer::capture(std::size_t storey, std::size_t camera, Loaded detail) const {
  const Camera& of = storeys_[storey].cameras[camera];
  return detail == Loaded::full ? of.full.get() : of.coarse.get();
}

const LocalGeometry* BundlePlayer::region(std::size_t storey, std::size_t region) const {
  return storeys_[storey].regions[region].get();
}

const ColourImage* BundlePlayer::texture(std::size_t texture) const { return images_[texture].get(); }

Loaded BundlePlayer::loaded(std::size_t storey, std::size_t camera) const {
  const Camera& of = storeys_[storey].cameras[camera];
  return of.full ? Loaded::full : of.coarse ? Loaded::coarse : Loaded::absent;
}

bool BundlePlayer::regionLoaded(std::size_t storey, std::size_t region) const {
  return storeys_[storey].regions[region] != nullptr;
}

void BundlePlayer::show(std::size_t storey, std::size_t camera) {
  const Camera& of = storeys_[storey].cameras[camera];
  storeys_[storey].walk.captures[camera] = of.full ? of.full : of.coarse;
}

Status BundlePlayer::takeRoom(std::uint64_t bytes, const std::string& what) {
  if (limit_ > 0 && memory_ + bytes > limit_)
    return fail(ErrorKind::outOfSpace,
                fmt::format("takes {} bytes where {} of {} are taken: unload something first", bytes, memory_,
                            limit_),
                what);
  memory_ += bytes;
  return {};
}

Result<std::shared_ptr<const DisplayCapture>> BundlePlayer::readCapture(std::size_t storey,
                                                                        std::size_t camera,
                                                                        Loaded detail) const {
  const BundleCamera& renditions = bundle_.storeys[storey].cameras[camera];
  const auto& file = detail == Loaded::full ? renditions.full : renditions.coarse;
  if (!file)
    return fail(ErrorKind::notFound, "was not baked", fmt::format("storey {}, camera {}", storey, camera));
  const auto read = readBundleCapture(*files_, bundle_.storeys[storey], camera, *file);
  if (!read) return tl::unexpected(read.error());
  return std::make_shared<const DisplayCapture>(prepareForDisplay(*read, bundle_.exposure));
}

Status BundlePlayer::keepCapture(std::size_t storey, std::size_t camera, Loaded detail,
                                 std::shared_ptr<const DisplayCapture> capture) {
  auto& place = slot(storey, camera, detail);
  if (place) return {};
  if (Status room =
          takeRoom(acentric::bytesOf(*capture), fmt::format("storey {}, camera {}", storey, camera));
      !room)
    return room;
  place = std::move(capture);
  show(storey, camera);
  return {};
}

Status BundlePlayer::loadCapture(std::size_t storey, std::size_t camera, Loaded detail) {
  if (slot(storey, camera, detail)) return {};
  auto read = readCapture(storey, camera, detail);
  if (!read) return tl::unexpected(read.error());
  return keepCapture(storey, camera, detail, std::move(*read));
}

void BundlePlayer::unloadCapture(std::size_t storey, std::size_t camera, Loaded detail) {
  auto& place = slot(storey, camera, detail);
  if (!place) return;
  memory_ -= acentric::bytesOf(*place);
  place.reset();
  show(storey, camera);
}

Result<ReadRegion> BundlePlayer::readRegion(std::size_t storey, std::size_t region, Images known) const {
  auto local = readBundleLocal(*files_, bundle_, bundle_.storeys[storey], region);
  if (!local) return tl::unexpected(local.error());
  ReadRegion read{std::move(*local), Images(bundle_.textures.size())};
  const auto imageOf = [&](std::size_t texture) -> Result<std::shared_ptr<const ColourImage>> {
    const BundleTexture& described = bundle_.textures[texture];
    for (std::size_t t = 0; t < known.size(); ++t)  // several textures may share a picture
      if (known[t] && bundle_.textures[t].file == described.file) return known[t];
    auto image = readBundleTexture(*files_, described);
    if (!image) return tl::unexpected(image.error());
    return std::make_shared<const ColourImage>(std::move(*image));
  };
  known.resize(bundle_.textures.size());
  for (const Mesh& mesh : read.local.surfaces->meshes) {
    const Material& material = bundle_.materials[std::size_t(mesh.material)];
    for (const TextureUse* use : {&material.baseColourTexture, &material.emissiveTexture}) {
      if (!use->used()) continue;
      const auto texture = std::size_t(use->texture);
      auto image = imageOf(texture);
      if (!image) return tl::unexpected(image.error());
      known[texture] = read.images[texture] = std::move(*image);
    }
  }
  return read;
}

WalkScene BundlePlayer::bareWalk(std::size_t storey, Images images) const {
  const WalkScene& loaded = storeys_[storey].walk;
  WalkScene walk;
  walk.scene = sceneOf(bundle_, std::move(images));
  walk.layout = loaded.layout, walk.plan = loaded.plan;
  walk.exposure = loaded.exposure, walk.mirrors = loaded.mirrors;
  return walk;
}

Status BundlePlayer::keepTexture(std::size_t texture, std::shared_ptr<const ColourImage> image) {
  if (images_[texture]) return {};
  if (std::ranges::find(images_, image) == images_.end())
    if (Status room = takeRoom(bytesOf(*image), bundle_.textures[texture].file.path); !room) return room;
  images_[texture] = std::move(image);
  return {};
}

Status BundlePlayer::keepRegion(std::size_t storey, std::size_t region, ReadRegion read) {
  auto& place = storeys_[storey].regions[region];
  if (place) return {};
  for (std::size_t texture = 0; texture < read.images.size(); ++texture)
    if (read.images[texture])
      if (Status kept = keepTexture(texture, std::move(read.images[texture])); !kept) return kept;
  auto made = std::make_shared<const LocalGeometry>(std::move(read.local));
  if (Status room = takeRoom(bytesOf(*made), fmt::format("storey {}, region {}", storey, region)); !room)
    return room;
  showTextures();
  place = std::move(made);
  storeys_[storey].walk.local[region] = place;
  return {};
}

void BundlePlayer::showTextures() {
  const ScenePtr scene = sceneOf(bundle_, images_);
  for (StoreyState& storey : storeys_) storey.walk.scene = scene;
}

Status BundlePlayer::loadRegion(std::size_t storey, std::size_t region) {
  if (storeys_[storey].regions[region]) return {};
  auto read = readRegion(storey, region, images_);
  if (!read) return tl::unexpected(read.error());
  return keepRegion(storey, region, std::move(*read));
}

void BundlePlayer::unloadRegion(std::size_t storey, std::size_t region) {
  auto& place = storeys_[storey].regions[region];
  if (!place) return;
  memory_ -= bytesOf(*place);
  place.reset();
  storeys_[storey].walk.local[region].reset();
}

void BundlePlayer::unloadTextures() {
  for (std::size_t t = 0; t < images_.size(); ++t) {
    if (!images_[t]) continue;
    memory_ -= bytesOf(*images_[t]);
    for (std::size_t other = images_.size(); other-- > t;)  // of a picture that several share, all
      if (images_[other] == images_[t]) images_[other].reset();
  }
  showTextures();
}

Result<Frame> BundlePlayer::render(const PerspectiveView& view, const ViewSettings& settings) {
  return renderFrame(storeys_[storeyAt(view.eye)].walk, view, settings, *runner_, frames_);
}

}  // namespace acentric
