#include "editor/commands/group_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "editor/commands/layout_edits.h"
#include "engine/base/contract.h"
#include "engine/layout/density.h"
#include "engine/layout/placement.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

Lattice latticeOf(const LayoutSpec& spec) {
  auto lattice = Lattice::of(spec);
  require(lattice.has_value(), "a project's configuration has a lattice");
  return *std::move(lattice);
}

}  // namespace

CellGroup::CellGroup(const LayoutSpec& spec, const std::set<CellId>& cells)
    : spec_(spec), lattice_(latticeOf(spec)), level_(kMaxLevel) {
  for (const CellId& cell : cells)
    if (cell.slot == kFreeSlot) {
      if (spec.freeApvs.contains(cell.i)) apvs_.push_back(cell.i);
    } else if (isPlaced(spec, lattice_, cell)) {
      cells_.insert(cell);
      level_ = std::min(level_, cell.level);
    }
  if (cells_.empty()) level_ = 0;
  const auto centre = [&](int i, int j) { return lattice_.polygonOf({i, j, 0, level_}).centroid(); };
  stepI_ = centre(1, 0) - centre(0, 0);
  stepJ_ = centre(0, 1) - centre(0, 0);
}

glm::dvec2 CellGroup::metresOf(const LatticeStep& step) const {
  return double(step.i) * stepI_ + double(step.j) * stepJ_;
}

LatticeStep CellGroup::nearestStep(const glm::dvec2& metres) const {
  const glm::dvec2 at = glm::inverse(glm::dmat2(stepI_, stepJ_)) * metres;
  const LatticeStep middle{int(std::lround(at.x)), int(std::lround(at.y))};
  LatticeStep best = middle;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) {
      const LatticeStep step{middle.i + i, middle.j + j};
      if (glm::distance(metresOf(step), metres) < glm::distance(metresOf(best), metres)) best = step;
    }
  return best;
}

LatticeStep CellGroup::stepTowards(const glm::dvec2& direction) const {
  constexpr double kAlike = 1e-9;
  const glm::dvec2 right(direction.y, -direction.x);
  LatticeStep best{1, 0};
  double bestAhead = -2, bestRight = 0;
  for (const LatticeStep step :
       {LatticeStep{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, -1}, {-1, 1}, {1, 1}, {-1, -1}}) {
    const glm::dvec2 way = metresOf(step);
    // Diagonals of square lattices are no neighbours.
    if (glm::length(way) > 1.01 * std::max(glm::length(stepI_), glm::length(stepJ_))) continue;
    const double ahead = glm::dot(glm::normalize(way), direction), side = glm::dot(way, right);
    if (ahead < bestAhead - kAlike || (ahead < bestAhead + kAlike && side <= bestRight)) continue;
    best = step, bestAhead = ahead, bestRight = side;
  }
  return best;
}

CellId CellGroup::shifted(const CellId& cell, const LatticeStep& step) const {
  const int scale = 1 << (cell.level - level_);
  return {cell.i + scale * step.i, cell.j + scale * step.j, cell.slot, cell.level};
}

bool CellGroup::blocked(const CellId& to, bool leaving) const {
  if (leaving && cells_.contains(to)) return false;
  if (to.level > 0 && !spec_.split.contains(lattice_.parentOf(to))) return true;
  return spec_.split.contains(to) || isPlaced(spec_, lattice_, to);
}

std::vector<CellGroup::Landing> CellGroup::landings(const LatticeStep& step, bool leaving) const {
  std::vector<Landing> landings;
  landings.reserve(cells_.size());
  for (const CellId& cell : cells_) {
    const CellId to = shifted(cell, step);
    landings.push_back({cell, to, blocked(to, leaving)});
  }
  return landings;
}

bool CellGroup::fits(const LatticeStep& step, bool leaving) const {
  return std::ranges::none_of(cells_,
                              [&](const CellId& cell) { return blocked(shifted(cell, step), leaving); });
}

