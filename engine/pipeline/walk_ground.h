#pragma once
/// Where a walker may stand: in a region and within the walkable outline, or in a cell that was added by hand
/// beyond it. Its border is a soft wall: whoever walks against it slides along. Over stairs and ramps a walk
/// goes on from storey to storey.

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "engine/layout/layout.h"

namespace acentric {

bool mayStand(const Layout& layout, const glm::dvec2& point);

/// The point itself, or one near it where one may stand, no farther than a nearest one but for a hundredth of
/// a cell. The point itself if one may stand nowhere.
glm::dvec2 nearestStanding(const Layout& layout, const glm::dvec2& point);

/// The same in whole centimetres, to be told to a person; as it is where no such place is near.
glm::dvec2 nearestStandingCentimetre(const Layout& layout, const glm::dvec2& point);

/// Where a walk straight from `from`, where one may stand, to `to` ends. What leads into a wall is lost, what
/// leads along it is kept; no wall is walked through, however long the step, if it is as thick as a hundredth
/// of a cell.
glm::dvec2 walkTo(const Layout& layout, const glm::dvec2& from, const glm::dvec2& to);

/// Where a walker's feet are.
struct Footing {
  int storey = 0;
  glm::dvec2 place{0};  ///< plan, metres
  double ground = 0;    ///< z, metres
  bool operator==(const Footing&) const = default;
};

/// The ground of several storeys. Where some of them overlap that are a step apart, as pieces of stairs and
/// the floors at their ends do, it goes over from one's ground to another's without a jump: each counts by
/// how far within its outline one is.
class StoreyGround {
 public:
  /// Null: a storey without ground. `whole`: is there no ground but these?
  explicit StoreyGround(std::vector<std::shared_ptr<const Layout>> storeys, bool whole = true);

  /// Are there stairs? Else a walk stays on its storey, but for steps from floor to floor.
  bool rises() const;

  /// Standing on a storey; nothing where one may not.
  std::optional<Footing> on(int storey, const glm::dvec2& place) const;
  /// Coming from nearby. Of several storeys, the one whose cameras are at the most fitting height, or
  /// `from`'s if that is about as good.
  std::optional<Footing> beside(const Footing& from, const glm::dvec2& place) const;
  /// As walkTo, over all storeys; from where one may stand.
  Footing walk(const Footing& from, const glm::dvec2& to) const;

  /// That suits an eye best (layout/storey_choice.h).
  int storeyAt(const glm::dvec3& eye) const;
  /// May an eye be there, on the storey or, where there are stairs, on the one that suits it best? It may
  /// where the ground is not known.
  bool holds(int storey, const glm::dvec3& eye) const;

  const Layout& layout(int storey) const { return *storeys_[std::size_t(storey)].layout; }

 private:
  struct Ground {
    std::shared_ptr<const Layout> layout;
    glm::dvec2 low, high;         ///< box of its regions
    glm::dvec2 along{0};          ///< upwards, unit; 0: level
    double lower = 0, upper = 0;  ///< of the outline, along that
    double within(const glm::dvec2& place) const;
    bool holds(const glm::dvec2& place) const;
  };
  bool joined(int from, int to) const;
  std::vector<Ground> storeys_;
  bool whole_;
};

}  // namespace acentric
