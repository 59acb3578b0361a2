#pragma once
/// A draggable border between two panes.

namespace acentric::ui {

enum class SplitDirection { horizontal, vertical };  ///< of the drag

/// Its thickness, scaled.
float splitterPixels();

/// Draws a splitter at the cursor, `length` pixels long, that changes `size` of the pane before it (or after
/// it, if `sizesNext`), kept in [least, most]. True while dragged.
bool splitter(const char* id, SplitDirection direction, float length, float& size, float least, float most,
              bool sizesNext = false);

}  // namespace acentric::ui
