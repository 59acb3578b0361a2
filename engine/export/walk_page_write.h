#pragma once
/// Pages of a walk's index (FORMAT.md, "Walks"), as those who write walks make them.

#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "engine/export/bundle.h"
#include "engine/export/bundle_json.h"

namespace acentric {

/// Of one inner page.
inline constexpr std::size_t kMostWalkChildren = 32;
/// A page's own regions and those two steps from them, which are in it too: an eye that crosses its border
/// has seen nothing of the next page yet. `neighbours`: of all regions.
std::set<int> withBeyond(const std::vector<std::vector<int>>& neighbours, const std::set<int>& own);

struct WalkBox {
  glm::dvec2 low{std::numeric_limits<double>::max()}, high{-std::numeric_limits<double>::max()};
  void add(const glm::dvec2& point) { low = glm::min(low, point), high = glm::max(high, point); }
  void add(const WalkBox& other) { add(other.low), add(other.high); }
};

/// The regions of a leaf with their cameras, these in the order in which regions first name them.
struct WalkLeaf {
  BundleStorey part;                            ///< numbers are those within the page
  std::vector<std::uint64_t> cameras, regions;  ///< theirs in the storey; regions rising
  std::vector<char> own;                        ///< by region
};

/// Where a file begins, from where data do.
using PlaceOfFile = std::function<std::uint64_t(const BundleFile&)>;

BundleJson leafPage(const WalkLeaf& leaf, const PlaceOfFile& placeOf);
BundleJson innerPage(std::vector<BundleJson> entries);
/// With where the file of a description begins; null stays null.
BundleJson placedFile(BundleJson file, std::uint64_t at);

/// A page that lies at `at`; as packed, and unpacked so many bytes long.
BundleJson pageEntry(std::uint64_t at, std::uint64_t bytes, const std::string& hash, std::uint64_t raw,
                     const WalkBox& box, bool leaf);

/// A storey of the root, without its cameras and regions: with what says where they are.
struct WalkStoreyCounts {
  std::uint64_t cameras = 0, regions = 0;
  double topElevation = 0, bottomElevation = 0;  ///< of its cameras
};
void putPage(BundleJson& storey, const WalkStoreyCounts& counts, BundleJson page);

}  // namespace acentric
