#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "editor/commands/setting_edits.h"
#include "editor/panels/bake_panel.h"
#include "editor/panels/bake_section.h"
#include "editor/panels/project_field.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

std::string differencesText(const BakeSettings& bake, BakePreset preset) {
  std::vector<std::string> names = differencesFrom(bake, preset);
  for (std::string& name : names) name = tr(name);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Of the columns, unscaled.
constexpr float kName = 76, kTime = 96, kSize = 150, kAccuracy = 204;

/// By which words of the language need more room than kName, pixels.
float moreForNames() {
  float widest = 0;
  for (const char* label : {"Draft", "Balanced", "Fine"})
    widest = std::max(widest, ImGui::CalcTextSize(tr(label)).x);
  return std::max(0.0F, widest + 2 * ImGui::GetStyle().FramePadding.x - ui::scaled(kName));
}
constexpr double kMegabyte = 1e6, kMostMegabytes = 1e7;

struct Row {
  std::optional<BakePreset> preset;  ///< nothing: the project's own settings
  const char* label;
  BakeSettings bake;
  std::string id() const { return std::string("quality.") + (preset ? nameOf(*preset) : "own"); }
};

std::string shortDuration(double seconds) {
  if (seconds < 59.5) return ui::formatDuration(seconds);
  const double minutes = seconds / 60;
  if (minutes < 59.5) return fmt::format("{:.0f} min", minutes);
  return fmt::format("{:.{}f} h", minutes / 60, minutes < 600 ? 1 : 0);
}

/// Why a sweep left the preset out; empty where it did not.
std::string leftOut(const Session& session, const Row& row) {
  const auto& sweep = session.sweeping().sweep();
  if (!sweep || !row.preset) return {};
  const SweepPoint* point = sweep->find(settingOf(session.project(), *row.preset));
  return point != nullptr ? point->skipped : std::string();
}

/// False where it is not measured.
bool drawAccuracyOf(const Session& session, const Row& row, const BakeCost* cost) {
  const auto& sweep = session.sweeping().sweep();
  const SweepPoint* point = sweep && cost != nullptr ? measuredWith(*sweep, *cost) : nullptr;
  if (point == nullptr || (*point)[Measure::psnr].count == 0) {
    ui::mutedText("– dB");
    const std::string why = leftOut(session, row);
    ui::tooltip(
        why.empty()
            ? tr("Not yet measured: Measure in the tab Accuracy (F6) tries the presets.")
            : trf("Not yet measured: Measure in the tab Accuracy (F6) tries the presets, and left this "
                  "one out: it {}.",
                  why));
    return false;
  }
  ImGui::Text("%.1f dB", (*point)[Measure::psnr].median);
  ui::tooltip(trf("PSNR against the ray-traced truth, measured: the median of {} frames along {}",
                  sweep->frames, sweep->path));
  return true;
}

void drawBakeOf(PanelContext& context, const Row& row, const BakeForecast& forecast) {
  if (forecast.nothing()) return ui::mutedText(tr("nothing to bake"));
  ImGui::TextUnformatted(shortDuration(forecast.seconds()).c_str());
  ImGui::SameLine(ui::scaled(kSize) + moreForNames());
  ImGui::TextUnformatted(ui::formatBytes(std::uint64_t(forecast.bytes())).c_str());
  context.log.item(row.id() + ".cost");
  ui::tooltip(
      trf("Predicted for {} cameras with {} (±{:.0f} %): {} for captures, {} for light on near "
          "geometry. All of it, whatever is baked already.",
          forecast.cameras, threadsText(forecast.threads), 100 * forecast.relativeError,
          ui::formatDuration(forecast.captureSeconds), ui::formatDuration(forecast.lightSeconds)));
}

/// False where its accuracy is not measured.
bool drawRow(PanelContext& context, const Row& row) {
  const Session& session = context.session();
  if (row.preset) {
    actionButton(context, row.id().c_str(), ButtonLook::toggle, {ui::scaled(kName) + moreForNames(), 0},
                 row.label);
  } else {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(row.label);
    const BakePreset nearest = nearestPreset(row.bake);
    ui::tooltip(trf("The project's own settings: as {}, but for {}", tr(nameOf(nearest)),
                    differencesText(row.bake, nearest)));
    context.log.item(row.id());
  }
  ImGui::SameLine(ui::scaled(kTime) + moreForNames());
  const BakeCost* cost = session.bakeCosts().of(row.bake);
  if (cost != nullptr) {
    drawBakeOf(context, row, cost->forecast);
  } else {
    ui::mutedText(session.bakeCosts().predicting() ? tr("predicting…") : tr("not yet predicted"));
    ui::tooltip(
        tr("Predicted in the background by baking a little, some seconds after the last change, while no "
           "bake runs"));
  }
  ImGui::SameLine(std::max(ui::scaled(kAccuracy) + moreForNames(),
                           ImGui::GetContentRegionMax().x - ImGui::CalcTextSize("00.0 dB").x));
  return drawAccuracyOf(session, row, cost);
}

void drawProposal(PanelContext& context, const SizeProposal& proposal) {
  const double samples = proposal.bake.samplesPerDegree;
  if (samples == context.session().project().bake.samplesPerDegree)
    return ui::mutedText(trf("Applied: {:.4g} samples per degree", samples));
  ui::wrappedText(proposal.far() ? ui::palette::warning : ui::palette::text,
                  trf("{}{:.4g} samples per degree: about {}, {}",
                      proposal.far() ? tr("The nearest that captures come: ") : "", samples,
                      ui::formatBytes(std::uint64_t(proposal.cost.forecast.bytes())),
                      shortDuration(proposal.cost.forecast.seconds())));
  const bool apply = ui::button(tr("Apply##size"));
  context.log.item("quality.applySize");
  ui::tooltip(tr("Sets the samples per degree; all else stays. Undo takes it back."));
  if (apply)
    context.session().apply(
        setBakeSettings(context.session().project(), proposal.bake,
                        fmt::format("{:.4g} MB", proposal.askedBytes / kMegabyte).c_str()));
}

/// Bytes follow from the resolution; here it is the other way round.
void drawSize(PanelContext& context) {
  double& megabytes = context.state().wantedMegabytes;
  Session& session = context.session();
  ImGui::AlignTextToFramePadding();
  ui::mutedText(tr("Fit a size"));
  ImGui::SameLine(ui::scaled(kTime) + moreForNames());
  ImGui::SetNextItemWidth(ui::scaled(100));
  const bool entered =
      ImGui::InputDouble("##megabytes", &megabytes, 0, 0, megabytes > 0 ? "%.6g MB" : "MB",
                         ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CharsDecimal |
                             ImGuiInputTextFlags_AutoSelectAll);
  context.log.item("quality.megabytes");
  ui::tooltip(
      tr("That captures and light may take on disk: samples per degree are looked for that fit it, in the "
         "background, by baking a little. Press Enter."));
  if (!std::isfinite(megabytes)) megabytes = 0;
  megabytes = std::clamp(megabytes, 0.0, kMostMegabytes);
  if (entered && megabytes > 0) session.proposeSize(megabytes * kMegabyte);
  if (session.bakeCosts().sizing()) {
    ImGui::SameLine();
    ui::mutedText(tr("looking…"));
  } else if (const SizeProposal* proposal = session.bakeCosts().proposal()) {
    drawProposal(context, *proposal);
  } else if (!session.bakeCosts().sizeTrouble().empty()) {
    ui::wrappedText(ui::palette::warning, trf("Not found: {}", session.bakeCosts().sizeTrouble()));
  }
}

}  // namespace

