#pragma once
/// Pictures with words: a legend below a picture, and sheets of pictures with headings, labels and captions.

#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/image/image.h"

namespace acentric {

struct LegendLine {
  ColourImage swatch;
  std::string text;
};
/// The picture with as many rows of entries below it as they need.
Result<ColourImage> withLegend(const ColourImage& picture, std::span<const LegendLine> lines);

/// A picture in a sheet, and what stands under it.
struct SheetPicture {
  ColourImage picture;
  std::string caption;
};
struct SheetRow {
  std::string label;  ///< left of it
  std::vector<SheetPicture> pictures;
};
struct Sheet {
  std::string title;
  std::vector<std::string> headings;  ///< above the columns
  std::vector<SheetRow> rows;
  std::vector<std::string> notes;  ///< lines below all
  int pictureWidth = 0;            ///< pixels to which each is scaled; 0 = as they are
};
/// All pictures of one size, rows as long as need be. Words, where there are none, take no room.
Result<ColourImage> drawSheet(const Sheet& sheet);

}  // namespace acentric
