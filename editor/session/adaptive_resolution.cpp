#include "editor/session/adaptive_resolution.h"

#include <algorithm>
#include <cmath>

namespace acentric::editor {

void AdaptiveResolution::measured(double scale, double seconds) {
  if (!(scale > 0) || !(seconds > 0)) return;
  const double wanted = scale * std::sqrt(kTargetSeconds / seconds);
  // Half of the way, in ratio: one slow frame (another program's doing) must not blur the next second.
  const double step = std::clamp(std::sqrt(wanted / scale_), 0.6, 1.3);
  scale_ = std::clamp(scale_ * step, kLeast, 1.0);
}

}  // namespace acentric::editor
