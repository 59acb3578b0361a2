#include "editor/panels/accuracy_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "editor/actions/accuracy_actions.h"
#include "editor/panels/accuracy_plot.h"
#include "engine/image/image.h"
#include "ui/image_view.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

namespace palette = ui::palette;

constexpr float kButtonGap = 4, kApart = 14, kCard = 290;
constexpr std::array<std::pair<const char*, const char*>, 3> kPresets{
    {{"preset.fast", trLater("Fast")},
     {"preset.balanced", trLater("Balanced")},
     {"preset.accurate", trLater("Accurate")}}};

std::string labelOf(const MeasureInfo& info) {
  return info.unit[0] == '\0' ? tr(info.label) : fmt::format("{}, {}", tr(info.label), info.unit);
}

std::string textOf(const MeasureInfo& info, double value) {
  return fmt::format("{:.{}f}{}{}", value * info.shown, info.digits, info.unit[0] == '\0' ? "" : " ",
                     info.unit);
}

void chooseMeasure(PanelContext& context, const char* id, bool error, Measure& chosen) {
  ImGui::SetNextItemWidth(ui::scaled(116));
  const bool open = ImGui::BeginCombo(fmt::format("##{}", id).c_str(), labelOf(infoOf(chosen)).c_str());
  context.log.item(id);
  if (!open) return;
  for (const MeasureInfo& info : measures()) {
    if (info.error != error) continue;
    if (ImGui::Selectable(labelOf(info).c_str(), info.measure == chosen)) chosen = info.measure;
    context.log.item(fmt::format("{}.{}", id, info.name));
  }
  ImGui::EndCombo();
}

void drawNumber(PanelContext& context, const char* id, const char* format, const char* help, int least,
                int most, int& value) {
  ImGui::SetNextItemWidth(ui::scaled(84));
  ImGui::DragInt(fmt::format("##{}", id).c_str(), &value, 0.1F, least, most, format,
                 ImGuiSliderFlags_AlwaysClamp);
  context.log.item(id);
  ui::tooltip(help);
}

void drawToolbar(PanelContext& context) {
  AccuracyState& state = context.state().accuracy;
  const SweepWatch& watch = context.session().sweeping();
  if (watch.running())
    actionButton(context, "sweep.stop", ButtonLook::plain, {},
                 watch.stopping() ? tr("Stopping") : tr("Stop"));
  else
    actionButton(context, "sweep.start", ButtonLook::primary, {},
                 watch.sweep() ? tr("Go on") : tr("Measure"));
  ImGui::SameLine(0, ui::scaled(kButtonGap));
  actionButton(context, "sweep.again", ButtonLook::plain, {}, tr("Anew"));
  ImGui::SameLine(0, ui::scaled(kApart));
  drawNumber(context, "sweep.minutes", trPrintf("%d minutes"),
             tr("How long it may take. What does not fit is left for another time."), 1, 24 * 60,
             state.request.minutes);
  ImGui::SameLine(0, ui::scaled(kButtonGap));
  drawNumber(context, "sweep.frames", trPrintf("%d frames"),
             tr("Of the walk, evenly chosen, that settings are compared in."), 1, 1000, state.request.frames);
  ImGui::SameLine(0, ui::scaled(kApart));
  if (ImGui::GetContentRegionAvail().x < ui::scaled(310)) ImGui::NewLine();
  ImGui::AlignTextToFramePadding();
  chooseMeasure(context, "accuracy.error", true, state.error);
  ImGui::SameLine(0, ui::scaled(6));
  ui::mutedText(tr("against"));
  ImGui::SameLine(0, ui::scaled(6));
  chooseMeasure(context, "accuracy.cost", false, state.cost);
}

void drawState(const SweepWatch& watch) {
  if (!watch.trouble().empty()) return ui::wrappedText(palette::danger, watch.trouble());
  const auto& sweep = watch.sweep();
  std::string text;
  if (sweep) {
    const auto measured = std::ranges::count_if(sweep->points, &SweepPoint::measured);
    text =
        trf("{} settings measured, {} left out; {} frames of {}×{} along {}, against {} rays a pixel; {}, {} "
            "threads",
            measured, std::ssize(sweep->points) - measured, sweep->frames, sweep->width, sweep->height,
            sweep->path, sweep->truthSamples, sweep->processor, sweep->threads);
  }
  if (watch.running())
    text = fmt::format("{} {}", watch.stopping() ? tr("Ending.") : tr("Measuring in the background."), text);
  ui::wrappedText(palette::muted, text);
  if (!sweep) return;
  std::string leftOut;
  for (const SweepPoint& point : sweep->points)
    if (!point.measured()) leftOut += fmt::format("{}: {}\n", textOf(point.setting), point.skipped);
  if (!leftOut.empty()) ui::tooltip(trf("Left out:\n{}", leftOut));
}

