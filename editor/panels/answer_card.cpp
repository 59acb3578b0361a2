#include "editor/panels/answer_card.h"

#include <fmt/format.h>

#include <algorithm>

#include "editor/session/engine_texts.h"
#include "engine/geometry/conventions.h"
#include "engine/measure/source_colours.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr float kCardWidth = 404, kCardMargin = 12, kCardLabel = 98;

/// As wide as its word in any language.
float buttonWidth(const char* word) {
  return std::max(ui::scaled(64), ImGui::CalcTextSize(word).x + ui::scaled(18));
}

void boldLine(PanelContext& context, const char* text) {
  ImGui::Dummy({0, ui::scaled(2)});
  ImGui::PushFont(context.window.fonts().bold);
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
}

std::string errorsText(const Attribution& errors) {
  std::string text = fmt::format("{:.1f} dB", errors.psnr());
  constexpr double kWorthTelling = 0.05;
  for (std::size_t s = 0; s < kErrorSources; ++s)
    if (const double share = errors.share(ErrorSource(s)); share >= kWorthTelling)
      text += fmt::format("\n{:.0f} % {}", 100 * share, tr(wordsFor(ErrorSource(s))));
  return text;
}

void swatch(const Rgba8& colour) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float side = ImGui::GetTextLineHeight();
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + side, at.y + side},
                                            IM_COL32(colour.r, colour.g, colour.b, 255), ui::scaled(2));
  ImGui::Dummy({side, side});
}

void drawColours(const PictureAnswer& answer) {
  ui::mutedText(tr("Colour"));
  ImGui::SameLine(ui::scaled(kCardLabel));
  swatch(answer.shown);
  ImGui::SameLine(0, ui::scaled(6));
  ImGui::TextUnformatted(tr("here"));
  ImGui::SameLine(0, ui::scaled(14));
  swatch(answer.truth);
  ImGui::SameLine(0, ui::scaled(6));
  ImGui::TextUnformatted(tr("truth"));
}

void drawPainter(const PixelPainter& painter) {
  std::string from = trf("{:.2f} m away, {:.1f}° beside the eye", painter.metres, degrees(painter.radians));
  if (painter.layer > 0) from = trf("layer {}, ", painter.layer) + from;
  ui::keyValue(tr("Captured"), from, kCardLabel);
  const bool few = painter.samplesPerPixel < 1;
  ui::keyValue(tr("Sampling"),
               trf("{:.2f} samples per pixel{}", painter.samplesPerPixel, few ? tr(": too few") : ""),
               kCardLabel);
  ui::tooltip(
      tr("In the direction on the surface in which there are fewest. Below 1 the capture is coarser than "
         "the screen."));
}

void drawAnswer(const PictureQuestion& question, const PictureAnswer& answer) {
  const OpenProject& open = *question.open;
  if (answer.surface) {
    const Mesh& mesh = open.scene->meshOf(answer.surface->mesh);
    const glm::dvec3& at = answer.surface->position;
    ui::keyValue(tr("Surface"), mesh.name.empty() ? tr("without a name") : ui::shortenPath(mesh.name, 34),
                 kCardLabel);
    ui::keyValue("", fmt::format("x {:.2f}  y {:.2f}  z {:.2f} m", at.x, at.y, at.z), kCardLabel);
  }
  if (answer.painter) drawPainter(*answer.painter);
  drawColours(answer);
  if (answer.region >= 0) {
    const Region& region = open.layout->regions[std::size_t(answer.region)];
    const int most = open.project.budget.trianglesPerRegion;
    std::string triangles = ui::formatCount(answer.triangles);
    if (most > 0) triangles += trf(" of {}", ui::formatCount(std::size_t(most)));
    ui::keyValue(tr("Region"), trf("({}, {}), {} triangles", region.id.i, region.id.j, triangles),
                 kCardLabel);
  }
  ui::keyValue(tr("Error here"), errorsText(answer.here), kCardLabel);
  ui::tooltip(trf("Against {} rays per pixel, within {} pixels: how near, and what keeps it from the truth",
                  kAskedRays, kAskedPixels));
}

