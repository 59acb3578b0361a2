#include "engine/layout/panorama_set.h"

#include <algorithm>

#include "engine/base/contract.h"

namespace acentric {
namespace {

constexpr double kClearShare = 0.01;  ///< of the eye height

ConvexPolygon squareAround(const glm::dvec2& place, double half) {
  return {{place - half, {place.x + half, place.y - half}, place + half, {place.x - half, place.y + half}}};
}

}  // namespace

std::vector<int> PanoramaSet::camerasFor(const glm::dvec2& eye) const {
  std::vector<std::pair<double, std::size_t>> nearest;
  for (std::size_t g = 0; g < groups.size(); ++g)
    nearest.emplace_back(glm::distance(groups[g].centre, eye), g);
  const std::size_t taken = std::min(drawn, nearest.size());
  std::ranges::partial_sort(nearest, nearest.begin() + std::ptrdiff_t(taken));
  std::vector<int> cameras;
  for (std::size_t n = 0; n < taken; ++n) {
    const PanoramaGroup& group = groups[nearest[n].second];
    for (int k = 0; k < group.cameras; ++k) cameras.push_back(group.firstCamera + k);
  }
  return cameras;
}

PanoramaSet panoramaSet(const LayoutSpec& like, std::span<const std::vector<glm::dvec2>> groups,
                        std::size_t drawn, double reach) {
  require(drawn > 0 && reach > 0, "pictures are painted from something, from somewhere");
  PanoramaSet set;
  set.drawn = drawn;
  LayoutSpec& spec = set.layout.spec;
  spec.floorHeight = like.floorHeight, spec.eyeHeight = like.eyeHeight;
  spec.nearBand = kClearShare * like.eyeHeight;
  std::vector<LayoutCamera>& cameras = set.layout.cameras;
  int number = 0;
  for (const std::vector<glm::dvec2>& places : groups) {
    require(!places.empty(), "a group has a panorama");
    PanoramaGroup group{glm::dvec2(0), places, int(cameras.size()), kPanoramaCameras * int(places.size())};
    for (const glm::dvec2& place : places) {
      group.centre += place / double(places.size());
      const Role role{{number, 0, kFreeSlot}, squareAround(place, reach), squareAround(place, spec.nearBand)};
      for (int k = 0; k < kPanoramaCameras; ++k)
        cameras.push_back({{number, 0, kFreeCorner, k},
                           place,
                           k * kTwoPi / kPanoramaCameras,
                           kTwoPi / kPanoramaCameras,
                           {role}});
      ++number;
    }
    set.groups.push_back(std::move(group));
  }
  return set;
}

}  // namespace acentric