void drawEmpty(PanelContext& context) {
  const auto line = [&](ImFont* font, const ui::Colour& colour, const std::string& text) {
    ImGui::PushFont(font);
    const float width = std::min(ImGui::GetContentRegionAvail().x, ui::scaled(520));
    ImGui::SetCursorPosX((ImGui::GetWindowSize().x - width) / 2);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
    ImGui::PushStyleColor(ImGuiCol_Text, colour.vec());
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    ImGui::PopFont();
    ImGui::Dummy({0, ui::scaled(6)});
  };
  ImGui::SetCursorPosY(ImGui::GetWindowSize().y * 0.28F);
  const ui::Fonts& fonts = context.window.fonts();
  const bool running = context.session().sweeping().running();
  line(fonts.title, palette::text,
       running ? tr("Measuring the project as it is") : tr("What does accuracy cost here?"));
  line(fonts.regular, palette::muted,
       running ? tr("The first mark appears when its captures are there and its frames are compared.")
               : tr("Measure tries settings of the bake and of the walk one by one, then together: the same "
                    "frames, "
                    "against ray-traced truth, in the background. Marks show error against time; three "
                    "presets come "
                    "out of it."));
  if (!running && context.session().hasProject() &&
      (context.session().untitled() || context.session().dirty()))
    line(fonts.regular, palette::warning, tr("Save the project first: it is measured as it is in its file."));
}

PlotMark markOf(const SweepPoint& point, const AccuracyState& state,
                const std::vector<SweepPreset>& presets) {
  const double across = infoOf(state.cost).shown;
  const Spread& x = point[state.cost];
  PlotMark mark;
  mark.x = x.median * across, mark.xLow = x.min * across, mark.xHigh = x.max * across;
  mark.y = mark.yLow = mark.yHigh = point[state.error].median * infoOf(state.error).shown;
  const auto name = [&mark](const std::string& word) { mark.name += (mark.name.empty() ? "" : ", ") + word; };
  for (const SweepPreset& preset : presets)
    if (preset.setting == point.setting) name(preset.name);
  if (point.setting.empty()) mark.base = true, name(tr("as it is"));
  mark.selected = state.selected == point.setting;
  return mark;
}

}  // namespace

void AccuracyPanel::drawPlot(PanelContext& context, const Sweep& sweep, const ImVec2& low,
                             const ImVec2& high) {
  AccuracyState& state = context.state().accuracy;
  const MeasureInfo &error = infoOf(state.error), &cost = infoOf(state.cost);
  const auto presets = presetsOf(sweep);
  std::vector<PlotMark> marks;
  std::vector<std::size_t> points;
  std::vector<Objectives> objectives;
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    const SweepPoint& point = sweep.points[i];
    const Spread &x = point[state.cost], &y = point[state.error];
    if (!point.measured() || x.count == 0 || y.count == 0 || x.min <= 0) continue;
    points.push_back(i);
    marks.push_back(markOf(point, state, presets));
    objectives.push_back({marks.back().x, error.moreIsBetter ? -marks.back().y : marks.back().y});
  }
  for (const std::size_t i : paretoFront(objectives)) marks[i].front = true;  // of the two that are shown
  if (marks.empty()) {
    ImGui::SetCursorScreenPos(low);
    return ui::mutedText(tr("Nothing that was measured has both."));
  }
  const PlotAxis across{labelOf(cost), true};
  const PlotAxis up{
      labelOf(error) + (error.moreIsBetter ? tr("  (more is better)") : tr("  (less is better)")), false};
  const AccuracyPlot plot = drawAccuracyPlot(low, high, across, up, marks);
  if (context.log.on())
    for (std::size_t i = 0; i < plot.places.size(); ++i) {
      const ImVec2& at = plot.places[i];
      context.log.rect(fmt::format("accuracy.mark{}", points[i]), at.x - 3, at.y - 3, at.x + 3, at.y + 3);
    }
  shown_ = state.selected.value_or(SweepSetting{});
  if (!plot.hovered) return;
  shown_ = sweep.points[points[*plot.hovered]].setting;
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) state.selected = shown_;
}

