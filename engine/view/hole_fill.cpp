#include "engine/view/hole_fill.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace acentric {
namespace {

/// Instead of an inverse depth, of a hole that is being filled from its neighbours.
constexpr float kQueued = -1;

/// Up to so many times the smaller inverse depth counts as the same surface.
constexpr float kSameDepth = 1.3f;
/// How far a line is followed to either side, pixels: most holes are narrow.
constexpr int kReach = 48;

struct Filled {
  std::uint32_t pixel = 0;
  Rgba8 colour{0};
  float inverseZDepth = 0;
};

class HoleFill {
 public:
  HoleFill(Frame& frame, FloatImage& inverseZDepth, TaskRunner& runner)
      : frame_(frame), inverseZDepth_(inverseZDepth) {
    constexpr std::size_t kPixelsPerTask = std::size_t(1) << 16;
    const auto& sources = frame.source.pixels;
    std::vector<std::vector<std::uint32_t>> found((sources.size() + kPixelsPerTask - 1) / kPixelsPerTask);
    runner.parallelFor(found.size(), [&](std::size_t task) {
      const std::size_t end = std::min(sources.size(), (task + 1) * kPixelsPerTask);
      for (std::size_t i = task * kPixelsPerTask; i < end; ++i)
        if (sources[i] == kSourceHole) found[task].push_back(static_cast<std::uint32_t>(i));
    });
    for (const auto& part : found) holes_.insert(holes_.end(), part.begin(), part.end());
    for (const std::uint32_t hole : holes_) inverseZDepth_.pixels[hole] = 0;
  }

  bool anyHoles() const { return !holes_.empty(); }

  /// Holes along lines in four directions, each from the farther of its two ends. Short lines count most: a
  /// hole is open across the edge that it lies behind.
  void fillAlongLines(int reach, TaskRunner& runner) {
    constexpr std::size_t kHolesPerTask = 1024;
    std::vector<std::vector<Filled>> filled((holes_.size() + kHolesPerTask - 1) / kHolesPerTask);
    runner.parallelFor(filled.size(), [&](std::size_t task) {
      const std::size_t end = std::min(holes_.size(), (task + 1) * kHolesPerTask);
      for (std::size_t i = task * kHolesPerTask; i < end; ++i)
        if (const auto f = fromLines(holes_[i], std::min(reach, kReach))) filled[task].push_back(*f);
    });
    for (const auto& part : filled)
      for (const Filled& f : part) fill(f);
  }

  /// Rings of pixels around what is known; local geometry counts as known only if `fromLocal`.
  void grow(bool fromLocal, int maxRings) {
    fromLocal_ = fromLocal;
    std::vector<std::uint32_t> ring;
    for (std::uint32_t hole : holes_)
      if (isOpen(hole) && hasKnownNeighbour(hole)) {
        inverseZDepth_.pixels[hole] = kQueued;
        ring.push_back(hole);
      }
    std::vector<Filled> filled;
    for (int round = 0; round < maxRings && !ring.empty(); ++round) {
      filled.clear();
      for (std::uint32_t pixel : ring) filled.push_back(fromNeighbours(pixel));
      for (const Filled& f : filled) fill(f);
      ring.clear();
      for (const Filled& f : filled)
        forNeighbours(f.pixel, [&](std::uint32_t n, bool) {
          if (!isOpen(n)) return;
          inverseZDepth_.pixels[n] = kQueued;
          ring.push_back(n);
        });
    }
    for (std::uint32_t pixel : ring) inverseZDepth_.pixels[pixel] = 0;
  }

 private:
  bool isKnown(std::uint32_t pixel) const { return frame_.source.pixels[pixel] != kSourceHole; }
  /// Neither known nor queued.
  bool isOpen(std::uint32_t pixel) const {
    return !isKnown(pixel) && inverseZDepth_.pixels[pixel] != kQueued;
  }

  void fill(const Filled& f) {
    frame_.colour.pixels[f.pixel] = f.colour;
    frame_.source.pixels[f.pixel] = kSourceInvented;
    inverseZDepth_.pixels[f.pixel] = f.inverseZDepth;
  }

  /// The first pixel that is no hole, going by (dx, dy), and how many steps away.
  struct End {
    std::uint32_t pixel = 0;
    int steps = 0;
  };
  std::optional<End> endOf(int x, int y, int dx, int dy, int reach) const {
    const int width = frame_.source.width, height = frame_.source.height;
    for (int steps = 1; steps <= reach; ++steps) {
      x += dx, y += dy;
      if (x < 0 || x >= width || y < 0 || y >= height) return {};
      const std::uint32_t pixel = static_cast<std::uint32_t>(y * width + x);
      if (isKnown(pixel)) return usable(pixel) ? std::optional(End{pixel, steps}) : std::nullopt;
    }
    return {};
  }

