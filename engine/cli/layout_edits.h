#pragma once
/// What `acentric layout` changes in a layout, as typed on the command line.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/layout/layout_spec.h"

namespace acentric::cli {

struct LayoutEdits {
  std::string configuration;  ///< empty = as it is
  std::optional<double> cellSize, rotationDegrees, eyeHeight, nearBand;
  std::string origin;                    ///< "x,y"
  std::vector<std::string> add, remove;  ///< "i,j,slot" or "i,j,slot,level"
  std::vector<std::string> split, join;  ///< likewise
  std::vector<std::string> density;      ///< "i,j,slot=times" or "i,j,slot,level=times"
  std::vector<std::string> free;         ///< "x,y,dx,dy,fov,hand"
  std::vector<int> removeFree;           ///< numbers
  std::string panoramas;                 ///< empty = as they are; "rings", "regions" or "none"
};

/// "x,y" in metres.
Result<glm::dvec2> parsePoint(std::string_view text);
/// "i,j,slot" or "i,j,slot,level".
Result<CellId> parseCell(std::string_view text);
/// "i,j,slot=times" or "i,j,slot,level=times".
Result<std::pair<CellId, double>> parseDensity(std::string_view text);
/// "x,y,dx,dy,fov,hand": centre and offset in metres, degrees, ccw or cw.
Result<Apv> parseApv(std::string_view text);

struct EditedLayout {
  LayoutSpec spec;
  std::vector<std::string> notes;  ///< what else had to change
};

/// The outline apart. Another configuration or cell size makes other cells: those added, removed or split one
/// by one are then forgotten, and a note says so.
Result<EditedLayout> applyEdits(const LayoutSpec& spec, const LayoutEdits& edits);

}  // namespace acentric::cli
