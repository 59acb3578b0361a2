#include "engine/export/walk_pages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <list>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "engine/base/json_text.h"
#include "engine/export/counted_ranges.h"
#include "engine/export/walk_tree.h"
#include "engine/layout/storey_choice.h"

namespace acentric {
namespace {

using Json = BundleJson;

constexpr std::size_t kKeptPlaces = 8;  // those that were used last: the eye's, and pages beside it

/// A region as it is told of, without its covers.
struct KnownRegion {
  RegionKind kind = RegionKind::ring;
  ConvexPolygon polygon, grown;
  std::vector<int> neighbours;
  std::uint64_t triangles = 0, bytes = 0;
};

/// Of a storey; what was told stays where it is.
struct Known {
  std::unordered_map<std::uint64_t, CameraFacts> cameras;
  std::unordered_map<std::uint64_t, KnownRegion> regions;
};

/// What the page tells of its cameras and own regions.
void take(const BundlePlace& place, Known& known) {
  const BundleStorey& here = place.here();
  for (std::size_t c = 0; c < place.cameras.size(); ++c)
    known.cameras.try_emplace(place.cameras[c], factsOf(here.layout.cameras[c], here.cameras[c]));
  for (std::size_t r = 0; r < place.regions.size(); ++r) {
    if (place.own[r] == 0) continue;  // of others it lacks neighbours
    const Region& region = here.layout.regions[r];
    KnownRegion its{region.kind, region.polygon, region.grown, {}};
    for (const int neighbour : here.neighbours[r])
      its.neighbours.push_back(int(place.regions[std::size_t(neighbour)]));
    if (here.local[r]) its.triangles = here.local[r]->triangles, its.bytes = here.local[r]->file.bytes;
    known.regions.try_emplace(place.regions[r], std::move(its));
  }
}

}  // namespace

struct WalkPages::Index {
  std::shared_ptr<const ByteRanges> ranges;  ///< that files are read through
  CountedRanges counted;
  std::optional<WalkIndex> index;
  Json root;  ///< with the pages of storeys left out
  FilePlaces textures;
  std::vector<Counts> counts;  ///< by storey
  std::optional<WalkTree> tree;
  std::vector<Known> known;          ///< by storey
  std::list<BundlePlacePtr> places;  ///< last used first

  explicit Index(std::shared_ptr<const ByteRanges> from) : ranges(from), counted(std::move(from)) {}

  /// A place that is kept, and fits.
  template <class Fits>
  BundlePlacePtr kept(std::size_t storey, const Fits& fits) {
    const auto found = std::ranges::find_if(
        places, [&](const BundlePlacePtr& p) { return p->storey == storey && fits(*p); });
    if (found == places.end()) return nullptr;
    places.splice(places.begin(), places, found);
    return places.front();
  }

  BundlePlacePtr placeKept(const WalkPage& leaf) {
    return kept(leaf.storey, [&](const BundlePlace& p) { return p.page == leaf.entry.at; });
  }
  void keep(const BundlePlacePtr& place) {
    places.push_front(place);
    if (places.size() > kKeptPlaces) places.pop_back();
  }

  Result<BundlePlacePtr> placeOf(WalkPage& leaf) {
    if (auto place = placeKept(leaf)) return place;
    auto place = made(leaf, std::exchange(leaf.json, nullptr));
    tree->dropTexts();
    if (place) keep(*place);
    return place;
  }

  /// From any thread. `text`: null where it has to be read again.
  Result<BundlePlacePtr> made(const WalkPage& leaf, Json text) const {
    const std::string what = index->nameOf(leaf.entry);
    return withinSense(what, [&]() -> Result<BundlePlacePtr> {
      if (!text.is_null()) return placeFrom(std::move(text), leaf, what);
      auto again = index->page(leaf.entry);
      if (!again) return tl::unexpected(again.error());
      return placeFrom(std::move(*again), leaf, what);
    });
  }

