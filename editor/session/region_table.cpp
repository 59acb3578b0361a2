#include "editor/session/region_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "ui/translate.h"

namespace acentric::editor {
namespace {

/// What a column is sorted by; figures that are not known come first.
double keyOf(const RegionRow& row, RegionColumn column) {
  switch (column) {
    case RegionColumn::budget:
    case RegionColumn::triangles:
      return row.triangles ? double(*row.triangles) : -1;
    case RegionColumn::kind:
      return double(row.kind);
    case RegionColumn::cameras:
      return row.cameras;
    case RegionColumn::bytes:
      return double(row.bytes);
    case RegionColumn::holes:
      return row.holes.value_or(-1);
    case RegionColumn::state:
      return double(row.state);
    case RegionColumn::name:
      break;
  }
  return row.region;
}

}  // namespace

BudgetLight lightOf(const RegionRow& row, std::size_t budget) {
  constexpr double kNear = 0.8;
  if (budget == 0 || !row.triangles) return BudgetLight::unknown;
  if (*row.triangles > budget) return BudgetLight::over;
  return double(*row.triangles) > kNear * double(budget) ? BudgetLight::near : BudgetLight::within;
}

std::vector<RegionRow> regionRows(const Layout& layout, const CaptureStatus* captures,
                                  std::span<const BakeState> states, const Inspection* inspection,
                                  const CoveragePicture* coverage) {
  const bool counted = inspection != nullptr && inspection->layout.get() == &layout;
  const bool onDisk = captures != nullptr && captures->bytes.size() == layout.cameras.size();
  const SurfaceCoverage* surfaces = coverage != nullptr && coverage->layout.get() == &layout &&
                                            coverage->request.kind == CoverageKind::surfaces
                                        ? coverage->surfaces.get()
                                        : nullptr;
  std::vector<RegionRow> rows;
  rows.reserve(layout.regions.size());
  for (std::size_t r = 0; r < layout.regions.size(); ++r) {
    const Region& region = layout.regions[r];
    RegionRow row;
    row.region = int(r);
    row.cell = region.id;
    row.kind = region.kind;
    if (counted) row.triangles = inspection->budgets.triangles[r];
    const std::vector<int> cameras = camerasOf(region);
    row.cameras = int(cameras.size());
    if (onDisk)
      for (const int camera : cameras) row.bytes += captures->bytes[std::size_t(camera)];
    if (surfaces != nullptr && r < surfaces->seenByRegion.size() && surfaces->seenByRegion[r] > 0)
      row.holes = double(surfaces->missedByRegion[r]) / double(surfaces->seenByRegion[r]);
    if (r < states.size()) row.state = states[r];
    rows.push_back(row);
  }
  return rows;
}

void sortRows(std::vector<RegionRow>& rows, RegionColumn column, bool descending) {
  std::ranges::stable_sort(rows, [&](const RegionRow& a, const RegionRow& b) {
    return descending ? keyOf(a, column) > keyOf(b, column) : keyOf(a, column) < keyOf(b, column);
  });
}

std::string nameOf(const CellId& cell) {
  if (cell.slot == kFreeSlot) return trf("panorama {}", cell.i);
  std::string name = fmt::format("{}, {}", cell.i, cell.j);
  if (cell.slot != 0) name += fmt::format(", {}", cell.slot);
  if (cell.level != 0) name += fmt::format(" /{}", 1 << cell.level);
  return name;
}

const char* nameOf(RegionKind kind) {
  switch (kind) {
    case RegionKind::ring:
      return tr("ring");
    case RegionKind::gapTriangle:
      return tr("gap, triangle");
    case RegionKind::gapSquare:
      return tr("gap, square");
    case RegionKind::gapHexagon:
      break;
  }
  return tr("gap, hexagon");
}

}  // namespace acentric::editor
