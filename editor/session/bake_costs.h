#pragma once
/// What baking the whole of the open project takes: with each preset (engine/pipeline/bake_presets.h), as it
/// is set, and at which resolution it takes a given size. Predicted in the background by baking a little, one
/// after another, and remembered until the layout or the scene is another. That takes from seconds to a
/// minute or two of a processor: it is done by itself where the costs of a project as it was opened are
/// shown, after changes once they are pointed at. Main thread only.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "editor/session/job.h"
#include "engine/measure/sweep.h"
#include "engine/pipeline/bake_forecast.h"
#include "engine/pipeline/bake_presets.h"

namespace acentric::editor {

struct BakeCostRequest {
  std::shared_ptr<const OpenProject> open;
  ImportHost host;
  int threads = 1;  ///< that the bake will have
  std::size_t memoryBytes = 0;
};

/// Of all storeys, whatever is on disk already.
struct BakeCost {
  BakeForecast forecast;
  std::vector<std::string> bakeKeys;  ///< SweepPoint::bakeKey, of each storey
};

/// A resolution whose captures and light are about as large as was asked for.
struct SizeProposal {
  double askedBytes = 0;
  BakeSettings bake;  ///< those of the project but for samplesPerDegree
  BakeCost cost;
  /// As near as it comes, though it is not near: captures cannot be as small or as large.
  bool far() const;
};

class BakeCosts {
 public:
  explicit BakeCosts(Inbox& inbox) : predicting_(inbox), sizing_(inbox) {}

  /// The project, told often; nothing: it is being changed, or a bake runs. `now` in seconds. Work begins
  /// once the project has kept still for some seconds while costs are shown.
  void follow(const std::optional<BakeCostRequest>& project, bool shown, double now);
  /// Null: not known (yet).
  const BakeCost* of(const BakeSettings& bake) const;
  bool predicting() const { return predicting_.running() && !predicting_.cancelling(); }

  /// Looks for the resolution at which the project that is looked at takes so many bytes.
  void propose(double bytes);
  bool sizing() const { return sizing_.running() && !sizing_.cancelling(); }
  /// Of the project as it is; nothing where it was not asked for, or something else has changed since.
  const SizeProposal* proposal() const;

  /// Why costs could not be predicted, and why no resolution was found; empty: nothing failed.
  const std::string& trouble() const { return trouble_; }
  const std::string& sizeTrouble() const { return sizeTrouble_; }

 private:
  void predictNext();
  void remember(const BakeSettings& bake, const BakeCost& cost);

  std::optional<BakeCostRequest> request_;  ///< the newest
  bool still_ = false;                      ///< it is the project as it is now
  double beginAt_ = 0;
  std::vector<std::pair<BakeSettings, BakeCost>> known_;
  std::optional<SizeProposal> proposal_;
  std::string trouble_, sizeTrouble_;
  // Last: they are stopped and joined first.
  Job predicting_, sizing_;
};

/// The point of a sweep that has these captures and was drawn as the project is; null where none was
/// measured.
const SweepPoint* measuredWith(const Sweep& sweep, const BakeCost& cost);

}  // namespace acentric::editor
