#pragma once
/// Whether a scene's scale can be right, told by what people stand on and under: how high the spaces between
/// floors and ceilings are, whether they lie one above another as storeys do, and where little is covered,
/// how far the whole extends.

#include <optional>
#include <string>

#include "engine/inspect/surface_probe.h"
#include "engine/scene/scene.h"

namespace acentric {

struct Headways {
  double coveredShare = 0;  ///< of the columns looked at, those with a ceiling over a floor
  double typical = 0;       ///< metres from floor to ceiling, the middle one by area
  double fittingShare = 0;  ///< of all, those that people build for themselves: 1.9 to 6 m
  double stackedShare = 0;  ///< of the covered columns, those with typical ones right above each other
  double storey = 0;        ///< metres from floor to floor in these, the middle one
};
Headways measureHeadways(const Bounds& bounds, const SurfaceProbe& probe);

struct ScaleEvidence {
  double factor = 1;      ///< the scene's lengths times this would fit people; not rounded
  double measured = 0;    ///< metres now
  std::string subject;    ///< what was measured: "its storeys are"
  std::string dimension;  ///< "high", "across"
};

/// Nothing where the scale may well be right: a hall, a cathedral, a landscape. `texelMetres`: typical edge
/// of a texel on the scene's surfaces, 0 = unknown; a weak hint, of use only where nothing is covered.
std::optional<ScaleEvidence> weighScale(const Bounds& bounds, const SurfaceProbe& probe,
                                        double texelMetres = 0);

}  // namespace acentric
