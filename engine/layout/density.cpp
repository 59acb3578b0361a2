#include "engine/layout/density.h"

namespace acentric {

void giveDensity(LayoutSpec& spec, const CellId& cell, double density) {
  spec.density.erase(cell);
  // What surrounds a part may have a density of its own.
  if (densityOf(spec, cell) != density) spec.density[cell] = density;
}

}  // namespace acentric
