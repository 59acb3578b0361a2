#pragma once
/// The tree of pages of one walk's index, where places and numbers are looked up. Each page is checked as far
/// as it is looked at here; what a leaf says of its regions and cameras is read elsewhere.

#include <array>
#include <limits>
#include <list>
#include <memory>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "engine/export/walk_index.h"
#include "engine/geometry/convex_polygon.h"

namespace acentric {

/// What is kept of a page: of an inner one what is below it, of a leaf what has which number. All of a leaf
/// takes a hundred times the room.
struct WalkPage {
  std::size_t storey = 0;
  WalkPageEntry entry;
  std::vector<WalkPageEntry> children;
  struct SeenRegion {
    std::uint64_t number = 0;
    bool own = false;
    ConvexPolygon polygon;
  };
  std::vector<SeenRegion> regions;     ///< in the storey's order
  std::vector<std::uint64_t> cameras;  ///< numbers
  BundleJson json;                     ///< of a leaf, until it was looked at
};
using WalkPagePtr = std::shared_ptr<WalkPage>;

/// In which leaf a number is, of as many leaves as were looked through: four bytes a number.
class LeafNumbers {
 public:
  /// The first leaf of a number counts.
  void add(std::uint64_t number, std::size_t leaf);
  std::optional<std::size_t> find(std::uint64_t number) const;

 private:
  static constexpr std::size_t kTogether = 64;  // numbers one after another; no count is believed beforehand
  std::unordered_map<std::uint64_t, std::array<std::uint32_t, kTogether>> leaves_;  ///< from 1 on; 0: none
};

enum class WalkThing { region, camera };

/// Pages that are kept, those that were used last. A way down the tree has kMostWalkLevels of them at most,
/// and a step over a border needs another one.
inline constexpr std::size_t kKeptWalkPages = 4 * kMostWalkLevels;

/// One thread, but where it says so.
class WalkTree {
 public:
  /// `index` outlives it. `top`: the topmost pages by storey, none where it has no region.
  WalkTree(const WalkIndex& index, std::vector<std::optional<WalkPageEntry>> top);

  /// The leaf of the region that holds a point, or comes nearest to it; of several the first in the storey's
  /// order. The storey has one, and the point's numbers are finite.
  struct Nearest {
    WalkPagePtr leaf;
    double distance = 0;  ///< metres, as of Layout::nearestRegion
  };
  Result<Nearest> nearest(std::size_t storey, const glm::dvec2& point);
  /// No region is nearer to the point; infinite where there is none.
  double leastDistance(std::size_t storey, const glm::dvec2& point) const;
  /// The leaf that has a camera, or whose own a region is. `inside`: a point of the region, where one is
  /// known. Where no page that is kept has it, leaves are looked through until one does, each once.
  Result<WalkPagePtr> leafOf(std::size_t storey, WalkThing thing, std::uint64_t number,
                             const std::optional<glm::dvec2>& inside = std::nullopt);
  /// The first page that `nearest` would read; none: all that it looks at is kept.
  std::optional<WalkPageEntry> missing(std::size_t storey, const glm::dvec2& point);
  /// From any thread.
  Result<WalkPagePtr> read(std::size_t storey, const WalkPageEntry& entry) const;
  void keep(const WalkPagePtr& page);
  /// Lets go of the texts of leaves, but for one.
  void dropTexts(const WalkPage* but = nullptr);

 private:
  /// For the nearest region, or for one with a number around a point that it holds.
  struct Query {
    glm::dvec2 point{0};
    std::optional<std::uint64_t> wanted = std::nullopt;
    WalkPagePtr leaf = nullptr;  ///< found
    std::uint64_t number = 0;    ///< of the region there
    double distance = std::numeric_limits<double>::infinity();
    double reach = std::numeric_limits<double>::infinity();  ///< pages that are farther away are left out
    std::optional<Error> damage = std::nullopt;              ///< the first that was met
    std::set<std::uint64_t> seen = {};                       ///< pages
  };
  struct Search {
    struct Pending {
      WalkPageEntry entry;
      int level = 0;
    };
    std::vector<Pending> pending;   ///< not looked through yet; the next one last
    std::set<std::uint64_t> named;  ///< pages that are pending, or were
    std::vector<WalkPageEntry> leaves;
    LeafNumbers regions, cameras;
  };
  WalkPagePtr kept(std::size_t storey, std::uint64_t at);
  Result<WalkPagePtr> page(std::size_t storey, const WalkPageEntry& entry);
  Status run(std::size_t storey, Query& query);
  Status visit(std::size_t storey, const WalkPageEntry& entry, int level, Query& query);
  Result<WalkPagePtr> lookThrough(std::size_t storey, WalkThing thing, std::uint64_t number);
  Result<WalkPagePtr> expand(std::size_t storey, const Search::Pending& next);

  const WalkIndex& index_;
  std::vector<std::optional<WalkPageEntry>> top_;
  std::vector<Search> searches_;  ///< by storey
  std::list<WalkPagePtr> kept_;   ///< last used first
  bool reads_ = true;
  std::optional<WalkPageEntry> missing_;  ///< where it does not
};

}  // namespace acentric
