#pragma once
/// Cameras all round at chosen places, which no regions share out: what walkthroughs are made of without
/// acentric views. One panorama is six cameras of 60 degrees; several panoramas may belong together (as those
/// of a head box).

#include <span>
#include <vector>

#include "engine/layout/layout.h"

namespace acentric {

struct PanoramaGroup {
  glm::dvec2 centre{0};              ///< plan, metres
  std::vector<glm::dvec2> places;    ///< of its panoramas
  int firstCamera = 0, cameras = 0;  ///< of PanoramaSet::layout, in order of the places
};

struct PanoramaSet {
  Layout layout;  ///< without regions; Layout::regionAt finds none
  std::vector<PanoramaGroup> groups;
  std::size_t drawn = 1;  ///< groups that a picture is painted from

  /// Cameras of the `drawn` groups whose centres are nearest to the eye, the nearest group first.
  std::vector<int> camerasFor(const glm::dvec2& eye) const;
};

/// Cameras of one panorama.
inline constexpr int kPanoramaCameras = 6;

/// At floor and eye height of `like`. Nothing nearer to a panorama than a hundredth of the eye height is
/// captured, so rows reach as far up and down as rows may. `reach`: how far from a panorama an eye may stand
/// that it is drawn for, metres; distances are rounded so that such an eye does not see it. Each group has at
/// least one place.
PanoramaSet panoramaSet(const LayoutSpec& like, std::span<const std::vector<glm::dvec2>> groups,
                        std::size_t drawn, double reach);

}  // namespace acentric
