#pragma once
/// Reads of a walk's index (FORMAT.md, "Walks") only the pages that tell of a place: what it takes depends on
/// how many regions a page has, not on how many the walk has.

#include <memory>
#include <mutex>
#include <string>

#include "engine/export/bundle_places.h"
#include "engine/export/walk_read.h"

namespace acentric {

struct WalkPagesStats {
  std::uint64_t requests = 0, bytes = 0;  ///< of ranges, for the index
};

/// Any thread; one at a time reads.
class WalkPages final : public BundlePlaces {
 public:
  /// Reads header and root. `name`: of the walk, for messages.
  static Result<std::unique_ptr<WalkPages>> open(std::shared_ptr<const ByteRanges> ranges,
                                                 const std::string& name);
  ~WalkPages() override;

  /// Without regions and cameras.
  const Bundle& root() const override { return root_; }
  Counts counts(std::size_t storey) const override;
  /// Of storeys only pages are read that may have the nearest region.
  Result<std::size_t> storeyAt(const glm::dvec3& eye) override;
  /// The page whose own regions hold a point of the plan, or come nearest to it: of all own regions the eye's
  /// is the first in the storey's order. notFound where there is no such storey, or no region in it.
  Result<BundlePlacePtr> placeAt(std::size_t storey, const glm::dvec2& point) override;
  /// What is damaged is named when it is asked for.
  void readAhead(std::size_t storey, const glm::dvec2& point) override;
  /// A page that was read lately where one has it; else one that the index is looked through for.
  Result<BundlePlacePtr> placeOfCamera(std::size_t storey, std::size_t camera) override;
  Result<BundlePlacePtr> placeOfRegion(std::size_t storey, std::size_t region) override;
  /// What a page tells of its cameras and own regions is kept.
  Result<CameraFacts> camera(std::size_t storey, std::size_t camera) override;
  Result<RegionFacts> region(std::size_t storey, std::size_t region) override;
  WalkPagesStats stats() const;

 private:
  struct Index;
  explicit WalkPages(std::string name);
  Status readRoot(std::shared_ptr<const ByteRanges> ranges);

  const std::string name_;
  std::mutex mutex_;
  std::unique_ptr<Index> index_;
  Bundle root_;
};

}  // namespace acentric
