#include "engine/inspect/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace acentric {
namespace {

/// Sizes of the refinement differ by this share.
constexpr double kFineStep = 0.01;

double extentOf(const Outline& outline) {
  glm::dvec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const auto& loop : outline.loops)
    for (const glm::dvec2& p : loop) low = glm::min(low, p), high = glm::max(high, p);
  return outline.empty() ? 0 : std::max(high.x - low.x, high.y - low.y);
}

/// Whole millimetres, and finer below a metre's size: what a person would choose.
double roundNumber(double metres) {
  const double perStep = std::max(1e3, std::pow(10, 3 - std::floor(std::log10(metres))));
  return std::clamp(std::round(perStep * metres) / perStep, kLeastCellSize, kLargestCellSize);
}

/// Turning a lattice about a ring's centre by this angle gives the same lattice.
double symmetryOf(const LayoutSpec& spec) {
  switch (cellPolygon(spec, CellId{}).size()) {
    case 3:
      return kTwoPi / 3;
    case 4:
    case 8:
      return kTwoPi / 4;
    default:
      return kTwoPi / 6;
  }
}

struct Candidate {
  FitPoint point;
  LayoutSpec spec;
  RegionBudgets budgets;
};

class Fitter {
 public:
  Fitter(const LayoutSpec& spec, const TriangleTree& tree, const FitOptions& options, TaskRunner& runner,
         const Progress& progress, std::stop_token stop)
      : base_(spec), tree_(tree), options_(options), runner_(runner), progress_(progress), stop_(stop) {
    base_.forgetCells();
    symmetry_ = symmetryOf(base_);
    total_ = options.sizes;
  }

  Result<FitResult> run() {
    const double largest = options_.largestCell > 0
                               ? options_.largestCell
                               : std::clamp(extentOf(base_.outline), options_.leastCell, kLargestCellSize);
    const double ratio = std::pow(options_.leastCell / largest, 1.0 / (options_.sizes - 1));
    std::optional<double> failed;  // the smallest size that did not fit before one did
    for (int n = 0; n < options_.sizes; ++n) {
      const double size =
          n + 1 == options_.sizes ? options_.leastCell : roundNumber(largest * std::pow(ratio, n));
      const bool fitted = result_.satisfied;
      const auto candidate = trySize(size);
      if (!candidate && candidate.error().kind == ErrorKind::tooLarge && !result_.curve.empty()) break;
      if (!candidate) return tl::unexpected(candidate.error());
      take(*candidate);
      if (!result_.satisfied) failed = size;
      if (!fitted && result_.satisfied && failed)
        if (auto refined = refine(*failed, size); !refined) return tl::unexpected(refined.error());
    }
    std::ranges::stable_sort(result_.curve, std::greater{}, &FitPoint::cellSize);
    result_.leastTried = result_.curve.back().cellSize;
    result_.over = result_.budgets.over(options_.mostTriangles);
    return std::move(result_);
  }

 private:
  /// Sizes between one that fits and the next larger on the ladder, which does not: from above, until one
  /// fits.
  Status refine(double failed, double fits) {
    std::vector<double> sizes;
    for (double size = failed * (1 - kFineStep); size > fits * (1 + 0.5 * kFineStep); size *= 1 - kFineStep)
      sizes.push_back(roundNumber(size));
    total_ += double(sizes.size());
    for (std::size_t n = 0; n < sizes.size(); ++n) {
      const auto candidate = trySize(sizes[n]);
      if (!candidate) return tl::unexpected(candidate.error());
      take(*candidate);
      if (candidate->point.over > 0) continue;
      total_ -= double(sizes.size() - n - 1);
      break;
    }
    return {};
  }

  /// The first that fits wins, being the largest; else the one with the least worst region. Within the
  /// refinement sizes fall towards the one that is held, so a fitting one is larger.
  void take(const Candidate& candidate) {
    result_.curve.push_back(candidate.point);
    const bool fits = candidate.point.over == 0;
    const bool better = fits ? !result_.satisfied || candidate.point.cellSize > result_.spec.cellSize
                             : !result_.satisfied && (result_.curve.size() == 1 ||
                                                      candidate.budgets.worst() < result_.budgets.worst());
    if (!better) return;
    result_.satisfied = fits;
    result_.spec = candidate.spec;
    result_.budgets = candidate.budgets;
  }

