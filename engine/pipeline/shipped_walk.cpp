#include "engine/pipeline/shipped_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <span>

#include "engine/export/walk_read.h"
#include "engine/geometry/conventions.h"
#include "engine/pipeline/walk_ground.h"

namespace acentric {
namespace {

using ImagePtr = std::shared_ptr<const ColourImage>;

/// Says which walk, and what can be done about it.
Error inWalk(const ShippedWalk& walk, Error error, const std::string& instead = {}) {
  error.message += instead;
  if (error.kind != ErrorKind::unsupported)  // which says what to do
    error.message += "; copy the walk again, or export it anew";
  if (!error.where.starts_with(walk.file.string()))
    error.where = walk.file.string() + (error.where.empty() ? "" : ", " + error.where);
  return error;
}

/// What the index names once, in bytes.
std::uint64_t bytesOf(const Bundle& bundle) {
  std::map<std::string, std::uint64_t> files;
  const auto add = [&](const auto& part) {
    if (part) files[part->file.path] = part->file.bytes;
  };
  for (const BundleTexture& texture : bundle.textures) add(&texture);
  for (const BundleStorey& storey : bundle.storeys) {
    for (const BundleCamera& camera : storey.cameras) add(camera.full), add(camera.coarse);
    for (const auto& local : storey.local) add(local);
  }
  std::uint64_t bytes = 0;
  for (const auto& [path, size] : files) bytes += size;
  return bytes;
}

/// Bundles keep no lattice. Numbers tell regions and cameras apart, and cells are as large as a region's
/// edges are long. `regions` and `cameras`: the numbers; empty: in order.
std::shared_ptr<const Layout> numbered(Layout layout, std::span<const std::uint64_t> regions = {},
                                       std::span<const std::uint64_t> cameras = {}) {
  const auto number = [](std::span<const std::uint64_t> numbers, std::size_t i) {
    return int(numbers.empty() ? i : numbers[i]);
  };
  for (std::size_t r = 0; r < layout.regions.size(); ++r) layout.regions[r].id = {number(regions, r), 0, 0};
  for (std::size_t c = 0; c < layout.cameras.size(); ++c) layout.cameras[c].id = {number(cameras, c), 0, 0};
  if (!layout.regions.empty()) {
    const auto& corners = layout.regions.front().polygon.corners;
    double around = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
      around += glm::distance(corners[i], corners[(i + 1) % corners.size()]);
    layout.spec.cellSize = std::clamp(around / double(corners.size()), kLeastCellSize, kLargestCellSize);
  }
  return std::make_shared<const Layout>(std::move(layout));
}

/// Several textures may share a picture, which is read once.
Result<std::vector<ImagePtr>> readTextures(ShippedWalk& walk, TaskRunner& runner, const Progress& progress,
                                           const std::stop_token& stop) {
  const std::vector<BundleTexture>& textures = walk.bundle.textures;
  std::map<std::string, std::size_t> first;
  std::vector<std::size_t> toRead;
  for (std::size_t t = 0; t < textures.size(); ++t)
    if (first.emplace(textures[t].file.path, t).second) toRead.push_back(t);
  std::vector<ImagePtr> images(textures.size());
  std::mutex told;
  double done = 0;
  runner.parallelFor(toRead.size(), [&](std::size_t i) {
    if (stop.stop_requested()) return;
    auto image = readBundleTexture(*walk.files, textures[toRead[i]]);
    const std::lock_guard lock(told);
    if (image)
      images[toRead[i]] = std::make_shared<const ColourImage>(std::move(*image));
    else
      walk.warnings.push_back(inWalk(walk, image.error(), ". It is white").describe());
    if (progress) progress({++done, double(toRead.size()), "reading textures"});
  });
  if (stop.stop_requested()) return fail(ErrorKind::cancelled, "cancelled", walk.file.string());
  for (std::size_t t = 0; t < textures.size(); ++t) images[t] = images[first[textures[t].file.path]];
  return images;
}

/// The best rendition is the full one; the coarse one stands in where both are there.
const BundleCapture* renditionOf(const BundleCamera& camera, Detail detail) {
  const auto& best = camera.full ? camera.full : camera.coarse;
  const auto& file = detail == Detail::full ? best : camera.coarse;
  return file && (detail == Detail::full || camera.full) ? &*file : nullptr;
}

ContentKey keyOf(const BundleCamera& camera) {
  const BundleCapture* best = renditionOf(camera, Detail::full);
  return best != nullptr ? best->file.hash : ContentKey{};
}

template <class Thing>
std::map<int, std::size_t> byNumber(const std::vector<Thing>& things) {
  std::map<int, std::size_t> places;
  for (std::size_t i = 0; i < things.size(); ++i) places.emplace(things[i].id.i, i);
  return places;
}

class ShippedSource final : public WalkSource {
 public:
  ShippedSource(ShippedWalkPtr walk, int storey)
      : walk_(std::move(walk)), storey_(walk_->bundle.storeys[std::size_t(storey)]) {}