  Result<BundlePlacePtr> placeFrom(Json text, const WalkPage& leaf, const std::string& what) const {
    auto place = std::make_shared<BundlePlace>();
    place->page = leaf.entry.at, place->storey = leaf.storey;
    place->cameras = leaf.cameras;
    FilePlaces files = textures;
    Json json = root, cameras = std::move(text.at("cameras")), regions = std::move(text.at("regions"));
    for (Json& camera : cameras) index->take(camera["full"], files), index->take(camera["coarse"], files);
    for (Json& region : regions) index->take(region["local"], files);
    for (const WalkPage::SeenRegion& region : leaf.regions) {
      place->regions.push_back(region.number);
      place->own.push_back(region.own ? 1 : 0);
    }
    const Counts& all = counts[leaf.storey];
    if (place->regions.back() >= all.regions ||
        std::ranges::any_of(place->cameras, [&](std::uint64_t n) { return n >= all.cameras; }))
      return fail(ErrorKind::malformed, "has a camera or a region beyond the storey's count", what);
    Json& here = json["storeys"][leaf.storey];
    here["cameras"] = std::move(cameras), here["regions"] = std::move(regions);
    auto bundle = parseBundle(jsonText(json), what);
    if (!bundle) return tl::unexpected(bundle.error());
    place->bundle = std::make_shared<const Bundle>(std::move(*bundle));
    place->files = std::make_shared<const RangeFiles>(ranges, std::move(files));
    return place;
  }

  Result<BundlePlacePtr> placeOf(const Result<WalkPagePtr>& leaf) {
    if (!leaf) return tl::unexpected(leaf.error());
    return placeOf(**leaf);
  }

  /// Of those that are kept.
  BundlePlacePtr placeWith(std::size_t storey, std::size_t region) {
    return kept(storey, [&](const BundlePlace& place) { return place.regionIn(region).has_value(); });
  }

  Result<BundlePlacePtr> placeOfRegion(std::size_t storey, std::size_t region) {
    if (auto place = placeWith(storey, region)) return place;
    return placeOfOwn(storey, region);
  }

  /// The place of the page whose own it is.
  Result<BundlePlacePtr> placeOfOwn(std::size_t storey, std::size_t region) {
    const auto owns = [&](const BundlePlace& place) {
      const auto found = place.regionIn(region);
      return found && place.own[*found] != 0;
    };
    if (auto place = kept(storey, owns)) return place;
    std::optional<glm::dvec2> inside;
    if (const auto near = placeWith(storey, region))
      inside = near->here().layout.regions[*near->regionIn(region)].polygon.centroid();
    return placeOf(tree->leafOf(storey, WalkThing::region, region, inside));
  }

