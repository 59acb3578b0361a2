#pragma once
/// Which way is up in a file that does not say: the way that most level surfaces face, since people stand on
/// them and live under them. Private to this folder.

#include <optional>
#include <string>
#include <vector>

#include "engine/scene/source_scene.h"

namespace acentric {

/// How many times more of the surfaces' area faces along Z than along Y, where that is plain and the scene is
/// no higher along Z than along Y; nothing where Y may as well be up.
std::optional<double> levelAlongZ(const SourceScene& scene);

}  // namespace acentric
