#include "engine/export/chart_picture.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/contract.h"
#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

/// From left to right what of a triangle lies between two rows.
std::optional<std::pair<double, double>> reachWithin(const std::array<glm::dvec2, 3>& triangle, double top,
                                                     double bottom) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 from = triangle[i], to = triangle[(i + 1) % 3];
    if (from.y >= top && from.y <= bottom) low = std::min(low, from.x), high = std::max(high, from.x);
    for (const double y : {top, bottom})
      if ((from.y < y) != (to.y < y)) {
        const double x = from.x + (to.x - from.x) * (y - from.y) / (to.y - from.y);
        low = std::min(low, x), high = std::max(high, x);
      }
  }
  if (low > high) return {};
  return std::pair(low, high);
}

/// Half of the texels across and down where the factors are 2.
ColourImage halved(const ColourImage& from, const glm::ivec2& factor) {
  const glm::ivec2 size = (glm::ivec2(from.width, from.height) - 2 * kChartBorder + factor - 1) / factor;
  ColourImage out(size.x + 2 * kChartBorder, size.y + 2 * kChartBorder);
  const glm::ivec2 last(from.width - 1, from.height - 1);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      glm::ivec4 sum(0);
      for (int j = 0; j < factor.y; ++j)
        for (int i = 0; i < factor.x; ++i) {
          const glm::ivec2 at = (glm::ivec2(x, y) - kChartBorder) * factor + glm::ivec2(i, j) + kChartBorder;
          const glm::ivec2 inside = glm::clamp(at, glm::ivec2(0), last);
          sum += glm::ivec4(from.at(inside.x, inside.y));
        }
      const int parts = factor.x * factor.y;
      out.at(x, y) = Rgba8((sum + parts / 2) / parts);
    }
  return out;
}

/// What a coordinate reads of a picture by a linear filter.
struct Tap {
  int first = 0;
  float second = 0;  ///< weight of the next
};

std::vector<Tap> tapsOf(int texels, int factor) {
  std::vector<Tap> taps;
  for (int t = 0; t < texels; ++t) {
    const double at = (t - kChartBorder + 0.5) / factor - 0.5 + kChartBorder;
    taps.push_back({int(at), float(at - int(at))});
  }
  return taps;
}

bool isNear(const ColourImage& small, const ColourImage& whole, const glm::ivec2& factor,
            const std::vector<char>& shown) {
  constexpr int kTile = 8;
  const std::vector<Tap> across = tapsOf(whole.width, factor.x), down = tapsOf(whole.height, factor.y);
  for (int top = 0; top < whole.height; top += kTile)
    for (int left = 0; left < whole.width; left += kTile) {
      double sum = 0;
      int values = 0;
      for (int y = top; y < std::min(top + kTile, whole.height); ++y)
        for (int x = left; x < std::min(left + kTile, whole.width); ++x) {
          if (shown[std::size_t(y) * std::size_t(whole.width) + std::size_t(x)] == 0) continue;
          const Tap &u = across[std::size_t(x)], &v = down[std::size_t(y)];
          const int right = std::min(u.first + 1, small.width - 1),
                    below = std::min(v.first + 1, small.height - 1);
          const glm::vec4 upper =
              glm::mix(glm::vec4(small.at(u.first, v.first)), glm::vec4(small.at(right, v.first)), u.second);
          const glm::vec4 lower =
              glm::mix(glm::vec4(small.at(u.first, below)), glm::vec4(small.at(right, below)), u.second);
          const glm::vec4 apart = glm::mix(upper, lower, v.second) - glm::vec4(whole.at(x, y));
          sum += double(glm::dot(apart, apart));
          values += 3;
        }
      if (sum > kShrinkError * kShrinkError * values) return false;
    }
  return true;
}

}  // namespace

glm::dvec2 nearestWithin(const std::array<glm::dvec2, 3>& triangle, const glm::dvec2& p) {
  const glm::dvec2 a = triangle[1] - triangle[0], b = triangle[2] - triangle[0], to = p - triangle[0];
  const double area = cross(a, b);
  if (area != 0) {
    const glm::dvec2 inside(cross(to, b) / area, cross(a, to) / area);
    if (inside.x >= 0 && inside.y >= 0 && inside.x + inside.y <= 1) return inside;
  }
  constexpr std::array<glm::dvec2, 3> kWeights{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)};
  glm::dvec2 best(0);
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    const glm::dvec2 side = triangle[next] - triangle[i];
    const double length = glm::dot(side, side);
    const double along = length > 0 ? std::clamp(glm::dot(p - triangle[i], side) / length, 0.0, 1.0) : 0;
    const glm::dvec2 apart = triangle[i] + along * side - p;
    if (const double distance = glm::dot(apart, apart); distance < nearest)
      nearest = distance, best = glm::mix(kWeights[i], kWeights[next], along);
  }
  return best;
}

