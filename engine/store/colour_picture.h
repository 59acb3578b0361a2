#pragma once
/// The colours of the first sample of each pixel as a picture (FORMAT.md, "Colours as pictures"): columns
/// across, rows down, of the smallest rectangle that holds all pixels with a sample.

#include <vector>

#include "engine/image/capture.h"
#include "engine/store/colour_codes.h"
#include "engine/store/still_picture.h"

namespace acentric {

struct PictureArea {
  int column = 0, row = 0;  ///< the first
  int columns = 0, rows = 0;

  std::uint64_t pixels() const { return std::uint64_t(columns) * std::uint64_t(rows); }
};
PictureArea areaOf(const CaptureSamples& samples);

/// A piece has so many at most.
inline constexpr int kMostPiecePixels = 1 << 22;
/// Pieces that are a file each, in rows from the upper left, in pixels of the area.
std::vector<PictureArea> piecesOf(const PictureArea& area);

/// Of all samples, as codes of so many bits; what no sample lies on continues what is beside it.
StillPicture pictureOf(const CaptureSamples& samples, const PictureArea& area,
                       const std::vector<ColourCodes>& codes, int bits);
StillPicture pieceOf(const StillPicture& picture, const PictureArea& piece);

/// Sets the codes of the first samples that lie in a piece.
void takePiece(const StillPicture& picture, const PictureArea& area, const PictureArea& piece,
               const CaptureSamples& samples, std::vector<ColourCodes>& codes);

}  // namespace acentric
