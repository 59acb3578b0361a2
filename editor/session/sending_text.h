#pragma once
/// What is on its way to the graphics card (view/frame.h), in words for the walk's figures.

#include <string>

#include "engine/view/frame.h"

namespace acentric::editor {

/// Which captures are; empty if none is.
std::string capturesAwaitedText(const FrameStats& stats);

}  // namespace acentric::editor
