#include "editor/panels/walk_facts.h"

#include <fmt/format.h>

#include "editor/panels/project_field.h"
#include "editor/panels/settings_panel.h"
#include "engine/geometry/conventions.h"
#include "ui/text_format.h"
#include "ui/translate.h"

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
  ui::panelTitle(context.window.fonts().bold, tr("Walk"));
  const Session& session = context.session();
  const ShippedWalk& walk = *session.shippedWalk();
  ui::wrappedText(ui::palette::muted,
                  tr("It is looked at as it was exported. To edit or bake it, open its project."));
  if (ui::section(tr("File"))) {
    fact(tr("Name"), walk.bundle.name);
    fact(tr("File"), walk.file.filename().string());
    fact(tr("Size"), ui::formatBytes(walk.bytes));
    fact(tr("Made by"), walk.bundle.generator);
    fact(tr("Textures"), ui::formatCount(walk.bundle.textures.size()));
  }
  if (!session.built() || !ui::section(tr("Storey"))) return;
  drawStoreyChoice(context);
  const Layout& layout = *session.built()->layout;
  const std::string all = ui::formatCount(walk.regionCount(session.built()->project.storey));
  fact(tr("Regions"), walk.pages ? trf("{} of {}", layout.regions.size(), all) : all);
  fact(tr("Cameras"), ui::formatCount(layout.cameras.size()));
  const WalkPose& pose = context.state().walker.pose();
  fact(tr("Eye"), fmt::format("({:.2f}, {:.2f}, {:.2f}) m", pose.eye.x, pose.eye.y, pose.eye.z));
  fact(tr("Looks"), trf("{:.0f}°, {:.0f}° up", degrees(pose.yawRadians), degrees(pose.pitchRadians)));
}

}  // namespace acentric::editor
