#pragma once
/// Places from which a judge looks: eyes in every region, spread evenly over what of it is walkable.

#include <vector>

#include "engine/base/result.h"
#include "engine/layout/layout.h"

namespace acentric {

struct EyeOptions {
  int perRegion = 7;  ///< places to stand in each region
  /// Metres above and below the layout's eye height, between which the eyes are spread.
  double lower = 0, higher = 0;
  /// 0 = all regions have eyes; else about so many at most, spread evenly over the layout: for a fair sample
  /// of very large ones.
  int mostRegions = 0;
  Status check() const;
};

/// By region. Of a region that the outline cuts, only places within the outline; one that the designer added
/// by hand counts as walkable throughout. The eyes lie strictly inside their regions.
std::vector<std::vector<glm::dvec3>> standingEyes(const Layout& layout, const EyeOptions& options);

}  // namespace acentric
