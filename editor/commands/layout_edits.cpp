#include "editor/commands/layout_edits.h"

#include <fmt/format.h>

#include <limits>

#include "editor/commands/stored_angle.h"
#include "engine/geometry/conventions.h"
#include "ui/translate.h"

namespace acentric::editor {

void placeCell(LayoutSpec& spec, const CellId& cell) {
  spec.removed.erase(cell);
  if (!isPlaced(spec, cell)) spec.added.insert(cell);
}

void takeCell(LayoutSpec& spec, const CellId& cell) {
  if (cell.slot == kFreeSlot) {
    spec.freeApvs.erase(cell.i);
    spec.density.erase(cell);
    return;
  }
  spec.added.erase(cell);
  if (isPlaced(spec, cell)) spec.removed.insert(cell);
}

namespace {

/// Is a cell a part, of whatever size, of `whole`?
bool isPartOf(const LayoutSpec& spec, CellId cell, const CellId& whole) {
  while (cell.level > whole.level) cell = wholeOf(spec, cell);
  return cell == whole;
}

/// Forgets what was chosen within a cell.
void join(LayoutSpec& spec, const CellId& whole) {
  for (std::set<CellId>* cells : {&spec.added, &spec.removed, &spec.split})
    std::erase_if(
        *cells, [&](const CellId& cell) { return cell.level > whole.level && isPartOf(spec, cell, whole); });
  std::erase_if(spec.density, [&](const auto& each) {
    return each.first.level > whole.level && isPartOf(spec, each.first, whole);
  });
  spec.split.erase(whole);
}

std::string nameOf(const CellId& cell) {
  return cell.slot == 0 ? fmt::format("({}, {})", cell.i, cell.j)
                        : fmt::format("({}, {}, {})", cell.i, cell.j, cell.slot);
}

template <class Change>
Edit edited(const Project& project, std::string label, Change change) {
  Edit edit{project, std::move(label)};
  change(edit.project.layout());
  return edit;
}

}  // namespace

Edit addCell(const Project& project, const CellId& cell) {
  return edited(project, trf("Add cell {}", nameOf(cell)), [&](LayoutSpec& spec) { placeCell(spec, cell); });
}

Edit removeCells(const Project& project, const std::set<CellId>& cells) {
  const std::string label = cells.size() == 1 ? trf("Remove cell {}", nameOf(*cells.begin()))
                                              : trf("Remove {} cells", cells.size());
  return edited(project, label, [&](LayoutSpec& spec) {
    for (const CellId& cell : cells) takeCell(spec, cell);
  });
}

Edit splitCells(const Project& project, const std::set<CellId>& cells) {
  return edited(
      project,
      cells.size() == 1 ? trf("Split cell {}", nameOf(*cells.begin())) : trf("Split {} cells", cells.size()),
      [&](LayoutSpec& spec) {
        for (const CellId& cell : cells)
          if (canSplitCell(spec, cell)) spec.split.insert(cell);
      });
}

Edit joinCells(const Project& project, const std::set<CellId>& cells) {
  return edited(project,
                cells.size() == 1 ? trf("Join the parts around {}", nameOf(*cells.begin()))
                                  : trf("Join the parts around {} cells", cells.size()),
                [&](LayoutSpec& spec) {
                  if (!canSplit(spec.configuration)) return;  // cells of another configuration
                  for (const CellId& cell : cells)
                    if (cell.level > 0 && cell.slot != kFreeSlot) join(spec, wholeOf(spec, cell));
                });
}

bool canSplitCell(const LayoutSpec& spec, const CellId& cell) {
  return canSplit(spec.configuration) && cell.slot != kFreeSlot && cell.level < kMaxLevel &&
         isPlaced(spec, cell);
}

Edit addFreeApv(const Project& project, const Apv& apv) {
  return edited(project, apv.offset == glm::dvec2(0) ? tr("Add panorama") : tr("Add acentric panorama"),
                [&](LayoutSpec& spec) { spec.freeApvs[nextFreeNumber(spec)] = apv; });
}

Edit setFreeApv(const Project& project, int number, const Apv& apv) {
  return edited(project, trf("Panorama {}", number), [&](LayoutSpec& spec) { spec.freeApvs[number] = apv; });
}

int nextFreeNumber(const LayoutSpec& spec) {
  return spec.freeApvs.empty() ? 0 : spec.freeApvs.rbegin()->first + 1;
}

Edit setConfiguration(const Project& project, Configuration configuration) {
  return edited(project, trf("Configuration {}", acentric::nameOf(configuration)), [&](LayoutSpec& spec) {
    if (spec.configuration == configuration) return;
    spec.configuration = configuration;
    spec.forgetCells();
  });
}

Edit setCellSize(const Project& project, double metres) {
  return edited(project, trf("Cell size {:.2f} m", metres),
                [&](LayoutSpec& spec) { spec.cellSize = metres; });
}

Edit setLatticeOrigin(const Project& project, const glm::dvec2& origin) {
  return edited(project, trf("Lattice origin {:.2f}, {:.2f} m", origin.x, origin.y),
                [&](LayoutSpec& spec) { spec.latticeOrigin = origin; });
}

Edit setRotation(const Project& project, double radiansValue) {
  return edited(project, trf("Lattice rotation {:.1f}°", degrees(radiansValue)),
                [&](LayoutSpec& spec) { spec.rotationRadians = storedAngle(radiansValue); });
}

Edit setLattice(const Project& project, const LatticePlace& place, std::string label) {
  return edited(project, std::move(label), [&](LayoutSpec& spec) { placeLattice(spec, place); });
}

void placeLattice(LayoutSpec& spec, const LatticePlace& place) {
  spec.latticeOrigin = place.origin;
  spec.rotationRadians = storedAngle(place.rotationRadians);
  spec.cellSize = place.cellSize;
}

LatticePlace latticePlaceOf(const LayoutSpec& spec) {
  return {spec.latticeOrigin, spec.rotationRadians, spec.cellSize};
}

Edit setOutline(const Project& project, Outline outline) {
  const char* label = outline.empty() ? tr("Clear outline") : tr("Change outline");
  return edited(project, label, [&](LayoutSpec& spec) { spec.outline = std::move(outline); });
}

Edit setEyeHeight(const Project& project, double metres) {
  return edited(project, trf("Eye height {:.2f} m", metres),
                [&](LayoutSpec& spec) { spec.eyeHeight = metres; });
}

Edit setFloorHeight(const Project& project, double metres) {
  return edited(project, trf("Floor height {:.2f} m", metres),
                [&](LayoutSpec& spec) { spec.floorHeight = metres; });
}

Edit setNearBand(const Project& project, double metres) {
  return edited(project, trf("Near band {:.2f} m", metres),
                [&](LayoutSpec& spec) { spec.nearBand = metres; });
}

CellId nearestSlot(const LayoutSpec& spec, const CellId& like, const glm::dvec2& centre) {
  const double reach = 2.5 * spec.cellSize;  // holds a cell of every kind in each lattice
  constexpr int kMost = 200;
  CellId best = like;
  double nearest = std::numeric_limits<double>::max();
  for (const LatticeCell& cell : cellsIn(spec, centre - reach, centre + reach, kMost)) {
    if (cell.id.slot != like.slot || cell.id.level != like.level) continue;
    const double distance = glm::distance(cell.polygon.centroid(), centre);
    if (distance < nearest) {
      nearest = distance;
      best = cell.id;
    }
  }
  return best;
}

}  // namespace acentric::editor
