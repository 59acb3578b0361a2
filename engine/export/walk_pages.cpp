#include "engine/export/walk_pages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <list>
#include <new>
#include <optional>

#include "engine/base/json_text.h"
#include "engine/export/counted_ranges.h"
#include "engine/export/walk_index.h"

namespace acentric {
namespace {

using Json = BundleJson;

/// Pages that are kept, those that were used last. A way down the tree has kMostWalkLevels of them at most,
/// and a step over a border needs another one.
constexpr std::size_t kKeptPages = 4 * kMostWalkLevels, kKeptPlaces = 4;

struct Box {
  glm::dvec2 low, high;
  double distanceTo(const glm::dvec2& p) const {
    return glm::length(glm::max(glm::max(low - p, p - high), glm::dvec2(0)));
  }
};

Box boxOf(const Json& entry) {
  const Json& box = entry.at("box");
  const auto side = [&](std::size_t i) { return box.at(i).get<double>(); };
  return {{side(0), side(1)}, {side(2), side(3)}};
}

/// A page as it is kept: of an inner one what is below it, of a leaf where its regions are. All of a leaf
/// takes a hundred times the room.
struct Page {
  std::uint64_t at = 0;
  Json entry, json;  ///< of a leaf `json` goes when it was looked at
  struct Own {
    std::uint64_t number = 0;
    ConvexPolygon polygon;
  };
  std::vector<Own> own;  ///< of a leaf
};
using PagePtr = std::shared_ptr<Page>;

}  // namespace

struct WalkPages::Index {
  std::shared_ptr<const ByteRanges> ranges;  ///< that files are read through
  CountedRanges counted;
  std::optional<WalkIndex> index;
  Json root;              ///< with the pages of storeys left out
  std::vector<Json> top;  ///< entries of the storeys' topmost pages
  FilePlaces textures;
  std::list<PagePtr> pages;        ///< last used first
  std::list<WalkPlacePtr> places;  ///< the same
  int read = 0;

  explicit Index(std::shared_ptr<const ByteRanges> from) : ranges(from), counted(std::move(from)) {}

  template <class List, class Same>
  static auto kept(List& list, const Same& same) -> typename List::value_type {
    const auto found = std::ranges::find_if(list, same);
    if (found == list.end()) return nullptr;
    list.splice(list.begin(), list, found);
    return list.front();
  }

  Result<PagePtr> page(const Json& entry) {
    const std::uint64_t at = WalkIndex::number(entry.at("at"));
    if (auto known = kept(pages, [&](const PagePtr& p) { return p->at == at; })) return known;
    auto json = index->page(entry);
    if (!json) return tl::unexpected(json.error());
    ++read;
    auto made = std::make_shared<Page>();
    made->at = at, made->entry = entry, made->json = std::move(*json);
    if (entry.at("leaf").get<bool>()) {
      for (const Json& region : made->json.at("regions")) {
        if (!region.at("own").get<bool>()) continue;
        Page::Own own{WalkIndex::number(region.at("number")), {}};
        for (const Json& corner : region.at("polygon"))
          own.polygon.corners.emplace_back(corner.at(0).get<double>(), corner.at(1).get<double>());
        if (own.polygon.size() < 3) return index->malformed("a region of its index has no polygon");
        made->own.push_back(std::move(own));
      }
    } else if (!made->json.at("pages").is_array()) {
      return index->malformed("a page of its index makes no sense");
    }
    pages.push_front(std::move(made));
    if (pages.size() > kKeptPages) pages.pop_back();
    return pages.front();
  }

  struct Nearest {
    PagePtr leaf;
    std::uint64_t number = 0;
    double distance = std::numeric_limits<double>::infinity();
  };

  Status visit(const Json& entry, int level, const glm::dvec2& point, Nearest& best) {
    if (level >= kMostWalkLevels) return index->malformed("its pages nest too deep");
    if (best.leaf && boxOf(entry).distanceTo(point) > best.distance) return {};
    const auto found = page(entry);
    if (!found) return tl::unexpected(found.error());
    if (!entry.at("leaf").get<bool>()) {
      std::vector<std::pair<double, const Json*>> nearestFirst;
      for (const Json& child : (*found)->json["pages"])
        nearestFirst.emplace_back(boxOf(child).distanceTo(point), &child);
      std::ranges::stable_sort(nearestFirst, {}, [](const auto& child) { return child.first; });
      for (const auto& [distance, child] : nearestFirst)
        if (Status visited = visit(*child, level + 1, point, best); !visited) return visited;
      return {};
    }
    for (const Page::Own& own : (*found)->own) {
      const double distance =
          own.polygon.containsClosed(point) ? 0 : glm::distance(own.polygon.nearestPoint(point), point);
      // Of regions that overlap the first is the eye's.
      if (distance < best.distance || (distance == best.distance && own.number < best.number))
        best = {*found, own.number, distance};
    }
    return {};
  }

