#include "editor/actions/action.h"

#include "ui/translate.h"

namespace acentric::editor {
namespace {

void saved(ActionContext& context, const Status& status, const Continuation& then) {
  if (status) return proceed(context, then);
  context.session.messages().addFailure(tr("Saving"), status.error());
}

}  // namespace

std::string menuOf(const Action& action) { return action.menu.empty() ? trLater("Window") : action.menu; }

std::string whyDisabled(const Action& action, const ActionContext& context) {
  if (action.enabled(context)) return {};
  if (!context.session.hasProject()) return tr("needs an open project");
  if (action.needsProject && context.session.shippedWalk()) return tr(kIsWalk);
  if (!context.session.built()) return tr("the project is still being opened");
  return action.needs.empty() ? tr("not now") : trf("needs {}", tr(action.needs));
}

GuideFacts guideFacts(const ActionContext& context) {
  const Session& session = context.session;
  const EditorState& state = context.state;
  GuideFacts facts;
  facts.coverage = state.overlay == PlanOverlay::coverage;
  facts.walkedMetres = state.walker.walkedMetres();
  facts.commands = state.commandsOpened;
  facts.baking = session.baking().running();
  facts.dirty = session.dirty();
  if (session.built()) facts.cells = int(session.built()->layout->regions.size());
  if (session.hasProject()) facts.changes = int(session.history().cursor());
  if (session.captures()) facts.baked = session.captures()->baked;
  return facts;
}

void beginAfresh(ActionContext& context) {
  EditorState& state = context.state;
  state.fitPlan = true;
  state.selection.clear();
  state.walkSelection = {};
  state.recorder = {};
  state.replay = {};
  state.goTo.reset();
  state.fullScreen = false;
  state.whole = WholeView::none;
  state.planTool.setMode(context.session.shippedWalk() ? PlanMode::eye : PlanMode::cells);
  if (!context.session.shippedWalk()) return;
  state.centreView = View::plan;
  if (state.overlay != PlanOverlay::bake && state.overlay != PlanOverlay::bytes)
    state.overlay = PlanOverlay::none;
  if (compares(state.walkLook)) state.walkLook = WalkLook::picture;
  state.showTable = false;
  state.array.reset();
  state.trial.reset();
}

void noteUse(EditorState& state, const std::string& id) {
  constexpr std::size_t kMost = 12;
  std::erase(state.recentActions, id);
  state.recentActions.insert(state.recentActions.begin(), id);
  if (state.recentActions.size() > kMost) state.recentActions.resize(kMost);
}

void proceedAfterAsking(ActionContext& context, const Continuation& continuation) {
  if (!context.session.worthAsking()) return proceed(context, continuation);
  context.state.continuation = continuation;
  context.state.dialog = Dialog::unsavedChanges;
}

void proceed(ActionContext& context, const Continuation& continuation) {
  switch (continuation.kind) {
    case Continuation::Kind::none:
      break;
    case Continuation::Kind::quit:
      context.session.close();
      context.state.quit = true;
      break;
    case Continuation::Kind::close:
      context.session.close();
      context.state.selection.clear();
      context.state.fullScreen = false;  // the welcome needs its menus
      break;
    case Continuation::Kind::open:
      context.session.open(continuation.file);
      break;
    case Continuation::Kind::openDialog:
      context.state.dialog = Dialog::openFile;
      break;
    case Continuation::Kind::newDialog:
      context.state.dialog = Dialog::newFile;
      break;
    case Continuation::Kind::bake:
      context.session.startBake(glm::dvec2(context.state.walker.pose().eye));
      break;
  }
}

void saveThen(ActionContext& context, const Continuation& then) {
  const SaveObstacle obstacle = context.session.saveObstacle();
  if (obstacle == SaveObstacle::none) return saved(context, context.session.save(), then);
  context.state.continuation = then;
  context.state.dialog = obstacle == SaveObstacle::changedOnDisk ? Dialog::changedOnDisk : Dialog::saveAs;
}

void overwriteThen(ActionContext& context, const Continuation& then) {
  saved(context, context.session.save(true), then);
}

void reload(ActionContext& context) {
  if (const Status read = context.session.reload(); !read)
    context.session.messages().addFailure(tr("Reloading"), read.error());
}

void saveAsThen(ActionContext& context, const std::filesystem::path& file, const Continuation& then) {
  saved(context, context.session.saveAs(file), then);
}

}  // namespace acentric::editor
