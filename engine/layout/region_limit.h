#pragma once
/// The refusal of layouts with more regions than can be handled: says how many there would be, and the way
/// out.

#include <fmt/format.h>

#include <cmath>

#include "engine/layout/layout_spec.h"

namespace acentric {

inline tl::unexpected<Error> tooManyRegions(double about, double cellSizeMetres) {
  return fail(
      ErrorKind::tooLarge,
      fmt::format("about {:.0f} regions would be placed, at most {} can be: choose cells of {:.2g} m or more "
                  "(now {:.3g} m), or a smaller outline",
                  about, kMaxRegions, 1.1 * cellSizeMetres * std::sqrt(std::max(1.0, about / kMaxRegions)),
                  cellSizeMetres),
      "layout");
}

}  // namespace acentric
