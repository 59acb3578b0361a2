#pragma once
/// Light for scenes that bring none, and a sky for those with a sun only. Private to this folder.

#include "engine/scene/source_scene.h"

namespace acentric {

/// No lights: a sun and a sky (if `allowed`). A directional light: a sky in proportion to it (if `allowed`).
/// Only point and spot lights: nothing, they light a room. Each choice is told in `guessed`.
void addDefaultLight(Scene& scene, bool allowed, ReportLines& guessed);

}  // namespace acentric
