#pragma once
/// The images that the walk's picture is painted from, back to front.

#include <optional>

#include "editor/panels/panel_context.h"
#include "editor/session/used_images.h"

namespace acentric::editor {

/// Between two corners on the window, or less high. The camera that the pointer is at.
std::optional<int> drawImageList(PanelContext& context, const ImVec2& low, const ImVec2& high,
                                 const std::vector<UsedImage>& images, const SourceColours& colours);
/// So many pixels high would show all.
float imageListHeight(std::size_t images);

}  // namespace acentric::editor