std::string costText(const BakeForecast& bake) {
  if (bake.nothing()) return tr("is baked already");
  return trf("bakes {} cameras: {}, {}", bake.cameras, ui::formatDuration(bake.seconds()),
             ui::formatBytes(std::uint64_t(bake.bytes())));
}

void apply(PanelContext& context, const PictureQuestion& question, const Improvement& improvement) {
  Session& session = context.session();
  if (session.project() == question.open->project)
    session.apply({improvement.project, trf("Improve: {}", engineText(improvement.what))});
  else
    session.messages().add(MessageLevel::warning, tr("The project has changed since: ask the picture again"));
}

void drawImprovements(PanelContext& context, const PictureQuestion& question,
                      const std::vector<Improvement>& improvements) {
  boldLine(context, tr("What would improve it, as predicted"));
  if (improvements.empty())
    return ui::wrappedText(ui::palette::muted, tr("Nothing that can be set promises more here."));
  for (std::size_t i = 0; i < improvements.size(); ++i) {
    const Improvement& each = improvements[i];
    ImGui::AlignTextToFramePadding();
    ImGui::Text("%.1f dB", each.psnrHere);
    ImGui::SameLine(ui::scaled(kCardLabel));
    ImGui::TextUnformatted(engineText(each.what).c_str());
    ui::tooltip(engineText(each.why));
    const float width = buttonWidth(tr("Apply"));
    ImGui::SameLine(ImGui::GetContentRegionMax().x - width);
    if (ui::button(fmt::format("{}##{}", tr("Apply"), i).c_str(), {width, 0})) apply(context, question, each);
    context.log.item(fmt::format("answer.apply.{}", i));
    ui::tooltip(tr("Changes the project so; undo takes it back. It is seen once it is baked."));
    ImGui::SetCursorPosX(ui::scaled(kCardLabel));
    ui::mutedText(costText(each.bake));
  }
}

}  // namespace

std::pair<ImVec2, ImVec2> drawAnswerCard(PanelContext& context, const ImVec2& areaMin, const ImVec2& areaMax,
                                         float& contentHeight) {
  PictureAsk& asked = context.session().asking();
  if (!asked.question()) return {};
  const float margin = ui::scaled(kCardMargin);
  const ImVec2 room(areaMax.x - areaMin.x - 2 * margin, areaMax.y - areaMin.y - 2 * margin);
  if (room.x < ui::scaled(120) || room.y < ui::scaled(60)) return {};
  const ImVec2 size(std::min(ui::scaled(kCardWidth), room.x), std::min(contentHeight, room.y));
  const bool left = 2 * asked.question()->pixel.x >= asked.question()->view.width;
  const ImVec2 low(left ? areaMin.x + margin : areaMax.x - margin - size.x, areaMin.y + margin);
  ImGui::SetCursorScreenPos(low);
  ImGui::PushStyleColor(ImGuiCol_ChildBg, ui::palette::panel.withOpacity(0.94F).vec());
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ui::scaled(ImVec2(12, 9)));
  ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, ui::scaled(5));
  ImGui::BeginChild("##answer", size, true, ImGuiWindowFlags_AlwaysUseWindowPadding);
  ImGui::PopStyleVar(2);
  bool close = false;
  if (const PictureQuestion question = *asked.question(); asked.answer()) {
    boldLine(context, engineText(sourceName(*question.open->layout, asked.answer()->source)).c_str());
    const float width = buttonWidth(tr("Close"));
    ImGui::SameLine(ImGui::GetContentRegionMax().x - width);
    close = ui::button(tr("Close"), {width, 0});
    context.log.item("answer.close");
    drawAnswer(question, *asked.answer());
    if (asked.improvements())
      drawImprovements(context, question, *asked.improvements());
    else if (asked.problem().empty())
      ui::mutedText(tr("Looking for what would improve it…"));
  } else if (asked.problem().empty()) {
    ui::mutedText(tr("Asking the picture…"));
  }
  if (!asked.problem().empty()) ui::wrappedText(ui::palette::danger, asked.problem());
  const float content = ImGui::GetCursorPosY() + ui::scaled(4);
  ImGui::EndChild();
  ImGui::PopStyleColor();
  context.log.item("answer");
  if (content != contentHeight) context.window.pacer().request();
  contentHeight = content;
  if (close) asked.clear();
  return {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
}

}  // namespace acentric::editor
