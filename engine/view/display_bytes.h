#pragma once

#include "engine/view/walk_scene.h"

namespace acentric {

/// What a capture that is ready to be drawn takes in memory, with what its mirrors show.
std::size_t bytesOf(const DisplayCapture& capture);

}  // namespace acentric
