#pragma once
/// Cells of a new project: see firstCellSize. Above this size they are larger than people like them, since
/// the walkable area is vast.

namespace acentric {

inline constexpr double kLargestUsualCell = 6.0;  ///< metres

}  // namespace acentric
