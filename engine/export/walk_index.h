#pragma once
/// A walk's index as it lies in the file (FORMAT.md, "Walks"): header, root and pages, each checked against
/// its hash before it is believed. What both readers of walks share.

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "engine/export/bundle_json.h"
#include "engine/export/walk_format.h"
#include "engine/export/walk_read.h"

namespace acentric {

/// Where files lie: from the beginning of the walk, and their bytes.
using FilePlaces = std::map<std::string, std::pair<std::uint64_t, std::uint64_t>>;

inline constexpr int kMostWalkLevels = 8;  // of pages

/// A page, as the one above it or the root names it.
struct WalkPageEntry {
  std::uint64_t at = 0;  ///< from where pages begin
  std::uint64_t bytes = 0, raw = 0;
  std::string hash;
  glm::dvec2 low{0}, high{0};  ///< box around the regions that are own in it or below it
  bool leaf = false;
};

class WalkIndex {
 public:
  /// Reads the header. `ranges` and `name` outlive it.
  static Result<WalkIndex> open(const ByteRanges& ranges, const std::string& name);

  Result<BundleJson> root() const;
  Result<BundleJson> page(const WalkPageEntry& entry) const;
  /// Throws what JSON throws where something is of another type than it should be.
  static WalkPageEntry entryOf(const BundleJson& json);
  /// The page, for messages.
  std::string nameOf(const WalkPageEntry& entry) const;
  /// Takes a file's place out of its description, which is then that of a bundle.
  void take(BundleJson& file, FilePlaces& places) const;

  /// Makes a storey of the root one of a bundle: lists in the place of what says where they are.
  static void putLists(BundleJson& storey, BundleJson cameras, BundleJson regions);

  tl::unexpected<Error> malformed(std::string message) const;
  /// A whole number, or the largest there is.
  static std::uint64_t number(const BundleJson& json);

 private:
  WalkIndex(const ByteRanges& ranges, const std::string& name) : ranges_(&ranges), name_(&name) {}
  Result<BundleJson> read(std::uint64_t at, std::uint64_t bytes, std::uint64_t raw, const std::string& hash,
                          const std::string& what, std::uint64_t mostRaw) const;

  const ByteRanges* ranges_;
  const std::string* name_;
  walk_format::Header header_;
};

/// What JSON throws where something of an index is of another type than it should be becomes an error of the
/// walk.
template <class Body>
auto withinSense(const std::string& name, const Body& body) -> decltype(body()) {
  try {
    return body();
  } catch (const BundleJson::exception& problem) {
    return fail(ErrorKind::malformed, std::string("its index makes no sense: ") + problem.what(), name);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory for its index", name);
  }
}

/// Reads files of a walk from where they lie.
class RangeFiles final : public BundleFiles {
 public:
  RangeFiles(std::shared_ptr<const ByteRanges> ranges, FilePlaces places)
      : ranges_(std::move(ranges)), places_(std::move(places)) {}
  Result<std::vector<std::byte>> read(const std::string& path, std::uint64_t mostBytes) const override;

 private:
  std::shared_ptr<const ByteRanges> ranges_;
  FilePlaces places_;
};

}  // namespace acentric
