#include "editor/panels/settings_parts.h"

#include <fmt/format.h>

#include <algorithm>

#include "ui/translate.h"

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
  const bool open = ui::section((tr(label) + std::string("###") + label).c_str(), openAtFirst);
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
      ImGui::TreeNodeEx((tr("Advanced") + std::string("###Advanced") + section).c_str(),
                        ImGuiTreeNodeFlags_NoTreePushOnOpen | ImGuiTreeNodeFlags_SpanAvailWidth |
                            ImGuiTreeNodeFlags_FramePadding);
  ImGui::PopStyleColor();
  logSection(context, name);
  if (asked) ImGui::SetScrollHereY(0.1F);
  if (changed.empty()) return open;
  std::vector<std::string> shown(changed.size());
  std::ranges::transform(changed, shown.begin(), [](const std::string& each) { return tr(each); });
  const std::string all = trf("Not as usual: {}", fmt::join(shown, ", "));
  ui::tooltip(all);
  ImGui::SameLine(ui::scaled(112));
  ui::badge(ui::palette::accent, trf("{} changed", changed.size()));
  ui::tooltip(all);
  return open;
}

}  // namespace acentric::editor
