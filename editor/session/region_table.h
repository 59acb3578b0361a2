#pragma once
/// The layout's regions as rows of figures, for budgets. Pure.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/session/capture_status.h"
#include "editor/session/coverage.h"
#include "editor/session/inspection.h"

namespace acentric::editor {

struct RegionRow {
  int region = 0;  ///< into Layout::regions
  CellId cell;
  RegionKind kind = RegionKind::ring;
  std::optional<std::size_t>
      triangles;                ///< of local geometry: within the near band; nothing: not counted yet
  int cameras = 0;              ///< whose captures the region shows
  std::uint64_t bytes = 0;      ///< of these on disk
  std::optional<double> holes;  ///< predicted share of what it sees; nothing: not measured
  BakeState state = BakeState::missing;
};

enum class RegionColumn { budget, name, kind, triangles, cameras, bytes, holes, state };

/// How a region stands to the triangle budget.
enum class BudgetLight {
  unknown,  ///< no budget, or not counted
  within,
  near,  ///< above four fifths of it
  over
};
BudgetLight lightOf(const RegionRow& row, std::size_t budget);

/// Figures that are of another layout are left out.
std::vector<RegionRow> regionRows(const Layout& layout, const CaptureStatus* captures,
                                  std::span<const BakeState> states, const Inspection* inspection,
                                  const CoveragePicture* coverage);
/// Regions that are equal in the column keep their order.
void sortRows(std::vector<RegionRow>& rows, RegionColumn column, bool descending);

/// "3, -1" or "3, -1, 2", with "/2" for a level; "panorama 4".
std::string nameOf(const CellId& cell);
const char* nameOf(RegionKind kind);

}  // namespace acentric::editor
