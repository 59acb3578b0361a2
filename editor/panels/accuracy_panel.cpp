#include "editor/panels/accuracy_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>

#include "editor/actions/accuracy_actions.h"
#include "editor/panels/accuracy_plot.h"
#include "editor/session/engine_texts.h"
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

/// Four figures are enough of a large one.
std::string numberOf(const MeasureInfo& info, double value) {
  const double shown = value * info.shown;
  return fmt::format("{:.{}f}", shown, shown >= 100 ? std::max(0, info.digits - 1) : info.digits);
}

std::string textOf(const MeasureInfo& info, double value) {
  return fmt::format("{}{}{}", numberOf(info, value), info.unit[0] == '\0' ? "" : " ", info.unit);
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

/// What the panel is about now.
const SweepWatch& watchOf(const PanelContext& context) {
  const Session& session = context.actions.session;
  return context.actions.state.accuracy.goals ? session.proposing() : session.sweeping();
}

/// A goal with a tick: unticked, there is none.
void drawGoal(PanelContext& context, const char* id, const char* label, const char* format, double unit,
              double usual, std::optional<double>& goal) {
  bool wanted = goal.has_value();
  if (ImGui::Checkbox(fmt::format("{}##{}", label, id).c_str(), &wanted))
    goal = wanted ? std::optional(usual * unit) : std::nullopt;
  context.log.item(fmt::format("{}.wanted", id));
  ImGui::SameLine(0, ui::scaled(kButtonGap));
  constexpr float kLeast = 0.1F, kMost = 1e7F;
  auto value = float(goal.value_or(usual * unit) / unit);
  ImGui::BeginDisabled(!wanted);
  ImGui::SetNextItemWidth(ui::scaled(78));
  if (ImGui::DragFloat(fmt::format("##{}", id).c_str(), &value, 0.25F, kLeast, kMost, format,
                       ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic))
    goal = double(value) * unit;
  context.log.item(id);
  ImGui::EndDisabled();
}

void drawGoals(PanelContext& context) {
  Goals& goals = context.state().accuracy.goalsRequest.goals;
  drawGoal(context, "goals.bytes", tr("at most"), "%.0f MB", 1e6, 60, goals.mostBytes);
  ImGui::SameLine(0, ui::scaled(kApart));
  drawGoal(context, "goals.frame", tr("at most"), "%.1f ms", 1, 16, goals.mostFrameMs);
  ui::tooltip(trf("Of the median frame of {} by {} pixels", context.state().accuracy.goalsRequest.width,
                  context.state().accuracy.goalsRequest.height));
  ImGui::SameLine(0, ui::scaled(kApart));
  drawGoal(context, "goals.psnr", tr("at least"), "%.1f dB", 1, 35, goals.leastPsnr);
}

void drawToolbar(PanelContext& context) {
  AccuracyState& state = context.state().accuracy;
  const SweepWatch& watch = watchOf(context);
  for (const auto& [id, label, goals] : {std::tuple("accuracy.all", tr("All settings"), false),
                                         std::tuple("accuracy.goals", tr("Goals"), true)}) {
    if (ui::toggleButton(label, state.goals == goals)) state.goals = goals;
    context.log.item(id);
    ImGui::SameLine(0, ui::scaled(goals ? kApart : kButtonGap));
  }
  SweepRequest& request = state.goals ? state.goalsRequest : state.request;
  AccuracyAxes& axes = state.shownAxes();
  const char* begin = state.goals ? tr("Find") : tr("Measure");
  if (watch.running())
    actionButton(context, state.goals ? "goals.stop" : "sweep.stop", ButtonLook::plain, {},
                 watch.stopping() ? tr("Stopping") : tr("Stop"));
  else
    actionButton(context, state.goals ? "goals.start" : "sweep.start", ButtonLook::primary, {},
                 watch.sweep() ? tr("Go on") : begin);
  if (!state.goals) {
    ImGui::SameLine(0, ui::scaled(kButtonGap));
    actionButton(context, "sweep.again", ButtonLook::plain, {}, tr("Anew"));
  }
  ImGui::SameLine(0, ui::scaled(kApart));
  drawNumber(context, "sweep.minutes", trPrintf("%d minutes"),
             tr("How long it may take. What does not fit is left for another time."), 1, 24 * 60,
             request.minutes);
  ImGui::SameLine(0, ui::scaled(kButtonGap));
  drawNumber(context, "sweep.frames", trPrintf("%d frames"),
             tr("Of the walk, evenly chosen, that settings are compared in."), 1, 1000, request.frames);
  ImGui::SameLine(0, ui::scaled(kApart));
  if (ImGui::GetContentRegionAvail().x < ui::scaled(310)) ImGui::NewLine();
  ImGui::AlignTextToFramePadding();
  chooseMeasure(context, "accuracy.error", true, axes.error);
  ImGui::SameLine(0, ui::scaled(6));
  ui::mutedText(tr("against"));
  ImGui::SameLine(0, ui::scaled(6));
  chooseMeasure(context, "accuracy.cost", false, axes.cost);
  if (state.goals) drawGoals(context);
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
    if (!point.measured())
      leftOut += fmt::format("{}: {}\n", textOf(point.setting), engineText(point.skipped));
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
  const bool running = watchOf(context).running(), goals = context.state().accuracy.goals;
  line(fonts.title, palette::text,
       running ? tr("Measuring the project as it is")
       : goals ? tr("What keeps to your budgets?")
               : tr("What does accuracy cost here?"));
  line(
      fonts.regular, palette::muted,
      running ? tr("The first mark appears when its captures are there and its frames are compared.")
      : goals
          ? tr("Find tries layouts and settings, the most promising first: it bakes what a few frames need, "
               "and compares them with ray-traced truth. The one that keeps to the budgets best is proposed.")
          : tr("Measure tries settings of the bake and of the walk one by one, then together: the same "
               "frames, "
               "against ray-traced truth, in the background. Marks show error against time; three presets "
               "come "
               "out of it."));
  if (!running && context.session().hasProject() &&
      (context.session().untitled() || context.session().dirty()))
    line(fonts.regular, palette::warning, tr("Save the project first: it is measured as it is in its file."));
}

/// In the unit that people see.
std::optional<double> goalOf(const Goals& goals, const MeasureInfo& info) {
  const auto shown = [&](const std::optional<double>& goal) {
    return goal ? std::optional(*goal * info.shown) : std::nullopt;
  };
  switch (info.measure) {
    case Measure::bytes:
      return shown(goals.mostBytes);
    case Measure::frameMs:
      return shown(goals.mostFrameMs);
    case Measure::psnr:
      return shown(goals.leastPsnr);
    default:
      return std::nullopt;
  }
}

void drawPresets(PanelContext& context) {
  ui::mutedText(tr("Presets"));
  for (const auto& [id, label] : kPresets) {
    ImGui::SameLine(0, ui::scaled(6));
    actionButton(context, id, ButtonLook::plain, {}, tr(label));
  }
}

std::string goalsText(const Goals& goals) {
  std::string text;
  const auto add = [&text](const std::string& goal) { text += (text.empty() ? "" : ", ") + goal; };
  if (goals.mostBytes) add(trf("at most {:g} MB", *goals.mostBytes / 1e6));
  if (goals.mostFrameMs) add(trf("at most {:g} ms", *goals.mostFrameMs));
  if (goals.leastPsnr) add(trf("at least {:g} dB", *goals.leastPsnr));
  return text;
}

std::string figuresText(const SweepPoint& point) {
  const auto text = [&](Measure measure) { return textOf(infoOf(measure), point[measure].median); };
  return fmt::format("{}, {}, {}", text(Measure::bytes), text(Measure::frameMs), text(Measure::psnr));
}

/// What keeps the goals best, and whether it does. Left of `right`, screen pixels.
void drawProposal(PanelContext& context, const Sweep& sweep, float right) {
  if (!sweep.goals) return;
  const SweepPoint* best = proposalOf(sweep, *sweep.goals);
  if (best == nullptr) return;
  const bool kept = missOf(*sweep.goals, figuresOf(*best)) <= 0;
  actionButton(context, "goals.take", kept ? ButtonLook::primary : ButtonLook::plain, {}, tr("Take"));
  ImGui::SameLine(0, ui::scaled(6));
  const std::string figures = figuresText(*best);
  const std::string text = kept ? trf("Kept: {}", figures) : trf("Not kept yet; nearest: {}", figures);
  ImGui::PushTextWrapPos(right - ImGui::GetWindowPos().x);
  ImGui::TextColored((kept ? palette::good : palette::warning).vec(), "%s", text.c_str());
  ImGui::PopTextWrapPos();
  ui::tooltip(goalsText(*sweep.goals) + "\n" + textOf(best->setting));
}

PlotMark markOf(const SweepPoint& point, const AccuracyState& state,
                const std::vector<SweepPreset>& presets) {
  const AccuracyAxes& axes = state.shownAxes();
  const double across = infoOf(axes.cost).shown;
  const Spread& x = point[axes.cost];
  PlotMark mark;
  mark.x = x.median * across, mark.xLow = x.min * across, mark.xHigh = x.max * across;
  mark.y = mark.yLow = mark.yHigh = point[axes.error].median * infoOf(axes.error).shown;
  const auto name = [&mark](const std::string& word) { mark.name += (mark.name.empty() ? "" : ", ") + word; };
  for (const SweepPreset& preset : presets)
    if (preset.setting == point.setting && state.goals == (preset.name == "proposal"))
      name(preset.name == "proposal" ? tr("proposal") : preset.name);
  if (point.setting.empty()) mark.base = true, name(tr("as it is"));
  mark.selected = state.selected == point.setting;
  return mark;
}

}  // namespace

