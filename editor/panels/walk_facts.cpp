#include "editor/panels/walk_facts.h"

#include <fmt/format.h>

#include "editor/panels/project_field.h"
#include "editor/panels/settings_panel.h"
#include "engine/geometry/conventions.h"
#include "ui/text_format.h"

namespace acentric::editor {
namespace {

void fact(const char* label, const std::string& value) {
  ui::keyValue(label, value, kLabelWidth);
  ui::tooltip(value);
}

}  // namespace

std::string walkLine(const ShippedWalk& walk) {
  return fmt::format("{}   {}   {}", walk.bundle.name, ui::formatBytes(walk.bytes), walk.bundle.generator);
}

void drawWalkFacts(PanelContext& context) {
  ui::panelTitle(context.window.fonts().bold, "Walk");
  const Session& session = context.session();
  const ShippedWalk& walk = *session.shippedWalk();
  ui::wrappedText(ui::palette::muted,
                  "It is looked at as it was exported. To edit or bake it, open its project.");
  if (ui::section("File")) {
    fact("Name", walk.bundle.name);
    fact("File", walk.file.filename().string());
    fact("Size", ui::formatBytes(walk.bytes));
    fact("Made by", walk.bundle.generator);
    fact("Textures", ui::formatCount(walk.bundle.textures.size()));
  }
  if (!session.built() || !ui::section("Storey")) return;
  drawStoreyChoice(context);
  const Layout& layout = *session.built()->layout;
  const std::string all = ui::formatCount(walk.regionCount(session.built()->project.storey));
  fact("Regions", walk.pages ? fmt::format("{} of {}", layout.regions.size(), all) : all);
  fact("Cameras", ui::formatCount(layout.cameras.size()));
  const WalkPose& pose = context.state().walker.pose();
  fact("Eye", fmt::format("({:.2f}, {:.2f}, {:.2f}) m", pose.eye.x, pose.eye.y, pose.eye.z));
  fact("Looks", fmt::format("{:.0f}°, {:.0f}° up", degrees(pose.yawRadians), degrees(pose.pitchRadians)));
}

}  // namespace acentric::editor
