#include "editor/panels/configuration_picker.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "editor/commands/layout_edits.h"
#include "editor/session/configuration_facts.h"
#include "engine/layout/images_per_view.h"
#include "ui/canvas_draw.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

namespace palette = ui::palette;

constexpr int kConfigurations = int(Configuration::g) + 1;
constexpr float kThumb = 92, kRowGap = 8, kTextWidth = 330;

/// One tiling, as far as it shows in a square of 5 edge lengths.
void drawThumb(ImDrawList& list, const ImVec2& at, float size, const Layout& patch) {
  constexpr double kEdges = 5;
  ui::CanvasView view;
  view.setArea(ui::fromIm(at), {size, size});
  const glm::dvec2 half(kEdges / 2 * patch.spec.cellSize);
  view.fit(patch.spec.latticeOrigin - half, patch.spec.latticeOrigin + half, 0);
  list.PushClipRect(at, {at.x + size, at.y + size}, true);
  list.AddRectFilled(at, {at.x + size, at.y + size}, palette::backdrop.packed());
  for (const Region& region : patch.regions) {
    const bool ring = region.kind == RegionKind::ring;
    ui::drawConvex(list, view, region.polygon.corners,
                   (ring ? palette::accent : palette::warning).withOpacity(ring ? 0.26F : 0.20F),
                   palette::text.withOpacity(0.5F), 1);
  }
  for (const LayoutCamera& camera : patch.cameras) {
    const ImVec2 place = ui::imVec(view.screenFromWorld(camera.position));
    const auto low = float(-camera.lowAzimuth - camera.fovRadians);
    list.PathLineTo(place);
    list.PathArcTo(place, 6, low, float(-camera.lowAzimuth), 6);
    list.PathFillConvex(palette::good.withOpacity(0.55F).packed());
  }
  for (const LayoutCamera& camera : patch.cameras)
    list.AddCircleFilled(ui::imVec(view.screenFromWorld(camera.position)), 1.8F, palette::good.packed(), 8);
  list.PopClipRect();
  list.AddRect(at, {at.x + size, at.y + size}, palette::border.packed(), 2);
}

std::string textOf(const ConfigurationFacts& facts, const std::optional<LaidCounts>& laid,
                   const PixelCost& cost) {
  std::string text = laid ? trf("{} regions, {} cameras here; per", ui::formatCount(laid->regions),
                                ui::formatCount(laid->cameras))
                          : std::string(tr("Per"));
  text += trf(" m² {:.2f} regions, {:.2f} cameras", facts.regions, facts.cameras);
  const std::string pixels = trf("{} thousand", ui::formatCount(std::uint64_t(facts.pixels / 1000)));
  text += cost.samples ? trf(", about {} thousand samples",
                             ui::formatCount(std::uint64_t(facts.pixels * *cost.samples / 1000)))
                       : trf(", {} pixels to trace", pixels);
  if (cost.bytes) text += trf(", about {}", ui::formatBytes(std::uint64_t(facts.pixels * *cost.bytes)));
  return text;
}

std::string imagesText(Configuration configuration) {
  const ImagesPerView& images = imagesPerView(configuration);
  return trf("Images that a view is painted from\n60° wide: {}\n90° wide: {}", sharesText(images.at60),
             sharesText(images.at90));
}

PixelCost costOf(Session& session) {
  PixelCost cost;
  const OpenProject& open = *session.built();
  if (const BakeEstimate* estimate = session.estimate(); estimate != nullptr && estimate->pixels > 0) {
    cost.samples = estimate->samples.value / estimate->pixels;
    cost.bytes = estimate->captureBytes.value / estimate->pixels;
  }
  if (const auto& captures = session.captures())
    if (const auto bytes = bytesPerPixel(*open.layout, captures->cameras, captures->bytes, open.scene->bounds,
                                         open.project.bake))
      cost.bytes = bytes;
  return cost;
}

}  // namespace

