#pragma once
/// The eyes of one region, asked together which of them a point is hidden from: most surfaces that a bake
/// asks about are hidden from all.

#include "engine/bake/eye_views.h"

namespace acentric {

class EyeGroup {
 public:
  explicit EyeGroup(std::vector<std::shared_ptr<const EyeView>> eyes);

  const std::vector<std::shared_ptr<const EyeView>>& eyes() const { return eyes_; }
  /// Has none of them a map?
  bool isUntraced() const { return side_ == 0; }
  /// By eye: 1 where its map shows the point hidden (EyeView::Sees::no), but for rounding to single
  /// precision; 0 where the map shows it, is unsure, or there is none.
  void findHidden(const glm::dvec3& point, std::vector<std::uint8_t>& hidden) const;

 private:
  static constexpr std::size_t kLanes = 4;
  using Floats = float __attribute__((vector_size(kLanes * sizeof(float))));
  /// Of as many eyes as a vector has lanes on every processor.
  struct Block {
    Floats x{}, y{}, z{};                            ///< relative to base_
    std::array<const std::uint16_t*, kLanes> map{};  ///< HiddenMap; null: there is none
  };
  std::vector<std::shared_ptr<const EyeView>> eyes_;
  int side_ = 0;  ///< of all maps; 0: there are none
  glm::dvec3 base_{0};
  std::vector<Block> blocks_;
};

}  // namespace acentric
