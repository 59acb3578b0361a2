#include "editor/panels/bake_panel.h"

#include <fmt/format.h>

#include <algorithm>

#include "ui/text_format.h"

namespace acentric::editor {
namespace {

constexpr float kValueX = 118;

void drawProgress(PanelContext& context) {
  const Session& session = context.session();
  const CaptureStatus* captures = session.captures().get();
  if (session.baking().running()) {
    const bool stopping = session.baking().cancelling();
    std::string text = stopping ? "stopping…" : progressText(session.baking());
    if (session.bakePaused())
      text = "paused: " + text;
    else if (const auto left = session.bakeSecondsLeft(context.now); left && !stopping)
      text += fmt::format("   {} left", ui::formatDuration(*left));
    ui::progressBar(progressFraction(session.baking()), text, context.now);
  } else if (captures != nullptr) {
    const int total = int(captures->cameras.size());
    const double fraction = total == 0 ? 0 : double(captures->baked) / total;
    const std::string text = captures->complete()
                                 ? fmt::format("all {} captures baked", total)
                                 : fmt::format("{} of {} captures baked", captures->baked, total);
    ui::progressBar(fraction, text, context.now, ui::palette::good);
  }
  context.log.item("bake.progress");
}

void drawFacts(PanelContext& context) {
  Session& session = context.session();
  const CaptureStatus* captures = session.captures().get();
  if (captures != nullptr)
    ui::keyValue("Captures",
                 fmt::format("{} of {} on disk", ui::formatCount(std::uint64_t(captures->baked)),
                             ui::formatCount(captures->cameras.size())),
                 kValueX);
  if (const auto& last = session.lastBake()) {
    const BakeReport& report = last->captures;
    ui::keyValue("Last bake",
                 fmt::format("{} baked, {} reused, {}", report.baked, report.reused,
                             ui::formatDuration(report.seconds + last->surfaceLightSeconds)),
                 kValueX);
    if (report.counts.rays.primary > 0)
      ui::keyValue(
          "Rays",
          fmt::format("{} primary, {} shadow, {} ambient", ui::formatCount(report.counts.rays.primary),
                      ui::formatCount(report.counts.rays.shadow),
                      ui::formatCount(report.counts.rays.ambient)),
          kValueX);
    ui::keyValue("On disk", ui::formatBytes(last->bytes), kValueX);
  }
  if (const BakeEstimate* estimate = session.estimate()) {
    const double error = std::max(estimate->seconds.relativeError, estimate->bytes.relativeError);
    ui::keyValue("Still to bake",
                 estimate->seconds.value == 0
                     ? std::string("nothing")
                     : fmt::format("{} captures, {:.1f} Mpixel: about {}, {} (±{:.0f} %)",
                                   ui::formatCount(std::uint64_t(estimate->cameras)), estimate->pixels / 1e6,
                                   ui::formatDuration(estimate->seconds.value),
                                   ui::formatBytes(std::uint64_t(estimate->bytes.value)), 100 * error),
                 kValueX);
  }
  int threads = session.bakeThreads();
  const ui::FieldEdit edit =
      ui::numberField({"Threads", "%.0f", 0.05, 1, double(session.processors()),
                       "For baking and loading. One fewer than the processors keeps the window quick."},
                      threads, kValueX);
  if (edit.changed) session.preferences().bakeThreads = threads;
  const ui::FieldEdit memory =
      ui::numberField({"Memory", "%.0f MB", 16, 16, 65536,
                       "Of finished captures that wait to be written; beyond that the bake waits."},
                      session.preferences().bakeMegabytes, kValueX);
  if (edit.finished || memory.finished) session.savePreferencesNow();
}

void drawLegend() {
  const auto entry = [](const ui::Colour& colour, const char* text) {
    ImGui::BeginGroup();
    ui::badge(colour, text);
    ImGui::EndGroup();
    ImGui::SameLine(0, 14);
  };
  entry(ui::palette::good, "baked");
  entry(ui::palette::warning, "partly");
  entry(ui::Colour::hex(0x9aa6b8), "missing");
  ImGui::NewLine();
}

}  // namespace

std::string progressText(const Job& job) {
  const ProgressState& progress = job.progress();
  std::string text = progress.stage.empty() ? job.label() : progress.stage;
  // Some stages count for themselves.
  if (progress.total > 1 && text.find(" of ") == std::string::npos)
    text += fmt::format(", {:.0f} of {:.0f}", progress.done, progress.total);
  return text;
}

double progressFraction(const Job& job) {
  const ProgressState& progress = job.progress();
  return progress.total > 0 ? progress.done / progress.total : -1;
}

void drawBakePanel(PanelContext& context) {
  ui::panelTitle(context.window.fonts().bold, "Bake");
  if (!context.session().built()) {
    ui::wrappedText(ui::palette::faint, "Nothing to bake: no project is open.");
    return;
  }
  constexpr float kButtonWidth = 104;
  if (context.session().baking().running()) {
    actionButton(context, "bake.cancel", ButtonLook::plain, {kButtonWidth, 0}, "Cancel");
    ImGui::SameLine();
    actionButton(context, "bake.pause", ButtonLook::plain, {},
                 context.session().bakePaused() ? "Go on" : "Pause");
  } else {
    actionButton(context, "bake.start", ButtonLook::primary, {kButtonWidth, 0});
    ImGui::SameLine();
    actionButton(context, "bake.estimate", ButtonLook::plain, {}, "Estimate");
  }
  ImGui::SameLine();
  drawProgress(context);
  drawLegend();
  drawFacts(context);
}

}  // namespace acentric::editor
