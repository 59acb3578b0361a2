#include "editor/panels/publish_panel.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include "editor/panels/bake_panel.h"
#include "editor/session/engine_texts.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr float kPublishLabelWidth = 150;

/// Of files, which are looked at more closely than a disk.
std::string megabytes(std::uint64_t bytes) { return fmt::format("{:.2f} MB", double(bytes) / 1e6); }

PublishPlace placeOf(const PublishDraft& draft) {
  return {draft.folder, draft.oneFile, draft.openBrowser,
          checkPublicAddress(draft.publicAddress).value_or(std::string())};
}

/// True once the text was changed and is left.
bool textField(PanelContext& context, const char* label, const char* hint, std::string& text,
               const char* name, const char* help) {
  ImGui::AlignTextToFramePadding();
  ui::mutedText(label);
  ImGui::SameLine(ui::scaled(kPublishLabelWidth));
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint((std::string("##") + name).c_str(), hint, &text);
  const bool changed = ImGui::IsItemDeactivatedAfterEdit();
  context.log.item(name);
  ui::tooltip(help);
  return changed;
}

void drawPlace(PanelContext& context) {
  PublishDraft& draft = context.state().publishDraft;
  textField(context, tr("Folder"), "", draft.folder, "publish.folder",
            tr("It is made, or replaced as a whole if it holds nothing but what was published before."));
  ui::checkField(tr("One file"), draft.oneFile, kPublishLabelWidth,
                 tr("The walk as one file beside the page, read by ranges, in place of hundreds of files."));
  context.log.item("publish.oneFile");
  ui::checkField(tr("Open the browser"), draft.openBrowser, kPublishLabelWidth,
                 tr("As soon as it is published."));
  context.log.item("publish.openBrowser");
}

/// What is not baked: bake it first, or go on without.
bool drawGaps(PanelContext& context, const BakeGaps& gaps) {
  ImGui::Dummy({0, ui::scaled(4)});
  ui::wrappedText(ui::palette::warning,
                  gaps.all() ? tr("Nothing is baked yet, so there is nothing to publish.")
                             : trf("{}. Where captures are missing, the published walk has holes or shows "
                                   "previews.",
                                   engineText(gaps.describe())));
  bool close = false;
  if (ui::primaryButton(tr("Bake first"))) {
    if (const Action* bake = findAction(context.table, std::string("bake.start"))) runAction(context, *bake);
    context.session().publishing().forgetAnswers();
    close = true;
  }
  context.log.item("publish.bake");
  if (!gaps.all()) {
    ImGui::SameLine();
    if (ui::button(tr("Publish what there is")))
      context.session().publish(placeOf(context.state().publishDraft), true);
    context.log.item("publish.anyway");
  }
  return close;
}

void drawSizes(const Published& published) {
  const PublishReport& report = published.report;
  const BundleReport& bundle = report.bundle;
  ui::keyValue(tr("Published"),
               trfMany("{} in {} file, in {}", "{} in {} files, in {}", std::uint64_t(report.files),
                       megabytes(report.bytes), report.files, ui::formatDuration(published.seconds)),
               kPublishLabelWidth);
  ui::tooltip(published.place.folder.string());
  ui::keyValue(
      tr("Captures"),
      trf("{}, coarse ones {}{}", megabytes(bundle.fullBytes), megabytes(bundle.coarseBytes),
          bundle.reused > 0 ? trf("; {} of {} as they were", bundle.reused, bundle.cameras) : std::string()),
      kPublishLabelWidth);
  ui::keyValue(tr("Near geometry"),
               trf("{}, its textures {}", megabytes(bundle.localBytes), megabytes(bundle.textureBytes)),
               kPublishLabelWidth);
  const std::uint64_t parts = bundle.fullBytes + bundle.coarseBytes + bundle.localBytes + bundle.textureBytes;
  if (report.walk.empty())
    ui::keyValue(tr("Index and page"),
                 fmt::format("{}, {}", megabytes(bundle.indexBytes),
                             megabytes(report.bytes - std::min(report.bytes, parts + bundle.indexBytes))),
                 kPublishLabelWidth);
  else
    ui::keyValue(tr("Index and page"), megabytes(report.bytes - std::min(report.bytes, parts)),
                 kPublishLabelWidth);
  if (bundle.missing > 0)
    ui::keyValue(tr("Not baked"), trf("{} of {} captures", bundle.missing, bundle.cameras),
                 kPublishLabelWidth);
}

