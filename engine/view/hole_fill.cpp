#include "engine/view/hole_fill.h"

#include <algorithm>
#include <array>

namespace acentric {
namespace {

enum class State : std::uint8_t { known, open, queued };

struct Filled {
  std::uint32_t pixel = 0;
  Rgba8 colour{0};
  float inverseZDepth = 0;
};

class HoleFill {
 public:
  HoleFill(Frame& frame, FloatImage& inverseZDepth)
      : frame_(frame), inverseZDepth_(inverseZDepth), state_(frame.source.pixels.size(), State::known) {
    for (std::size_t i = 0; i < state_.size(); ++i)
      if (frame_.source.pixels[i] == kSourceHole) {
        state_[i] = State::open;
        holes_.push_back(static_cast<std::uint32_t>(i));
      }
  }

  bool anyHoles() const { return !holes_.empty(); }

  /// Rings of pixels around what is known; local geometry counts as known only if `fromLocal`.
  void grow(bool fromLocal, int maxRings) {
    fromLocal_ = fromLocal;
    std::vector<std::uint32_t> ring;
    for (std::uint32_t hole : holes_)
      if (state_[hole] == State::open && hasKnownNeighbour(hole)) {
        state_[hole] = State::queued;
        ring.push_back(hole);
      }
    std::vector<Filled> filled;
    for (int round = 0; round < maxRings && !ring.empty(); ++round) {
      filled.clear();
      for (std::uint32_t pixel : ring) filled.push_back(fromNeighbours(pixel));
      for (const Filled& f : filled) {
        state_[f.pixel] = State::known;
        frame_.colour.pixels[f.pixel] = f.colour;
        frame_.source.pixels[f.pixel] = kSourceInvented;
        inverseZDepth_.pixels[f.pixel] = f.inverseZDepth;
      }
      ring.clear();
      for (const Filled& f : filled)
        forNeighbours(f.pixel, [&](std::uint32_t n, bool) {
          if (state_[n] != State::open) return;
          state_[n] = State::queued;
          ring.push_back(n);
        });
    }
    for (std::uint32_t pixel : ring) state_[pixel] = State::open;
  }

 private:
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
    return state_[pixel] == State::known && (fromLocal_ || frame_.source.pixels[pixel] != kSourceLocal);
  }

  bool hasKnownNeighbour(std::uint32_t pixel) const {
    bool any = false;
    forNeighbours(pixel, [&](std::uint32_t n, bool) { any = any || usable(n); });
    return any;
  }

  Filled fromNeighbours(std::uint32_t pixel) const {
    constexpr float kSameDepth =
        1.3f;  // up to so many times the smallest inverse depth counts as the same surface
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
  std::vector<State> state_;
  std::vector<std::uint32_t> holes_;
  bool fromLocal_ = false;
};

}  // namespace

void fillHoles(Frame& frame, FloatImage& inverseZDepth, int maxRings) {
  HoleFill fill(frame, inverseZDepth);
  if (!fill.anyHoles()) return;
  fill.grow(false, maxRings);
  fill.grow(true, maxRings);
}

}  // namespace acentric