void ConfigurationPicker::prepare(Session& session) {
  entries_.clear();
  for (int c = 0; c < kConfigurations; ++c) {
    Entry entry;
    entry.patch = patchOf(session.project().layout(), Configuration(c));
    entry.facts = factsOf(entry.patch, session.built()->scene->bounds, session.project().bake);
    entries_.push_back(std::move(entry));
  }
  cost_ = costOf(session);
}

/// A row of the list; true if it was chosen.
bool ConfigurationPicker::drawChoice(PanelContext& context, Configuration configuration) {
  Session& session = context.session();
  const LayoutSpec& spec = session.project().layout();
  Entry& entry = entries_[std::size_t(configuration)];
  ImGui::PushID(int(configuration));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float thumb = ui::scaled(kThumb);
  const bool chosen = ImGui::Selectable("##choice", spec.configuration == configuration,
                                        ImGuiSelectableFlags_None, {thumb + ui::scaled(kTextWidth), thumb});
  const bool hovered = ImGui::IsItemHovered();
  ui::tooltip(imagesText(configuration));
  context.log.item(fmt::format("configuration.{}", nameOf(configuration)));
  if (hovered && !std::exchange(entry.counted, true))
    entry.laid = laidCounts(spec, configuration, entry.facts);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  drawThumb(list, at, thumb, entry.patch);
  ImFont* bold = context.window.fonts().bold;
  ImFont* small = context.window.fonts().small;
  const float x = at.x + thumb + ui::scaled(12), room = ui::scaled(kTextWidth - 18);
  list.AddText(bold, bold->FontSize, {x, at.y + ui::scaled(1)}, palette::text.packed(),
               nameOf(configuration));
  list.AddText(small, small->FontSize, {x + ui::scaled(18), at.y + ui::scaled(3)}, palette::muted.packed(),
               tr(describe(configuration)));
  list.AddText(small, small->FontSize, {x, at.y + ui::scaled(21)}, palette::text.packed(),
               adviceOn(configuration), nullptr, room);
  list.AddText(small, small->FontSize, {x, at.y + ui::scaled(54)}, palette::muted.packed(),
               textOf(entry.facts, entry.laid, cost_).c_str(), nullptr, room);
  if (hovered) context.state().trial = setConfiguration(session.project(), configuration).project.layout();
  ImGui::PopID();
  return chosen;
}

void ConfigurationPicker::draw(PanelContext& context, float labelWidth) {
  Session& session = context.session();
  context.state().trial.reset();
  ImGui::AlignTextToFramePadding();
  ui::mutedText(tr("Configuration"));
  ImGui::SameLine(ui::scaled(labelWidth));
  const char* name = nameOf(session.project().layout().configuration);
  if (ui::button(trf("{}   choose…##configuration", name).c_str(), {ImGui::GetContentRegionAvail().x, 0},
                 session.built() != nullptr)) {
    prepare(session);
    ImGui::OpenPopup("##configurations");
  }
  context.log.item("settings.configuration");
  ui::tooltip(tr("How panoramas are placed: angle of a camera and the polygons of the lattice."));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ui::scaled(ImVec2(12, 10)));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ui::scaled(ImVec2(8, kRowGap)));
  // Over the settings, so that the plan shows what is pointed at.
  ImGui::SetNextWindowPos({6, ImGui::GetFrameHeight() + 8});
  if (ImGui::BeginPopup("##configurations")) {
    std::optional<Configuration> chosen;
    for (int c = 0; c < kConfigurations; ++c)
      if (drawChoice(context, Configuration(c))) chosen = Configuration(c);
    ui::mutedText(cost_.bytes ? tr("Bytes by what is baked or was estimated so far")
                              : tr("Bytes are predicted after a first bake or an estimate"));
    if (chosen) {
      context.state().trial.reset();
      session.apply(setConfiguration(session.project(), *chosen));
      ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar(2);
  ui::wrappedText(palette::faint, tr(describe(session.project().layout().configuration)));
}

}  // namespace acentric::editor