/// Kept as soon as it is typed: links begin with it.
void drawLinks(PanelContext& context) {
  PublishDraft& draft = context.state().publishDraft;
  const bool typed =
      textField(context, tr("Public address"), tr("https://…, where you copy the folder to; optional"),
                draft.publicAddress, "publish.publicAddress",
                tr("Links that are copied here begin with it, in place of this machine's address."));
  const auto checked = checkPublicAddress(draft.publicAddress);
  if (!checked) ui::wrappedText(ui::palette::danger, engineText(checked.error()));
  if (typed && checked) {
    PublishPlace place = context.session().publishPlace();
    place.publicAddress = *checked;
    context.session().keepPublishPlace(place);
  }
  actionButton(context, "publish.copyView", ButtonLook::plain, {}, tr("Copy link to this view"));
  ImGui::SameLine();
  actionButton(context, "publish.copyStart", ButtonLook::plain, {}, tr("Copy link to the start"));
}

void drawServer(PanelContext& context) {
  Publisher& publishing = context.session().publishing();
  if (!publishing.serving()) {
    ui::keyValue(tr("Address"), tr("not served"), kPublishLabelWidth);
    if (ui::button(tr("Serve it"))) publishing.serve();
    context.log.item("publish.serve");
    return;
  }
  ui::keyValue(tr("Address"), publishing.address(), kPublishLabelWidth);
  context.log.item("publish.address");
  ui::tooltip(tr("On this machine alone. To show it to others, copy the folder to a web server."));
  const auto load = publishing.lastLoad();
  ui::keyValue(
      tr("First frame"),
      load ? trf("after {:.1f} s and {}, {} requests", load->seconds, megabytes(load->bytes), load->requests)
           : std::string(tr("not seen yet")),
      kPublishLabelWidth);
  ui::tooltip(tr("Of the page that was opened from here last; text is sent compressed."));
  context.log.item(load ? "publish.loaded" : "publish.notLoaded");
  actionButton(context, "publish.open", ButtonLook::plain, {}, tr("Open in browser"));
  ImGui::SameLine();
  actionButton(context, "publish.stop", ButtonLook::plain, {}, tr("Stop serving"));
}

}  // namespace

void drawPublishDialog(PanelContext& context, const DialogKeys& keys) {
  Session& session = context.session();
  Publisher& publishing = session.publishing();
  if (!session.built() || session.shippedWalk()) {
    context.state().dialog = Dialog::none;
    return;
  }
  if (!beginDialog(trLater("Publish"), 660)) return;
  const bool running = publishing.job().running();
  ImGui::BeginDisabled(running);
  drawPlace(context);
  ImGui::EndDisabled();
  bool close = keys.escape;
  if (running) {
    ImGui::Dummy({0, ui::scaled(4)});
    ui::progressBar(progressFraction(publishing.job()), progressText(publishing.job()), context.now);
  } else if (const std::optional<BakeGaps> gaps = publishing.gaps()) {
    close = drawGaps(context, *gaps) || close;
  } else if (!publishing.trouble().empty()) {
    ImGui::Dummy({0, ui::scaled(4)});
    ui::wrappedText(ui::palette::danger, publishing.trouble());
    context.log.item("publish.trouble");
  }
  if (publishing.published()) {
    ImGui::Dummy({0, ui::scaled(4)});
    ImGui::Separator();
    drawSizes(*publishing.published());
    drawServer(context);
    drawLinks(context);
  }
  alignButtons(2);
  close = ui::button(tr("Close"), {dialogButtonWidth(), 0}) || close;
  context.log.item("dialog.close");
  ImGui::SameLine();
  if (running) {
    if (ui::button(tr("Cancel"), {dialogButtonWidth(), 0}, !publishing.job().cancelling()))
      publishing.cancel();
    context.log.item("publish.cancel");
  } else {
    const bool ready = std::filesystem::path(context.state().publishDraft.folder).is_absolute() &&
                       !session.rebuilding().running();
    const char* const label = publishing.published() ? tr("Publish again") : tr("Publish");
    const ImVec2 size = {dialogButtonWidth(), 0};
    // While it asks, the answer is what the dialog is for.
    const bool begin =
        publishing.gaps() ? ui::button(label, size, ready) : ui::primaryButton(label, size, ready);
    context.log.item("publish.begin");
    if (begin || (ready && keys.enter)) session.publish(placeOf(context.state().publishDraft), false);
  }
  if (close) context.state().dialog = Dialog::none;
  endDialog(close);
}

}  // namespace acentric::editor