  std::optional<Filled> fromLines(std::uint32_t hole, int reach) const {
    static constexpr std::array<std::array<int, 2>, 4> kDirections{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
    const int width = frame_.source.width;
    const int x = static_cast<int>(hole) % width, y = static_cast<int>(hole) / width;
    glm::vec3 colour(0);
    float depth = 0, weights = 0;
    const auto add = [&](std::uint32_t pixel, float weight) {
      colour += weight * glm::vec3(frame_.colour.pixels[pixel]);
      depth += weight * inverseZDepth_.pixels[pixel];
      weights += weight;
    };
    for (const auto& [dx, dy] : kDirections) {
      const auto ahead = endOf(x, y, dx, dy, reach), behind = endOf(x, y, -dx, -dy, reach);
      if (!ahead && !behind) continue;
      const float length =
          (dx != 0 && dy != 0 ? std::sqrt(2.0f) : 1.0f) *
          static_cast<float>((ahead ? ahead->steps : reach) + (behind ? behind->steps : reach));
      const float weight = 1 / (length * length * length);
      if (!ahead || !behind) {
        add((ahead ? ahead : behind)->pixel, weight);
        continue;
      }
      const float a = inverseZDepth_.pixels[ahead->pixel], b = inverseZDepth_.pixels[behind->pixel];
      if (std::max(a, b) > kSameDepth * std::min(a, b)) {
        add(a < b ? ahead->pixel : behind->pixel, weight);
      } else {
        const float share =
            static_cast<float>(behind->steps) / static_cast<float>(ahead->steps + behind->steps);
        add(ahead->pixel, share * weight);
        add(behind->pixel, (1 - share) * weight);
      }
    }
    if (weights == 0) return {};
    colour = colour / weights + 0.5f;
    return Filled{hole, Rgba8(glm::u8vec3(colour), 255), depth / weights};
  }

  template <class Visit>
  void forNeighbours(std::uint32_t pixel, const Visit& visit) const {
    const int width = frame_.source.width, height = frame_.source.height;
    const int x = static_cast<int>(pixel) % width, y = static_cast<int>(pixel) / width;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if ((dx != 0 || dy != 0) && x + dx >= 0 && x + dx < width && y + dy >= 0 && y + dy < height)
          visit(static_cast<std::uint32_t>((y + dy) * width + x + dx), dx == 0 || dy == 0);
  }

  bool usable(std::uint32_t pixel) const {
    return isKnown(pixel) && (fromLocal_ || frame_.source.pixels[pixel] != kSourceLocal);
  }

  bool hasKnownNeighbour(std::uint32_t pixel) const {
    bool any = false;
    forNeighbours(pixel, [&](std::uint32_t n, bool) { any = any || usable(n); });
    return any;
  }

  Filled fromNeighbours(std::uint32_t pixel) const {
    float smallest = std::numeric_limits<float>::max();
    forNeighbours(pixel, [&](std::uint32_t n, bool) {
      if (usable(n)) smallest = std::min(smallest, inverseZDepth_.pixels[n]);
    });
    std::array<int, 3> sum{};
    int weights = 0;
    float depthSum = 0;
    forNeighbours(pixel, [&](std::uint32_t n, bool straight) {
      if (!usable(n) || inverseZDepth_.pixels[n] > kSameDepth * smallest) return;
      const int weight = straight ? 3 : 2;
      const Rgba8& colour = frame_.colour.pixels[n];
      for (int c = 0; c < 3; ++c) sum[static_cast<std::size_t>(c)] += weight * colour[c];
      depthSum += static_cast<float>(weight) * inverseZDepth_.pixels[n];
      weights += weight;
    });
    const auto mean = [&](int total) { return static_cast<std::uint8_t>((total + weights / 2) / weights); };
    return {pixel, Rgba8(mean(sum[0]), mean(sum[1]), mean(sum[2]), 255),
            depthSum / static_cast<float>(weights)};
  }

  Frame& frame_;
  FloatImage& inverseZDepth_;
  std::vector<std::uint32_t> holes_;
  bool fromLocal_ = false;
};

}  // namespace

void fillHoles(Frame& frame, FloatImage& inverseZDepth, int maxRings, TaskRunner& runner) {
  HoleFill fill(frame, inverseZDepth, runner);
  if (!fill.anyHoles()) return;
  fill.fillAlongLines(maxRings, runner);
  fill.grow(false, maxRings);
  fill.grow(true, maxRings);
}

}  // namespace acentric
