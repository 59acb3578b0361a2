#pragma once
/// Lets test listings name a configuration "b" instead of by its bytes.

#include <ostream>

#include "engine/layout/layout_spec.h"

namespace acentric {
inline void PrintTo(Configuration configuration, std::ostream* out) { *out << nameOf(configuration); }
}  // namespace acentric
