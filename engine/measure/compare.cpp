#include "engine/measure/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/base/contract.h"

namespace acentric {
namespace {

constexpr Rgba8 kSheetBackground(24, 24, 24, 255);

template <class A, class B>
bool sameSize(const Image<A>& a, const Image<B>& b) {
  return a.width == b.width && a.height == b.height;
}

}  // namespace

Result<Comparison> compare(const Frame& frame, const ColourImage& truth, const FloatImage& truthDistance) {
  if (!sameSize(frame.colour, truth) || !sameSize(frame.source, truth) || !sameSize(truthDistance, truth))
    return fail(ErrorKind::invalidArgument,
                fmt::format("a frame of {} x {} cannot be compared with a truth of {} x {} (distances {} x "
                            "{}); render both alike",
                            frame.colour.width, frame.colour.height, truth.width, truth.height,
                            truthDistance.width, truthDistance.height),
                "comparison");
  if (truth.empty())
    return fail(ErrorKind::invalidArgument, "an empty picture cannot be compared", "comparison");
  return Comparison{psnrOf(frame.colour, truth), ssimOf(frame.colour, truth),
                    holeShareOf(frame, truthDistance)};
}

double holeShareOf(const Frame& frame, const FloatImage& truthDistance) {
  require(sameSize(frame.source, truthDistance), "a frame and a truth of one size are compared");
  if (truthDistance.empty()) return 0;
  std::size_t holes = 0;
  for (std::size_t i = 0; i < truthDistance.pixels.size(); ++i)
    holes += std::isfinite(truthDistance.pixels[i]) && !isReal(frame.source.pixels[i]) ? 1 : 0;
  return static_cast<double>(holes) / static_cast<double>(truthDistance.pixels.size());
}

double depthErrorOf(const Frame& frame, const FloatImage& inverseZDepth, const PerspectiveView& view,
                    const FloatImage& truthDistance) {
  require(sameSize(frame.source, truthDistance) && sameSize(inverseZDepth, truthDistance),
          "a frame, its depths and a truth of one size are compared");
  const glm::dvec3 forward = view.rayThrough(0.5 * view.width, 0.5 * view.height);
  double sum = 0;
  std::size_t count = 0;
  for (int y = 0; y < truthDistance.height; ++y)
    for (int x = 0; x < truthDistance.width; ++x) {
      if (!isReal(frame.source.at(x, y))) continue;
      const double alongAxis = glm::dot(forward, view.rayThrough(x + 0.5, y + 0.5));
      const double drawn = std::max(0.0, alongAxis * double(inverseZDepth.at(x, y)));
      const double truth = 1 / double(truthDistance.at(x, y));
      sum += drawn == truth ? 0 : std::abs(drawn - truth) / std::max(drawn, truth);
      ++count;
    }
  return count == 0 ? 0 : sum / double(count);
}

double psnrOf(const ColourImage& a, const ColourImage& b) {
  require(sameSize(a, b), "pictures of one size are compared");
  std::uint64_t squares = 0;  // 3 * 255^2 per pixel: holds 10^14 pixels
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::ivec3 difference = glm::ivec3(a.pixels[i]) - glm::ivec3(b.pixels[i]);
    squares += static_cast<std::uint64_t>(difference.x * difference.x + difference.y * difference.y +
                                          difference.z * difference.z);
  }
  return psnrOfSquares(double(squares), a.pixels.size());
}

double psnrOfSquares(double squares, std::size_t pixels) {
  if (squares <= 0 || pixels == 0) return 99;
  return std::min(99.0, 10 * std::log10(255.0 * 255.0 * 3 * double(pixels) / squares));
}

ColourImage differenceImage(const ColourImage& a, const ColourImage& b, int gain) {
  require(sameSize(a, b), "pictures of one size are compared");
  ColourImage out(a.width, a.height);
  const auto amplified = [&](int x, int y) {
    return static_cast<std::uint8_t>(std::clamp<std::int64_t>(std::int64_t(gain) * std::abs(x - y), 0, 255));
  };
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    const Rgba8 &p = a.pixels[i], &q = b.pixels[i];
    out.pixels[i] = Rgba8(amplified(p.r, q.r), amplified(p.g, q.g), amplified(p.b, q.b), 255);
  }
  return out;
}

ColourImage contactSheet(const std::vector<ColourImage>& pictures, int columns, int gap) {
  require(columns >= 1 && gap >= 0, "a contact sheet has at least one column and no negative gap");
  if (pictures.empty()) return {};
  int cellWidth = 0, cellHeight = 0;
  for (const ColourImage& picture : pictures) {
    cellWidth = std::max(cellWidth, picture.width);
    cellHeight = std::max(cellHeight, picture.height);
  }
  const int count = static_cast<int>(pictures.size());
  const int used = std::min(columns, count), rows = (count + columns - 1) / columns;
  ColourImage sheet(used * cellWidth + (used - 1) * gap, rows * cellHeight + (rows - 1) * gap,
                    kSheetBackground);
  for (int i = 0; i < count; ++i) {
    const ColourImage& picture = pictures[static_cast<std::size_t>(i)];
    const int left = (i % columns) * (cellWidth + gap), top = (i / columns) * (cellHeight + gap);
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) sheet.at(left + x, top + y) = picture.at(x, y);
  }
  return sheet;
}

}  // namespace acentric
