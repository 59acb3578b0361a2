#pragma once
/// Sampling coverage of a project (engine/inspect/surface_coverage.h), wired to the ray tracer,
/// the bake's cameras and the renderers.

#include <functional>
#include <memory>

#include "engine/inspect/surface_coverage.h"
#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/view_holes.h"

namespace acentric {

/// Opaque surfaces as a bake under the ray scene's effect plan takes them. Keeps `rays` alive.
std::unique_ptr<OpaqueTracer> opaqueTracerFor(RayScenePtr rays);

/// What the captures of a project would hold. Keeps what it refers to alive; immutable.
/// Its pruning asks the bake's own test, from the bake's test eyes: all of them, or those alone that are
/// placed without a look at the scene, where regions are so many that those which limit the loss are not to
/// be found for each.
class ProjectReach {
 public:
  enum class Eyes : std::uint8_t { all, placed };
  explicit ProjectReach(const OpenProject& open, Eyes eyes = Eyes::all);
  const CaptureReach& operator*() const { return reach_; }

 private:
  std::shared_ptr<const Layout> layout_;
  std::unique_ptr<OpaqueTracer> tracer_;
  std::unique_ptr<CaptureSight> sight_;  ///< null without pruning
  CaptureReach reach_;
};

/// For a display so many pixels wide with the project's field of view.
SurfaceCoverageOptions surfaceCoverageOptionsFor(const Project& project, int displayWidth);

/// One frame: holes foretold, and holes rendered.
struct HoleSample {
  PerspectiveView view;
  double missed = 0, open = 0;  ///< ViewHoles
  double measured = 0;          ///< hole share of the frame
  int missingImages = 0;
  /// Pixels: open in the frame, open by prediction, and both.
  std::uint64_t holes = 0, predicted = 0, both = 0;
};

struct Correlation {
  double pearson = 0, spearman = 0;  ///< NaN where a series does not vary
};

struct HoleCorrelation {
  std::vector<HoleSample> frames;
  int eyes = 0;  ///< that frames in a row were made from
  /// Each against `measured`, eye by eye: the frames that one eye looks through are taken together, since
  /// single frames of a good capture have too few holes to compare.
  Correlation missed, open;
};

/// Views all round from places drawn at random where one may stand, six to a place, each 60 degrees wide, and
/// within the bake's eye range: `count` places.
Result<std::vector<PerspectiveView>> randomLooks(const OpenProject& open, int count, int width, int height);

/// `render`: the frame of a view, with the project's captures.
Result<HoleCorrelation> correlateHoles(const ProjectReach& reach, const std::vector<PerspectiveView>& views,
                                       const ViewSettings& settings,
                                       const std::function<Result<Frame>(const PerspectiveView&)>& render,
                                       TaskRunner& runner, const Progress& progress = {},
                                       std::stop_token stop = {});

}  // namespace acentric