void drawBakePresets(PanelContext& context) {
  Session& session = context.session();
  const BakeSettings own = session.project().bake;
  const auto rowOf = [&](BakePreset preset, const char* label) {
    return Row{preset, label, withPreset(own, preset)};
  };
  std::vector<Row> rows{rowOf(BakePreset::draft, tr("Draft")), rowOf(BakePreset::balanced, tr("Balanced")),
                        rowOf(BakePreset::fine, tr("Fine"))};
  if (!presetInForce(own)) rows.push_back({{}, tr("Own"), own});
  const ImVec2 low = ImGui::GetCursorScreenPos();
  bool measured = true;
  for (const Row& row : rows) measured = drawRow(context, row) && measured;
  const ImVec2 high(low.x + ImGui::GetContentRegionAvail().x, ImGui::GetCursorScreenPos().y);
  session.showBakeCosts(ImGui::IsRectVisible(low, high));
  if (!measured)
    ui::wrappedText(ui::palette::faint, tr("– dB: not yet measured; the tab Accuracy (F6) measures it."));
  if (!session.bakeCosts().trouble().empty())
    ui::wrappedText(ui::palette::warning, trf("Not predicted: {}", session.bakeCosts().trouble()));
  drawSize(context);
}

}  // namespace acentric::editor
