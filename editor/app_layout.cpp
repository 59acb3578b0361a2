/// How the window's panes lie beside each other.
#include <algorithm>

#include "editor/actions/menu_actions.h"
#include "editor/app.h"
#include "editor/panels/bake_panel.h"
#include "editor/panels/bottom_tabs.h"
#include "editor/panels/report_panel.h"
#include "editor/panels/settings_panel.h"
#include "editor/panels/status_bar.h"
#include "editor/panels/walk_facts.h"
#include "editor/panels/welcome.h"
#include "ui/splitter.h"

namespace acentric::editor {

void App::drawBottom(PanelContext& context, const PaneSizes& panes) {
  if (session_.shippedWalk()) {  // nothing to bake or to report of
    if (beginPane("##messagesPane", {0, panes.bottom})) drawBottomTabs(context);
    return endPane();
  }
  const float gap = 2;
  if (beginPane("##bakePane", {panes.bake, panes.bottom})) drawBakePanel(context);
  endPane();
  if (panes.report > 0) {
    ImGui::SameLine(0, gap);
    if (beginPane("##reportPane", {panes.report, panes.bottom})) drawReportPanel(context);
    endPane();
  }
  if (panes.messages > 0) {
    ImGui::SameLine(0, gap);
    if (beginPane("##messagesPane", {panes.messages, panes.bottom})) drawBottomTabs(context);
    endPane();
  }
}

void App::drawCentre(PanelContext& context, const ImVec2& size) {
  if (beginPane("##centrePane", size, false)) centre_.draw(context);
  endPane();
}

void App::drawWalk(PanelContext& context, const ImVec2& size) {
  if (beginPane("##walkPane", size, false)) walk_.draw(context);
  endPane();
}

void App::drawPanels(PanelContext& context, const PaneSizes& panes, float width) {
  drawCentre(context, {std::max(1.0F, panes.plan), panes.upper});
  if (panes.walk <= 0) return;
  ImGui::SameLine(0, 0);
  const float scale = window_->look().scale;
  float walk = panes.walk;
  if (ui::splitter("##split2", ui::SplitDirection::horizontal, panes.upper, walk, 240 * scale,
                   width - 300 * scale, true))
    session_.preferences().walkWidth = walk / scale;
  ImGui::SameLine(0, 0);
  drawWalk(context, {panes.walk, panes.upper});
}

void App::drawFour(PanelContext& context, const PaneSizes& panes, float width, float height) {
  Preferences& wanted = session_.preferences();
  const float bar = ui::splitterPixels();
  // Shares are remembered, not lengths.
  const auto split = [](const char* id, ui::SplitDirection direction, float length, float shown, float whole,
                        float& share) {
    float size = shown;
    const float least = Preferences::kLeastShare * whole;
    if (ui::splitter(id, direction, length, size, least, whole - least)) share = size / whole;
  };
  const auto view = [&](const char* id, View which, const ImVec2& size) {
    if (beginPane(id, size, false)) centre_.drawAlone(context, which);
    endPane();
  };
  const auto upright = [&](const char* id, float length) {
    ImGui::SameLine(0, 0);
    split(id, ui::SplitDirection::horizontal, length, panes.plan, width - bar, wanted.fourColumn);
    ImGui::SameLine(0, 0);
  };
  view("##planPane", View::plan, {panes.plan, panes.upper});
  if (panes.walk > 0) {
    upright("##split4", panes.upper);
    drawWalk(context, {panes.walk, panes.upper});
  }
  if (panes.lower <= 0) return;
  split("##split5", ui::SplitDirection::vertical, width, panes.upper, height - bar, wanted.fourRow);
  view("##scenePane", View::scene3d, {panes.plan, panes.lower});
  if (panes.walk <= 0) return;
  upright("##split6", panes.lower);
  view("##accuracyPane", View::accuracy, {panes.walk, panes.lower});
}

float App::drawLayout(PanelContext& context, float top) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float scale = window_->look().scale;
  const float bar = ui::splitterPixels();
  const float status = state_.fullScreen ? 0 : statusBarPixels();
  const float height = std::max(1.0F, display.y - top - status);
  Preferences& wanted = session_.preferences();
  const Arrangement arrangement = arrangementOf(context.actions);
  PaneSizes panes = paneSizes(arrangement, display.x, height, bar, wanted, scale);
  panes.upper = std::max(1.0F, panes.upper);
  // Sizes are remembered unscaled.
  const auto split = [scale](const char* id, ui::SplitDirection direction, float length, float shown,
                             float& kept, float least, float most, bool sizesNext) {
    float size = shown;
    if (ui::splitter(id, direction, length, size, least * scale, most, sizesNext)) kept = size / scale;
  };
  using enum ui::SplitDirection;
  if (panes.settings > 0) {
    if (beginPane("##settingsPane", {panes.settings, height})) {
      if (session_.shippedWalk())
        drawWalkFacts(context);
      else
        drawSettingsPanel(context, configurations_);
    }
    endPane();
    ImGui::SameLine(0, 0);
    split("##split1", horizontal, height, panes.settings, wanted.settingsWidth, 220, display.x * 0.4F, false);
    ImGui::SameLine(0, 0);
  }
  ImGui::BeginGroup();
  const float width = std::max(1.0F, display.x - (panes.settings > 0 ? panes.settings + bar : 0));
  if (!session_.hasProject()) {
    if (beginPane("##welcomePane", {width, panes.upper})) drawWelcome(context);
    endPane();
  } else if (arrangement == Arrangement::panels) {
    drawPanels(context, panes, width);
  } else if (arrangement == Arrangement::four) {
    drawFour(context, panes, width, height);
  } else if (arrangement == Arrangement::centre) {
    drawCentre(context, {width, panes.upper});
  } else {
    drawWalk(context, {width, panes.upper});
  }
  if (panes.bottom > 0) {
    split("##split3", vertical, width, panes.bottom, wanted.bottomHeight, 120, height * 0.6F, true);
    drawBottom(context, panes);
  }
  ImGui::EndGroup();
  return top + panes.upper;
}

}  // namespace acentric::editor
