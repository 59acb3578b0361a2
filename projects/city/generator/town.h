#pragma once
/// A flat town for layouts of large ground: 2 x 2 km, about 30,000 triangles. Streets 12 m wide every 100 m,
/// houses with gables along them, close together around the market place in the middle, farther apart
/// outside, and fields between.

#include "projects/gallery/generator/model.h"

namespace acentric::city {

/// The same every time. The market place is around the origin.
gallery::Model makeTown();

}  // namespace acentric::city
