#pragma once
/// Bakes captures at the resolution at which they take a given number of bytes.

#include <functional>

#include "engine/bench/representation.h"
#include "engine/pipeline/fit_resolution.h"

namespace acentric {

/// How the captures of a representation are made.
struct CaptureBake {
  std::size_t together = 1;  ///< so many cameras, one after the other, are baked together or not at all
  /// The project with these cameras at so many samples per degree.
  std::function<Result<OpenProject>(double samplesPerDegree)> at;
  /// Those that are missing; how long it took, seconds.
  std::function<Result<double>(const OpenProject& open, const std::vector<int>& cameras,
                               const CaptureStore& store)>
      bake;
  /// Under which they lie in the store, by camera.
  std::function<std::vector<ContentKey>(const OpenProject& open)> keys;
  std::vector<ContentKey> keep;  ///< of others in the same store
};

/// A part this much of the whole tells its size.
inline constexpr std::size_t kSizingPart = 8;

/// The usual bake of a project's cameras, without light on surfaces.
CaptureBake plainBake(const Workplace& at, std::function<Result<OpenProject>(double)> open);

struct SizedCaptures {
  OpenProject open;  ///< its `keys` are those of CaptureBake
  CaptureStore store;
  RepresentationCost cost;  ///< of the captures; samples are not counted yet
};
/// Has an earlier run left all of them?
Result<bool> isBakedToSize(const Workplace& at, const std::string& name, const CaptureBake& captures,
                           std::optional<double> target, double tolerance);
/// Without a target, at the project's samples per degree. An earlier run's captures are taken where they are
/// of the same cameras and target. Captures of other runs in the folder are deleted.
Result<SizedCaptures> bakeToSize(const Workplace& at, const std::string& name, const CaptureBake& captures,
                                 std::optional<double> target, double tolerance);

}  // namespace acentric
