#include "engine/export/bundle_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/view/view_cameras.h"

namespace acentric {
namespace {

template <class Array>
std::uint64_t bytesIn(const Array& values) {
  return values.size() * sizeof(typename Array::value_type);
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

void BundlePlayer::open(std::unique_ptr<BundlePlaces> places) {
  places_ = std::move(places);
  images_.resize(bundle().textures.size());
  parts_.resize(bundle().storeys.size());
}

void BundlePlayer::setThreads(int threads) { runner_ = std::make_unique<TaskRunner>(threads - 1); }

Result<std::size_t> BundlePlayer::storeyAt(const glm::dvec3& eye) const {
  if (!std::isfinite(eye.x) || !std::isfinite(eye.y) || !std::isfinite(eye.z)) return 0;
  return places_->storeyAt(eye);
}

Result<BundlePlacePtr> BundlePlayer::placeAt(std::size_t storey, const glm::dvec2& point) const {
  if (places_->counts(storey).regions == 0 || !std::isfinite(point.x) || !std::isfinite(point.y))
    return nullptr;
  return places_->placeAt(storey, point);
}

Result<BundlePlayer::Eye> BundlePlayer::stand(const PerspectiveView& view,
                                              const ViewSettings& settings) const {
  for (const Status& sound : {view.check(), settings.check()})
    if (!sound) return tl::unexpected(sound.error());
  const auto failed = [](Error error) {  // notFound is what the eye may be
    if (error.kind == ErrorKind::notFound) error.kind = ErrorKind::unreadable;
    return tl::unexpected(std::move(error));
  };
  const auto storey = storeyAt(view.eye);
  if (!storey) return failed(storey.error());
  const glm::dvec2 point(view.eye);
  const auto place = placeAt(*storey, point);
  if (!place) return failed(place.error());
  const auto region = *place ? (*place)->here().layout.regionAt(point) : std::nullopt;
  if (!region)
    return fail(ErrorKind::notFound,
                fmt::format("the eye ({:.3f}, {:.3f}) stands in no region", point.x, point.y), "view");
  return Eye{*place, *region};
}

Result<BundlePlayer::Needs> BundlePlayer::needsOf(const PerspectiveView& view,
                                                  const ViewSettings& settings) const {
  const auto eye = stand(view, settings);
  if (!eye) return tl::unexpected(eye.error());
  return Needs{eye->place, eye->region, paintingOrder(eye->place->here().layout, view, settings)};
}

// What is loaded
// ------------------------------------------------------------------------------------------------------------

const DisplayCapture* BundlePlayer::capture(std::size_t storey, std::size_t camera, Loaded detail) const {
  const auto found = parts_[storey].cameras.find(camera);
  if (found == parts_[storey].cameras.end()) return nullptr;
  return detail == Loaded::full ? found->second.full.get() : found->second.coarse.get();
}

const LocalGeometry* BundlePlayer::region(std::size_t storey, std::size_t region) const {
  const auto found = parts_[storey].regions.find(region);
  return found == parts_[storey].regions.end() ? nullptr : found->second.local.get();
}

Loaded BundlePlayer::loaded(std::size_t storey, std::size_t camera) const {
  const auto found = parts_[storey].cameras.find(camera);
  if (found == parts_[storey].cameras.end()) return Loaded::absent;
  return found->second.full ? Loaded::full : Loaded::coarse;
}

void BundlePlayer::showCamera(std::size_t storey, std::size_t camera) {
  if (!place_ || place_->storey != storey) return;
  if (const auto here = place_->cameraIn(camera)) {
    const auto found = parts_[storey].cameras.find(camera);
    walk_.captures[*here] = found != parts_[storey].cameras.end() ? found->second.best() : nullptr;
  }
}

void BundlePlayer::showRegion(std::size_t storey, std::size_t region) {
  if (!place_ || place_->storey != storey) return;
  if (const auto here = place_->regionIn(region)) {
    const auto found = parts_[storey].regions.find(region);
    walk_.local[*here] = found != parts_[storey].regions.end() ? found->second.local : nullptr;
  }
}

void BundlePlayer::enter(const BundlePlacePtr& place) {
  if (place == place_) return;
  walk_ = walkSceneOf(place, sceneOf(bundle(), images_));
  place_ = place;
  for (std::size_t c = 0; c < place->cameras.size(); ++c) {
    const auto found = parts_[place->storey].cameras.find(place->cameras[c]);
    if (found != parts_[place->storey].cameras.end()) walk_.captures[c] = found->second.best();
  }
  for (std::size_t r = 0; r < place->regions.size(); ++r) {
    const auto found = parts_[place->storey].regions.find(place->regions[r]);
    if (found != parts_[place->storey].regions.end()) walk_.local[r] = found->second.local;
  }
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

// Loading
// ------------------------------------------------------------------------------------------------------------

Status BundlePlayer::keepCapture(std::size_t storey, std::size_t camera, Loaded detail, CapturePtr capture) {
  if (this->capture(storey, camera, detail) != nullptr) return {};
  if (Status room =
          takeRoom(acentric::bytesOf(*capture), fmt::format("storey {}, camera {}", storey, camera));
      !room)
    return room;
  parts_[storey].cameras[camera].of(detail) = std::move(capture);
  showCamera(storey, camera);
  return {};
}

Status BundlePlayer::loadCapture(const BundlePlace& place, std::size_t camera, Loaded detail) {
  const std::size_t number = place.cameras[camera];
  if (capture(place.storey, number, detail) != nullptr) return {};
  auto read = readCapture(place, camera, detail);
  if (!read) return tl::unexpected(read.error());
  return keepCapture(place.storey, number, detail, std::move(*read));
}

Status BundlePlayer::loadCapture(std::size_t storey, std::size_t camera, Loaded detail) {
  if (capture(storey, camera, detail) != nullptr) return {};
  const auto place = places_->placeOfCamera(storey, camera);
  if (!place) return tl::unexpected(place.error());
  return loadCapture(**place, *(*place)->cameraIn(camera), detail);
}

void BundlePlayer::unloadCapture(std::size_t storey, std::size_t camera, Loaded detail) {
  if (capture(storey, camera, detail) == nullptr) return;
  Camera& of = parts_[storey].cameras[camera];
  memory_ -= acentric::bytesOf(*of.of(detail));
  of.of(detail).reset();
  if (!of.best()) parts_[storey].cameras.erase(camera);
  showCamera(storey, camera);
}

Status BundlePlayer::keepTexture(std::size_t texture, std::shared_ptr<const ColourImage> image) {
  if (images_[texture]) return {};
  if (std::ranges::find(images_, image) == images_.end())
    if (Status room = takeRoom(bytesOf(*image), bundle().textures[texture].file.path); !room) return room;
  images_[texture] = std::move(image);
  return {};
}

Status BundlePlayer::keepRegion(std::size_t storey, std::size_t region, ReadRegion read) {
  if (regionLoaded(storey, region)) return {};
  for (std::size_t texture = 0; texture < read.images.size(); ++texture)
    if (read.images[texture])
      if (Status kept = keepTexture(texture, std::move(read.images[texture])); !kept) return kept;
  auto made = std::make_shared<const LocalGeometry>(std::move(read.local));
  if (Status room = takeRoom(bytesOf(*made), fmt::format("storey {}, region {}", storey, region)); !room)
    return room;
  walk_.scene = sceneOf(bundle(), images_);
  parts_[storey].regions[region] = {read.middle, std::move(made)};
  showRegion(storey, region);
  return {};
}

Status BundlePlayer::loadRegion(const BundlePlace& place, std::size_t region) {
  const std::size_t number = place.regions[region];
  if (regionLoaded(place.storey, number)) return {};
  auto read = readRegion(place, region, images_);
  if (!read) return tl::unexpected(read.error());
  return keepRegion(place.storey, number, std::move(*read));
}

Status BundlePlayer::loadRegion(std::size_t storey, std::size_t region) {
  if (regionLoaded(storey, region)) return {};
  const auto place = places_->placeOfRegion(storey, region);
  if (!place) return tl::unexpected(place.error());
  return loadRegion(**place, *(*place)->regionIn(region));
}

void BundlePlayer::unloadRegion(std::size_t storey, std::size_t region) {
  const LocalGeometry* local = this->region(storey, region);
  if (local == nullptr) return;
  memory_ -= bytesOf(*local);
  parts_[storey].regions.erase(region);
  showRegion(storey, region);
}

void BundlePlayer::unloadTextures() {
  for (std::size_t t = 0; t < images_.size(); ++t) {
    if (!images_[t]) continue;
    memory_ -= bytesOf(*images_[t]);
    for (std::size_t other = images_.size(); other-- > t;)  // of a picture that several share, all
      if (images_[other] == images_[t]) images_[other].reset();
  }
  walk_.scene = sceneOf(bundle(), images_);
}

Status BundlePlayer::loadView(const Needs& needs, Loaded detail, bool regions) {
  const BundlePlace& place = *needs.place;
  for (const int c : needs.cameras) {
    const auto camera = std::size_t(c);
    if (detail == Loaded::coarse && loaded(place.storey, place.cameras[camera]) != Loaded::absent) continue;
    const Loaded chosen = renditionOf(place.here().cameras[camera], detail);
    if (chosen == Loaded::absent) continue;  // it stays a hole
    if (Status done = loadCapture(place, camera, chosen); !done) return done;
  }
  return regions ? loadRegion(place, std::size_t(needs.region)) : Status();
}

Result<Frame> BundlePlayer::render(const PerspectiveView& view, const ViewSettings& settings) {
  const auto eye = stand(view, settings);
  if (!eye) return tl::unexpected(eye.error());
  enter(eye->place);
  return renderFrame(walk_, view, settings, *runner_, frames_);
}

}  // namespace acentric
