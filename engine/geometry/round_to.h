#pragma once

#include <cmath>

namespace acentric {

/// The nearest multiple of `step`; the value itself where that is not above 0.
inline double roundTo(double value, double step) {
  return step > 0 ? std::round(value / step) * step : value;
}

}  // namespace acentric
