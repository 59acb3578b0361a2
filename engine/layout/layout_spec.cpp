#include "engine/layout/layout_spec.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/base/contract.h"
#include "engine/geometry/conventions.h"
#include "engine/layout/lattice.h"
#include "engine/layout/region_limit.h"

namespace acentric {
namespace {

constexpr double kMaxCoordinate = 1e7;  // metres: map coordinates, with room for a micrometre in a double
constexpr std::size_t kMaxOutlinePoints = 4096;

struct Entry {
  Configuration configuration;
  const char* name;
  const char* description;
};
constexpr Entry kEntries[] = {
    {Configuration::a, "a", "45° cameras, octagons and squares (4.8.8)"},
    {Configuration::b, "b", "60° cameras, hexagons and triangles (3.6.3.6)"},
    {Configuration::c, "c", "60° cameras, hexagons (6.6.6)"},
    {Configuration::d, "d", "90° cameras, squares in a checkerboard"},
    {Configuration::e, "e", "90° cameras, squares (a full panorama at each corner)"},
    {Configuration::f, "f", "120° cameras, triangles and hexagons (3.6.3.6)"},
    {Configuration::g, "g", "120° cameras, triangles (a full panorama at each corner)"},
};

tl::unexpected<Error> refuse(std::string message) {
  return fail(ErrorKind::invalidArgument, std::move(message), "layout");
}

Status checkRange(const char* what, double value, double low, double high) {
  if (std::isfinite(value) && value >= low && value <= high) return {};
  return refuse(fmt::format("{} is {}; it must lie in {}..{}", what, value, low, high));
}

std::string describe(const CellId& id) {
  return id.level == 0 ? fmt::format("({}, {}, {})", id.i, id.j, id.slot)
                       : fmt::format("({}, {}, {}, level {})", id.i, id.j, id.slot, id.level);
}

Status checkCells(const char* what, const std::set<CellId>& cells, const LayoutSpec& spec,
                  const Lattice& lattice, bool needsParent) {
  const Configuration configuration = spec.configuration;
  for (const CellId& id : cells) {
    const bool far =
        std::abs(std::int64_t(id.i)) > kMaxCellIndex || std::abs(std::int64_t(id.j)) > kMaxCellIndex;
    const bool level = id.level == 0 || (canSplit(configuration) && id.level > 0 && id.level <= kMaxLevel);
    if (far || !level || id.slot < 0 || id.slot >= lattice.slots())
      return refuse(fmt::format("the {} region {} does not exist in configuration {}; take it off the list",
                                what, describe(id), nameOf(configuration)));
    for (const glm::dvec2& corner : lattice.polygonOf(id).corners)
      if (!(std::abs(corner.x) <= 2 * kMaxCoordinate && std::abs(corner.y) <= 2 * kMaxCoordinate))
        return refuse(fmt::format("the {} region {} lies farther than {} m out; take it off the list", what,
                                  describe(id), 2 * kMaxCoordinate));
    // Regions of different sizes must not overlap.
    if (id.level > 0 && needsParent && !spec.split.contains(lattice.parentOf(id)))
      return refuse(
          fmt::format("the {} region {} is part of {}, which is not split; split that, or take this "
                      "off the list",
                      what, describe(id), describe(lattice.parentOf(id))));
  }
  return {};
}

Status checkSlope(const std::optional<GroundSlope>& slope) {
  if (!slope) return {};
  for (const Status& status :
       {checkRange("the x in metres where the slope has the floor's height", slope->at.x, -kMaxCoordinate,
                   kMaxCoordinate),
        checkRange("the y in metres where the slope has the floor's height", slope->at.y, -kMaxCoordinate,
                   kMaxCoordinate),
        checkRange("the slope's rise in metres per metre", glm::length(slope->rise), 0, kSteepestGround)})
    if (!status) return status;
  return {};
}

Status checkDensity(const LayoutSpec& spec, const Lattice& lattice) {
  if (spec.density.size() > std::size_t(kMaxRegions))
    return refuse(fmt::format("{} regions have a density of their own; at most {} can", spec.density.size(),
                              kMaxRegions));
  std::set<CellId> cells;
  for (const auto& [id, density] : spec.density) {
    if (Status status = checkRange(fmt::format("the density of the region {}", describe(id)).c_str(), density,
                                   kLeastRegionDensity, kMostRegionDensity);
        !status)
      return status;
    if (id.slot != kFreeSlot)
      cells.insert(id);
    else if (!spec.freeApvs.contains(id.i))
      return refuse(fmt::format("free APV {} has a density, but there is none of that number", id.i));
  }
  return checkCells("differently sampled", cells, spec, lattice, false);
}

Status checkFreeApvs(const LayoutSpec& spec) {
  if (spec.freeApvs.size() > std::size_t(kMaxFreeApvs))
    return refuse(fmt::format("{} free APVs, at most {} can be", spec.freeApvs.size(), kMaxFreeApvs));
  for (const auto& [number, apv] : spec.freeApvs) {
    if (Status status = apv.check(); !status)
      return refuse(fmt::format("free APV {}: {}", number, status.error().message));
    if (!(std::abs(apv.centre.x) <= kMaxCoordinate && std::abs(apv.centre.y) <= kMaxCoordinate))
      return refuse(fmt::format("free APV {} lies farther than {} m out", number, kMaxCoordinate));
    const double radius = glm::length(apv.offset);
    if (!apv.traditional() && !(radius >= kLeastCellSize && radius <= kLargestCellSize))
      return refuse(
          fmt::format("free APV {} has an offset of {} m; it must be 0 (a traditional panorama) or "
                      "lie in {}..{}",
                      number, radius, kLeastCellSize, kLargestCellSize));
  }
  return {};
}

}  // namespace

const char* nameOf(Configuration configuration) {
  for (const Entry& entry : kEntries)
    if (entry.configuration == configuration) return entry.name;
  return "?";
}

const char* describe(Configuration configuration) {
  for (const Entry& entry : kEntries)
    if (entry.configuration == configuration) return entry.description;
  return "unknown";
}

Result<Configuration> parseConfiguration(std::string_view name) {
  for (const Entry& entry : kEntries)
    if (name == entry.name) return entry.configuration;
  return refuse(
      fmt::format("there is no configuration '{}'; choose one of a, b, c, d, e, f, g", name.substr(0, 40)));
}

bool canSplit(Configuration configuration) {
  const LatticeTable* table = latticeTable(configuration);
  return table != nullptr && table->splits();
}

Status checkOutline(const Outline& outline) {
  std::size_t points = 0;
  for (std::size_t l = 0; l < outline.loops.size(); ++l) {
    const auto& loop = outline.loops[l];
    if (loop.size() < 3)
      return refuse(fmt::format("outline loop {} has {} points; it needs at least 3", l + 1, loop.size()));
    for (const glm::dvec2& point : loop)
      if (!(std::abs(point.x) <= kMaxCoordinate && std::abs(point.y) <= kMaxCoordinate))
        return refuse(fmt::format("outline loop {} has the point ({}, {}); coordinates must lie within {} m",
                                  l + 1, point.x, point.y, kMaxCoordinate));
    points += loop.size();
  }
  if (points > kMaxOutlinePoints)
    return refuse(
        fmt::format("the outline has {} points, more than {}; simplify it", points, kMaxOutlinePoints));
  return {};
}

void LayoutSpec::forgetCells() {
  added.clear(), removed.clear(), split.clear();
  std::erase_if(density, [](const auto& each) { return each.first.slot != kFreeSlot; });
}

Status LayoutSpec::check() const {
  if (std::string_view(nameOf(configuration)) == "?") return refuse("the configuration is not one of a to g");
  for (const Status& status :
       {checkRange("the cell size in metres", cellSize, kLeastCellSize, kLargestCellSize),
        checkRange("the lattice origin's x in metres", latticeOrigin.x, -kMaxCoordinate, kMaxCoordinate),
        checkRange("the lattice origin's y in metres", latticeOrigin.y, -kMaxCoordinate, kMaxCoordinate),
        checkRange("the rotation in radians", rotationRadians, -1000, 1000),
        checkRange("the floor height in metres", floorHeight, -kMaxCoordinate, kMaxCoordinate),
        checkRange("the eye height in metres", eyeHeight, 1e-5, 1e5),
        checkRange("the near band in metres", nearBand, 0, 1e5), checkOutline(outline), checkSlope(slope)})
    if (!status) return status;
  const std::optional<Lattice> lattice = Lattice::of(*this);
  require(lattice.has_value(), "a named configuration has a lattice");
  if (!split.empty() && !canSplit(configuration))
    return refuse(fmt::format("regions of configuration {} cannot be split; only those of e and g can",
                              nameOf(configuration)));
  for (const Status& status : {checkCells("added", added, *this, *lattice, true),
                               checkCells("removed", removed, *this, *lattice, false),
                               checkCells("split", split, *this, *lattice, true), checkFreeApvs(*this),
                               checkDensity(*this, *lattice)})
    if (!status) return status;
  for (const CellId& id : split)
    if (id.level >= kMaxLevel)
      return refuse(fmt::format("the region {} is split once more than {} times", describe(id), kMaxLevel));
  if (split.size() > std::size_t(kMaxRegions))
    return refuse(fmt::format("{} regions are split; at most {} can be", split.size(), kMaxRegions));
  if (added.size() > std::size_t(kMaxRegions) || removed.size() > std::size_t(kMaxRegions))
    return refuse(fmt::format(
        "{} regions are added and {} removed one by one; at most {} of each can be. Edit the outline instead",
        added.size(), removed.size(), kMaxRegions));
  // By area, without counting: buildLayout counts exactly, and refuses what this just lets through.
  const double byArea = outline.area() / lattice->meanRegionArea() - double(removed.size());
  if (byArea > 1.1 * kMaxRegions) return tooManyRegions(byArea, cellSize);
  return {};
}

void LayoutSpec::addTo(Hasher& hasher) const {
  hasher.value(configuration)
      .value(cellSize)
      .value(latticeOrigin.x)
      .value(latticeOrigin.y)
      .value(rotationRadians);
  hasher.value(floorHeight).value(eyeHeight).value(nearBand);
  hasher.value(std::uint64_t(outline.loops.size()));
  for (const auto& loop : outline.loops) {
    hasher.value(std::uint64_t(loop.size()));
    for (const glm::dvec2& point : loop) hasher.value(point.x).value(point.y);
  }
  for (const auto* cells : {&added, &removed, &split}) {
    hasher.value(std::uint64_t(cells->size()));
    for (const CellId& id : *cells) hasher.value(id.i).value(id.j).value(id.slot).value(id.level);
  }
  hasher.value(std::uint64_t(freeApvs.size()));
  for (const auto& [number, apv] : freeApvs) {
    hasher.value(number).value(apv.centre.x).value(apv.centre.y).value(apv.offset.x).value(apv.offset.y);
    hasher.value(apv.fovDegrees).value(apv.hand);
  }
  for (const auto& [id, factor] : density)
    hasher.value(id.i).value(id.j).value(id.slot).value(id.level).value(factor);
  if (slope) hasher.value(slope->at.x).value(slope->at.y).value(slope->rise.x).value(slope->rise.y);
}

}  // namespace acentric
