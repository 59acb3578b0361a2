#pragma once
/// Reads of a walk's index (FORMAT.md, "Walks") only the pages that tell of a place: what it takes depends on
/// how many regions a page has, not on how many the walk has.

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/export/walk_read.h"

namespace acentric {

/// What the walk is around one place.
struct WalkPlace {
  std::uint64_t page = 0;  ///< tells it from the places of other pages
  std::size_t storey = 0;
  /// All of the walk but that storey's other regions, and the regions and cameras of other storeys. Numbers
  /// of regions and cameras are those within the page.
  Bundle bundle;
  std::vector<std::uint64_t> cameras, regions;  ///< by number in the page: theirs in the storey
  std::vector<char> own;                        ///< by region: is no other page needed there?
  std::shared_ptr<const BundleFiles> files;

  const BundleStorey& here() const { return bundle.storeys[storey]; }
};
using WalkPlacePtr = std::shared_ptr<const WalkPlace>;

struct WalkPagesStats {
  std::uint64_t requests = 0, bytes = 0;  ///< of ranges, for the index
  int pages = 0;                          ///< pages read, again where they were forgotten
};

/// Any thread; one at a time reads.
class WalkPages {
 public:
  /// Reads header and root. `name`: of the walk, for messages.
  static Result<std::unique_ptr<WalkPages>> open(std::shared_ptr<const ByteRanges> ranges,
                                                 const std::string& name);
  ~WalkPages();

  /// The page whose own regions hold a point of the plan, or come nearest to it: of all own regions the eye's
  /// is the first in the storey's order. Fails where the storey has no region.
  Result<WalkPlacePtr> placeAt(std::size_t storey, const glm::dvec2& point);
  /// Without regions and cameras.
  const Bundle& root() const { return root_; }
  std::uint64_t regionCount(std::size_t storey) const { return counts_[storey]; }
  WalkPagesStats stats() const;

 private:
  struct Index;
  explicit WalkPages(std::string name);
  Status readRoot(std::shared_ptr<const ByteRanges> ranges);
  Result<WalkPlacePtr> find(std::size_t storey, const glm::dvec2& point);

  const std::string name_;
  mutable std::mutex mutex_;
  std::unique_ptr<Index> index_;
  Bundle root_;
  std::vector<std::uint64_t> counts_;  ///< regions, by storey
};

}  // namespace acentric
