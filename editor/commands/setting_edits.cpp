#include "editor/commands/setting_edits.h"

#include <fmt/format.h>

#include "editor/commands/stored_angle.h"
#include "ui/translate.h"

namespace acentric::editor {

Edit setBakeSettings(const Project& project, const BakeSettings& bake, const char* field) {
  Edit edit{project, trf("Bake: {}", field)};
  edit.project.bake = bake;
  return edit;
}

Edit setBakePreset(const Project& project, BakePreset preset) {
  Edit edit{project, trf("Bake quality: {}", tr(nameOf(preset)))};
  edit.project.bake = withPreset(project.bake, preset);
  return edit;
}

Edit setBudget(const Project& project, const TriangleBudget& budget, const char* field) {
  Edit edit{project, trf("Budget: {}", field)};
  edit.project.budget = budget;
  return edit;
}

Edit setViewSettings(const Project& project, const ViewSettings& view, const char* field) {
  Edit edit{project, trf("View: {}", field)};
  edit.project.view = view;
  return edit;
}

Edit setFieldOfView(const Project& project, double degreesValue) {
  Edit edit{project, trf("Field of view {:.0f}°", degreesValue)};
  edit.project.fovDegrees = degreesValue;
  return edit;
}

Edit setExposure(const Project& project, float exposure) {
  Edit edit{project, trf("Exposure {:.3g}", exposure)};
  edit.project.exposure = exposure;
  return edit;
}

Edit setSpawn(const Project& project, const Spawn& spawn) {
  Edit edit{project, tr("Set start of the walk")};
  edit.project.spawn() = {spawn.position, storedAngle(spawn.yawRadians)};
  return edit;
}

Edit setEffect(const Project& project, Effect effect, std::optional<bool> override) {
  const char* state = !override ? tr("as the scene calls for") : *override ? tr("on") : tr("off");
  Edit edit{project, fmt::format("{}: {}", tr(labelOf(effect)), state)};
  if (override)
    edit.project.effects[effect] = *override;
  else
    edit.project.effects.erase(effect);
  return edit;
}

Edit setScene(const Project& project, const std::filesystem::path& scene) {
  Edit edit{project, trf("Model: {}", scene.filename().string())};
  edit.project.scene = scene;
  return edit;
}

Edit setImport(const Project& project, const ImportOptions& import, const char* field) {
  Edit edit{project, trf("Import: {}", field)};
  edit.project.import = import;
  return edit;
}

}  // namespace acentric::editor