  Result<WalkPlacePtr> placeOf(Page& leaf, std::size_t storey, const std::string& name) {
    if (leaf.json.is_null()) {
      auto again = index->page(leaf.entry);
      if (!again) return tl::unexpected(again.error());
      leaf.json = std::move(*again), ++read;
    }
    auto place = std::make_shared<WalkPlace>();
    place->page = leaf.at, place->storey = storey;
    FilePlaces files = textures;
    Json json = root, cameras = std::move(leaf.json.at("cameras")),
         regions = std::move(leaf.json.at("regions"));
    leaf.json = nullptr;
    for (Json& camera : cameras) {
      place->cameras.push_back(WalkIndex::number(camera.at("number")));
      index->take(camera["full"], files), index->take(camera["coarse"], files);
    }
    for (Json& region : regions) {
      place->regions.push_back(WalkIndex::number(region.at("number")));
      place->own.push_back(region.at("own").get<bool>() ? 1 : 0);
      index->take(region["local"], files);
    }
    const auto tooLarge = [](std::uint64_t n) { return n > std::uint64_t(std::numeric_limits<int>::max()); };
    if (!std::ranges::is_sorted(place->regions) || std::ranges::any_of(place->regions, tooLarge) ||
        std::ranges::any_of(place->cameras, tooLarge))
      return index->malformed("the numbers of a page of its index make no sense");
    Json& here = json["storeys"][storey];
    here["cameras"] = std::move(cameras), here["regions"] = std::move(regions);
    auto bundle = parseBundle(jsonText(json), name);
    if (!bundle) return tl::unexpected(bundle.error());
    place->bundle = std::move(*bundle);
    place->files = std::make_shared<const RangeFiles>(ranges, std::move(files));
    return place;
  }
};

WalkPages::WalkPages(std::string name) : name_(std::move(name)) {}
WalkPages::~WalkPages() = default;

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
  for (Json& storey : (*root)["storeys"]) {
    index_->top.push_back(storey.at("page"));
    counts_.push_back(WalkIndex::number(storey.at("regionCount")));
    WalkIndex::putLists(storey, Json::array(), Json::array());
  }
  auto bundle = parseBundle(jsonText(*root), name_);
  if (!bundle) return tl::unexpected(bundle.error());
  root_ = std::move(*bundle);
  index_->root = std::move(*root);
  return {};
}

Result<WalkPlacePtr> WalkPages::placeAt(std::size_t storey, const glm::dvec2& point) {
  const std::lock_guard lock(mutex_);
  return withinSense(name_, [&] { return find(storey, point); });
}

Result<WalkPlacePtr> WalkPages::find(std::size_t storey, const glm::dvec2& point) {
  Index::Nearest best;
  if (storey >= index_->top.size() || index_->top[storey].is_null())
    return fail(ErrorKind::notFound, "has no region to stand in", name_);
  if (Status visited = index_->visit(index_->top[storey], 0, point, best); !visited)
    return tl::unexpected(visited.error());
  if (!best.leaf) return index_->index->malformed("its index has pages without regions");
  const auto same = [&](const WalkPlacePtr& p) { return p->page == best.leaf->at && p->storey == storey; };
  Result<WalkPlacePtr> place = Index::kept(index_->places, same);
  const bool known = *place != nullptr;
  if (!known) place = index_->placeOf(*best.leaf, storey, name_);
  for (const PagePtr& page : index_->pages)
    if (!page->own.empty()) page->json = nullptr;
  if (known || !place) return place;
  index_->places.push_front(*place);
  if (index_->places.size() > kKeptPlaces) index_->places.pop_back();
  return place;
}

WalkPagesStats WalkPages::stats() const {
  const std::lock_guard lock(mutex_);
  return {index_->counted.requests(), index_->counted.bytes(), index_->read};
}

}  // namespace acentric
