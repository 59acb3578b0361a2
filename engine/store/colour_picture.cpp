#include "engine/store/colour_picture.h"

#include <algorithm>

namespace acentric {
namespace {

/// visit(sample, column, row) of the first sample of each pixel in the columns [first, end).
template <class Visit>
void forFirst(const CaptureSamples& samples, std::size_t first, std::size_t end, const Visit& visit) {
  for (std::size_t column = first; column < end; ++column)
    for (std::size_t i = samples.columnStart[column]; i < samples.columnStart[column + 1]; ++i)
      if (i == samples.columnStart[column] || samples.row[i] != samples.row[i - 1])
        visit(i, column, std::size_t(samples.row[i]));
}

/// Fills what is open of a line of pixels: between two samples evenly from one to the other. False where it
/// holds none.
bool fillLine(std::uint16_t* line, const std::uint8_t* known, std::size_t count) {
  std::size_t last = count;
  for (std::size_t n = 0; n <= count; ++n) {
    if (n < count && known[n] == 0) continue;
    if (n == count && last == count) return false;
    const std::size_t from = last == count ? 0 : last + 1;
    const int b = n < count ? line[n] : line[last];
    const int a = last == count ? b : line[last];
    const int steps = int(n - from) + 1;
    for (std::size_t open = from; open < n; ++open)
      line[open] = std::uint16_t(a + (b - a) * (int(open - from) + 1) / steps);
    last = n;
  }
  return true;
}

/// Rows without a sample are as the one above, or below.
void fill(std::vector<std::uint16_t>& plane, const std::vector<std::uint8_t>& known, std::size_t width) {
  std::vector<bool> filled(plane.size() / width, false);
  for (std::size_t y = 0; y < filled.size(); ++y)
    filled[y] = fillLine(plane.data() + y * width, known.data() + y * width, width);
  const auto copy = [&](std::size_t from, std::size_t to) {
    std::copy_n(plane.data() + from * width, width, plane.data() + to * width);
    filled[to] = true;
  };
  for (std::size_t y = 1; y < filled.size(); ++y)
    if (!filled[y] && filled[y - 1]) copy(y - 1, y);
  for (std::size_t y = filled.size(); y-- > 1;)
    if (filled[y] && !filled[y - 1]) copy(y, y - 1);
}

}  // namespace

PictureArea areaOf(const CaptureSamples& samples) {
  if (samples.sampleCount() == 0) return {};
  std::size_t first = 0, end = samples.columnStart.size() - 1;
  while (samples.columnStart[first + 1] == 0) ++first;
  while (samples.columnStart[end - 1] == samples.sampleCount()) --end;
  const auto [top, bottom] = std::ranges::minmax(samples.row);
  return {int(first), int(top), int(end - first), int(bottom - top) + 1};
}

std::vector<PictureArea> piecesOf(const PictureArea& area) {
  std::vector<PictureArea> pieces;
  if (area.pixels() == 0) return pieces;
  const int width = std::min(area.columns, kMostPictureSide),
            height = std::min(kMostPiecePixels / width, kMostPictureSide);
  for (int y = 0; y < area.rows; y += height)
    for (int x = 0; x < area.columns; x += width)
      pieces.push_back({x, y, std::min(width, area.columns - x), std::min(height, area.rows - y)});
  return pieces;
}

StillPicture pictureOf(const CaptureSamples& samples, const PictureArea& area,
                       const std::vector<ColourCodes>& codes, int bits) {
  StillPicture picture{area.columns, area.rows, bits, {}};
  if (area.pixels() == 0) return picture;
  for (auto& plane : picture.planes) plane.resize(area.pixels());
  std::vector<std::uint8_t> known(area.pixels(), 0);
  const std::size_t width = std::size_t(area.columns), first = std::size_t(area.column);
  forFirst(samples, first, first + width, [&](std::size_t i, std::size_t column, std::size_t row) {
    const std::size_t at = (row - std::size_t(area.row)) * width + column - first;
    for (std::size_t p = 0; p < 3; ++p) picture.planes[p][at] = codes[i][p];
    known[at] = 1;
  });
  for (auto& plane : picture.planes) fill(plane, known, width);
  return picture;
}

StillPicture pieceOf(const StillPicture& picture, const PictureArea& piece) {
  StillPicture out{piece.columns, piece.rows, picture.bits, {}};
  for (int p = 0; p < 3; ++p)
    for (int y = piece.row; y < piece.row + piece.rows; ++y) {
      const auto line = picture.planes[p].begin() + std::ptrdiff_t(y) * picture.width + piece.column;
      out.planes[p].insert(out.planes[p].end(), line, line + piece.columns);
    }
  return out;
}

void takePiece(const StillPicture& picture, const PictureArea& area, const PictureArea& piece,
               const CaptureSamples& samples, std::vector<ColourCodes>& codes) {
  const std::size_t first = std::size_t(area.column + piece.column), width = std::size_t(piece.columns);
  const std::size_t top = std::size_t(area.row + piece.row), bottom = top + std::size_t(piece.rows);
  forFirst(samples, first, first + width, [&](std::size_t i, std::size_t column, std::size_t row) {
    if (row < top || row >= bottom) return;
    const std::size_t at = (row - top) * width + column - first;
    for (std::size_t p = 0; p < 3; ++p) codes[i][p] = picture.planes[p][at];
  });
}

}  // namespace acentric
