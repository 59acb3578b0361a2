#include "engine/inspect/refine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "engine/base/contract.h"
#include "engine/layout/lattice.h"
#include "engine/layout/placement.h"

namespace acentric {
namespace {

class Refiner {
 public:
  Refiner(const LayoutSpec& spec, const Lattice& lattice, const TriangleTree& tree,
          const RefineOptions& options, TaskRunner& runner, const Progress& progress, std::stop_token stop)
      : spec_(spec),
        lattice_(lattice),
        tree_(tree),
        options_(options),
        runner_(runner),
        progress_(progress),
        stop_(stop) {}

  Result<RefineResult> run() {
    Result<Layout> layout = buildLayout(spec_);
    if (!layout) return tl::unexpected(layout.error());
    const auto before = budgetsOf(*layout);
    if (!before) return tl::unexpected(before.error());
    RefineResult result;
    result.regionsBefore = layout->regions.size();
    result.worstBefore = before->worst();
    result.overBefore = before->over(options_.mostTriangles).size();
    if (options_.merge)
      if (auto done = mergeAll(); !done) return tl::unexpected(done.error());
    result.merged = merged_;
    if (auto done = splitAll(); !done) return tl::unexpected(done.error());
    takeBackWhatDoesNotHelp();
    result.split = made_.size();

    layout = buildLayout(spec_);
    if (!layout) return tl::unexpected(layout.error());
    auto budgets = budgetsOf(*layout);
    if (!budgets) return tl::unexpected(budgets.error());
    result.budgets = std::move(*budgets);
    result.budgets.counted = counted_;
    for (const int r : result.budgets.over(options_.mostTriangles))
      result.over.push_back({r, whyOver(layout->regions[std::size_t(r)].id)});
    for (const Region& region : layout->regions) {
      const auto level = std::size_t(region.id.level);
      if (result.regionsPerLevel.size() <= level) result.regionsPerLevel.resize(level + 1);
      ++result.regionsPerLevel[level];
    }
    result.spec = std::move(spec_);
    return result;
  }

 private:
  bool fits(std::size_t triangles) const { return triangles <= options_.mostTriangles; }

  bool divisible(const CellId& id) const {
    const double part = std::ldexp(spec_.cellSize, -id.level - 1);
    return id.level < kMaxLevel && part >= options_.leastCell * (1 - 1e-9);
  }

  /// Counts those of the regions that are not known yet.
  Status learn(std::vector<Region> regions) {
    std::erase_if(regions, [&](const Region& region) { return known_.contains(region.id); });
    Layout layout;
    layout.regions = std::move(regions);
    const auto budgets = countRegions(tree_, layout, runner_, progress_, stop_);
    if (!budgets) return tl::unexpected(budgets.error());
    for (std::size_t n = 0; n < layout.regions.size(); ++n)
      known_[layout.regions[n].id] = budgets->triangles[n];
    counted_ += layout.regions.size();
    return {};
  }

  Status learn(const std::vector<CellId>& cells) {
    std::vector<Region> regions;
    for (const CellId& id : cells) {
      if (known_.contains(id)) continue;
      Region& region = regions.emplace_back();
      region.id = id;
      region.grown = lattice_.polygonOf(id).grown(spec_.nearBand);
    }
    return learn(std::move(regions));
  }

  Result<RegionBudgets> budgetsOf(const Layout& layout) {
    if (auto done = learn(layout.regions); !done) return tl::unexpected(done.error());
    RegionBudgets budgets;
    for (const Region& region : layout.regions) budgets.triangles.push_back(known_.at(region.id));
    return budgets;
  }

  Status mergeAll() {
    const auto byHand = [&](const CellId& id) {
      return spec_.added.contains(id) || spec_.removed.contains(id);
    };
    for (int level = kMaxLevel; level-- > 0;) {
      const auto placed = placedCells(spec_, lattice_);
      if (!placed) return tl::unexpected(placed.error());
      const auto isPlaced = [&](const CellId& id) { return std::ranges::binary_search(*placed, id); };
      std::vector<CellId> wholes;
      for (const CellId& id : spec_.split) {
        const auto parts = lattice_.childrenOf(id);
        const auto isSplit = [&](const CellId& part) { return spec_.split.contains(part); };
        if (id.level == level && std::ranges::any_of(parts, isPlaced) &&
            std::ranges::none_of(parts, isSplit) && std::ranges::none_of(parts, byHand))
          wholes.push_back(id);
      }
      if (auto done = learn(wholes); !done) return done;
      for (const CellId& id : wholes)
        if (fits(known_.at(id))) merged_ += spec_.split.erase(id);
    }
    return {};
  }

