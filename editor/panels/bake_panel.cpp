#include "editor/panels/bake_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "editor/panels/bake_cameras.h"
#include "editor/panels/preference_fields.h"
#include "editor/panels/toolbar_flow.h"
#include "editor/session/engine_texts.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr float kValueX = 118;

void drawProgress(PanelContext& context) {
  const Session& session = context.session();
  const CaptureStatus* captures = session.captures().get();
  const BakeQueue& queue = session.bakeQueue();
  if (session.baking().running()) {
    std::string text = session.baking().cancelling() ? tr("stopping…")
                       : queue.cameras().empty()     ? session.baking().label() + "…"
                       : session.bakePaused()        ? tr("paused")
                                                     : ui::formatPercent(queue.share());
    if (!queue.cameras().empty()) text += trf("   {} of {}", queue.finished(), queue.toBake());
    ui::progressBar(queue.cameras().empty() ? -1 : queue.share(), text, context.now);
  } else if (session.estimating().running()) {
    ui::progressBar(progressFraction(session.estimating()), progressText(session.estimating()), context.now);
  } else if (captures != nullptr) {
    const int total = int(captures->cameras.size());
    const double fraction = total == 0 ? 0 : double(captures->baked) / total;
    const std::string text = total == 0             ? std::string(tr("no cells, nothing to bake"))
                             : captures->complete() ? trf("all {} captures baked", total)
                                                    : trf("{} of {} captures baked", captures->baked, total);
    ui::progressBar(fraction, text, context.now, ui::palette::good);
  }
  context.log.item("bake.progress");
}

/// What is being done, how fast, and for how long.
void drawPace(PanelContext& context) {
  Session& session = context.session();
  const BakeQueue& queue = session.bakeQueue();
  ui::keyValue(tr("Now"), session.bakePaused() ? tr("paused") : bakeProgressText(session), kValueX);
  std::string pace;
  if (const auto rays = queue.raysPerSecond(); rays && !session.bakePaused())
    pace = trf("{:.2f} million rays/s", *rays / 1e6);
  if (const auto left = session.bakeSecondsLeft(); left && !session.bakePaused())
    pace += trf("{}about {} left", pace.empty() ? "" : ", ", ui::formatDuration(*left));
  ui::keyValue(tr("Pace"), pace.empty() ? tr("not known yet") : pace, kValueX);
  ui::tooltip(tr(
      "Measured over the last half minute; time left is as predicted while the first cameras are baked, and "
      "then "
      "without light on local geometry."));
}

/// What the bake was to take when it was begun.
void drawForecast(const Session& session) {
  const std::optional<BakeForecast>& forecast = session.bakeForecast();
  std::string text = tr("being estimated…");
  if (forecast && forecast->nothing()) text = tr("nothing: all of it is there");
  if (forecast && !forecast->nothing()) {
    std::string what;
    if (forecast->cameras > 0)
      what = trfMany("{} capture", "{} captures", std::uint64_t(forecast->cameras),
                     ui::formatCount(std::uint64_t(forecast->cameras)));
    if (forecast->lights > 0) what = what.empty() ? tr("light") : trf("{} and light", what);
    text = trf("{}: about {}, {} on disk, up to {} of memory", what, ui::formatDuration(forecast->seconds()),
               ui::formatBytes(std::uint64_t(forecast->bytes())), ui::formatBytes(forecast->memoryBytes));
  }
  ui::keyValue(tr("To bake"), text, kValueX);
  if (forecast && !forecast->nothing())
    ui::tooltip(
        trf("Estimated when the bake began, for {} (±{:.0f} %). The memory is that of captures "
            "until they are written; the scene comes on top.",
            threadsText(forecast->threads), 100 * forecast->relativeError));
}

/// What is edited during a bake is for the next.
void drawOutdated(const Session& session) {
  const int outdated = session.outdatedInBake();
  if (outdated == 0) return;
  ui::mutedText(tr("Edited since"));
  ImGui::SameLine(ui::scaled(kValueX));
  ui::wrappedText(
      ui::palette::warning,
      trfMany("{} capture of this bake is no longer used. Cancel, then bake the project as it is.",
              "{} captures of this bake are no longer used. Cancel, then bake the project as it "
              "is.",
              std::uint64_t(outdated), ui::formatCount(std::uint64_t(outdated))));
}

