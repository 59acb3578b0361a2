#pragma once
/// How the window is shared between panes. What has no room goes, in this order: scene report and messages,
/// the settings, the bottom, the walk; the plan goes last. Pure; all lengths in one unit, of any scale.

#include "editor/session/preferences.h"

namespace acentric::editor {

/// Which panes there are: settings, a view, the walk and the bottom; four views; or one view.
enum class Arrangement { panels, four, centre, walk };

struct PaneSizes {
  float settings = 0, plan = 0, walk = 0;  ///< widths; 0: not shown. Of four views `walk` is the right two's
  float upper = 0, lower = 0, bottom = 0;  ///< heights; lower: of the second row of four views
  float bake = 0, report = 0, messages = 0;
};

/// `width` and `height` of what the panes share, `splitter` between two of them; unscaled lengths are
/// multiplied by `scale`. No result is negative, and none that is shown thinner than 1.
PaneSizes paneSizes(Arrangement arrangement, float width, float height, float splitter,
                    const Preferences& wanted, float scale);

}  // namespace acentric::editor