void AccuracyPanel::drawPlot(PanelContext& context, const Sweep& sweep, const ImVec2& low,
                             const ImVec2& high) {
  AccuracyState& state = context.state().accuracy;
  const AccuracyAxes& axes = state.shownAxes();
  const MeasureInfo &error = infoOf(axes.error), &cost = infoOf(axes.cost);
  const auto presets = presetsOf(sweep);
  std::vector<PlotMark> marks;
  std::vector<std::size_t> points;
  std::vector<Objectives> objectives;
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    const SweepPoint& point = sweep.points[i];
    const Spread &x = point[axes.cost], &y = point[axes.error];
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
  const Goals goals = state.goals ? sweep.goals.value_or(Goals{}) : Goals{};
  const PlotAxis across{labelOf(cost), true, goalOf(goals, cost)};
  const PlotAxis up{
      labelOf(error) + (error.moreIsBetter ? tr("  (more is better)") : tr("  (less is better)")), false,
      goalOf(goals, error)};
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
  const auto& watch = watchOf(context);
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
      text += trf("  ({} to {})", numberOf(info, value.min), numberOf(info, value.max));
    if (info.measure == Measure::bakeSeconds && point.bakeEstimated) text += tr("  predicted");
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
  const SweepWatch& watch = watchOf(context);
  const auto sweep = watch.sweep();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ui::scaled({10, 8}));
  const bool open = ImGui::BeginChild("##accuracy", {0, 0}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
  ImGui::PopStyleVar();
  if (open) {
    if (sweep && sweep->goals && goalsOf_ != watch.folder()) {  // of an earlier search
      goalsOf_ = watch.folder();
      context.state().accuracy.goalsRequest.goals = *sweep->goals;
    }
    drawToolbar(context);
    drawState(watch);
    const SweepPoint* shown = sweep ? sweep->find(shown_) : nullptr;
    if (!sweep || std::ranges::none_of(sweep->points, &SweepPoint::measured)) {
      drawEmpty(context);
    } else {
      const bool goals = context.state().accuracy.goals;
      const float foot =
          ImGui::GetFrameHeightWithSpacing() + (goals ? ImGui::GetTextLineHeightWithSpacing() : 0);
      const ImVec2 at = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
      const float card = std::min(ui::scaled(kCard), room.x * 0.45F);
      drawPlot(context, *sweep, at, {at.x + room.x - card - ui::scaled(8), at.y + room.y - foot});
      ImGui::SetCursorScreenPos({at.x, at.y + room.y - foot + ImGui::GetStyle().ItemSpacing.y});
      ImGui::AlignTextToFramePadding();
      if (goals)
        drawProposal(context, *sweep, at.x + room.x - card - ui::scaled(8));
      else
        drawPresets(context);
      ImGui::SetCursorScreenPos({at.x + room.x - card, at.y});
      if (ImGui::BeginChild("##accuracyPoint", {card, room.y}) && shown && shown->measured())
        drawPoint(context, *sweep, *shown);
      ImGui::EndChild();
    }
  }
  ImGui::EndChild();
}

}  // namespace acentric::editor
