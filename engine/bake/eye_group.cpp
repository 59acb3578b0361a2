#include "engine/bake/eye_group.h"

#include <algorithm>

#include "engine/base/contract.h"

namespace acentric {

EyeGroup::EyeGroup(std::vector<std::shared_ptr<const EyeView>> eyes)
    : eyes_(std::move(eyes)), blocks_((eyes_.size() + kLanes - 1) / kLanes) {
  if (!eyes_.empty()) base_ = eyes_.front()->eye();
  for (std::size_t e = 0; e < eyes_.size(); ++e) {
    Block& block = blocks_[e / kLanes];
    const std::size_t lane = e % kLanes;
    const glm::vec3 place(eyes_[e]->eye() - base_);
    block.x[lane] = place.x, block.y[lane] = place.y, block.z[lane] = place.z;
    if (eyes_[e]->isUntraced()) continue;
    const int side = eyes_[e]->lattice().side();
    require(side_ == 0 || side == side_, "the maps of a region's eyes are equally fine");
    side_ = side;
    block.map[lane] = eyes_[e]->hiddenBelow().data();
  }
}

void EyeGroup::findHidden(const glm::dvec3& point, std::vector<std::uint8_t>& hidden) const {
  using Whole = std::int32_t __attribute__((vector_size(kLanes * sizeof(std::int32_t))));
  constexpr float kNearest = 1e-30f;  // for the place of the eye itself
  hidden.resize(blocks_.size() * kLanes);
  const glm::vec3 at(point - base_);
  const float half = 0.5f * float(side_), end = float(side_);
  const int last = side_ - 1;
  const auto size = [](const Floats& v) { return v < 0 ? -v : v; };
  const auto texel = [&](const Floats& place) {
    const Floats clamped = place < 0 ? Floats{} : place > end ? Floats{} + end : place;
    const Whole whole = __builtin_convertvector(clamped, Whole);
    return whole > last ? Whole{} + last : whole;
  };
  std::uint8_t* out = hidden.data();
  for (const Block& block : blocks_) {
    // The texel, as CubeLattice::placeOf finds it.
    const Floats x = at.x - block.x, y = at.y - block.y, z = at.z - block.z;
    const Floats sizeX = size(x), sizeY = size(y), sizeZ = size(z);
    const Whole alongX = (sizeX >= sizeY) & (sizeX >= sizeZ), alongY = sizeY >= sizeZ;
    const Floats axis = alongX ? x : alongY ? y : z;
    const Floats u = alongX ? y : alongY ? z : x, v = alongX ? z : alongY ? x : y;
    const Floats distance = size(axis), w = 1 / (distance > kNearest ? distance : Floats{} + kNearest);
    const Whole face = (alongX ? Whole{} : alongY ? Whole{} + 2 : Whole{} + 4) - (axis < 0);
    const Whole column = texel((u * w + 1) * half), row = texel((v * w + 1) * half);
    const Whole index = HiddenMap::indexOf(side_, face, column, row);
    for (std::size_t i = 0; i < kLanes; ++i)
      *out++ = block.map[i] != nullptr && w[i] < HiddenMap::valueOf(block.map[i][index[i]]) ? 1 : 0;
  }
}

}  // namespace acentric
