#include "engine/pipeline/residency.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/contract.h"

namespace acentric {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSmallest = std::numeric_limits<double>::min();

/// How much longer than straight ahead a way straight back counts.
constexpr double kTurningRound = 1.6;
/// A capture gives way to one whose distance is this much smaller, not to a slightly nearer one, nor because
/// the eye turned round.
constexpr double kClearlyNearer = kTurningRound;
/// The way into a region that the eye already touches, as a share of its radius.
constexpr double kWayIn = 0.25;

double wayTo(const glm::dvec2& centre, double radius, const Whereabouts& where, const glm::dvec2& heading) {
  const glm::dvec2 towards = centre - where.eye;
  const double length = glm::length(towards);
  const double ahead = length > 0 ? glm::dot(towards, heading) / length : 0;
  const double turning = heading == glm::dvec2(0) ? 1 : 1 + (kTurningRound - 1) * 0.5 * (1 - ahead);
  return (std::max(0.0, length - radius) + kWayIn * radius) * turning;
}

/// In [-1, 0]: -1 for a camera that looks where the eye looks.
double byGaze(const glm::dvec2& camera, const glm::dvec2& gaze) {
  return -0.5 * (1 + std::clamp(glm::dot(camera, gaze), -1.0, 1.0));
}

}  // namespace

RegionNeeds regionNeeds(const Layout& layout, bool panoramas) {
  RegionNeeds needs;
  needs.start.push_back(0);
  for (std::size_t r = 0; r < layout.regions.size(); ++r) {
    const Region& region = layout.regions[r];
    needs.centre.push_back(region.polygon.centroid());
    double radius = 0;
    for (const glm::dvec2& corner : region.polygon.corners)
      radius = std::max(radius, glm::distance(corner, needs.centre.back()));
    needs.radius.push_back(radius);
    const auto first = std::ptrdiff_t(needs.camera.size());
    const auto add = [&](const Cover& cover) {
      for (const Piece& piece : cover.pieces) needs.camera.push_back(piece.camera);
    };
    std::ranges::for_each(region.covers, add);
    if (panoramas) std::ranges::for_each(layout.panoramasFor(int(r)), add);
    std::sort(needs.camera.begin() + first, needs.camera.end());
    needs.camera.erase(std::unique(needs.camera.begin() + first, needs.camera.end()), needs.camera.end());
    needs.start.push_back(std::uint32_t(needs.camera.size()));
  }
  for (const LayoutCamera& camera : layout.cameras)
    needs.direction.push_back(directionOf(camera.lowAzimuth + 0.5 * camera.fovRadians));
  return needs;
}

WalkDistances walkDistances(const Layout& layout, const RegionNeeds& needs, const Whereabouts& where) {
  WalkDistances distances;
  distances.camera.assign(layout.cameras.size(), kInfinity);
  distances.region.assign(layout.regions.size(), kInfinity);
  const auto inside = layout.regionAt(where.eye);
  const int here = inside ? *inside : layout.nearestRegion(where.eye).region;
  const double speed = glm::length(where.velocity);
  const glm::dvec2 heading = speed > 0 ? where.velocity / speed : glm::dvec2(0);
  const glm::dvec2 gaze = directionOf(where.yawRadians);
  for (std::size_t r = 0; r < layout.regions.size(); ++r) {
    const bool needed = int(r) == here;
    distances.region[r] = needed ? 0 : wayTo(needs.centre[r], needs.radius[r], where, heading);
    for (std::size_t n = needs.start[r]; n < needs.start[r + 1]; ++n) {
      const auto camera = std::size_t(needs.camera[n]);
      const double way = needed ? byGaze(needs.direction[camera], gaze) : distances.region[r];
      distances.camera[camera] = std::min(distances.camera[camera], way);
    }
  }
  return distances;
}

namespace {

/// Plans step by step on a copy of what is there.
class ResidencyPlanner {
 public:
  explicit ResidencyPlanner(const ResidencyInput& input)
      : input_(input), there_(input.residence.begin(), input.residence.end()) {
    const std::size_t count = input.distance.size();
    require(input.bytes.size() == count && there_.size() == count && input.lastUse.size() == count,
            "each camera has a distance, bytes, a residence and a use");
    std::vector<int> nearestFirst(count);
    std::iota(nearestFirst.begin(), nearestFirst.end(), 0);
    std::ranges::stable_sort(nearestFirst, {}, [&](int c) {
      const bool coming = there_[std::size_t(c)] == Residence::loading;  // and not to be stopped any more
      return coming ? std::min(distance(c), kSmallest) : distance(c);
    });
    bool room = true;
    for (const int c : nearestFirst) {
      const bool needed = distance(c) <= 0;
      if (bytes(c) == 0) continue;
      if (there_[std::size_t(c)] != Residence::absent) taken_ += bytes(c);
      const bool coming = there_[std::size_t(c)] == Residence::loading;
      room = room && (coming || distance(c) < kInfinity) &&
             (needed || coming || wantedBytes_ + bytes(c) <= input.limit);
      if (room) {
        wanted_.push_back(c);
        wantedBytes_ += bytes(c);
        if (needed) neededBytes_ = wantedBytes_;
      } else if (there_[std::size_t(c)] == Residence::resident) {
        spare_.push_back(c);
      }
    }
    std::ranges::reverse(spare_);  // of those unused for equally long the farthest goes first
    std::ranges::stable_sort(spare_, {}, [&](int c) { return input.lastUse[std::size_t(c)]; });
  }

  ResidencyPlan plan() {
    ResidencyPlan plan;
    plan.beyondLimit = neededBytes_ > input_.limit ? neededBytes_ - input_.limit : 0;
    makeRoom(0, 0, plan.evict);
    for (const int c : wanted_) {
      if (plan.steps.size() >= input_.mostSteps) break;
      if (there_[std::size_t(c)] != Residence::absent) continue;
      ResidencyPlan::Step step{c, {}};
      if (!makeRoom(bytes(c), distance(c), step.evict)) break;
      taken_ += bytes(c);
      plan.steps.push_back(std::move(step));
    }
    return plan;
  }

 private:
  double distance(int camera) const { return input_.distance[std::size_t(camera)]; }
  std::size_t bytes(int camera) const { return input_.bytes[std::size_t(camera)]; }

  /// Evicts for something of this distance until so many more bytes fit. For what is needed now all that can
  /// go goes, fit or not, and it is true; for anything else nothing goes in vain.
  bool makeRoom(std::size_t more, double nearer, std::vector<int>& evicted) {
    std::size_t freed = 0;
    const auto fits = [&] { return taken_ - freed + more <= input_.limit; };
    for (const int c : spare_) {
      if (fits()) break;
      if (there_[std::size_t(c)] != Residence::resident || distance(c) <= kClearlyNearer * nearer) continue;
      evicted.push_back(c);
      freed += bytes(c);
    }
    if (!fits() && nearer > 0) {
      evicted.clear();
      return false;
    }
    for (const int c : evicted) there_[std::size_t(c)] = Residence::absent;
    taken_ -= freed;
    return true;
  }

  const ResidencyInput& input_;
  std::vector<Residence> there_;
  std::vector<int> wanted_;  ///< nearest first: what would be in memory if nothing were there yet
  std::vector<int> spare_;   ///< what is there beside it, longest unused first
  std::size_t taken_ = 0, wantedBytes_ = 0, neededBytes_ = 0;
};

}  // namespace

ResidencyPlan planResidency(const ResidencyInput& input) { return ResidencyPlanner(input).plan(); }

}  // namespace acentric
