#pragma once
/// Where the parts of a walk come from: captures in two renditions, and the local geometry of regions. Each
/// call takes as long as the disk does; all of them may be called from several threads at once.

#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/pipeline/pipeline.h"

namespace acentric {

/// A coarse rendition stands in where the full one is not in memory.
enum class Detail : std::uint8_t { coarse, full };

struct LocalPart {
  std::shared_ptr<const LocalGeometry> geometry;  ///< null only if told to stop
  std::optional<LoadedWalk::Simplified> simplified;
  std::vector<std::string> warnings;
};

class WalkSource {
 public:
  virtual ~WalkSource() = default;
  /// On disk, of a camera's rendition; 0 = there is none.
  virtual std::uint64_t storedBytes(int camera, Detail detail) const = 0;
  virtual Result<Capture> capture(int camera, Detail detail) const = 0;
  virtual LocalPart local(int region, const std::stop_token& stop) const = 0;
};

/// A walk before its first capture is there.
struct WalkStart {
  LoadedWalk walk;                                            ///< the captures in it are full ones
  std::vector<std::shared_ptr<const DisplayCapture>> coarse;  ///< by camera, that are there; empty: none
  std::shared_ptr<const WalkSource> source;
};

/// Of a project's store. Full renditions are the best captures that are there, coarse ones the previews of
/// those that have a better one. `former` gives the light, captures and local geometry that did not change.
Result<WalkStart> startWalk(const OpenProject& open, const LoadedWalk* former);

}  // namespace acentric
