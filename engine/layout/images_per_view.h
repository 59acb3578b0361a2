#pragma once
/// How many images a view is painted from, for each configuration: counted with the covers that walks draw,
/// for eyes all over the cells. It depends on the configuration and the field of view alone, not on the
/// cells' size.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/layout/layout.h"

namespace acentric {

/// Of views, the shares that need so many images; an image is what one capture camera sees (at most 60
/// degrees).
struct ImageCounts {
  std::vector<double> shares;  ///< [n]: of views that need n images; sums to 1
  double mean() const;
  int most() const { return int(shares.size()) - 1; }
};

struct ImageCountOptions {
  double fovDegrees = 60;  ///< horizontal, 1..179
  int views = 20'000;      ///< 1..10'000'000
  std::uint64_t seed = 1;

  Status check() const;
};

/// Eyes uniform over one cell of an endless lattice, yaw uniform all round, the paper's hand (chooseCover).
/// Only the cover that a view is painted from: what the other hand or a panorama adds behind is not counted.
Result<ImageCounts> countImages(Configuration configuration, const ImageCountOptions& options);

/// The same for a million views, as a table for people; tests count again.
struct ImagesPerView {
  static constexpr std::size_t kMost = 12;
  /// [n]: percent of views that need n images, by the horizontal field of view in degrees.
  std::array<double, kMost> at60{}, at90{};
};
const ImagesPerView& imagesPerView(Configuration configuration);
/// "2 in 40.0 %, 3 in 58.3 %, 4 in 1.7 %"; shares that round to nothing are left out.
std::string sharesText(const std::array<double, ImagesPerView::kMost>& percent);

}  // namespace acentric
