#include "editor/actions/menu_actions.h"
#include "editor/actions/path_walk.h"
#include "editor/commands/walk_edits.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

bool withBookmark(const ActionContext& c) {
  return withBuilt(c) && c.state.walkSelection.bookmark(c.session.project()) != nullptr;
}
bool withPath(const ActionContext& c) {
  return withBuilt(c) && c.state.walkSelection.path(c.session.project()) != nullptr;
}
bool withEither(const ActionContext& c) { return withBookmark(c) || withPath(c); }

void moveSelected(ActionContext& c, int steps) {
  WalkSelection& selected = c.state.walkSelection;
  const Project& project = c.session.project();
  const std::size_t count = withPath(c) ? project.paths.size() : project.bookmarks.size();
  const auto to = std::ptrdiff_t(selected.number) + steps;
  if (to < 0 || to >= std::ptrdiff_t(count)) return;
  if (c.session.apply(withPath(c) ? movePath(project, selected.number, steps)
                                  : moveBookmark(project, selected.number, steps)))
    selected.number = std::size_t(to);
}

void removeSelected(ActionContext& c) {
  const std::size_t number = c.state.walkSelection.number;
  const Project& project = c.session.project();
  const bool path = withPath(c);
  selectWalk(c, {});
  c.session.apply(path ? removePath(project, number) : removeBookmark(project, number));
}

void addRecording(std::vector<Action>& table) {
  table.push_back(
      {"walk.record",
       "Walk",
       trLater("Record walk"),
       {key::r, kCtrl},
       {},
       trLater("From the first step to the last before this is pressed again; the walk becomes a path"),
       true,
       withBuilt,
       startOrStopRecording,
       [](const ActionContext& c) { return c.state.recorder.recording(); }});
  table.push_back({"path.play",
                   "Walk",
                   trLater("Play path"),
                   {key::space, 0},
                   {},
                   trLater("Along the selected path in real time, or a pause; walking takes over"),
                   false,
                   withPath,
                   playOrPause,
                   [](const ActionContext& c) { return c.state.replay.playing(); },
                   trLater("a selected path")});
  table.push_back({"path.stop",
                   "Walk",
                   trLater("Stop path"),
                   {},
                   {},
                   trLater("Back to its beginning"),
                   false,
                   [](const ActionContext& c) {
                     return withPath(c) && (c.state.replay.playing() || c.state.replay.at() > 0);
                   },
                   stopReplay,
                   {},
                   trLater("a path that plays")});
  table.push_back({"path.loop",
                   "Walk",
                   trLater("Loop path"),
                   {},
                   {},
                   trLater("Begins again at its end"),
                   false,
                   withProject,
                   [](ActionContext& c) { c.state.replay.loop = !c.state.replay.loop; },
                   [](const ActionContext& c) { return c.state.replay.loop; }});
  table.push_back({"path.export",
                   "Walk",
                   trLater("Export path…"),
                   {},
                   {},
                   trLater("As a JSON file for `acentric walk --path` and other programs"),
                   false,
                   withPath,
                   [](ActionContext& c) { c.state.dialog = Dialog::exportPath; },
                   {},
                   trLater("a selected path")});
}

void addBookmarks(std::vector<Action>& table) {
  table.push_back(
      {"bookmark.add",
       "Walk",
       trLater("Bookmark this place"),
       {key::b, kCtrlShift},
       {},
       trLater("Keeps where the eye is and where it looks, to come back to"),
       true,
       withBuilt,
       [](ActionContext& c) {
         const Project& project = c.session.project();
         if (!c.session.apply(addBookmark(project, pathPose(c.state.walker.pose())))) return;
         c.state.bottomTab = BottomTab::paths;
         selectWalk(c, {WalkSelection::Kind::bookmark, c.session.project().bookmarks.size() - 1, {}});
       },
       {}});
  table.push_back({"bookmark.go",
                   "Walk",
                   trLater("Go to bookmark"),
                   {key::enter, kCtrl},
                   {},
                   trLater("To the selected one"),
                   false,
                   withBookmark,
                   [](ActionContext& c) { goToBookmark(c, c.state.walkSelection.number); },
                   {},
                   trLater("a selected bookmark")});
  table.push_back({"bookmark.update",
                   "Walk",
                   trLater("Move bookmark here"),
                   {},
                   {},
                   trLater("The selected one then is where the eye is"),
                   false,
                   withBookmark,
                   [](ActionContext& c) {
                     c.session.apply(updateBookmark(c.session.project(), c.state.walkSelection.number,
                                                    pathPose(c.state.walker.pose())));
                   },
                   {},
                   trLater("a selected bookmark")});
}

}  // namespace

void addPathActions(std::vector<Action>& table) {
  addRecording(table);
  addBookmarks(table);
  table.push_back({"walks.up",
                   "Walk",
                   trLater("Move up in the list"),
                   {},
                   {},
                   trLater("The selected bookmark or path"),
                   true,
                   [](const ActionContext& c) { return withEither(c) && c.state.walkSelection.number > 0; },
                   [](ActionContext& c) { moveSelected(c, -1); },
                   {},
                   trLater("a selected bookmark or path below another")});
  table.push_back({"walks.down",
                   "Walk",
                   trLater("Move down in the list"),
                   {},
                   {},
                   trLater("The selected bookmark or path"),
                   false,
                   [](const ActionContext& c) {
                     const Project* project = withEither(c) ? &c.session.project() : nullptr;
                     return project != nullptr &&
                            c.state.walkSelection.number + 1 <
                                (withPath(c) ? project->paths.size() : project->bookmarks.size());
                   },
                   [](ActionContext& c) { moveSelected(c, 1); },
                   {},
                   trLater("a selected bookmark or path above another")});
  table.push_back({"walks.remove",
                   "Walk",
                   trLater("Remove bookmark or path"),
                   {},
                   {},
                   trLater("The selected one; an undo brings it back"),
                   false,
                   withEither,
                   removeSelected,
                   {},
                   trLater("a selected bookmark or path")});
  table.push_back({"view.paths",
                   "Plan",
                   trLater("Show paths and bookmarks"),
                   {},
                   {},
                   "",
                   true,
                   withProject,
                   [](ActionContext& c) { c.state.showPaths = !c.state.showPaths; },
                   [](const ActionContext& c) { return c.state.showPaths; }});
}

}  // namespace acentric::editor
