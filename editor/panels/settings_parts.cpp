#include "editor/panels/settings_parts.h"

#include <fmt/format.h>

#include <algorithm>

namespace acentric::editor {
namespace {

constexpr const char* kAdvanced = "/Advanced";

void logSection(PanelContext& context, const std::string& label) {
  std::string name = "section." + label;
  std::ranges::replace(name, ' ', '-');
  context.log.item(name);
}

}  // namespace

bool askedSection(PanelContext& context, const char* label, bool openAtFirst) {
  std::string& wanted = context.state().openSection;
  const bool asked = wanted == label;
  if (asked) wanted.clear();
  if (asked || wanted == std::string(label) + kAdvanced) ImGui::SetNextItemOpen(true);
  const bool open = ui::section(label, openAtFirst);
  logSection(context, label);
  if (asked) ImGui::SetScrollHereY(0.1F);
  return open;
}

bool advancedPart(PanelContext& context, const char* section, const std::vector<std::string>& changed) {
  const std::string name = std::string(section) + kAdvanced;
  std::string& wanted = context.state().openSection;
  const bool asked = wanted == name;
  if (asked) {
    wanted.clear();
    ImGui::SetNextItemOpen(true);
  }
  ImGui::PushStyleColor(ImGuiCol_Text, ui::palette::muted.vec());
  const bool open =
      ImGui::TreeNodeEx((std::string("Advanced##") + section).c_str(), ImGuiTreeNodeFlags_NoTreePushOnOpen |
                                                                           ImGuiTreeNodeFlags_SpanAvailWidth |
                                                                           ImGuiTreeNodeFlags_FramePadding);
  ImGui::PopStyleColor();
  logSection(context, name);
  if (asked) ImGui::SetScrollHereY(0.1F);
  if (changed.empty()) return open;
  const std::string all = fmt::format("Not as usual: {}", fmt::join(changed, ", "));
  ui::tooltip(all);
  ImGui::SameLine(ui::scaled(112));
  ui::badge(ui::palette::accent, fmt::format("{} changed", changed.size()));
  ui::tooltip(all);
  return open;
}

}  // namespace acentric::editor
