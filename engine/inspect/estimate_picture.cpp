#include "engine/inspect/estimate_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/base/contract.h"
#include "engine/picture/layout_picture.h"

namespace acentric {

std::vector<double> bytesPerRegion(const Layout& layout, std::span<const double> cameraPixels,
                                   const BakeEstimate& estimate) {
  require(cameraPixels.size() == layout.cameras.size(), "each camera has its pixels");
  const double bytesPerPixel = estimate.pixels > 0 ? estimate.captureBytes.value / estimate.pixels : 0;
  std::vector<double> bytes;
  for (const Region& region : layout.regions) {
    std::set<int> cameras;
    for (const Cover& cover : region.covers)
      for (const Piece& piece : cover.pieces) cameras.insert(piece.camera);
    double pixels = 0;
    for (const int camera : cameras) pixels += cameraPixels[std::size_t(camera)];
    bytes.push_back(bytesPerPixel * pixels);
  }
  return bytes;
}

PlanPicture pictureOf(const Layout& layout, std::span<const double> cameraPixels,
                      const BakeEstimate& estimate, std::string title) {
  const std::vector<double> bytes = bytesPerRegion(layout, cameraPixels, estimate);
  PlanPicture picture = pictureOf(layout, std::move(title));
  std::erase_if(picture.legend, [](const LegendEntry& e) { return e.swatch == LegendSwatch::area; });
  const auto [least, most] = std::ranges::minmax_element(bytes);
  PlanScale scale;
  scale.label = "captures of a region";
  scale.unit = "MB";
  scale.low = bytes.empty() ? 0 : *least / 1e6;
  scale.high = bytes.empty() ? 1 : *most / 1e6;
  if (!(scale.high > scale.low)) scale.high = scale.low + 1;
  picture.scale = scale;
  for (std::size_t r = 0; r < bytes.size(); ++r) {
    picture.polygons[r].value = bytes[r] / 1e6;
    picture.polygons[r].stroke = {255, 255, 255, 255};
    picture.polygons[r].label = fmt::format("{:.1f}", bytes[r] / 1e6);
  }
  picture.notes.push_back(fmt::format(
      "{} captures of {:.1f} Mpixel: {:.1f} MB (\u00b1{:.0f} %), {:.0f} s of baking (\u00b1{:.0f} %), light "
      "on "
      "local geometry included.",
      estimate.cameras, estimate.pixels / 1e6, estimate.bytes.value / 1e6, 100 * estimate.bytes.relativeError,
      estimate.seconds.value, 100 * estimate.seconds.relativeError));
  picture.notes.push_back("Captures that regions share are counted for each of them.");
  return picture;
}

}  // namespace acentric
