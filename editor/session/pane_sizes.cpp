#include "editor/session/pane_sizes.h"

#include <algorithm>
#include <cmath>

namespace acentric::editor {
namespace {

constexpr float kLeastSettings = 220, kLeastPlan = 300, kLeastWalk = 240;
constexpr float kLeastUpper = 200, kLeastBottom = 120;
constexpr float kLeastFour = 200;  // of one of four views, both ways
constexpr float kLeastReport = 250, kLeastBake = 380;

/// As wanted, but so that `others` fit beside it; 0 where not even `least` does.
float part(float wanted, float least, float whole, float others) {
  const float room = whole - others;
  return room < least ? 0 : std::clamp(wanted, least, room);
}

/// Their shares of the window; one view where there is no room for two.
PaneSizes fourSizes(float width, float height, float splitter, const Preferences& wanted, float scale) {
  PaneSizes sizes;
  const float least = kLeastFour * scale;
  sizes.walk = part((width - splitter) * (1 - wanted.fourColumn), least, width, least + splitter);
  sizes.plan = width - (sizes.walk > 0 ? sizes.walk + splitter : 0);
  sizes.lower = part((height - splitter) * (1 - wanted.fourRow), least, height, least + splitter);
  sizes.upper = height - (sizes.lower > 0 ? sizes.lower + splitter : 0);
  return sizes;
}

PaneSizes panelSizes(float width, float height, float splitter, const Preferences& wanted, float scale) {
  PaneSizes sizes;
  if (wanted.showBottom)
    sizes.bottom =
        part(wanted.bottomHeight * scale, kLeastBottom * scale, height, kLeastUpper * scale + splitter);
  sizes.upper = std::max(0.0F, height - (sizes.bottom > 0 ? sizes.bottom + splitter : 0));

  const float least = (kLeastPlan + kLeastWalk) * scale + splitter;
  if (wanted.showSettings)
    sizes.settings = part(wanted.settingsWidth * scale, kLeastSettings * scale, width, least + splitter);
  const float right = std::max(0.0F, width - (sizes.settings > 0 ? sizes.settings + splitter : 0));
  sizes.walk = part(wanted.walkWidth * scale, kLeastWalk * scale, right, kLeastPlan * scale + splitter);
  sizes.plan = std::max(0.0F, right - (sizes.walk > 0 ? sizes.walk + splitter : 0));

  if (sizes.bottom == 0) return sizes;
  const float gaps = 4;
  const bool messages = right >= (kLeastBake + 2 * kLeastReport) * scale + gaps;
  const bool report = right >= (kLeastBake + kLeastReport) * scale + gaps;
  sizes.bake = !report ? right : std::floor(std::max(kLeastBake * scale, right * 0.36F));
  if (messages) sizes.report = std::floor((right - sizes.bake - gaps) / 2);
  if (report) sizes.messages = std::max(0.0F, right - sizes.bake - sizes.report - gaps);
  return sizes;
}

}  // namespace

PaneSizes paneSizes(Arrangement arrangement, float width, float height, float splitter,
                    const Preferences& wanted, float scale) {
  width = std::max(width, 0.0F);
  height = std::max(height, 0.0F);
  switch (arrangement) {
    case Arrangement::panels:
      return panelSizes(width, height, splitter, wanted, scale);
    case Arrangement::four:
      return fourSizes(width, height, splitter, wanted, scale);
    case Arrangement::centre:
      return {.plan = width, .upper = height};
    case Arrangement::walk:
      break;
  }
  return {.walk = width, .upper = height};
}

}  // namespace acentric::editor
