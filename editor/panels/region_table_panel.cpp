#include "editor/panels/region_table_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "editor/overlays/bake_signs.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

namespace palette = ui::palette;

constexpr std::array<std::pair<const char*, RegionColumn>, 8> kColumns{
    {{"##light", RegionColumn::budget},
     {trLater("Region"), RegionColumn::name},
     {trLater("Kind"), RegionColumn::kind},
     {trLater("Triangles"), RegionColumn::triangles},
     {trLater("Cameras"), RegionColumn::cameras},
     {trLater("On disk"), RegionColumn::bytes},
     {trLater("Holes"), RegionColumn::holes},
     {trLater("Baked"), RegionColumn::state}}};
constexpr std::array<float, 8> kWidths{20, 68, 88, 68, 70, 60, 48, 72};

/// A sign of its own for each: a check mark, an exclamation mark in a triangle, a cross.
void drawLight(BudgetLight light) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const float line = ImGui::GetTextLineHeight();
  const ImVec2 at(from.x + 8, from.y + line / 2);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImGui::Dummy({16, line});
  switch (light) {
    case BudgetLight::unknown:
      list.AddLine({at.x - 4, at.y}, {at.x + 4, at.y}, palette::faint.packed(), 1.5F);
      return ui::tooltip(tr("No budget is set, or its triangles are being counted."));
    case BudgetLight::within:
      drawBakeSign(list, at, BakeState::baked, 6);
      return ui::tooltip(tr("Within the budget"));
    case BudgetLight::near: {
      const ImU32 ink = palette::warning.packed();
      list.AddTriangle({at.x, at.y - 6.5F}, {at.x + 7, at.y + 5.5F}, {at.x - 7, at.y + 5.5F}, ink, 1.6F);
      list.AddLine({at.x, at.y - 2.5F}, {at.x, at.y + 1.5F}, ink, 1.5F);
      list.AddCircleFilled({at.x, at.y + 3.6F}, 0.9F, ink);
      return ui::tooltip(tr("Above four fifths of the budget"));
    }
    case BudgetLight::over:
      drawBakeSign(list, at, BakeState::failed, 6);
      return ui::tooltip(tr("Over the budget"));
  }
}

void rightText(const std::string& text, const ui::Colour& colour = palette::text) {
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  const float room = ImGui::GetContentRegionAvail().x;
  if (room > width) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - width - 4);
  ImGui::PushStyleColor(ImGuiCol_Text, colour.vec());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

}  // namespace

void RegionTablePanel::update(PanelContext& context) {
  Session& session = context.session();
  const auto& layout = session.built()->layout;
  const auto inspection = session.inspection();
  const auto coverage = session.coverage();
  if (layout == layout_ && session.captures() == captures_ && inspection == inspection_ &&
      coverage == coverage_)
    return;
  layout_ = layout;
  captures_ = session.captures();
  inspection_ = inspection;
  coverage_ = coverage;
  std::vector<BakeState> states;
  if (captures_ && captures_->cameras.size() == layout->cameras.size())
    states = regionStates(*layout, *captures_, bakeMarks(session.bakeQueue(), session.built()->keys));
  rows_ = regionRows(*layout, captures_.get(), states, inspection.get(), coverage.get());
  sorted_ = false;
}

void RegionTablePanel::drawHead(PanelContext& context) {
  Session& session = context.session();
  const auto budget = std::size_t(session.project().budget.trianglesPerRegion);
  const auto over = std::ranges::count_if(
      rows_, [&](const RegionRow& row) { return lightOf(row, budget) == BudgetLight::over; });
  std::string text = trf("{} regions", ui::formatCount(rows_.size()));
  if (!inspection_) text += tr(", counting triangles");
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text.c_str());
  ImGui::SameLine(0, 14);
  if (budget == 0)
    ui::mutedText(tr("no triangle budget is set"));
  else
    ui::badge(over > 0 ? palette::danger : palette::good,
              trf("{} over {} triangles", ui::formatCount(std::uint64_t(over)), ui::formatCount(budget)));
}

