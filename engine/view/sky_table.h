#pragma once
/// The sky's colours on the screen, computed once a frame: they depend on a direction's z alone.

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/image/colour.h"
#include "engine/image/sky.h"
#include "engine/view/canvas.h"

namespace acentric {

class SkyTable {
 public:
  SkyTable(const Sky& sky, float exposure) : sky_(sky) {
    const auto codes = [&](float z) {
      return wordOf(encodeForDisplay(sky.radiance({0, 0, z}), exposure)) & 0x00ffffffu;
    };
    codes_.reserve(kSteps + 1);
    for (int i = 0; i <= kSteps; ++i) codes_.push_back(codes(static_cast<float>(i) / kSteps));
    ground_ = codes(-1);
  }
  const Sky& sky() const { return sky_; }

  /// Blue, green and red as canvas pixels hold them; `direction` need not be of unit length.
  std::uint32_t towards(const glm::vec3& direction) const {
    if (direction.z < 0) return ground_;
    const float z = std::min(direction.z / std::sqrt(glm::dot(direction, direction)), 1.0f);
    return codes_[static_cast<std::size_t>(z * kSteps + 0.5f)];
  }

 private:
  static constexpr int kSteps = 1024;
  Sky sky_;
  std::vector<std::uint32_t> codes_;
  std::uint32_t ground_ = 0;
};

}  // namespace acentric
