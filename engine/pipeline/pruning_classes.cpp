#include "engine/pipeline/pruning_classes.h"

#include <algorithm>
#include <vector>

#include "engine/bake/flush_denormals.h"
#include "engine/bake/test_eyes.h"

namespace acentric {
namespace {

constexpr std::size_t kLooks = 200'000;  // of all regions
constexpr std::uint64_t kSeed = 0x636c61737365, kEyeSeed = 0x65796573;
constexpr PruningClasses kClasses = {{{0.05, {}}, {0.2, {}}, {0.5, {}}, {1, {}}}};

/// A region's surfaces, and its eyes, all chosen at random.
class RegionClasses {
 public:
  RegionClasses(const OpenProject& open, const Region& region)
      : open_(open),
        region_(region),
        looks_(*open.rays, region.polygon, region.grown, open.layout->eyeZ(), open.project.bake) {}

  void addTo(PruningClasses& classes, std::size_t looks, TaskRunner& runner, const std::stop_token& stop) {
    RayCounts rays;
    const auto found = findTestEyes(*open_.rays, region_.polygon, region_.grown, open_.layout->eyeZ(),
                                    open_.project.bake, runner, rays, stop);
    // To nobody's eyes, everything that is looked at is lost.
    std::vector<RandomLooks::Lost> seen, others;
    looks_.loss({}, looks, kSeed, runner, rays, &seen, stop);
    looks_.loss({}, 4 * kClassEyes, kEyeSeed, runner, rays, &others, stop);
    if (others.size() > kClassEyes) others.erase(others.begin() + kClassEyes, others.end());
    std::vector<std::uint8_t> classOf(seen.size()), lost(seen.size());
    runner.parallelFor(seen.size(), [&](std::size_t n) {
      const FlushDenormals flush;
      if (stop.stop_requested()) return;
      RayCounts counts;
      classOf[n] = std::uint8_t(classNumber(seen[n], others, counts));
      lost[n] = std::ranges::none_of(
          found.eyes, [&](const glm::dvec3& eye) { return looks_.sees(eye, seen[n], counts); });
    });
    for (std::size_t n = 0; n < seen.size(); ++n) classes[classOf[n]].loss += {1, lost[n]};
  }

 private:
  std::size_t classNumber(const RandomLooks::Lost& what, const std::vector<RandomLooks::Lost>& others,
                          RayCounts& rays) const {
    const double all = double(others.size());
    std::size_t seeing = 0;
    for (const RandomLooks::Lost& other : others) {
      seeing += looks_.sees(other.eye, what, rays) ? 1 : 0;
      if (double(seeing) >= kClasses[kClasses.size() - 2].seenByFewerThan * all) break;
    }
    std::size_t number = 0;
    while (number + 1 < kClasses.size() && double(seeing) >= kClasses[number].seenByFewerThan * all) ++number;
    return number;
  }

  const OpenProject& open_;
  const Region& region_;
  RandomLooks looks_;
};

}  // namespace

PruningClasses pruningClassesOf(const OpenProject& open, TaskRunner& runner, const std::stop_token& stop) {
  PruningClasses classes = kClasses;
  const auto& regions = open.layout->regions;
  const std::size_t looks = std::max<std::size_t>(1000, kLooks / std::max<std::size_t>(1, regions.size()));
  for (const Region& region : regions)
    if (!stop.stop_requested()) RegionClasses(open, region).addTo(classes, looks, runner, stop);
  return classes;
}

}  // namespace acentric