  std::uint64_t storedBytes(int camera, Detail detail) const override {
    const BundleCapture* file = renditionOf(storey_.cameras[std::size_t(camera)], detail);
    return file != nullptr ? file->file.bytes : 0;
  }

  Result<Capture> capture(int camera, Detail detail) const override {
    const BundleCapture* file = renditionOf(storey_.cameras[std::size_t(camera)], detail);
    if (file == nullptr) return fail(ErrorKind::notFound, "was not baked", fmt::format("camera {}", camera));
    auto read = readBundleCapture(*walk_->files, storey_, std::size_t(camera), *file);
    if (read) return read;
    const bool coarse = detail == Detail::full && storedBytes(camera, Detail::coarse) > 0;
    return tl::unexpected(inWalk(*walk_, read.error(), coarse ? ". The coarse capture stands in" : ""));
  }

  LocalPart local(int region, const std::stop_token&) const override {
    LocalPart part;
    auto read = readBundleLocal(*walk_->files, walk_->bundle, storey_, std::size_t(region));
    if (!read) {
      part.warnings.push_back(inWalk(*walk_, read.error(), ". Near geometry is missing there").describe());
      const ConvexPolygon& grown = storey_.layout.regions[std::size_t(region)].grown;
      read = LocalGeometry{grown, {}, {}, std::make_shared<const LocalSurfaces>()};
    }
    part.geometry = std::make_shared<const LocalGeometry>(std::move(*read));
    return part;
  }

 private:
  ShippedWalkPtr walk_;
  const BundleStorey& storey_;
};

Status readAll(ShippedWalk& walk, TaskRunner& runner, const Progress& progress, const std::stop_token& stop) {
  auto images = readTextures(walk, runner, progress, stop);
  if (!images) return tl::unexpected(images.error());
  walk.scene = sceneOf(walk.bundle, std::move(*images));
  auto rays = RayScene::build(walk.scene, planEffects(*walk.scene, {}));
  if (!rays) return tl::unexpected(rays.error());
  walk.rays = std::move(*rays);
  return {};
}

Status checkProject(const ShippedWalk& walk) {
  const Status sound = projectOf(walk).check();
  if (!sound) return fail(sound.error().kind, sound.error().describe(), walk.file.string());
  return {};
}

/// Files of several pages.
class FilesOfPlaces final : public BundleFiles {
 public:
  explicit FilesOfPlaces(const std::vector<BundlePlacePtr>& places) {
    for (const BundlePlacePtr& place : places)
      if (place) files_.push_back(place->files);
  }
  Result<std::vector<std::byte>> read(const std::string& path, std::uint64_t mostBytes) const override {
    for (const auto& files : files_)
      if (auto read = files->read(path, mostBytes); read || read.error().kind != ErrorKind::notFound)
        return read;
    return fail(ErrorKind::notFound, "is in no page of its index", path);
  }

 private:
  std::vector<std::shared_ptr<const BundleFiles>> files_;
};

/// The pages around a place of a storey, and beside it on the others; null where a storey has no region. The
/// others' that cannot be read are left out.
Result<std::vector<BundlePlacePtr>> placesAt(ShippedWalk& walk, std::size_t storey, const glm::dvec2& point) {
  std::vector<BundlePlacePtr> places(walk.pages->root().storeys.size());
  for (std::size_t s = 0; s < places.size(); ++s) {
    if (walk.pages->counts(s).regions == 0) continue;
    auto place = walk.pages->placeAt(s, point);
    if (place)
      places[s] = std::move(*place);
    else if (s == storey)
      return tl::unexpected(inWalk(walk, place.error()));
    else
      walk.warnings.push_back(inWalk(walk, place.error(), ". Its storey is left out").describe());
  }
  return places;
}

/// Makes them, at least one, what is there of the walk.
void putPlaces(ShippedWalk& walk, std::vector<BundlePlacePtr> places) {
  const auto any = std::ranges::find_if(places, [](const BundlePlacePtr& place) { return place != nullptr; });
  walk.bundle = *(*any)->bundle;
  for (std::size_t s = 0; s < places.size(); ++s) {
    BundleStorey& storey = walk.bundle.storeys[s];
    if (places[s]) storey = places[s]->here();
    walk.layouts.push_back(places[s] ? numbered(storey.layout, places[s]->regions, places[s]->cameras)
                                     : numbered(storey.layout));
  }
  walk.files = std::make_shared<const FilesOfPlaces>(places);
  walk.places = std::move(places);
}

/// Null: all of it is read at once, which also says what is wrong with it.
std::shared_ptr<WalkPages> pagesOf(const std::filesystem::path& file, std::uint64_t regionsAtOnce) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) return nullptr;
  auto ranges = fileRanges(file);
  if (!ranges) return nullptr;
  auto pages = WalkPages::open(std::move(*ranges), file.string());
  if (!pages) return nullptr;
  std::uint64_t regions = 0;
  for (std::size_t s = 0; s < (*pages)->root().storeys.size(); ++s) regions += (*pages)->counts(s).regions;
  return regions > regionsAtOnce ? std::move(*pages) : nullptr;
}

