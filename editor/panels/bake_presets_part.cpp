#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "editor/commands/setting_edits.h"
#include "editor/panels/bake_section.h"
#include "editor/panels/project_field.h"
#include "ui/text_format.h"

namespace acentric::editor {
namespace {

/// Of the columns, unscaled.
constexpr float kName = 78, kTime = 88, kSize = 168;
constexpr double kMegabyte = 1e6, kMostMegabytes = 1e7;

struct Row {
  const char* id;     ///< of the action; nullptr: the project's own settings
  const char* label;  ///< of the button
  BakeSettings bake;
};

std::string shortDuration(double seconds) {
  if (seconds < 60) return ui::formatDuration(seconds);
  const auto minutes = (long long)(std::llround(seconds / 60));
  return minutes < 60 ? fmt::format("{} min", minutes)
                      : fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

/// Why a sweep left the preset out; empty where it did not.
std::string leftOut(const Session& session, const Row& row) {
  const auto& sweep = session.sweeping().sweep();
  if (!sweep) return {};
  Project wanted = session.project();
  wanted.bake = row.bake;
  for (const BakePreset preset : kBakePresets) {
    if (presetInForce(row.bake) != preset) continue;
    const SweepPoint* point = sweep->find(settingOf(session.project(), preset));
    if (point != nullptr && !point->measured()) return point->skipped;
  }
  return {};
}

void drawAccuracyOf(const Session& session, const Row& row, const BakeCost* cost) {
  const auto& sweep = session.sweeping().sweep();
  const SweepPoint* point = sweep && cost != nullptr ? measuredWith(*sweep, *cost) : nullptr;
  if (point != nullptr && (*point)[Measure::psnr].count > 0) {
    ImGui::Text("%.1f dB", (*point)[Measure::psnr].median);
    return ui::tooltip(
        fmt::format("PSNR against the ray-traced truth: the median of {} frames along {}, as "
                    "measured (Accuracy)",
                    sweep->frames, sweep->path));
  }
  ui::mutedText("– dB");
  const std::string why = leftOut(session, row);
  ui::tooltip("Not yet measured: Measure in the tab Accuracy (F6) tries the presets" +
              (why.empty() ? std::string(".") : ", and left this one out: it " + why + "."));
}

void drawCost(PanelContext& context, const Row& row) {
  const Session& session = context.session();
  const BakeCost* cost = session.bakeCosts().of(row.bake);
  ImGui::SameLine(ui::scaled(kTime));
  if (cost == nullptr) {
    ui::mutedText(session.bakeCosts().trouble().empty() ? "not known yet" : "not known");
    ui::tooltip(session.baking().running() ? "Predicted when no bake runs"
                                           : "Predicted in the background by baking a little");
  } else if (cost->forecast.nothing()) {
    ui::mutedText("nothing to bake");
  } else {
    const BakeForecast& forecast = cost->forecast;
    ImGui::TextUnformatted(shortDuration(forecast.seconds()).c_str());
    ImGui::SameLine(ui::scaled(kSize));
    ImGui::TextUnformatted(ui::formatBytes(std::uint64_t(forecast.bytes())).c_str());
    context.log.item(std::string(row.id != nullptr ? row.id : "quality.own") + ".cost");
    ui::tooltip(
        fmt::format("Predicted for {} cameras with {} {} (±{:.0f} %): {} for captures, {} for light on near "
                    "geometry; all of it, "
                    "whatever is baked already.",
                    forecast.cameras, forecast.threads, forecast.threads == 1 ? "thread" : "threads",
                    100 * forecast.relativeError, ui::formatDuration(forecast.captureSeconds),
                    ui::formatDuration(forecast.lightSeconds)));
  }
  const std::string accuracy = "00.0 dB";
  ImGui::SameLine(std::max(ui::scaled(kSize + 58),
                           ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(accuracy.c_str()).x));
  drawAccuracyOf(session, row, cost);
}

void drawRow(PanelContext& context, const Row& row) {
  if (row.id != nullptr) {
    actionButton(context, row.id, ButtonLook::toggle, {ui::scaled(kName), 0}, row.label);
  } else {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(row.label);
    const BakePreset nearest = nearestPreset(row.bake);
    std::string all;
    for (const std::string& each : differencesFrom(row.bake, nearest))
      all += (all.empty() ? "" : ", ") + each;
    ui::tooltip(fmt::format("The project's own settings: as {}, but for {}", nameOf(nearest), all));
    context.log.item("quality.own");
  }
  drawCost(context, row);
}

void drawProposal(PanelContext& context, const SizeProposal& proposal) {
  const double samples = proposal.bake.samplesPerDegree;
  if (samples == context.session().project().bake.samplesPerDegree)
    return ui::mutedText(fmt::format("The project is so: {:.4g} samples per degree", samples));
  ui::wrappedText(proposal.far() ? ui::palette::warning : ui::palette::text,
                  fmt::format("{}{:.4g} samples per degree: about {}, {}",
                              proposal.far() ? "The nearest that captures come: " : "", samples,
                              ui::formatBytes(std::uint64_t(proposal.forecast.bytes())),
                              shortDuration(proposal.forecast.seconds())));
  const bool apply = ui::button("Apply##size");
  context.log.item("quality.applySize");
  ui::tooltip("Sets the samples per degree; all else stays. Undo takes it back.");
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
  ui::mutedText("Fit a size");
  ImGui::SameLine(ui::scaled(kTime));
  ImGui::SetNextItemWidth(ui::scaled(100));
  const bool entered =
      ImGui::InputDouble("##megabytes", &megabytes, 0, 0, megabytes > 0 ? "%.6g MB" : "MB",
                         ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CharsDecimal |
                             ImGuiInputTextFlags_AutoSelectAll);
  context.log.item("quality.megabytes");
  ui::tooltip(
      "That captures and light may take on disk: samples per degree are looked for that fit it, in the "
      "background, by baking a little. Press Enter.");
  if (!std::isfinite(megabytes)) megabytes = 0;
  megabytes = std::clamp(megabytes, 0.0, kMostMegabytes);
  if (entered && megabytes > 0) session.proposeSize(megabytes * kMegabyte);
  if (session.bakeCosts().sizing()) {
    ImGui::SameLine();
    ui::mutedText("looking…");
  } else if (const SizeProposal* proposal = session.bakeCosts().proposal()) {
    drawProposal(context, *proposal);
  } else if (!session.bakeCosts().sizeTrouble().empty()) {
    ui::wrappedText(ui::palette::warning, "Not found: " + session.bakeCosts().sizeTrouble());
  }
}

}  // namespace

void drawBakePresets(PanelContext& context) {
  Session& session = context.session();
  const BakeSettings own = session.project().bake;
  const std::optional<BakePreset> inForce = presetInForce(own);
  const Row rows[] = {{"quality.draft", "Draft", withPreset(own, BakePreset::draft)},
                      {"quality.balanced", "Balanced", withPreset(own, BakePreset::balanced)},
                      {"quality.fine", "Fine", withPreset(own, BakePreset::fine)},
                      {nullptr, "Own", own}};
  ImGui::BeginGroup();
  for (const Row& row : rows)
    if (row.id != nullptr || !inForce) drawRow(context, row);
  ImGui::EndGroup();
  session.askForBakeCosts(ImGui::IsItemVisible());
  if (!session.bakeCosts().trouble().empty())
    ui::wrappedText(ui::palette::warning, "Not predicted: " + session.bakeCosts().trouble());
  drawSize(context);
}

}  // namespace acentric::editor
