#pragma once
/// How many rays a bake will gather light with (engine/bake/gathered_light.h), told before it is run.
///
/// Light is gathered once for each place on a surface, whoever reads it first: what a part of a bake gathers
/// says little about the whole, of which most finds its places read already. So places are asked instead:
/// some thousands, spread evenly over all that there are, whether any of the cameras will read them. That
/// follows from geometry: the place lies in the camera's image, some served region needs it there, and
/// samples are dense enough to meet it. The same for the cells that bounces are read from: does light that
/// leaves one come to a place that is read?
///
/// Not modelled: what is seen in mirrors only, and that the surfaces' own light has a resolution of its own
/// where it has too many samples.

#include <stop_token>
#include <vector>

#include "engine/base/task_runner.h"
#include "engine/inspect/estimates.h"
#include "engine/pipeline/pipeline.h"
#include "engine/scene/surface_light.h"

namespace acentric {

/// `cameras`: those that will be baked. `light`: samples of the surfaces' own light as they are laid out,
/// which is baked after the captures; null: none. Gathers some of the places, with `runner`, to measure the
/// rate: for about a million rays, but nothing of it is kept. Nothing to gather gives zeros. `brief`: a tenth
/// of all that.
Result<GatherForecast> forecastGathering(const OpenProject& open, const std::vector<int>& cameras,
                                         const SurfaceLight* light, TaskRunner& runner,
                                         const std::stop_token& stop = {}, bool brief = false);

}  // namespace acentric