Status openAtStart(ShippedWalk& walk, std::shared_ptr<WalkPages> pages) {
  std::error_code error;
  walk.bytes = std::filesystem::file_size(walk.file, error);
  walk.pages = std::move(pages);
  const std::size_t storey = std::size_t(walk.pages->root().storey);
  auto places = placesAt(walk, storey, walk.pages->root().storeys[storey].start);
  if (!places) return tl::unexpected(places.error());
  putPlaces(walk, std::move(*places));
  return checkProject(walk);
}

}  // namespace

Result<ShippedWalkPtr> openShippedWalk(const std::filesystem::path& file, TaskRunner& runner,
                                       const Progress& progress, const std::stop_token& stop,
                                       std::uint64_t regionsAtOnce) {
  auto walk = std::make_shared<ShippedWalk>();
  walk->file = file;
  if (auto pages = pagesOf(file, regionsAtOnce)) {
    if (Status read = openAtStart(*walk, std::move(pages)); !read) return tl::unexpected(read.error());
    if (Status read = readAll(*walk, runner, progress, stop); !read) return tl::unexpected(read.error());
    return walk;
  }
  auto files = bundleAt(file);
  if (!isBundle(file) && (files || files.error().kind == ErrorKind::malformed))
    return fail(ErrorKind::malformed,
                "is neither a walk (*.acentric) nor the folder of a bundle (with bundle.json); `acentric "
                "export` writes both",
                file.string());
  if (!files) return tl::unexpected(inWalk(*walk, files.error()));
  walk->files = std::move(*files);
  auto bundle = readBundle(*walk->files);
  if (!bundle) return tl::unexpected(inWalk(*walk, bundle.error()));
  walk->bundle = std::move(*bundle);
  std::error_code error;
  const bool oneFile = !std::filesystem::is_directory(file, error);
  walk->bytes = oneFile ? std::filesystem::file_size(file, error) : bytesOf(walk->bundle);
  for (const BundleStorey& storey : walk->bundle.storeys) walk->layouts.push_back(numbered(storey.layout));
  if (Status sound = checkProject(*walk); !sound) return tl::unexpected(sound.error());
  if (Status read = readAll(*walk, runner, progress, stop); !read) return tl::unexpected(read.error());
  return walk;
}

Result<ShippedWalkPtr> shippedPlaces(std::vector<BundlePlacePtr> places, const std::filesystem::path& file,
                                     const ShippedWalk* former, TaskRunner& runner,
                                     const std::stop_token& stop) {
  auto walk = std::make_shared<ShippedWalk>();
  walk->file = file;
  putPlaces(*walk, std::move(places));
  if (former != nullptr) {
    walk->scene = former->scene, walk->rays = former->rays;
  } else if (Status read = readAll(*walk, runner, {}, stop); !read) {
    return tl::unexpected(read.error());
  }
  return walk;
}

Result<ShippedWalkPtr> placeAround(const ShippedWalkPtr& walk, int storey, const glm::dvec2& point) {
  auto next = std::make_shared<ShippedWalk>();
  next->file = walk->file, next->pages = walk->pages, next->bytes = walk->bytes;
  auto places = placesAt(*next, std::size_t(storey), point);
  if (!places) return tl::unexpected(places.error());
  const auto same = [](const BundlePlacePtr& a, const BundlePlacePtr& b) {
    return (a == nullptr) == (b == nullptr) && (a == nullptr || a->page == b->page);
  };
  if (std::ranges::equal(*places, walk->places, same)) return walk;
  putPlaces(*next, std::move(*places));
  next->scene = walk->scene, next->rays = walk->rays;
  return next;
}

std::uint64_t ShippedWalk::regionCount(int storey) const {
  return pages ? pages->counts(std::size_t(storey)).regions : layouts[std::size_t(storey)]->regions.size();
}

bool ShippedWalk::isOwn(int storey, int region) const {
  return places.empty() || places[std::size_t(storey)]->own[std::size_t(region)] != 0;
}