std::vector<TexelOwner> ownersOf(std::span<const std::array<glm::dvec2, 3>> triangles,
                                 const glm::ivec2& size) {
  const glm::ivec2 all = size + 2 * kChartBorder;
  std::vector<TexelOwner> owners(std::size_t(all.x) * std::size_t(all.y));
  constexpr double kReach = double(kOwnedWithin);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& triangle = triangles[t];
    double top = HUGE_VAL, bottom = -HUGE_VAL;
    for (const glm::dvec2& corner : triangle)
      top = std::min(top, corner.y), bottom = std::max(bottom, corner.y);
    const auto texel = [](double at) { return at + kChartBorder - 0.5; };  // whose middle lies there
    const int firstRow = std::max(0, int(std::ceil(texel(top - kReach))));
    const int lastRow = std::min(all.y - 1, int(std::floor(texel(bottom + kReach))));
    for (int y = firstRow; y <= lastRow; ++y) {
      const double middle = y - kChartBorder + 0.5;
      const auto reach = reachWithin(triangle, middle - kReach, middle + kReach);
      if (!reach) continue;
      const int last = std::min(all.x - 1, int(std::floor(texel(reach->second + kReach))));
      for (int x = std::max(0, int(std::ceil(texel(reach->first - kReach)))); x <= last; ++x) {
        TexelOwner& owner = owners[std::size_t(y) * std::size_t(all.x) + std::size_t(x)];
        if (owner.triangle != TexelOwner::kNone && owner.distance == 0) continue;
        const glm::dvec2 p(x - kChartBorder + 0.5, middle);
        const glm::dvec2 at = nearestWithin(triangle, p);
        const glm::dvec2 place = (1 - at.x - at.y) * triangle[0] + at.x * triangle[1] + at.y * triangle[2];
        double distance = glm::distance(place, p);
        if (distance < 1e-6) distance = 0;  // inside, but for rounding
        if (distance > kReach || (owner.triangle != TexelOwner::kNone && float(distance) >= owner.distance))
          continue;
        owner = {std::uint32_t(t), glm::vec2(at), float(distance)};
      }
    }
  }
  return owners;
}

void fillUnknown(ColourImage& picture, const std::vector<char>& known) {
  require(known.size() == picture.pixels.size(), "each texel is known or not");
  if (std::ranges::all_of(known, [](char each) { return each != 0; })) return;
  struct Sum {
    std::array<std::uint64_t, 4> codes{};
    std::uint64_t texels = 0;
  };
  glm::ivec2 size(picture.width, picture.height), above = (size + 1) / 2;
  std::vector<std::vector<Sum>> levels;
  levels.emplace_back(std::size_t(above.x) * std::size_t(above.y));
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const std::size_t i = std::size_t(y) * std::size_t(size.x) + std::size_t(x);
      if (known[i] == 0) continue;
      Sum& sum = levels[0][std::size_t(y / 2) * std::size_t(above.x) + std::size_t(x / 2)];
      for (int c = 0; c < 4; ++c) sum.codes[std::size_t(c)] += picture.pixels[i][c];
      ++sum.texels;
    }
  std::vector<glm::ivec2> sizes{above};
  while (sizes.back().x > 1 || sizes.back().y > 1) {
    const glm::ivec2 below = sizes.back();
    sizes.push_back((below + 1) / 2);
    std::vector<Sum> next(std::size_t(sizes.back().x) * std::size_t(sizes.back().y));
    for (int y = 0; y < below.y; ++y)
      for (int x = 0; x < below.x; ++x) {
        const Sum& from = levels.back()[std::size_t(y) * std::size_t(below.x) + std::size_t(x)];
        Sum& to = next[std::size_t(y / 2) * std::size_t(sizes.back().x) + std::size_t(x / 2)];
        for (std::size_t c = 0; c < 4; ++c) to.codes[c] += from.codes[c];
        to.texels += from.texels;
      }
    levels.push_back(std::move(next));
  }
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const std::size_t i = std::size_t(y) * std::size_t(size.x) + std::size_t(x);
      if (known[i] != 0) continue;
      for (std::size_t level = 0; level < levels.size(); ++level) {
        const int shift = int(level) + 1;
        const Sum& sum =
            levels[level][std::size_t(y >> shift) * std::size_t(sizes[level].x) + std::size_t(x >> shift)];
        if (sum.texels == 0) continue;
        for (int c = 0; c < 4; ++c)
          picture.pixels[i][c] = std::uint8_t((sum.codes[std::size_t(c)] + sum.texels / 2) / sum.texels);
        break;
      }
    }
}

ChartPicture shrunk(ChartPicture picture, const std::vector<char>& shown) {
  const ColourImage whole = picture.image;
  const glm::dvec2 density = picture.texelsPerMetre;
  glm::ivec2 factor(1);
  // The picture is cut by `factor` from the whole in one go: an average of averages would be rounded each
  // time.
  for (bool again = true; again;) {
    again = false;
    for (const glm::ivec2& by : {glm::ivec2(2, 2), glm::ivec2(2, 1), glm::ivec2(1, 2)}) {
      const glm::ivec2 size = picture.size(), more = factor * by;
      if ((by.x == 2 && size.x == 1) || (by.y == 2 && size.y == 1)) continue;
      ColourImage smaller = halved(whole, more);
      if (!isNear(smaller, whole, more, shown)) continue;
      picture.image = std::move(smaller), factor = more;
      picture.texelsPerMetre = density / glm::dvec2(factor);
      again = true;
      break;
    }
  }
  return picture;
}

}  // namespace acentric
