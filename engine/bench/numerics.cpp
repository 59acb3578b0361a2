#include "engine/bench/numerics.h"

namespace acentric {

Result<Numerics> benchNumerics(const OpenProject& open, const std::vector<PerspectiveView>& views,
                               const NumericsBenchOptions& options, TaskRunner& runner,
                               const Progress& progress, std::stop_token stop) {
  if (views.empty()) return fail(ErrorKind::invalidArgument, "needs views", "bench numerics");
  auto warp = benchWarp(open, views, options, runner, progress, stop);
  if (!warp) return tl::unexpected(warp.error());
  NumericsTable signs = benchSigns(*open.layout, options);
  auto distances = benchDistances(open, views, options, runner, stop);
  if (!distances) return tl::unexpected(distances.error());
  return Numerics{std::move(*warp), std::move(signs), std::move(*distances)};
}

}  // namespace acentric
