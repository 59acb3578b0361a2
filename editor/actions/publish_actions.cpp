#include "editor/actions/menu_actions.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

bool isServed(const ActionContext& c) { return c.session.publishing().serving(); }
bool hasLink(const ActionContext& c) { return !c.session.linkToWalk().empty(); }

void add(std::vector<Action>& table, const char* id, const char* label, const char* help,
         bool (*enabled)(const ActionContext&), std::function<void(ActionContext&)> run) {
  table.push_back({id,
                   "File",
                   label,
                   {},
                   {},
                   help,
                   false,
                   enabled,
                   std::move(run),
                   {},
                   trLater("a published walk that is served")});
}

/// Of the page, at the eye's view.
std::string linkToView(const ActionContext& c) {
  const WalkPose& pose = c.state.walker.pose();
  return c.session.linkToWalk() +
         viewAddress(pose.eye, pose.yawRadians, pose.pitchRadians, c.session.project().storey);
}

}  // namespace

void addPublishActions(std::vector<Action>& table) {
  table.push_back({"file.publish",
                   "File",
                   trLater("Publish…"),
                   {key::e, kCtrl},
                   {},
                   trLater("Writes the walk as a folder for web servers, and shows it in the browser"),
                   true,
                   withBuilt,
                   [](ActionContext& c) {
                     const PublishPlace place = c.session.publishPlace();
                     c.state.publishDraft = {place.folder.string(), place.publicAddress, place.oneFile,
                                             place.openBrowser};
                     if (!c.session.publishing().job().running()) c.session.publishing().forgetAnswers();
                     c.state.dialog = Dialog::publish;
                   },
                   {}});
  add(table, "publish.open", trLater("Open the published walk in the browser"), "", isServed,
      [](ActionContext& c) { c.session.publishing().openInBrowser(); });
  add(table, "publish.copyView", trLater("Copy a link to this view"),
      trLater("The published walk, seen as the walk shows it here"), hasLink,
      [](ActionContext& c) { c.state.toClipboard = linkToView(c); });
  add(table, "publish.copyStart", trLater("Copy a link to the start"),
      trLater("The published walk, where it begins"), hasLink,
      [](ActionContext& c) { c.state.toClipboard = c.session.linkToWalk(); });
  add(table, "publish.stop", trLater("Stop serving the published walk"),
      trLater("What is published stays in its folder"), isServed,
      [](ActionContext& c) { c.session.publishing().stopServing(); });
}

}  // namespace acentric::editor
