#include "engine/export/walk_tree.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/layout/point_inside.h"

namespace acentric {
namespace {

using Json = BundleJson;

/// Distances are rounded.
constexpr double kSlack = 1e-12;

/// No region of the page is nearer.
double leastDistanceTo(const WalkPageEntry& page, const glm::dvec2& p) {
  return (1 - kSlack) * glm::length(glm::max(glm::max(page.low - p, p - page.high), glm::dvec2(0)));
}

/// From the nearest side of a page's box, which holds the point.
double depthIn(const WalkPageEntry& page, const glm::dvec2& p) {
  const glm::dvec2 depth = glm::min(p - page.low, page.high - p);
  return std::min(depth.x, depth.y);
}

bool has(const WalkPage& page, WalkThing thing, std::uint64_t number) {
  if (thing == WalkThing::camera) return std::ranges::find(page.cameras, number) != page.cameras.end();
  const auto found = std::ranges::lower_bound(page.regions, number, {}, &WalkPage::SeenRegion::number);
  return found != page.regions.end() && found->number == number && found->own;
}

/// What is looked at of a leaf's text.
Status readLeaf(WalkPage& leaf, const std::string& name) {
  for (const Json& region : leaf.json.at("regions")) {
    WalkPage::SeenRegion seen{WalkIndex::number(region.at("number")), region.at("own").get<bool>(), {}};
    for (const Json& corner : region.at("polygon"))
      seen.polygon.corners.emplace_back(corner.at(0).get<double>(), corner.at(1).get<double>());
    if (seen.polygon.size() < 3) return fail(ErrorKind::malformed, "has a region without a polygon", name);
    if (!leaf.regions.empty() && leaf.regions.back().number >= seen.number)
      return fail(ErrorKind::malformed, "has regions in another order than the storey's", name);
    leaf.regions.push_back(std::move(seen));
  }
  for (const Json& camera : leaf.json.at("cameras"))
    leaf.cameras.push_back(WalkIndex::number(camera.at("number")));
  if (std::ranges::none_of(leaf.regions, &WalkPage::SeenRegion::own))
    return fail(ErrorKind::malformed, "has no region of its own", name);
  return {};
}

}  // namespace

void LeafNumbers::add(std::uint64_t number, std::size_t leaf) {
  std::uint32_t& place = leaves_[number / kTogether][number % kTogether];
  if (place == 0) place = std::uint32_t(leaf + 1);
}

std::optional<std::size_t> LeafNumbers::find(std::uint64_t number) const {
  const auto found = leaves_.find(number / kTogether);
  if (found == leaves_.end() || found->second[number % kTogether] == 0) return std::nullopt;
  return found->second[number % kTogether] - 1;
}

WalkTree::WalkTree(const WalkIndex& index, std::vector<std::optional<WalkPageEntry>> top)
    : index_(index), top_(std::move(top)), searches_(top_.size()) {
  for (std::size_t s = 0; s < top_.size(); ++s)
    if (top_[s]) searches_[s].pending.push_back({*top_[s], 0});
}

Result<WalkPagePtr> WalkTree::read(std::size_t storey, const WalkPageEntry& entry) const {
  const std::string name = index_.nameOf(entry);
  return withinSense(name, [&]() -> Result<WalkPagePtr> {
    auto json = index_.page(entry);
    if (!json) return tl::unexpected(json.error());
    auto made = std::make_shared<WalkPage>();
    made->storey = storey, made->entry = entry;
    if (entry.leaf) {
      made->json = std::move(*json);
      if (Status read = readLeaf(*made, name); !read) return tl::unexpected(read.error());
      return made;
    }
    for (const Json& child : json->at("pages")) made->children.push_back(WalkIndex::entryOf(child));
    if (made->children.empty()) return fail(ErrorKind::malformed, "has no page below it", name);
    return made;
  });
}

WalkPagePtr WalkTree::kept(std::size_t storey, std::uint64_t at) {
  const auto found = std::ranges::find_if(
      kept_, [&](const WalkPagePtr& p) { return p->storey == storey && p->entry.at == at; });
  if (found == kept_.end()) return nullptr;
  kept_.splice(kept_.begin(), kept_, found);
  return kept_.front();
}

void WalkTree::keep(const WalkPagePtr& page) {
  if (kept(page->storey, page->entry.at)) return;
  kept_.push_front(page);
  if (kept_.size() > kKeptWalkPages) kept_.pop_back();
}

Result<WalkPagePtr> WalkTree::page(std::size_t storey, const WalkPageEntry& entry) {
  if (auto known = kept(storey, entry.at)) return known;
  if (!reads_) {
    missing_ = entry;
    return fail(ErrorKind::cancelled, "has to be read first", index_.nameOf(entry));
  }
  auto made = read(storey, entry);
  if (made) keep(*made);
  return made;
}

void WalkTree::dropTexts(const WalkPage* but) {
  for (const WalkPagePtr& page : kept_)
    if (page.get() != but) page->json = nullptr;
}

// By place
// ------------------------------------------------------------------------------------------------------------

Status WalkTree::visit(std::size_t storey, const WalkPageEntry& entry, int level, Query& query) {
  if (leastDistanceTo(entry, query.point) > query.reach) return {};
  if (level >= kMostWalkLevels) return index_.malformed("its pages nest too deep");
  if (!query.seen.insert(entry.at).second) return index_.malformed("its index names a page twice");
  const auto found = page(storey, entry);
  if (!found) {
    if (found.error().kind != ErrorKind::malformed) return tl::unexpected(found.error());
    if (!query.damage) query.damage = found.error();  // perhaps another page has what is looked for
    return {};
  }
  std::vector<const WalkPageEntry*> likeliestFirst;
  for (const WalkPageEntry& child : (*found)->children) likeliestFirst.push_back(&child);
  std::ranges::stable_sort(likeliestFirst, {}, [&](const WalkPageEntry* child) {
    return std::pair(leastDistanceTo(*child, query.point), -depthIn(*child, query.point));
  });
  for (const WalkPageEntry* child : likeliestFirst)
    if (Status visited = visit(storey, *child, level + 1, query); !visited) return visited;
  for (const WalkPage::SeenRegion& region : (*found)->regions) {
    if (!region.own || (query.wanted && region.number != *query.wanted)) continue;
    const double distance = query.wanted || region.polygon.containsClosed(query.point)
                                ? 0
                                : glm::distance(region.polygon.nearestPoint(query.point), query.point);
    if (distance < query.distance || (distance == query.distance && region.number < query.number))
      query.leaf = *found, query.number = region.number, query.distance = query.reach = distance;
  }
  // Regions that overlap one of a leaf's own are in the leaf too: no other page knows better.
  if (query.distance == 0) query.reach = -1;
  return {};
}

/// Of a point that a region holds damage elsewhere does not matter.
Status WalkTree::run(std::size_t storey, Query& query) {
  if (Status visited = visit(storey, *top_[storey], 0, query); !visited) return visited;
  if (query.damage && query.distance > 0) return tl::unexpected(*query.damage);
  if (!query.leaf) return index_.malformed("its pages lack a region that they name");
  return {};
}

Result<WalkTree::Nearest> WalkTree::nearest(std::size_t storey, const glm::dvec2& point) {
  Query query{point};
  if (Status done = run(storey, query); !done) return tl::unexpected(done.error());
  if (query.distance > 0) {
    const ConvexPolygon& polygon =
        std::ranges::lower_bound(query.leaf->regions, query.number, {}, &WalkPage::SeenRegion::number)
            ->polygon;
    const auto holds = [&](const glm::dvec2& p) { return polygon.contains(p); };
    return Nearest{query.leaf, glm::distance(pointInside(polygon, point, holds), point)};
  }
  const auto first = std::ranges::find_if(query.leaf->regions, [&](const WalkPage::SeenRegion& region) {
    return region.polygon.containsClosed(point);
  });
  if (first == query.leaf->regions.end() || first->own) return Nearest{query.leaf, 0};
  Query owner{point, first->number};  // of regions that overlap the first is the eye's
  owner.reach = 0;
  if (Status done = run(storey, owner); !done) return tl::unexpected(done.error());
  return Nearest{owner.leaf, 0};
}

std::optional<WalkPageEntry> WalkTree::missing(std::size_t storey, const glm::dvec2& point) {
  reads_ = false, missing_ = std::nullopt;
  static_cast<void>(nearest(storey, point));
  reads_ = true;
  return missing_;
}

double WalkTree::leastDistance(std::size_t storey, const glm::dvec2& point) const {
  return top_[storey] ? leastDistanceTo(*top_[storey], point) : std::numeric_limits<double>::infinity();
}

// By number
// ------------------------------------------------------------------------------------------------------------

Result<WalkPagePtr> WalkTree::leafOf(std::size_t storey, WalkThing thing, std::uint64_t number,
                                     const std::optional<glm::dvec2>& inside) {
  const auto found = std::ranges::find_if(
      kept_, [&](const WalkPagePtr& p) { return p->storey == storey && has(*p, thing, number); });
  if (found != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, found);
    return kept_.front();
  }
  if (!inside) return lookThrough(storey, thing, number);
  Query query{*inside, number};
  query.reach = 0;
  if (Status done = run(storey, query); !done) return tl::unexpected(done.error());
  return query.leaf;
}