  Result<Candidate> trySize(double cellSize) {
    std::optional<Candidate> best;
    const int places = options_.origins * options_.origins;
    for (int turn = 0; turn < options_.rotations; ++turn)
      for (int place = 0; place < places; ++place) {
        LayoutSpec spec = base_;
        spec.cellSize = cellSize;
        spec.rotationRadians += symmetry_ * turn / options_.rotations;
        // Over twice the edge: about a lattice's period.
        spec.latticeOrigin +=
            2 * cellSize / options_.origins * glm::dvec2(place % options_.origins, place / options_.origins);
        auto candidate = measure(spec);
        if (!candidate) return candidate;
        const auto rank = [](const FitPoint& p) { return std::tuple(p.worst, p.over, p.cameras); };
        if (!best || rank(candidate->point) < rank(best->point)) best = std::move(*candidate);
        done_ += 1.0 / (options_.rotations * places);
        if (progress_) progress_({done_, total_, fmt::format("cells of {:.2f} m", cellSize)});
      }
    return std::move(*best);
  }

  Result<Candidate> measure(const LayoutSpec& spec) {
    const auto layout = buildLayout(spec);
    if (!layout) return tl::unexpected(layout.error());
    auto budgets = countRegions(tree_, *layout, runner_, {}, stop_);
    if (!budgets) return tl::unexpected(budgets.error());
    Candidate candidate{{}, spec, std::move(*budgets)};
    candidate.point = {spec.cellSize,
                       spec.rotationRadians,
                       spec.latticeOrigin,
                       candidate.budgets.worst(),
                       candidate.budgets.median(),
                       candidate.budgets.over(options_.mostTriangles).size(),
                       layout->regions.size(),
                       layout->cameras.size()};
    return candidate;
  }

  LayoutSpec base_;
  const TriangleTree& tree_;
  const FitOptions& options_;
  TaskRunner& runner_;
  const Progress& progress_;
  std::stop_token stop_;
  double symmetry_ = 0, done_ = 0, total_ = 0;
  FitResult result_;
};

}  // namespace

Status FitOptions::check() const {
  const auto refuse = [](std::string message) {
    return fail(ErrorKind::invalidArgument, std::move(message));
  };
  if (mostTriangles == 0) return refuse("the budget must be at least one triangle per region");
  if (!(leastCell >= kLeastCellSize && leastCell <= kLargestCellSize))
    return refuse(fmt::format("the smallest cell must be {:g} to {:g} m, not {:g}", kLeastCellSize,
                              kLargestCellSize, leastCell));
  if (largestCell != 0 && !(largestCell >= leastCell && largestCell <= kLargestCellSize))
    return refuse(fmt::format("the largest cell must be {:g} to {:g} m, not {:g}", leastCell,
                              kLargestCellSize, largestCell));
  if (sizes < 2 || sizes > 200) return refuse(fmt::format("2 to 200 sizes can be tried, not {}", sizes));
  if (rotations < 1 || rotations > 90)
    return refuse(fmt::format("1 to 90 rotations can be tried, not {}", rotations));
  if (origins < 1 || origins > 16)
    return refuse(fmt::format("1 to 16 origins along an axis can be tried, not {}", origins));
  return {};
}

Result<FitResult> fitToBudget(const LayoutSpec& spec, const TriangleTree& tree, const FitOptions& options,
                              TaskRunner& runner, const Progress& progress, std::stop_token stop) {
  if (auto sound = options.check(); !sound) return tl::unexpected(sound.error());
  if (spec.outline.empty())
    return fail(ErrorKind::invalidArgument, "there is no walkable outline to lay cells over: draw one first");
  auto result = Fitter(spec, tree, options, runner, progress, stop).run();
  if (result)
    result->droppedEdits = spec.added.size() + spec.removed.size() + spec.split.size() + spec.density.size();
  return result;
}

}  // namespace acentric
