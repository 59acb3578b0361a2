#pragma once
/// What captures and their meshes take on the graphics card (view/frame.h), in words for the walk's figures.

#include <string>

#include "engine/view/frame.h"

namespace acentric::editor {

/// Of one capture: triangles, error, bytes.
std::string meshText(const MeshCost& cost);
/// Of those that a frame drew, together; empty if it drew none.
std::string meshSumText(const FrameStats& stats);
/// What is still being built for them; empty if nothing is.
std::string meshesAwaitedText(const FrameStats& stats);
/// Which captures are on their way to the graphics card; empty if none is.
std::string capturesAwaitedText(const FrameStats& stats);

}  // namespace acentric::editor