std::optional<LatticeStep> CellGroup::nearestFreeStep() const {
  if (cells_.empty()) return apvs_.empty() ? std::nullopt : std::optional(LatticeStep{1, 0});
  constexpr int kFarthest = 400;
  // Ring by ring: what lies on later rings is farther than `reach` times their number.
  const double area = std::abs(stepI_.x * stepJ_.y - stepI_.y * stepJ_.x);
  const double reach = area / std::max(glm::length(stepI_), glm::length(stepJ_));
  std::optional<LatticeStep> best;
  double nearest = 0;
  for (int ring = 1; ring <= kFarthest && (!best || ring * reach < nearest); ++ring)
    for (int i = -ring; i <= ring; ++i)
      for (int j = -ring; j <= ring; j += std::abs(i) == ring ? 1 : 2 * ring) {
        // To the right and up first, where several are as near.
        const LatticeStep step{-i, -j};
        const double distance = glm::length(metresOf(step));
        if ((best && distance >= nearest * (1 - 1e-9)) || !fits(step, false)) continue;
        best = step, nearest = distance;
      }
  return best;
}

/// What the edits need of a group.
struct GroupEditing {
  static int copyInto(const CellGroup& group, LayoutSpec& spec, const LatticeStep& step,
                      std::set<CellId>& placed) {
    int skipped = 0;
    for (const CellId& cell : group.cells_) {
      const CellId to = group.shifted(cell, step);
      if (group.blocked(to, false)) {
        ++skipped;
        continue;
      }
      placeCell(spec, to);
      giveDensity(spec, to, densityOf(group.spec_, cell));
      placed.insert(to);
    }
    for (const int number : group.apvs_) {
      Apv apv = group.spec_.freeApvs.at(number);
      apv.centre += group.metresOf(step);
      const int copy = nextFreeNumber(spec);
      spec.freeApvs[copy] = apv;
      giveDensity(spec, {copy, 0, kFreeSlot}, densityOf(group.spec_, {number, 0, kFreeSlot}));
      placed.insert({copy, 0, kFreeSlot});
    }
    return skipped;
  }

  static std::set<CellId> move(const CellGroup& group, LayoutSpec& spec, const LatticeStep& step) {
    std::set<CellId> placed;
    for (const CellId& cell : group.cells_) takeCell(spec, cell), spec.density.erase(cell);
    for (const CellId& cell : group.cells_) {
      const CellId to = group.shifted(cell, step);
      placeCell(spec, to);
      giveDensity(spec, to, densityOf(group.spec_, cell));
      placed.insert(to);
    }
    for (const int number : group.apvs_) {
      spec.freeApvs[number].centre += group.metresOf(step);
      placed.insert({number, 0, kFreeSlot});
    }
    return placed;
  }
};

GroupEdit moveCells(const Project& project, const std::set<CellId>& cells, const LatticeStep& step) {
  const CellGroup group(project.layout(), cells);
  GroupEdit result{{project, trfMany("Move cell", "Move {} cells", cells.size(), cells.size())}, cells};
  if (step == LatticeStep{} || group.empty()) return result;
  for (const CellGroup::Landing& landing : group.landings(step, true))
    result.skipped += landing.blocked ? 1 : 0;
  if (result.skipped == 0) result.cells = GroupEditing::move(group, result.edit.project.layout(), step);
  return result;
}

GroupEdit copyCells(const Project& project, const std::set<CellId>& cells,
                    const std::vector<LatticeStep>& steps) {
  const CellGroup group(project.layout(), cells);
  GroupEdit result{{project, trfMany("Copy cell", "Copy {} cells", cells.size(), cells.size())}, {}};
  if (steps.size() > 1) result.edit.label = trf("{} {} times", result.edit.label, steps.size());
  std::set<CellId> placed;
  for (const LatticeStep& step : steps)
    result.skipped += GroupEditing::copyInto(group, result.edit.project.layout(), step, placed);
  result.cells = std::move(placed);
  return result;
}

std::vector<LatticeStep> CellArray::steps() const {
  std::vector<LatticeStep> steps;
  for (int j = 0; j < countJ; ++j)
    for (int i = 0; i < countI; ++i)
      if (i != 0 || j != 0) steps.push_back({i * everyI, j * everyJ});
  return steps;
}

CellArray roomyArray(const LayoutSpec& spec, const std::set<CellId>& cells) {
  CellArray array;
  const CellGroup group(spec, cells);
  const auto spacing = [&](bool alongI) {
    for (int every = 1; every < 1000; ++every) {
      const LatticeStep step = alongI ? LatticeStep{every, 0} : LatticeStep{0, every};
      const auto landings = group.landings(step, false);
      if (std::ranges::none_of(landings,
                               [&](const CellGroup::Landing& landing) { return cells.contains(landing.to); }))
        return every;
    }
    return 1;
  };
  array.everyI = spacing(true);
  array.everyJ = spacing(false);
  return array;
}

}  // namespace acentric::editor
