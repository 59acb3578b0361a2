#include "engine/view/cracks.h"

#include <algorithm>
#include <cstring>

namespace acentric {
namespace {

/// The depths of the columns around one, that many at a time, with room above and below.
class DepthWindow {
 public:
  DepthWindow(const Canvas& canvas)
      : canvas_(canvas),
        pitch_(std::size_t(canvas.height) + 2 * kReach),
        depths_(kColumns * pitch_, kNothing) {
    for (int x = 0; x < kReach; ++x) fetch(x);
  }
  /// Moves on to column x, counted from the canvas's first: to 0, 1 and so on.
  void moveTo(int x) { fetch(x + kReach); }
  /// Of the column `beside` the one moved to: its first row, with kReach rows before.
  const float* column(int x, int beside) const {
    return depths_.data() + placeOf(x + beside) * pitch_ + kReach;
  }

 private:
  static constexpr int kReach = Cracks::kReach;
  static constexpr std::size_t kColumns = 2 * kReach + 1;
  static constexpr float kNothing = -1;

  std::size_t placeOf(int x) const { return std::size_t(x + kReach) % kColumns; }
  void fetch(int x) {
    float* const to = depths_.data() + placeOf(x) * pitch_ + kReach;
    if (x >= canvas_.width) {
      std::fill_n(to, canvas_.height, kNothing);
      return;
    }
    const CanvasPixel* const from = canvas_.column(canvas_.x0 + x);
    for (int y = 0; y < canvas_.height; ++y) to[y] = inverseZDepthOf(from[y]);
  }

  const Canvas& canvas_;
  std::size_t pitch_;
  std::vector<float> depths_;
};

}  // namespace

void Cracks::open(Canvas& canvas, std::uint32_t openBelow) {
  cracks_.clear();
  DepthWindow window(canvas);
  std::vector<std::uint8_t> between(std::size_t(canvas.height));
  for (int x = 0; x < canvas.width; ++x) {
    window.moveTo(x);
    static_assert(kReach == 3);
    const float *const own = window.column(x, 0), *const left1 = window.column(x, -1),
                       *const left2 = window.column(x, -2), *const left3 = window.column(x, -3),
                       *const right1 = window.column(x, 1), *const right2 = window.column(x, 2),
                       *const right3 = window.column(x, 3);
    const auto nearest = [](float a, float b, float c) { return std::max(std::max(a, b), c); };
    for (int y = 0; y < canvas.height; ++y) {
      const float across =
          std::min(nearest(left1[y], left2[y], left3[y]), nearest(right1[y], right2[y], right3[y]));
      const float along =
          std::min(nearest(own[y - 1], own[y - 2], own[y - 3]), nearest(own[y + 1], own[y + 2], own[y + 3]));
      between[std::size_t(y)] = std::max(across, along) > kBefore * own[y];
    }
    const std::size_t first = std::size_t(x) * std::size_t(canvas.height);
    const std::uint8_t* const end = between.data() + between.size();
    for (const std::uint8_t* at = between.data();
         (at = static_cast<const std::uint8_t*>(std::memchr(at, 1, std::size_t(end - at)))) != nullptr;
         ++at) {
      const std::size_t i = first + std::size_t(at - between.data());
      if (slotOf(canvas.pixels[i]) >= openBelow) cracks_.push_back({i, canvas.pixels[i]});
    }
  }
  for (const Crack& crack : cracks_) canvas.pixels[crack.at] &= ~kSlotBits;
}

void Cracks::close(Canvas& canvas) {
  for (const Crack& crack : cracks_) {
    CanvasPixel& pixel = canvas.pixels[crack.at];
    if (slotOf(pixel) == 0 || !(inverseZDepthOf(pixel) > kBefore * inverseZDepthOf(crack.pixel)))
      pixel = crack.pixel;
  }
}

}  // namespace acentric
