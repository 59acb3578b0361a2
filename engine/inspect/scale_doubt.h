#pragma once
/// Whether a scene's scale can be right, told by what people stand on, pass through and stand under: steps,
/// doorways, how high the spaces between floors and ceilings are, whether they lie one above another as
/// storeys do, and where little is covered, how far the whole extends.

#include <optional>
#include <string>
#include <vector>

#include "engine/inspect/built_sizes.h"
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

/// What a scene's scale can be told by.
struct ScaleMeasures {
  Headways headways;
  BuiltSizes built;
  double across = 0;       ///< metres from corner to corner of the whole
  double texelMetres = 0;  ///< typical edge of a texel, 0 = unknown; of use only where little is covered
};

struct ScaleFinding {
  std::string subject;    ///< what was measured: "its storeys are"
  double metres = 0;      ///< now
  std::string dimension;  ///< "high", "across"
};

struct ScaleEvidence {
  double factor = 1;                   ///< the scene's lengths times this would fit people; not rounded
  std::vector<ScaleFinding> findings;  ///< at least one; what people are surest of first
};

/// Nothing where the scale may well be right: a hall, a cathedral, a landscape. Steps and doorways of
/// people's size outweigh high rooms; steps that are too large count only where nothing else fits people, for
/// there are stands and terraces.
std::optional<ScaleEvidence> weighScale(const ScaleMeasures& measures);

}  // namespace acentric
