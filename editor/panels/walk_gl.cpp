/// The walk on OpenGL: when the graphics card draws it, and what is sent there meanwhile.
#include <fmt/format.h>

#include "editor/panels/walk_panel.h"
#include "editor/session/engine_texts.h"
#include "ui/translate.h"

namespace acentric::editor {

void WalkPanel::openGl(Session& session) {
  if (gl_ || !glProblem_.empty()) return;
  auto created = GlRenderer::create({.waitForCaptures = false});
  if (created) {
    gl_ = std::move(*created);
    return;
  }
  glProblem_ = engineText(created.error().message);
  session.messages().add(MessageLevel::warning, trf("{}. Until then the walk is drawn with \"{}\".",
                                                    glProblem_, nameOf(settingsOf(session).renderer)));
}

bool WalkPanel::receive(PanelContext& context) {
  const Result<bool> ready = gl_->receive();
  if (gl_->anyToReceive()) context.window.pacer().request(1);
  if (!ready) problem_ = engineText(ready.error());
  return ready && *ready;
}

void WalkPanel::drawWithGl(PanelContext& context) {
  Session& session = context.session();
  const PerspectiveView full = viewAt(context, 1);
  const WalkLook look = context.state().walkLook;
  const bool plain = look == WalkLook::picture || compares(look);
  const bool news = receive(context);
  if (!news && !stale(context, full) && shown_.look == look && showingGl_ == plain) return;
  const bool moving = context.state().walker.moving() || looking_ || !samePlace(shown_.view, full);
  const double scale = moving ? resolution_.movingScale() : 1.0;
  const PerspectiveView view = viewAt(context, scale);
  const ViewSettings settings = settingsOf(session);
  const auto stats = gl_->draw(session.walk()->walk, view, settings);
  if (gl_->anyToReceive()) context.window.pacer().request(1);
  rested_.reset();
  shown_ = {session.walk(), view, settings, look, stats ? *stats : FrameStats{}, -1, true};
  if (stats) resolution_.measured(scale, stats->totalSeconds);
  if (stats) times_.add(*stats);
  if (moving) context.window.pacer().request();  // the full picture follows once the eye rests
  problem_ = stats ? "" : engineText(stats.error());
  if (!stats) return;
  ++context.state().picturesShown;
  if (context.log.on())
    context.log.event("glframe",
                      fmt::format("{}x{} images {} captures {} missing {}", view.width, view.height,
                                  stats->images, stats->capturesAwaited, stats->missingImages));
  showingGl_ = true;
  ++glPictures_;
  if (plain) return;
  lastFrame_ = gl_->readBack();
  shown_.holeShare =
      double(lastFrame_.holeCount()) / double(std::max<std::size_t>(1, lastFrame_.source.pixels.size()));
  show(lastFrame_);
}

/// Draws what is shown once more on the graphics card, which then goes on if it does well. A picture that was
/// not drawn to the end, or not by list priority, is none to compare with.
void WalkPanel::tryGraphics(PanelContext& context) {
  Session& session = context.session();
  const Graphics graphics = session.preferences().graphics;
  const bool comparable = shown_.valid && problem_.empty() && shown_.settings.renderer == Renderer::list &&
                          shown_.settings.reconstruction == Reconstruction::patches &&
                          shown_.stats.missingImages == 0 && !session.streaming();
  if (!comparable || !trial_.wanted(graphics, context.window.graphicsDescription())) return;
  openGl(session);
  if (!gl_) return trial_.refuse(graphics);
  ViewSettings settings = shown_.settings;
  settings.renderer = Renderer::gl;
  const auto stats = gl_->draw(shown_.loaded->walk, shown_.view, settings);
  if (stats && (stats->capturesAwaited > 0 || gl_->anyToReceive())) return context.window.pacer().request(1);
  std::string told =
      stats ? "" : trf("The graphics card cannot draw this walk: {}", engineText(stats.error()));
  if (stats) {
    Frame card = gl_->readBack();
    card.stats = *stats;
    told = trial_.judge(lastFrame_, card, graphics);
  } else {
    trial_.refuse(graphics);
  }
  if (!told.empty()) session.messages().add(MessageLevel::warning, told);
  context.log.event("graphics", trial_.passed(graphics) ? "card" : "processor");
  context.window.pacer().request();
}

}  // namespace acentric::editor