  Status splitAll() {
    for (;;) {
      const auto placed = placedCells(spec_, lattice_);
      if (!placed) return tl::unexpected(placed.error());
      if (auto done = learn(*placed); !done) return done;
      std::vector<CellId> excessive = *placed;
      std::erase_if(excessive, [&](const CellId& id) { return fits(known_.at(id)) || !divisible(id); });
      if (excessive.empty()) return {};
      tooMany_ = placed->size() + 3 * excessive.size() + spec_.freeApvs.size() > std::size_t(kMaxRegions) ||
                 spec_.split.size() + excessive.size() > std::size_t(kMaxRegions);
      if (tooMany_) return {};
      spec_.split.insert(excessive.begin(), excessive.end());
      made_.insert(excessive.begin(), excessive.end());
    }
  }

  /// From the smallest up: the worst region below each split that was made.
  void takeBackWhatDoesNotHelp() {
    std::vector<CellId> made(made_.begin(), made_.end());
    std::ranges::stable_sort(made, std::greater{}, &CellId::level);
    std::map<CellId, std::size_t> worstBelow;
    for (const CellId& id : made) {
      std::size_t worst = 0;
      bool any = false;
      for (const CellId& part : lattice_.childrenOf(id)) {
        const auto split = worstBelow.find(part);
        const auto whole = known_.find(part);
        if (whole == known_.end()) continue;  // beyond the outline
        any = true;
        worst = std::max(worst, split != worstBelow.end() ? split->second : whole->second);
      }
      const double enough = double(known_.at(id)) * (1 - options_.leastGain);
      if (any && (fits(worst) || double(worst) < enough)) {
        worstBelow[id] = worst;
        continue;
      }
      takeBack(id);
      noHelp_.insert(id);
    }
  }

  /// With all splits below it.
  void takeBack(const CellId& id) {
    if (made_.erase(id) == 0) return;
    spec_.split.erase(id);
    for (const CellId& part : lattice_.childrenOf(id)) takeBack(part);
  }

  WhyOver whyOver(const CellId& id) const {
    if (id.slot == kFreeSlot) return WhyOver::freeApv;
    if (noHelp_.contains(id)) return WhyOver::splitsNoHelp;
    return tooMany_ && divisible(id) ? WhyOver::tooMany : WhyOver::smallest;
  }

  LayoutSpec spec_;
  const Lattice& lattice_;
  const TriangleTree& tree_;
  const RefineOptions& options_;
  TaskRunner& runner_;
  const Progress& progress_;
  std::stop_token stop_;
  std::map<CellId, std::size_t> known_;
  std::set<CellId> made_, noHelp_;
  std::size_t counted_ = 0, merged_ = 0;
  bool tooMany_ = false;
};

}  // namespace

const char* describe(WhyOver why) {
  switch (why) {
    case WhyOver::smallest:
      return "its parts would be smaller than allowed";
    case WhyOver::splitsNoHelp:
      return "splitting it further does not lower its worst part";
    case WhyOver::freeApv:
      return "a free APV cannot be split";
    case WhyOver::tooMany:
      return "more splits would give too many regions";
  }
  return "";
}

Status RefineOptions::check() const {
  const auto refuse = [](std::string message) {
    return fail(ErrorKind::invalidArgument, std::move(message));
  };
  if (mostTriangles == 0) return refuse("the budget must be at least one triangle per region");
  if (!(leastCell >= kLeastCellSize && leastCell <= kLargestCellSize))
    return refuse(fmt::format("the smallest cell must be {:g} to {:g} m, not {:g}", kLeastCellSize,
                              kLargestCellSize, leastCell));
  if (!(leastGain >= 0 && leastGain <= 1))
    return refuse(fmt::format("the share that a split must gain must be 0 to 1, not {:g}", leastGain));
  return {};
}

Result<RefineResult> refineToBudget(const LayoutSpec& spec, const TriangleTree& tree,
                                    const RefineOptions& options, TaskRunner& runner,
                                    const Progress& progress, std::stop_token stop) {
  if (auto sound = options.check(); !sound) return tl::unexpected(sound.error());
  if (auto sound = spec.check(); !sound) return tl::unexpected(sound.error());
  if (!canSplit(spec.configuration))
    return fail(ErrorKind::invalidArgument,
                fmt::format("cells of configuration {} cannot be split, only those of e (squares) and g "
                            "(triangles): choose one of these, or fit the size of all cells",
                            nameOf(spec.configuration)));
  const std::optional<Lattice> lattice = Lattice::of(spec);
  require(lattice.has_value(), "a checked configuration has a lattice");
  return Refiner(spec, *lattice, tree, options, runner, progress, stop).run();
}

}  // namespace acentric
