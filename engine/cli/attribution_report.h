#pragma once
/// What the error of frames comes from, gathered along a path.

#include <vector>

#include "engine/bake/truth.h"
#include "engine/cli/command.h"
#include "engine/geometry/perspective_view.h"
#include "engine/measure/attribution.h"

namespace acentric::cli {

class AttributionReport {
 public:
  explicit AttributionReport(double samplesPerDegree) : samplesPerDegree_(samplesPerDegree) {}
  void add(const Frame& frame, const TruthFrame& truth, const Image<std::uint8_t>& viewDependent,
           const PerspectiveView& view);
  Json json() const;
  std::string text() const;

 private:
  /// The truth's at the captures' density, of the whole error of the frames.
  double shareAtLimit(ErrorSource source) const;

  double samplesPerDegree_;
  Attribution sums_, limitSums_;
  std::vector<double> limitPsnr_, limitSsim_;  ///< of the truth at the captures' density, by frame
};

}  // namespace acentric::cli