void drawDisk(Session& session) {
  if (!session.freeBytes()) return;
  std::string text = trf("{} free", ui::formatBytes(*session.freeBytes()));
  const BakeEstimate* estimate = session.estimate();
  std::optional<double> needed = estimate != nullptr ? std::optional(estimate->bytes.value) : std::nullopt;
  if (session.baking().running())
    needed = session.neededBytes() ? std::optional(*session.neededBytes() * (1 - session.bakeQueue().share()))
                                   : std::nullopt;
  if (needed && *needed > 0) text += trf(", about {} needed", ui::formatBytes(std::uint64_t(*needed)));
  const bool tight = needed && *needed > 0.9 * double(*session.freeBytes());
  ui::mutedText(tr("Disk"));
  ImGui::SameLine(ui::scaled(kValueX));
  ui::wrappedText(tight ? ui::palette::warning : ui::palette::text, text);
}

/// Of the layout as it is: captures, and how much of the ground they are for.
void drawPlan(const Session& session) {
  const Storey& storey = session.project().current();
  std::string text = trf("{} captures for {}", ui::formatCount(session.built()->layout->cameras.size()),
                         ui::formatArea(storey.layout.outline.area()));
  if (!storey.walkable.empty())
    text += trf(" of {} that can be walked", ui::formatArea(storey.walkable.area()));
  const CaptureStatus* captures = session.captures().get();
  const bool allBaked = captures != nullptr && captures->baked == int(captures->cameras.size());
  if (session.estimate() == nullptr && !allBaked) {
    const BakeCost* cost = session.bakeCosts().of(session.project().bake);
    if (cost == nullptr) {
      text += tr("; Estimate tells what baking them takes");
    } else {
      const std::string time = ui::formatDuration(cost->forecast.seconds());
      const std::string bytes = ui::formatBytes(std::uint64_t(cost->forecast.bytes()));
      text += session.project().storeys.size() > 1
                  ? trf("; all storeys take about {} to bake, and {}", time, bytes)
                  : trf("; all of it takes about {} to bake, and {}", time, bytes);
    }
  }
  ui::keyValue(tr("Plan"), text, kValueX);
}

void drawFacts(PanelContext& context) {
  Session& session = context.session();
  const CaptureStatus* captures = session.captures().get();
  if (session.baking().running()) {
    drawForecast(session);
    drawOutdated(session);
    drawPace(context);
  }
  if (captures != nullptr) {
    const auto& walk = session.walk();
    ui::keyValue(tr("Captures"),
                 trf("{} of {} on disk{}", ui::formatCount(std::uint64_t(captures->baked)),
                     ui::formatCount(captures->cameras.size()),
                     walk && walk->coarse > 0 ? trf(", {} previews or drafts", walk->coarse) : std::string()),
                 kValueX);
  }
  if (!session.baking().running()) drawPlan(session);
  drawDisk(session);
  if (const auto& last = session.lastBake(); last && !session.baking().running()) {
    const BakeReport& report = last->captures;
    ui::keyValue(tr("Last bake"),
                 trf("{} baked, {} reused, {}", report.baked, report.reused,
                     ui::formatDuration(report.seconds + last->surfaceLightSeconds)),
                 kValueX);
    if (report.counts.rays.primary > 0)
      ui::keyValue(
          tr("Rays"),
          trf("{} primary, {} shadow, {} ambient", ui::formatCount(report.counts.rays.primary),
              ui::formatCount(report.counts.rays.shadow), ui::formatCount(report.counts.rays.ambient)),
          kValueX);
    if (const TestEyeSummary& eyes = report.testEyes; eyes.loss.looks > 0) {
      ui::keyValue(tr("Pruning"), trf("loses less than {:.2g} % of what is seen", 100 * eyes.worstLimit),
                   kValueX);
      ui::tooltip(trf(
          "With 95 % confidence, from any of the regions that the baked cameras serve. {:.1f} test eyes a "
          "region, {} at most.",
          double(eyes.eyes) / double(eyes.regions), eyes.most));
    }
    if (report.peakBytes > 0)
      ui::keyValue(tr("Memory used"), trf("{} at most", ui::formatBytes(report.peakBytes)), kValueX);
    ui::keyValue(tr("On disk"), ui::formatBytes(last->bytes), kValueX);
  }
  if (const BakeEstimate* estimate = session.estimate(); estimate != nullptr && !session.baking().running()) {
    const double error = std::max(estimate->seconds.relativeError, estimate->bytes.relativeError);
    ui::keyValue(
        tr("Still to bake"),
        estimate->seconds.value == 0
            ? std::string(tr("nothing"))
            : trf("{} captures: about {}, {} (±{:.0f} %)", ui::formatCount(std::uint64_t(estimate->cameras)),
                  ui::formatDuration(estimate->seconds.value),
                  ui::formatBytes(std::uint64_t(estimate->bytes.value)), 100 * error),
        kValueX);
    ui::tooltip(trf("{:.1f} million pixels, {:.1f} million samples", estimate->pixels / 1e6,
                    estimate->samples.value / 1e6));
  }
  bakeThreadsField(context, kValueX);
  bakeMemoryField(context, kValueX);
}

