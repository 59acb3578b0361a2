#pragma once
/// Whether the light is in a scene's colours already, as in photogrammetry and scans: then nothing may be lit
/// once more. Told by what such programs write: photographs or measured colours and nothing else of a
/// material, each part of a picture used once, triangles of about one size, no lamp. Private to this folder.

#include <optional>
#include <string>

#include "engine/scene/source_scene.h"

namespace acentric {

/// What speaks for it, for a person; nothing where light is to be computed. `scene` has its own lights only.
std::optional<std::string> whyLightIsInTextures(const Scene& scene);

/// Makes materials lit or unlit as `lighting` says, and tells in `guessed`. Whether colours are shown as they
/// are: then the scene needs no light.
bool applyLighting(Scene& scene, Lighting lighting, ReportLines& guessed);

}  // namespace acentric
