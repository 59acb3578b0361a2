#pragma once
/// Where a texture's alpha cuts a surface out, told without reading its colour: by cell between four texels
/// whether all of it is cut out, none of it, or the texture has to be read. The answers are those of the
/// bilinear look-up, to the last bit.

#include <cstdint>
#include <vector>

#include "engine/scene/texture_lookup.h"

namespace acentric {

class AlphaCells {
 public:
  enum class Cut : std::uint8_t { readTexture, nowhere, everywhere };

  /// Of a texture in use whose alpha, times `factor` (0 or more), is cut out below `cutoff`. Refers to the
  /// sampler's image while it is made.
  AlphaCells(const TextureSampler& texture, float factor, float cutoff);

  /// `at`: transformed texture coordinates.
  Cut at(const glm::vec2& at) const {
    const glm::ivec2 cell = texture_.cellAt(at) + 1;
    const auto index = std::size_t(cell.y) * std::size_t(columns_) + std::size_t(cell.x);
    return Cut(cuts_[index / kPerByte] >> (kBits * (index % kPerByte)) & kMask);
  }
  /// Is it made of these?
  bool isOf(const TextureSampler& texture, float factor, float cutoff) const {
    return texture_ == texture && factor_ == factor && cutoff_ == cutoff;
  }

 private:
  static constexpr std::size_t kBits = 2, kPerByte = 4;
  static constexpr unsigned kMask = 3;

  TextureSampler texture_;
  float factor_, cutoff_;
  int columns_;
  std::vector<std::uint8_t> cuts_;  ///< row by row, kPerByte cells each
};

}  // namespace acentric