void RegionTablePanel::drawRow(PanelContext& context, const RegionRow& row, std::size_t budget) {
  EditorState& state = context.state();
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const BudgetLight light = lightOf(row, budget);
  ImGui::PushID(row.region);
  const bool selected = state.selection.contains(row.cell);
  const float start = ImGui::GetCursorPosX();
  const bool clicked = ImGui::Selectable("##row", selected, ImGuiSelectableFlags_SpanAllColumns);
  if (context.log.on())
    context.log.item(fmt::format("table.{}.{}.{}", row.cell.i, row.cell.j, row.cell.slot));
  if (clicked) {
    state.selection = {row.cell};
    state.frameCell = row.cell;
  }
  ImGui::SameLine();
  ImGui::SetCursorPosX(start);
  drawLight(light);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(nameOf(row.cell).c_str());
  ImGui::TableNextColumn();
  ui::mutedText(nameOf(row.kind));
  ImGui::TableNextColumn();
  rightText(row.triangles ? ui::formatCount(*row.triangles) : "…",
            light == BudgetLight::over ? palette::danger : palette::text);
  ImGui::TableNextColumn();
  rightText(std::to_string(row.cameras));
  ImGui::TableNextColumn();
  rightText(row.bytes > 0 ? ui::formatBytes(row.bytes) : tr("none"),
            row.bytes > 0 ? palette::text : palette::faint);
  ImGui::TableNextColumn();
  rightText(row.holes ? ui::formatPercent(*row.holes) : "–", row.holes ? palette::text : palette::faint);
  ImGui::TableNextColumn();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  drawBakeSign(*ImGui::GetWindowDrawList(), {at.x + 6, at.y + ImGui::GetTextLineHeight() / 2}, row.state,
               4.5F);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 18);
  ui::mutedText(nameOf(row.state));
  ImGui::PopID();
}

void RegionTablePanel::drawRows(PanelContext& context, float height) {
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_Sortable | ImGuiTableFlags_ScrollY |
                                     ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV |
                                     ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoSavedSettings;
  if (!ImGui::BeginTable("##regions", int(kColumns.size()), kFlags, {0, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  for (std::size_t c = 0; c < kColumns.size(); ++c) {
    ImGuiTableColumnFlags flags =
        ImGuiTableColumnFlags_PreferSortDescending | ImGuiTableColumnFlags_WidthFixed;
    if (kColumns[c].second == RegionColumn::triangles) flags |= ImGuiTableColumnFlags_DefaultSort;
    const char* const label = tr(kColumns[c].first);
    const float width = std::max(kWidths[c], ImGui::CalcTextSize(label, nullptr, true).x + 2);
    ImGui::TableSetupColumn(label, flags, width, ImGuiID(c));
  }
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (std::size_t c = 0; c < kColumns.size(); ++c) {
    ImGui::TableSetColumnIndex(int(c));
    ImGui::TableHeader(tr(kColumns[c].first));
    context.log.item(fmt::format("table.column{}", c));
    if (kColumns[c].second == RegionColumn::triangles)
      ui::tooltip(tr("Of local geometry: within the region and its near band."));
    if (kColumns[c].second == RegionColumn::holes)
      ui::tooltip(
          tr("Predicted share of what is seen from the region that no capture shows; known while the "
             "overlay is the coverage of surfaces."));
    if (kColumns[c].second == RegionColumn::bytes)
      ui::tooltip(
          tr("Of the captures that the region shows; one that serves several regions counts for each."));
  }
  if (ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs(); specs != nullptr && specs->SpecsCount > 0) {
    column_ = kColumns[specs->Specs[0].ColumnUserID].second;
    descending_ = specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
    if (specs->SpecsDirty || !sorted_) {
      sortRows(rows_, column_, descending_);
      if (!rows_.empty()) context.log.event("table", fmt::format("first {}", nameOf(rows_.front().cell)));
    }
    specs->SpecsDirty = false;
    sorted_ = true;
  }
  const auto budget = std::size_t(context.session().project().budget.trianglesPerRegion);
  ImGuiListClipper clipper;
  clipper.Begin(int(rows_.size()));
  while (clipper.Step())
    for (int r = clipper.DisplayStart; r < clipper.DisplayEnd; ++r)
      drawRow(context, rows_[std::size_t(r)], budget);
  ImGui::EndTable();
}

void RegionTablePanel::draw(PanelContext& context, const ImVec2& at, const ImVec2& size) {
  update(context);
  ImGui::SetCursorPos(at);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, palette::panel.vec());
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10, 6});
  if (ImGui::BeginChild("##regionTable", size, false, ImGuiWindowFlags_AlwaysUseWindowPadding)) {
    drawHead(context);
    const float foot = ImGui::GetFrameHeightWithSpacing();
    drawRows(context, std::max(40.0F, ImGui::GetContentRegionAvail().y - foot));
    actionButton(context, "budget.fit", ButtonLook::plain, {}, tr("Fit to budget"));
    ImGui::SameLine();
    actionButton(context, "budget.split", ButtonLook::plain, {}, tr("Split"));
    ImGui::SameLine();
    actionButton(context, "edit.selectOverBudget", ButtonLook::plain, {}, tr("Select what is over"));
  }
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

}  // namespace acentric::editor
