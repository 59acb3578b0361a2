#include "editor/actions/action.h"

namespace acentric::editor {
namespace {

/// A new project from a model that was not touched is worth no question.
bool wouldLoseWork(const Session& session) {
  return session.dirty() && !(session.untitled() && !session.history().canUndo());
}

void saved(ActionContext& context, const Status& status, const Continuation& then) {
  if (status) return proceed(context, then);
  context.session.messages().addFailure("Saving", status.error());
}

}  // namespace

void proceedAfterAsking(ActionContext& context, const Continuation& continuation) {
  if (!wouldLoseWork(context.session)) return proceed(context, continuation);
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
      break;
    case Continuation::Kind::open:
      context.session.open(continuation.file);
      break;
    case Continuation::Kind::openDialog:
      context.state.dialog = Dialog::openFile;
      break;
    case Continuation::Kind::bake:
      context.session.startBake(glm::dvec2(context.state.walker.pose().eye));
      break;
  }
}

void saveThen(ActionContext& context, const Continuation& then) {
  if (context.session.untitled()) {
    context.state.continuation = then;
    context.state.dialog = Dialog::saveAs;
    return;
  }
  saved(context, context.session.save(), then);
}

void saveAsThen(ActionContext& context, const std::filesystem::path& file, const Continuation& then) {
  saved(context, context.session.saveAs(file), then);
}

}  // namespace acentric::editor
