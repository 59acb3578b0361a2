#include "engine/image/patch_order.h"

#include <algorithm>
#include <queue>

namespace acentric {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;
/// Of large rings so large a part is taken out at once, before they are looked at again.
constexpr std::size_t kPartOfRing = 24;

class Orderer {
 public:
  Orderer(const std::vector<PatchPair>& pairs, const std::vector<float>& nearest, bool nearestFirst)
      : nearest_(nearest),
        nearestFirst_(nearestFirst),
        start_(nearest.size() + 1, 0),
        after_(pairs.size()),
        group_(nearest.size(), 0),
        ring_(nearest.size(), kNone),
        visit_(nearest.size()) {
    for (const PatchPair& pair : pairs) ++start_[pair.first + 1];
    for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (const PatchPair& pair : pairs) after_[next[pair.first]++] = {pair.second, pair.weight};
  }

  std::vector<std::uint32_t> run() {
    std::vector<std::uint32_t> all(nearest_.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    pending_.push_back({std::move(all), false});
    while (!pending_.empty()) {
      Pending next = std::move(pending_.back());
      pending_.pop_back();
      if (next.patches.size() == 1)
        order_.push_back(next.patches.front());
      else if (next.isRing)
        breakRing(std::move(next.patches));
      else
        split(next.patches);
    }
    return std::move(order_);
  }

 private:
  struct After {
    std::uint32_t patch = 0;
    int weight = 0;
  };
  /// To be ordered, before all that were pending already.
  struct Pending {
    std::vector<std::uint32_t> patches;
    bool isRing = false;  ///< each may hide each other, by way of others
  };
  struct Visit {
    std::uint32_t number = 0, lowest = 0;  ///< Tarjan's
    std::size_t next = 0;                  ///< into after_
  };

  template <class Each>
  void forAfter(std::uint32_t patch, const Each& each) const {
    for (std::size_t i = start_[patch]; i < start_[patch + 1]; ++i) each(after_[i]);
  }

  /// Into rings and single patches, in an order that all pairs between them keep.
  void split(const std::vector<std::uint32_t>& patches) {
    ++groups_;
    for (const std::uint32_t patch : patches)
      group_[patch] = groups_, visit_[patch] = {}, ring_[patch] = kNone;
    std::vector<std::vector<std::uint32_t>> rings;
    std::uint32_t visited = 0;
    for (const std::uint32_t patch : patches)
      if (visit_[patch].number == 0) findRings(patch, visited, rings);
    std::vector<std::uint32_t> hidden(rings.size(), 0);
    std::vector<float> nearest(rings.size(), 0);
    const auto forPairsOf = [&](std::uint32_t ring, const auto& each) {
      for (const std::uint32_t patch : rings[ring])
        forAfter(patch, [&](const After& after) {
          if (group_[after.patch] == groups_ && ring_[after.patch] != ring) each(ring_[after.patch]);
        });
    };
    for (std::uint32_t ring = 0; ring < rings.size(); ++ring) {
      for (const std::uint32_t patch : rings[ring]) nearest[ring] = std::max(nearest[ring], nearest_[patch]);
      forPairsOf(ring, [&](std::uint32_t other) { ++hidden[other]; });
    }
    const auto farther = [&](std::uint32_t a, std::uint32_t b) {
      return nearest[a] != nearest[b] ? nearest[a] < nearest[b] : rings[a].front() > rings[b].front();
    };
    std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, decltype(farther)> free(farther);
    for (std::uint32_t ring = 0; ring < rings.size(); ++ring)
      if (hidden[ring] == 0) free.push(ring);
    std::vector<std::uint32_t> order;
    while (!free.empty()) {
      const std::uint32_t ring = free.top();
      free.pop();
      order.push_back(ring);
      forPairsOf(ring, [&](std::uint32_t other) {
        if (--hidden[other] == 0) free.push(other);
      });
    }
    for (auto ring = order.rbegin(); ring != order.rend(); ++ring)
      pending_.push_back({std::move(rings[*ring]), true});
  }

  /// Strongly connected components (Tarjan 1972) of what is reached from a patch.
  void findRings(std::uint32_t from, std::uint32_t& visited, std::vector<std::vector<std::uint32_t>>& rings) {
    const auto enter = [&](std::uint32_t patch) {
      visit_[patch] = {++visited, visited, start_[patch]};
      open_.push_back(patch), path_.push_back(patch);
    };
    enter(from);
    while (!path_.empty()) {
      const std::uint32_t patch = path_.back();
      Visit& visit = visit_[patch];
      if (visit.next < start_[patch + 1]) {
        const std::uint32_t after = after_[visit.next++].patch;
        if (group_[after] != groups_ || ring_[after] != kNone) continue;
        if (visit_[after].number == 0)
          enter(after);
        else
          visit.lowest = std::min(visit.lowest, visit_[after].number);
        continue;
      }
      path_.pop_back();
      if (!path_.empty()) visit_[path_.back()].lowest = std::min(visit_[path_.back()].lowest, visit.lowest);
      if (visit.lowest != visit.number) continue;
      std::vector<std::uint32_t>& ring = rings.emplace_back();
      while (ring.empty() || ring.back() != patch) {
        ring.push_back(open_.back());
        ring_[open_.back()] = std::uint32_t(rings.size() - 1);
        open_.pop_back();
      }
      std::ranges::sort(ring);
    }
  }

  /// Some of the ring go first, the others are split anew.
  void breakRing(std::vector<std::uint32_t> patches) {
    ++groups_;
    for (const std::uint32_t patch : patches) group_[patch] = groups_;
    std::vector<std::int64_t> hides(patches.size(), 0), hidden(patches.size(), 0);
    const auto placeOf = [&](std::uint32_t patch) {
      return std::size_t(std::ranges::lower_bound(patches, patch) - patches.begin());
    };
    if (!nearestFirst_)
      for (std::size_t i = 0; i < patches.size(); ++i)
        forAfter(patches[i], [&](const After& after) {
          if (group_[after.patch] != groups_) return;
          hides[i] += after.weight, hidden[placeOf(after.patch)] += after.weight;
        });
    const auto goesBefore = [&](std::size_t a, std::size_t b) {
      if (nearestFirst_) return nearest_[patches[a]] > nearest_[patches[b]];
      return double(hidden[a]) * double(hides[b]) < double(hidden[b]) * double(hides[a]);
    };
    std::vector<std::size_t> places(patches.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = i;
    const std::size_t count = std::max<std::size_t>(1, patches.size() / kPartOfRing);
    std::ranges::stable_sort(places, goesBefore);
    Pending rest;
    for (std::size_t i = 0; i < places.size(); ++i)
      (i < count ? order_ : rest.patches).push_back(patches[places[i]]);
    std::ranges::sort(rest.patches);
    pending_.push_back(std::move(rest));
  }

  const std::vector<float>& nearest_;
  bool nearestFirst_;
  std::vector<std::size_t> start_;  ///< of each patch's, into after_
  std::vector<After> after_;
  std::vector<std::uint32_t> group_;  ///< of each patch: the last that it was looked at with
  std::uint32_t groups_ = 0;
  std::vector<std::uint32_t> ring_;  ///< of the group
  std::vector<Visit> visit_;
  std::vector<std::uint32_t> open_, path_;
  std::vector<Pending> pending_;
  std::vector<std::uint32_t> order_;
};

}  // namespace

PatchOrder orderPatches(const std::vector<PatchPair>& pairs, const std::vector<float>& nearest,
                        bool nearestFirst) {
  PatchOrder order{Orderer(pairs, nearest, nearestFirst).run(), 0};
  std::vector<std::uint32_t> place(nearest.size());
  for (std::uint32_t i = 0; i < order.patches.size(); ++i) place[order.patches[i]] = i;
  order.broken = std::size_t(
      std::ranges::count_if(pairs, [&](const PatchPair& p) { return place[p.first] > place[p.second]; }));
  return order;
}

}  // namespace acentric