  Result<BundlePlacePtr> placeOfCamera(std::size_t storey, std::size_t camera) {
    const auto has = [&](const BundlePlace& place) { return place.cameraIn(camera).has_value(); };
    if (auto place = kept(storey, has)) return place;
    return placeOf(tree->leafOf(storey, WalkThing::camera, camera));
  }
};

WalkPages::WalkPages(std::string name) : name_(std::move(name)) {}
WalkPages::~WalkPages() = default;

BundlePlaces::Counts WalkPages::counts(std::size_t storey) const { return index_->counts[storey]; }

Result<std::unique_ptr<WalkPages>> WalkPages::open(std::shared_ptr<const ByteRanges> ranges,
                                                   const std::string& name) {
  std::unique_ptr<WalkPages> pages(new WalkPages(name));
  const Status read = withinSense(name, [&] { return pages->readRoot(std::move(ranges)); });
  if (!read) return tl::unexpected(read.error());
  return pages;
}

Status WalkPages::readRoot(std::shared_ptr<const ByteRanges> ranges) {
  index_ = std::make_unique<Index>(std::move(ranges));
  auto index = WalkIndex::open(index_->counted, name_);
  if (!index) return tl::unexpected(index.error());
  index_->index = *index;
  auto root = index_->index->root();
  if (!root) return tl::unexpected(root.error());
  for (Json& texture : (*root)["textures"]) index_->index->take(texture, index_->textures);
  std::vector<std::optional<WalkPageEntry>> top;
  for (Json& storey : (*root)["storeys"]) {
    const std::uint64_t cameras = WalkIndex::number(storey.at("cameraCount")),
                        regions = WalkIndex::number(storey.at("regionCount"));
    constexpr auto kMost = std::uint64_t(std::numeric_limits<std::int32_t>::max());
    const Json& page = storey.at("page");
    if (cameras > kMost || regions > kMost) return index_->index->malformed("a storey counts too much");
    if (page.is_null() != (regions == 0))
      return index_->index->malformed("a storey has regions without pages, or pages without regions");
    top.emplace_back();
    if (!page.is_null()) top.back() = WalkIndex::entryOf(page);
    index_->counts.push_back({cameras, regions});
    WalkIndex::putLists(storey, Json::array(), Json::array());
  }
  auto bundle = parseBundle(jsonText(*root), name_);
  if (!bundle) return tl::unexpected(bundle.error());
  root_ = std::move(*bundle);
  index_->root = std::move(*root);
  index_->known.resize(top.size());
  index_->tree.emplace(*index_->index, std::move(top));
  return {};
}

Result<std::size_t> WalkPages::storeyAt(const glm::dvec3& eye) {
  std::vector<std::pair<double, std::size_t>> atLeast;
  const std::vector<Counts>& all = index_->counts;
  for (std::size_t s = 0; s < all.size(); ++s)
    if (all[s].regions > 0)
      atLeast.emplace_back(misfitOf(index_->tree->leastDistance(s, eye), root_.storeys[s].layout, eye), s);
  if (all.size() == 1 || atLeast.empty()) return 0;
  std::ranges::sort(atLeast);
  const std::lock_guard lock(mutex_);
  std::pair<double, std::size_t> best{std::numeric_limits<double>::infinity(), 0};
  WalkPagePtr leaf;
  for (const auto& [least, s] : atLeast) {
    if (least > best.first) break;
    const auto nearest = index_->tree->nearest(s, eye);
    if (!nearest) return tl::unexpected(nearest.error());
    const std::pair misfit(misfitOf(nearest->distance, root_.storeys[s].layout, eye), s);
    if (misfit < best) best = misfit, leaf = nearest->leaf;
  }
  index_->tree->dropTexts(leaf.get());  // it is asked for next
  return best.second;
}

Result<BundlePlacePtr> WalkPages::placeAt(std::size_t storey, const glm::dvec2& point) {
  if (storey >= index_->counts.size() || counts(storey).regions == 0)
    return fail(ErrorKind::notFound, "has no region to stand in", name_);
  const std::lock_guard lock(mutex_);
  const auto nearest = index_->tree->nearest(storey, point);
  if (!nearest) return tl::unexpected(nearest.error());
  return index_->placeOf(*nearest->leaf);
}

void WalkPages::readAhead(std::size_t storey, const glm::dvec2& point) {
  std::unique_lock lock(mutex_);
  WalkTree& tree = *index_->tree;
  std::size_t read = 0;
  while (const auto missing = tree.missing(storey, point)) {
    if (read++ == kKeptWalkPages) return;
    lock.unlock();
    const auto page = tree.read(storey, *missing);
    lock.lock();
    if (!page) return;
    tree.keep(*page);
  }
  const auto nearest = tree.nearest(storey, point);
  if (!nearest || index_->placeKept(*nearest->leaf)) return;
  Json text = std::exchange(nearest->leaf->json, nullptr);
  lock.unlock();
  const auto place = index_->made(*nearest->leaf, std::move(text));
  lock.lock();
  if (place && !index_->placeKept(*nearest->leaf)) index_->keep(*place);
}

Result<BundlePlacePtr> WalkPages::placeOfCamera(std::size_t storey, std::size_t camera) {
  const std::lock_guard lock(mutex_);
  return index_->placeOfCamera(storey, camera);
}

Result<BundlePlacePtr> WalkPages::placeOfRegion(std::size_t storey, std::size_t region) {
  const std::lock_guard lock(mutex_);
  return index_->placeOfRegion(storey, region);
}

Result<CameraFacts> WalkPages::camera(std::size_t storey, std::size_t camera) {
  const std::lock_guard lock(mutex_);
  auto& cameras = index_->known[storey].cameras;
  if (!cameras.contains(camera)) {
    const auto place = index_->placeOfCamera(storey, camera);
    if (!place) return tl::unexpected(place.error());
    take(**place, index_->known[storey]);
  }
  return cameras.at(camera);
}

Result<RegionFacts> WalkPages::region(std::size_t storey, std::size_t region) {
  const std::lock_guard lock(mutex_);
  auto& regions = index_->known[storey].regions;
  if (!regions.contains(region)) {
    const auto place = index_->placeOfOwn(storey, region);
    if (!place) return tl::unexpected(place.error());
    take(**place, index_->known[storey]);
  }
  const KnownRegion& its = regions.at(region);
  return RegionFacts{its.kind,       its.polygon.corners, its.grown.corners,
                     its.neighbours, its.triangles,       its.bytes};
}

WalkPagesStats WalkPages::stats() const { return {index_->counted.requests(), index_->counted.bytes()}; }

}  // namespace acentric
