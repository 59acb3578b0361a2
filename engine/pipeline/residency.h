#pragma once
/// Which captures should be in memory, and in which order they come and go. Values in, values out: no disk,
/// no clock, no threads; WalkStream does what is planned here.
///
/// Each camera has a distance: how far the eye has to walk until a frame may need its capture, longer where
/// it would have to turn round. What lies nearer is loaded first, as much as memory holds. What is there
/// beside that gives way, longest unused first, and only to what is clearly nearer: so nothing comes and goes
/// while the eye stands at a border.

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "engine/layout/layout.h"

namespace acentric {

/// The regions of a layout and the cameras that frames from each may need.
struct RegionNeeds {
  std::vector<glm::dvec2> centre;     ///< of a circle around the region, plan, metres
  std::vector<double> radius;         ///< of that circle, metres
  std::vector<std::uint32_t> start;   ///< regions + 1 offsets into `camera`
  std::vector<int> camera;            ///< into Layout::cameras
  std::vector<glm::dvec2> direction;  ///< by camera: the middle of its view, unit
};
/// `panoramas`: with those that fill what a cover leaves open (ViewSettings::secondaryCover).
RegionNeeds regionNeeds(const Layout& layout, bool panoramas);

/// Of whom walks.
struct Whereabouts {
  glm::dvec2 eye{0};  ///< plan, metres
  double yawRadians = 0;
  glm::dvec2 velocity{0};  ///< plan, metres per second; only its direction counts
  bool operator==(const Whereabouts&) const = default;
};

struct WalkDistances {
  /// By camera: at most 0 = needed in the region where the eye stands, the less the nearer to where it looks;
  /// else metres of walking (weighted by direction); infinity = no region needs it.
  std::vector<double> camera;
  std::vector<double> region;  ///< the same; 0 = the eye stands in it, or it is the nearest
};
WalkDistances walkDistances(const Layout& layout, const RegionNeeds& needs, const Whereabouts& where);

enum class Residence : std::uint8_t { absent, loading, resident };

struct ResidencyInput {
  std::span<const double> distance;    ///< by camera, as in WalkDistances; infinity = do not load
  std::span<const std::size_t> bytes;  ///< that each takes, or is expected to; 0 = there is none
  std::span<const Residence> residence;
  std::span<const std::uint64_t> lastUse;  ///< when it was loaded, or needed last
  std::size_t limit = 0;                   ///< bytes, for all
  std::size_t mostSteps = std::numeric_limits<std::size_t>::max();
};

struct ResidencyPlan {
  std::vector<int> evict;  ///< at once: more is there than the limit allows
  struct Step {
    int load = 0;
    std::vector<int> evict;  ///< before it
  };
  std::vector<Step> steps;      ///< in this order
  std::size_t beyondLimit = 0;  ///< bytes that the captures needed now take above the limit by themselves
};

/// After all steps the captures take no more than the limit, unless those needed now do so by themselves:
/// these are loaded whatever the limit.
ResidencyPlan planResidency(const ResidencyInput& input);

}  // namespace acentric
