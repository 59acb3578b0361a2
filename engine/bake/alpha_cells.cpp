#include "engine/bake/alpha_cells.h"

#include <algorithm>

namespace acentric {
namespace {

/// Of an alpha: more than rounding takes of it in a look-up.
constexpr float kRounding = 1e-5f;

}  // namespace

AlphaCells::AlphaCells(const TextureSampler& texture, float factor, float cutoff)
    : texture_(texture), factor_(factor), cutoff_(cutoff), columns_(texture.image()->width + 1) {
  const int rows = texture.image()->height + 1;
  cuts_.resize((std::size_t(columns_) * std::size_t(rows) + kPerByte - 1) / kPerByte, 0);
  std::size_t index = 0;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns_; ++x, ++index) {
      const auto texels = texture.texelsOf({x - 1, y - 1});
      const auto [least, most] = std::minmax({texels[0].a, texels[1].a, texels[2].a, texels[3].a});
      const auto alpha = [&](std::uint8_t stored) { return factor * (float(stored) * (1 / 255.0f)); };
      Cut cut = Cut::readTexture;
      if (alpha(least) * (1 - kRounding) >= cutoff) cut = Cut::nowhere;
      if (alpha(most) * (1 + kRounding) < cutoff) cut = Cut::everywhere;
      cuts_[index / kPerByte] |= std::uint8_t(unsigned(cut) << (kBits * (index % kPerByte)));
    }
}

}  // namespace acentric
