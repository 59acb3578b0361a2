#pragma once
/// At how many samples per degree captures take a given number of bytes.

#include <functional>

#include "engine/base/result.h"

namespace acentric {

/// Of `first` samples per degree and what others take: those at which `whole` gives `target` bytes, within
/// the tolerance (a share) if that is found in three tries. `rough` tells beforehand, from a part. Bytes grow
/// about as the square of samples per degree.
Result<double> fitResolution(double first, double target, double tolerance,
                             const std::function<Result<double>(double)>& rough,
                             const std::function<Result<double>(double)>& whole);

}  // namespace acentric