void drawLegend() {
  const auto entry = [](const ui::Colour& colour, const char* text, ui::Mark mark) {
    ImGui::BeginGroup();
    ui::badge(colour, text, mark);
    ImGui::EndGroup();
    ImGui::SameLine(0, ui::scaled(14));
  };
  entry(ui::palette::done, tr("baked"), ui::Mark::disc);
  entry(ui::palette::partly, tr("partly"), ui::Mark::half);
  entry(ui::palette::missing, tr("missing"), ui::Mark::ring);
  ImGui::NewLine();
}

/// What can be done, how far it is, and which of the two lists is shown.
void drawHead(PanelContext& context) {
  const AsTallAsIcons tall(context);
  const float buttonWidth = ui::scaled(104);
  if (context.session().baking().running()) {
    actionButton(context, "bake.cancel", ButtonLook::plain, {buttonWidth, 0}, tr("Cancel"));
    ImGui::SameLine();
    actionButton(context, "bake.pause", ButtonLook::plain, {},
                 context.session().bakePaused() ? tr("Go on") : tr("Pause"));
  } else {
    actionButton(context, "bake.start", ButtonLook::primary, {buttonWidth, 0});
    ImGui::SameLine();
    actionIcon(context, "bake.estimate", ui::Icon::calculator, ButtonLook::plain, tr("Estimate"));
  }
  ImGui::SameLine();
  actionIcon(context, "file.publish", ui::Icon::share, ButtonLook::plain, tr("Publish…"));
  ImGui::SameLine();
  drawProgress(context);
  const auto view = [&](const char* label, const char* help, ui::Icon icon, bool cameras) {
    bool& shown = context.state().showBakeCameras;
    const bool on = shown == cameras;
    ImFont* icons = context.window.fonts().icons;
    const bool clicked = icons != nullptr ? ui::iconButton(icons, (std::string("##view") + label).c_str(),
                                                           icon, on ? ui::Pressed::chosen : ui::Pressed::no)
                                          : ui::toggleButton(label, on);
    if (clicked) shown = cameras;
    context.log.item(cameras ? "bake.cameras" : "bake.overview");
    ui::tooltip(std::string(label) + "\n" + help);
  };
  view(tr("Overview"), tr("Pace, disk, settings"), ui::Icon::listing, false);
  ImGui::SameLine(0, ui::scaled(3));
  view(tr("Cameras"), tr("What became of each camera"), ui::Icon::videoCamera, true);
  ImGui::SameLine(0, ui::scaled(14));
  drawLegend();
}

}  // namespace

std::string threadsText(int threads) {
  return trfMany("{} thread", "{} threads", std::uint64_t(threads), threads);
}

std::string progressText(const Job& job) {
  const ProgressState& progress = job.progress();
  std::string text = progress.stage.empty() ? job.label() : engineText(progress.stage);
  // Some stages count for themselves.
  if (progress.total > 1 && progress.stage.find(" of ") == std::string::npos)
    text += trf(", {:.0f} of {:.0f}", progress.done, progress.total);
  return text;
}

std::string bakeProgressText(const Session& session) {
  const BakeQueue& queue = session.bakeQueue();
  if (queue.cameras().empty()) return progressText(session.baking());
  const QueuedCamera& camera = queue.cameras()[queue.current()];
  if (camera.stage != CameraStage::tracing || camera.previewing) return progressText(session.baking());
  const std::string text = trf("baking camera {} ({} of {})", camera.camera,
                               std::min(queue.finished() + 1, queue.toBake()), queue.toBake());
  const auto& storeys = session.project().storeys;
  const bool named = storeys.size() > 1 && std::size_t(camera.storey) < storeys.size();
  return named ? storeys[std::size_t(camera.storey)].name + ": " + text : text;
}

double progressFraction(const Job& job) {
  const ProgressState& progress = job.progress();
  return progress.total > 0 ? progress.done / progress.total : -1;
}

void drawBakePanel(PanelContext& context) {
  ui::panelTitle(context.window.fonts().bold, tr("Bake"));
  if (!context.session().built()) {
    ui::wrappedText(ui::palette::faint, tr("Nothing to bake: no project is open."));
    return;
  }
  drawHead(context);
  if (context.state().showBakeCameras) return drawBakeCameras(context);
  ImGui::BeginChild("##facts");
  drawFacts(context);
  ImGui::EndChild();
}

}  // namespace acentric::editor
