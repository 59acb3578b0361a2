#include "engine/store/colour_tiles.h"

#include <algorithm>
#include <array>
#include <utility>

namespace acentric {
namespace {

/// visit(sample, column, row, layer) for all.
template <class Visit>
void forSamples(const CaptureSamples& samples, const Visit& visit) {
  for (std::size_t column = 0; column + 1 < samples.columnStart.size(); ++column) {
    std::size_t layer = 0;
    for (std::size_t i = samples.columnStart[column]; i < samples.columnStart[column + 1]; ++i) {
      layer = i > samples.columnStart[column] && samples.row[i] == samples.row[i - 1] ? layer + 1 : 0;
      visit(i, column, samples.row[i], layer);
    }
  }
}

/// Fills what is open of a line of pixels `stride` apart: between two samples evenly from one to the other.
/// False where it holds none.
bool fillLine(std::vector<std::uint16_t>& plane, const std::vector<std::uint8_t>& known, std::size_t first,
              std::size_t stride, std::size_t count) {
  std::size_t last = count;
  for (std::size_t n = 0; n <= count; ++n) {
    if (n < count && known[first + n * stride] == 0) continue;
    if (n == count && last == count) return false;
    const std::size_t from = last == count ? 0 : last + 1;
    const int b = n < count ? plane[first + n * stride] : plane[first + last * stride];
    const int a = last == count ? b : plane[first + last * stride];
    const int steps = int(n - from) + 1;
    for (std::size_t open = from; open < n; ++open)
      plane[first + open * stride] = std::uint16_t(a + (b - a) * (int(open - from) + 1) / steps);
    last = n;
  }
  return true;
}

}  // namespace

ColourTiles layOutColours(const CaptureSamples& samples, int rows, bool whole) {
  if (samples.sampleCount() == 0) return {};
  constexpr std::size_t kMostAcross = kMostPictureSide / kColourTile;
  const std::size_t across = (samples.columnStart.size() - 1 + kColourTile - 1) / kColourTile,
                    inRow = std::min(across, kMostAcross),
                    down = (std::size_t(rows) + kColourTile - 1) / kColourTile;
  const auto keyOf = [&](std::size_t column, std::size_t row, std::size_t layer) {
    return std::uint64_t(layer) << 32 | (row / kColourTile * across + column / kColourTile);
  };
  std::vector<std::uint64_t> keys;  // of tiles that are kept, in their order in the picture
  if (whole)
    for (std::size_t tile = 0; tile < across * down; ++tile) keys.push_back(tile);
  std::array<std::uint64_t, 8> last;  // of layers: most samples lie in the tile of the one above
  last.fill(~std::uint64_t(0));
  forSamples(samples, [&](std::size_t, std::size_t column, std::size_t row, std::size_t layer) {
    if (whole && layer == 0) return;
    const std::uint64_t key = keyOf(column, row, layer);
    if (std::exchange(last[layer % last.size()], key) != key) keys.push_back(key);
  });
  std::ranges::sort(keys);
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());

  ColourTiles tiles;
  tiles.width = int(inRow) * kColourTile;
  tiles.height = int((keys.size() + inRow - 1) / inRow) * kColourTile;
  tiles.place.resize(samples.sampleCount());
  std::array<std::size_t, 8> number{};
  last.fill(~std::uint64_t(0));
  forSamples(samples, [&](std::size_t i, std::size_t column, std::size_t row, std::size_t layer) {
    const std::uint64_t key = keyOf(column, row, layer);
    std::size_t& tile = number[layer % number.size()];
    if (std::exchange(last[layer % last.size()], key) != key)
      tile = std::size_t(std::ranges::lower_bound(keys, key) - keys.begin());
    const std::size_t x = tile % inRow * kColourTile + column % kColourTile,
                      y = tile / inRow * kColourTile + row % kColourTile;
    tiles.place[i] = std::uint32_t(y * std::size_t(tiles.width) + x);
  });
  return tiles;
}

StillPicture pictureOf(const CaptureSamples& samples, const ColourTiles& tiles, const ColourCoder& coder) {
  const std::size_t width = std::size_t(tiles.width), pixels = width * std::size_t(tiles.height);
  StillPicture picture{tiles.width, tiles.height, {}};
  for (auto& plane : picture.planes) plane.resize(pixels);
  std::vector<std::uint8_t> known(pixels, 0);
  for (std::size_t i = 0; i < samples.sampleCount(); ++i) {
    const ColourCodes codes = coder.codesOf(samples.colour[i]);
    for (int p = 0; p < 3; ++p) picture.planes[p][tiles.place[i]] = codes[std::size_t(p)];
    known[tiles.place[i]] = 1;
  }
  for (auto& plane : picture.planes) {
    // Rows tile by tile where tiles are of other places; a row without a sample as the one above or below.
    std::vector<std::uint8_t> filled(std::size_t(tiles.height), 0);
    for (std::size_t y = 0; y < std::size_t(tiles.height); ++y)
      filled[y] = fillLine(plane, known, y * width, 1, width) ? 1 : 0;
    const auto copy = [&](std::size_t from, std::size_t to) {
      std::copy_n(plane.begin() + std::ptrdiff_t(from * width), width,
                  plane.begin() + std::ptrdiff_t(to * width));
      filled[to] = 1;
    };
    for (std::size_t y = 1; y < filled.size(); ++y)
      if (filled[y] == 0 && filled[y - 1] != 0) copy(y - 1, y);
    for (std::size_t y = filled.size(); y-- > 1;)
      if (filled[y] != 0 && filled[y - 1] == 0) copy(y, y - 1);
  }
  return picture;
}

}  // namespace acentric
