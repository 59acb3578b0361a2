#pragma once
/// What each effect of a plan costs, as a share of the time that a bake of this layout would trace and shade:
/// measured on pixels of all its cameras, with and without the effect. Light that is gathered once per place
/// is shared by all pixels that read the place; how many those are follows from the cameras that see it.

#include <array>
#include <stop_token>

#include "engine/bake/bake_settings.h"
#include "engine/bake/ray_scene.h"
#include "engine/layout/layout.h"

namespace acentric {

struct EffectCosts {
  /// 0..1, by effect; 0 of those that are off. Alpha tests, blending and glass also make rays longer: that is
  /// part of what remains, as are the rays that find what is seen, and the plain surface.
  std::array<double, kEffectCount> share{};
  int pixels = 0;  ///< measured; 0 = nothing to see, or stopped
  double of(Effect effect) const { return share[std::size_t(effect)]; }
};

/// Takes some tenths of a second on the calling thread. Gathers its own light: nothing is kept.
EffectCosts measureEffectCosts(const RayScene& scene, const Layout& layout, const BakeSettings& settings,
                               std::stop_token stop = {});

}  // namespace acentric
