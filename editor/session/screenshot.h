#pragma once
/// Pictures of the walk as files beside the project, under names that were free.

#include <filesystem>

#include "engine/image/image.h"

namespace acentric::editor {

/// Left of `share` of the width one picture, right of it the other; of one size.
ColourImage splitPicture(const ColourImage& left, const ColourImage& right, double share);

/// "kitchen-view-007.png" beside "kitchen.acentric.json": one more than the highest that is there.
std::filesystem::path nextScreenshot(const std::filesystem::path& projectFile);

/// Writes a PNG under such a name and returns it. Never replaces a file, also not one that another program
/// makes at the same moment; what is written is whole or not there.
Result<std::filesystem::path> writeScreenshot(const ColourImage& picture,
                                              const std::filesystem::path& projectFile);

}  // namespace acentric::editor