Result<WalkPagePtr> WalkTree::expand(std::size_t storey, const Search::Pending& next) {
  Search& search = searches_[storey];
  if (next.level >= kMostWalkLevels) return index_.malformed("its pages nest too deep");
  auto page = read(storey, next.entry);
  if (!page) return page;
  const std::vector<WalkPageEntry>& children = (*page)->children;
  for (std::size_t c = 0; c < children.size(); ++c)
    if (search.named.contains(children[c].at) ||
        std::ranges::count(children, children[c].at, &WalkPageEntry::at) > 1)
      return index_.malformed("its index names a page twice");
  for (auto child = children.rbegin(); child != children.rend(); ++child) {
    search.named.insert(child->at);
    search.pending.push_back({*child, next.level + 1});
  }
  if (!next.entry.leaf) return page;
  for (const WalkPage::SeenRegion& region : (*page)->regions)
    if (region.own) search.regions.add(region.number, search.leaves.size());
  for (const std::uint64_t camera : (*page)->cameras) search.cameras.add(camera, search.leaves.size());
  search.leaves.push_back(next.entry);
  return page;
}

Result<WalkPagePtr> WalkTree::lookThrough(std::size_t storey, WalkThing thing, std::uint64_t number) {
  Search& search = searches_[storey];
  const LeafNumbers& numbers = thing == WalkThing::region ? search.regions : search.cameras;
  if (const auto known = numbers.find(number)) return page(storey, search.leaves[*known]);
  std::optional<Error> damage;
  std::vector<Search::Pending> damaged;  // which are tried again the next time
  while (!search.pending.empty()) {
    const Search::Pending next = search.pending.back();
    search.pending.pop_back();
    const auto page = expand(storey, next);
    if (page) {
      if (!numbers.find(number)) continue;
      search.pending.insert(search.pending.begin(), damaged.begin(), damaged.end());
      keep(*page);
      return page;
    }
    damaged.push_back(next);
    if (!damage) damage = page.error();
    if (page.error().kind != ErrorKind::malformed) break;  // so would be the others
  }
  search.pending.insert(search.pending.begin(), damaged.begin(), damaged.end());
  if (damage) return tl::unexpected(*damage);
  return index_.malformed(fmt::format("its pages lack {} {} of storey {}",
                                      thing == WalkThing::region ? "region" : "camera", number, storey));
}

}  // namespace acentric
