#pragma once
/// Careful arithmetic against less: the warp in floats and in doubles, exact and naive signs, inverse
/// distances in more and fewer bits. Error and time side by side, on frames of a walk and on the hard cases
/// of apv.md section 6.

#include <span>
#include <vector>

#include "engine/measure/numerics.h"
#include "engine/pipeline/pipeline.h"

namespace acentric {

struct NumericsBenchOptions {
  int repeats = 3;  ///< of what is timed; medians
};

/// `views`: the ordinary cases, all standing in regions of `open`, whose captures are baked.
Result<Numerics> benchNumerics(const OpenProject& open, const std::vector<PerspectiveView>& views,
                               const NumericsBenchOptions& options, TaskRunner& runner,
                               const Progress& progress = {}, std::stop_token stop = {});

/// Its three parts.
Result<NumericsTable> benchWarp(const OpenProject& open, const std::vector<PerspectiveView>& views,
                                const NumericsBenchOptions& options, TaskRunner& runner,
                                const Progress& progress, const std::stop_token& stop);
NumericsTable benchSigns(const Layout& layout, const NumericsBenchOptions& options);
Result<NumericsTable> benchDistances(const OpenProject& open, const std::vector<PerspectiveView>& views,
                                     const NumericsBenchOptions& options, TaskRunner& runner,
                                     const std::stop_token& stop);

}  // namespace acentric