Project projectOf(const ShippedWalk& walk) {
  const Bundle& bundle = walk.bundle;
  Project project;
  project.scene = kBundleIndex;  // no model, and a project names one
  project.storeys.clear();
  for (std::size_t s = 0; s < bundle.storeys.size(); ++s)
    project.storeys.push_back({bundle.storeys[s].name,
                               walk.layouts[s]->spec,
                               {bundle.storeys[s].start, bundle.storeys[s].startYaw},
                               {}});
  project.storey = bundle.storey;
  project.view = bundle.view;
  project.fovDegrees = degrees(bundle.fov);
  project.exposure = bundle.exposure;
  for (const BundleBookmark& b : bundle.bookmarks)
    project.bookmarks.push_back({b.name, b.storey, b.pose.eye, b.pose.yaw, b.pose.pitch, degrees(b.fov)});
  for (const BundlePath& from : bundle.paths) {
    WalkPath path{from.name, from.storey, {}};
    for (const BundlePose& p : from.poses) path.path.poses.push_back({p.eye, p.yaw, p.pitch, p.seconds});
    project.paths.push_back(std::move(path));
  }
  // No bundle says how far up and down the eye may go: as far as its bookmarks and paths do.
  double& range = project.bake.eyeRange = 0;
  const auto reach = [&](int storey, const glm::dvec3& eye) {
    range = std::max(range, std::abs(eye.z - walk.layouts[std::size_t(storey)]->eyeZ()));
  };
  for (const Bookmark& b : project.bookmarks) reach(b.storey, b.eye);
  for (const WalkPath& path : project.paths)
    for (const PathPose& pose : path.path.poses) reach(path.storey, pose.eye);
  return project;
}

OpenProject openProject(const ShippedWalk& walk, const Project& project) {
  OpenProject open;
  open.file = walk.file;
  open.project = project;
  open.scene = open.imported = walk.scene;
  open.drawn = std::make_shared<const DrawnScene>(walk.scene);
  open.plan = walk.rays->plan();
  open.rays = walk.rays;
  open.layout = walk.layouts[std::size_t(project.storey)];
  open.layouts = walk.layouts;
  open.ground = std::make_shared<const StoreyGround>(walk.layouts, walk.pages == nullptr);
  for (const BundleCamera& camera : walk.bundle.storeys[std::size_t(project.storey)].cameras)
    open.keys.push_back(keyOf(camera));
  return open;
}

CapturesOnDisk capturesOf(const ShippedWalk& walk, int storey) {
  CapturesOnDisk there;
  for (const BundleCamera& camera : walk.bundle.storeys[std::size_t(storey)].cameras) {
    there.baked.push_back(camera.full.has_value());
    there.stale.push_back(false);
    there.bytes.push_back(camera.full ? camera.full->file.bytes : 0);
  }
  return there;
}

WalkStart startWalk(const ShippedWalkPtr& walk, int storey, const LoadedWalk* former) {
  const BundleStorey& from = walk->bundle.storeys[std::size_t(storey)];
  WalkStart start;
  LoadedWalk& loaded = start.walk;
  loaded.walk = walkSceneOf(walk->bundle, walk->layouts[std::size_t(storey)], walk->scene);
  loaded.standsIn.assign(from.cameras.size(), false);
  for (const BundleCamera& camera : from.cameras) {
    loaded.keys.push_back(keyOf(camera));
    if (!camera.full) ++(camera.coarse ? loaded.coarse : loaded.missing);
  }
  if (former != nullptr) {
    loaded.captureMemory = former->captureMemory;
    const bool same = former->walk.layout == loaded.walk.layout;
    if (same) loaded.walk.local = former->walk.local;
    for (std::size_t c = 0; same && c < from.cameras.size(); ++c)
      if (!former->standsIn[c]) loaded.walk.captures[c] = former->walk.captures[c];
  }
  start.source = std::make_shared<const ShippedSource>(walk, storey);
  return start;
}

int takeOver(const LoadedWalk& from, WalkStream::Held held, WalkStart& start) {
  int dropped = 0;
  LoadedWalk& to = start.walk;
  to.captureMemory = from.captureMemory;
  start.coarse.resize(to.walk.captures.size());
  const auto cameras = byNumber(to.walk.layout->cameras), regions = byNumber(to.walk.layout->regions);
  for (std::size_t c = 0; c < held.full.size(); ++c) {
    const auto found = cameras.find(from.walk.layout->cameras[c].id.i);
    if (found == cameras.end()) {
      dropped += (held.full[c] ? 1 : 0) + (held.coarse[c] ? 1 : 0);
      continue;
    }
    to.walk.captures[found->second] = std::move(held.full[c]);
    start.coarse[found->second] = std::move(held.coarse[c]);
  }
  for (std::size_t r = 0; r < held.local.size(); ++r)
    if (const auto found = regions.find(from.walk.layout->regions[r].id.i); found != regions.end())
      to.walk.local[found->second] = std::move(held.local[r]);
  return dropped;
}

}  // namespace acentric