void AccuracyPanel::drawPicture(PanelContext& context, const SweepPoint& point) {
  if (point.pictures.empty()) return;
  const bool difference = context.state().accuracy.difference;
  const auto& watch = context.session().sweeping();
  const auto file = watch.folder() / (point.pictures + (difference ? "-difference.jpg" : ".jpg"));
  if (file != pictureFile_ || watch.sweep() != pictureOf_) {
    pictureFile_ = file;
    pictureOf_ = watch.sweep();
    picture_.clear();
    if (const auto picture = readColourImage(file))
      picture_.upload(picture->width, picture->height,
                      {&picture->pixels.front().x, picture->pixels.size() * sizeof(Rgba8)});
  }
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = width * 9 / 16;
  ImGui::InvisibleButton("##worst", {width, height});
  context.log.item("accuracy.picture");
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + height}, palette::backdrop.packed());
  if (!picture_.empty())
    ui::drawImage(picture_.imguiId(),
                  ui::fitImage({at.x, at.y}, {width, height}, double(picture_.width()) / picture_.height()),
                  false);
  if (ui::toggleButton(tr("Difference"), difference)) context.state().accuracy.difference = !difference;
  context.log.item("accuracy.difference");
  ui::tooltip(tr("From the truth, amplified, instead of the frame"));
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ui::mutedText(trf("worst frame: {} of {}", point.worstFrame + 1, pictureOf_->frames));
}

void AccuracyPanel::drawPoint(PanelContext& context, const Sweep& sweep, const SweepPoint& point) {
  ImGui::PushFont(context.window.fonts().bold);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(point.setting.empty() ? tr("The project as it was measured") : tr("Changed"));
  ImGui::PopTextWrapPos();
  ImGui::PopFont();
  for (const KnobChoice& choice : point.setting) ui::keyValue(choice.knob.c_str(), choice.value, 170);
  drawPicture(context, point);
  const SweepPoint& base = sweep.points.front();
  for (const MeasureInfo& info : measures()) {
    const Spread& value = point[info.measure];
    if (value.count == 0) continue;
    std::string text = textOf(info, value.median);
    if (value.max > value.min && !info.error)
      text += trf("  ({:.{}f} to {:.{}f})", value.min * info.shown, info.digits, value.max * info.shown,
                  info.digits);
    if (info.measure == Measure::bakeSeconds && point.bakeEstimated) text += tr("  foretold");
    ui::keyValue(tr(info.label), text, 100);
    const Spread& before = base[info.measure];
    if (info.error)
      ui::tooltip(trf("Median of {}; worst {}", value.count,
                      textOf(info, info.moreIsBetter ? value.min : value.max)));
    if (!point.setting.empty() && before.count > 0 && before.median != 0 && !info.error) {
      ImGui::SameLine();
      ui::mutedText(fmt::format("×{:.2f}", value.median / before.median));
    }
  }
  const bool apply =
      ui::button(tr("Apply to the project"), {ImGui::GetContentRegionAvail().x, 0}, !point.setting.empty());
  context.log.item("accuracy.apply");
  ui::tooltip(tr("Sets the project so; undo takes it back. What bakes has to be baked again."));
  if (apply) applySetting(context.actions, point.setting, trf("Use {}", textOf(point.setting)));
}

void AccuracyPanel::draw(PanelContext& context) {
  const SweepWatch& watch = context.session().sweeping();
  const auto sweep = watch.sweep();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ui::scaled({10, 8}));
  const bool open = ImGui::BeginChild("##accuracy", {0, 0}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  ImGui::PopStyleVar();
  if (open) {
    drawToolbar(context);
    drawState(watch);
    const SweepPoint* shown = sweep ? sweep->find(shown_) : nullptr;
    if (!sweep || std::ranges::none_of(sweep->points, &SweepPoint::measured)) {
      drawEmpty(context);
    } else {
      const float foot = ImGui::GetFrameHeightWithSpacing();
      const ImVec2 at = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
      const float card = std::min(ui::scaled(kCard), room.x * 0.45F);
      drawPlot(context, *sweep, at, {at.x + room.x - card - ui::scaled(8), at.y + room.y - foot});
      ImGui::SetCursorScreenPos({at.x, at.y + room.y - foot + ImGui::GetStyle().ItemSpacing.y});
      ImGui::AlignTextToFramePadding();
      ui::mutedText(tr("Presets"));
      for (const auto& [id, label] : kPresets) {
        ImGui::SameLine(0, ui::scaled(6));
        actionButton(context, id, ButtonLook::plain, {}, tr(label));
      }
      ImGui::SetCursorScreenPos({at.x + room.x - card, at.y});
      if (ImGui::BeginChild("##accuracyPoint", {card, room.y}) && shown && shown->measured())
        drawPoint(context, *sweep, *shown);
      ImGui::EndChild();
    }
  }
  ImGui::EndChild();
}

}  // namespace acentric::editor
