#include <algorithm>
#include <numeric>

#include "engine/pipeline/pipeline.h"

namespace acentric {
namespace {

/// What a view from a region is painted from: every camera of its covers.
std::vector<bool> seenFrom(const Layout& layout, int region) {
  std::vector<bool> seen(layout.cameras.size(), false);
  for (const Cover& cover : layout.regions[std::size_t(region)].covers)
    for (const Piece& piece : cover.pieces) seen[std::size_t(piece.camera)] = true;
  return seen;
}

}  // namespace

std::vector<int> firstViewCameras(const OpenProject& open, const glm::dvec2& from) {
  const auto region = open.layout->regionAt(from);
  if (!region) return {};
  std::vector<int> cameras = bakingOrder(open, from);
  const std::vector<bool> first = seenFrom(*open.layout, *region);
  std::erase_if(cameras, [&](int camera) { return !first[std::size_t(camera)]; });
  return cameras;
}

ContentKey firstLightKey(const ContentKey& surfaceLightKey) {
  return Hasher().text("first light").value(surfaceLightKey.high).value(surfaceLightKey.low).finish();
}

std::vector<int> bakingOrder(const OpenProject& open) {
  return bakingOrder(open, open.project.spawn().position);
}

std::vector<int> bakingOrder(const OpenProject& open, const glm::dvec2& from) {
  const Layout& layout = *open.layout;
  std::vector<int> order(layout.cameras.size());
  std::iota(order.begin(), order.end(), 0);
  const auto region = layout.regionAt(from);
  const std::vector<bool> first =
      region ? seenFrom(layout, *region) : std::vector<bool>(layout.cameras.size(), false);
  const auto rank = [&](int camera) {
    return std::pair(!first[std::size_t(camera)],
                     glm::distance(layout.cameras[std::size_t(camera)].position, from));
  };
  std::ranges::stable_sort(order, {}, rank);
  return order;
}

}  // namespace acentric
