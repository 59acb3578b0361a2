/// The picture of the walk panel: when it is drawn anew, by whom, and what is said of it.
#include <fmt/format.h>

#include <algorithm>

#include "editor/panels/walk_panel.h"
#include "editor/session/engine_texts.h"
#include "editor/session/screenshot.h"
#include "editor/session/sending_text.h"
#include "engine/geometry/conventions.h"
#include "ui/canvas_draw.h"
#include "ui/image_view.h"
#include "ui/text_format.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {

constexpr Rgba8 kHoleColour{13, 14, 16, 255};

/// Nothing to walk on, and nothing on the way.
bool nothingBaked(const Session& session) {
  return session.captures() && session.captures()->baked == 0 && !session.baking().running() &&
         (!session.walk() || session.walk()->coarse == 0);
}

}  // namespace

PerspectiveView WalkPanel::viewAt(PanelContext& context, double scale) const {
  const WalkPose& pose = context.state().walker.pose();
  PerspectiveView view;
  view.eye = pose.eye;
  view.yawRadians = pose.yawRadians;
  view.pitchRadians = pose.pitchRadians;
  view.fovRadians = radians(context.session().project().fovDegrees);
  view.width = std::max(16, int(area_.x * scale));
  view.height = std::max(16, int(area_.y * scale));
  return view;
}

ViewSettings WalkPanel::settingsOf(const Session& session) const {
  ViewSettings settings = session.project().view;
  if (!glProblem_.empty() || settings.reconstruction != Reconstruction::patches)
    settings.renderer = withoutOpenGl(settings.renderer);
  else if (settings.renderer == Renderer::list && trial_.passed(session.preferences().graphics))
    settings.renderer = Renderer::gl;
  return settings;
}

bool WalkPanel::stale(const PanelContext& context, const PerspectiveView& full) const {
  const Session& session = context.actions.session;
  return !shown_.valid || shown_.loaded != session.walk() || !samePlace(shown_.view, full) ||
         shown_.view.width != full.width || shown_.view.height != full.height ||
         shown_.settings != settingsOf(session);
}

void WalkPanel::requestFrame(PanelContext& context) {
  Session& session = context.session();
  if (!session.walk() || area_.x < 16 || area_.y < 16) return;
  // From storey to storey: the picture stays while the walk is still that of the one before.
  const Layout& drawn = *session.walk()->walk.layout;
  if (shown_.valid && session.built()->layout != session.walk()->walk.layout &&
      !drawn.regionAt(glm::dvec2(context.state().walker.pose().eye)))
    return;
  if (shown_.valid && shown_.loaded != session.walk() &&
      rendersTheSame(shown_.loaded->walk, session.walk()->walk, shown_.view, shown_.settings))
    shown_.loaded = session.walk();
  if (onOpenGl(session.project().view.renderer)) openGl(session);
  if (onOpenGl(settingsOf(session).renderer)) return drawWithGl(context);
  const PerspectiveView full = viewAt(context, 1);
  if (!requested_ && !stale(context, full)) return tryGraphics(context);
  if (gl_) gl_->stopSending();
  if (requested_) return;
  const bool moving = context.state().walker.moving() || looking_ || !samePlace(shown_.view, full);
  const double scale = moving ? resolution_.movingScale() : 1.0;
  renderer_.request({session.walk(), viewAt(context, scale), settingsOf(session), scale});
  requested_ = true;
}

const SourceColours& WalkPanel::coloursOf(const std::shared_ptr<const Layout>& layout) {
  if (!colours_ || colouredLayout_ != layout) colours_.emplace(*layout);
  colouredLayout_ = layout;
  return *colours_;
}

ColourImage WalkPanel::pictureOf(const Frame& frame) {
  const auto& layout = shown_.loaded->walk.layout;
  ColourImage picture = shown_.look == WalkLook::sources
                            ? sourcePicture(frame, coloursOf(layout), SourceRoles(*layout, shown_.view))
                            : frame.colour;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const PixelSource source = frame.source.pixels[i];
    if (shown_.look == WalkLook::holes && (source == kSourceHole || source == kSourceInvented))
      picture.pixels[i] = kInventedColour;
    else if (source == kSourceHole)
      picture.pixels[i] = kHoleColour;
    picture.pixels[i].a = 255;
  }
  return picture;
}

void WalkPanel::show(const Frame& frame) {
  const ColourImage picture = pictureOf(frame);
  texture_.upload(picture.width, picture.height,
                  {&picture.pixels.front().x, picture.pixels.size() * sizeof(Rgba8)});
  showingGl_ = false;
}

void WalkPanel::keepRested(PanelContext& context) {
  const EditorState& state = context.state();
  const bool wanted = compares(state.walkLook) || state.showImages || state.takePicture || askAt_;
  if (!wanted || !context.session().walk() || !problem_.empty() || stale(context, viewAt(context, 1)))
    return rested_.reset();
  if (rested_) return;
  if (showingGl_) lastFrame_ = gl_->readBack();
  rested_ = std::make_shared<const Frame>(lastFrame_);
  if (showingGl_)  // it was not known before
    shown_.holeShare =
        double(rested_->holeCount()) / double(std::max<std::size_t>(1, rested_->source.pixels.size()));
}

void WalkPanel::askForTruth(PanelContext& context) {
  Session& session = context.session();
  const EditorState& state = context.state();
  const PerspectiveView full = viewAt(context, 1);
  const bool rests = session.walk() && !state.walker.moving() && shown_.valid &&
                     samePlace(shown_.view, full) && full.check();
  if (rests && state.walkLook == WalkLook::variant)
    session.variants().follow(VariantRequest{session.built(), full, rested_, session.walkBytes()});
  else
    session.variants().follow(std::nullopt);
  if (const auto& figures = session.variants().figures(); figures != loggedVariants_ && session.captures()) {
    loggedVariants_ = figures;
    if (figures)
      context.log.event("variants", keptText(*figures) + " " + nowText(*figures, session.captures()->bytes));
  }
  if (!rests || !needsTruth(state.walkLook)) return session.comparing().follow(std::nullopt);
  session.comparing().follow(
      CompareRequest{session.built(), full, session.walk()->walk.exposure, state.truthRays, rested_});
  const std::shared_ptr<const Compared>& compared = session.comparing().compared();
  if (!context.log.on() || compared == loggedCompared_) return;
  loggedCompared_ = compared;
  if (compared) context.log.event("compared", figuresText(*compared) + " " + againstText(*compared));
}

void WalkPanel::savePicture(PanelContext& context) {
  EditorState& state = context.state();
  if (!state.takePicture || (!rested_ && problem_.empty())) return;
  state.takePicture = false;
  Session& session = context.session();
  if (!rested_)
    return session.messages().add(MessageLevel::warning, trf("There is no picture to save: {}", problem_));
  ColourImage picture = pictureOf(*rested_);
  if (const auto& kept = session.variants().frame(); kept && state.walkLook == WalkLook::variant)
    picture = splitPicture(kept->colour, picture, state.splitAt);
  if (const auto& truth = session.comparing().truth(); truth && needsTruth(state.walkLook))
    picture = state.walkLook == WalkLook::split
                  ? splitPicture(picture, truth->frame.colour, state.splitAt)
                  : differenceImage(picture, truth->frame.colour, state.differenceGain);
  session.savePicture(std::move(picture));
}

void WalkPanel::drawOverlays(PanelContext& context, const ImVec2& low, const ImVec2& size) {
  const bool colours = WalkOverlays::needColours(context.state()) && shown_.loaded;
  overlays_.draw(context, *ImGui::GetWindowDrawList(), low, {low.x + size.x, low.y + size.y}, place_,
                 {shown_.loaded, shown_.view, shown_.settings, rested_},
                 colours ? &coloursOf(shown_.loaded->walk.layout) : nullptr, times_);
}

void WalkPanel::nameSource(const glm::dvec2& pointer) const {
  const Image<PixelSource>& source = lastFrame_.source;
  if (shown_.look != WalkLook::sources || showingGl_ || source.empty() || looking_ ||
      overlays_.cover(pointer))
    return;
  const glm::dvec2 at = (pointer - place_.min) / place_.size * glm::dvec2(source.width, source.height);
  if (at.x < 0 || at.y < 0 || at.x >= source.width || at.y >= source.height) return;
  const PixelSource here = source.at(int(at.x), int(at.y));
  const Layout& layout = *shown_.loaded->walk.layout;
  const SourceRole role = SourceRoles(layout, shown_.view).of(here);
  const std::string text =
      engineText(sourceName(layout, here)) + (role == SourceRole::otherHand ? tr(" (other hand)") : "");
  ui::tooltip(text);
}

void WalkPanel::takePicture(PanelContext& context) {
  auto picture = renderer_.take();
  if (picture) {
    requested_ = false;
    context.window.pacer().request(1);
    const WalkRequest& request = picture->request;
    rested_.reset();
    shown_ = {request.loaded,
              request.view,
              request.settings,
              context.state().walkLook,
              picture->frame.stats,
              -1,
              true};
    problem_ = picture->problem;
    if (problem_.empty()) {
      ++context.state().picturesShown;
      renderer_.recycle(std::move(lastFrame_));
      lastFrame_ = std::move(picture->frame);
      resolution_.measured(request.scale, lastFrame_.stats.totalSeconds);
      times_.add(lastFrame_.stats);
      shown_.holeShare =
          double(lastFrame_.holeCount()) / double(std::max<std::size_t>(1, lastFrame_.source.pixels.size()));
      show(lastFrame_);
      if (context.log.on() && request.scale >= 1)
        context.log.event("frame", fmt::format("{}x{} images {} holes {:.4f}", request.view.width,
                                               request.view.height, shown_.stats.images, shown_.holeShare));
    }
  } else if (shown_.valid && shown_.look != context.state().walkLook && !showingGl_ &&
             !lastFrame_.colour.empty()) {
    shown_.look = context.state().walkLook;
    show(lastFrame_);
  }
}

/// Is the place so little baked that a quick picture of it tells more?
bool WalkPanel::worthPreview(const PanelContext& context) const {
  const Session& session = context.actions.session;
  if (session.shippedWalk() || context.actions.state.walkLook != WalkLook::picture) return false;
  if (session.built()->layout->regions.empty()) return false;
  constexpr double kMostHoles = 0.5;
  return nothingBaked(session) || (shown_.valid && !session.streaming() && shown_.stats.missingImages > 0 &&
                                   shown_.holeShare > kMostHoles);
}

void WalkPanel::drawPicture(PanelContext& context, const ImVec2& low, const ImVec2& size) {
  previewing_ = worthPreview(context) &&
                preview_.draw(context, viewAt(context, 1), low, {low.x + size.x, low.y + size.y});
  if (previewing_) return;
  if (!worthPreview(context)) preview_.clear();
  const bool picture = shown_.valid && (showingGl_ ? gl_ != nullptr : !texture_.empty());
  if (picture)
    place_ = ui::fitImage(ui::fromIm(low), ui::fromIm(size), double(shown_.view.width) / shown_.view.height);
  const bool covers = picture && place_.size.x > double(size.x) - 1 && place_.size.y > double(size.y) - 1;
  if (!covers)  // software rasterisers take long over pixels that nobody sees
    ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + size.x, low.y + size.y},
                                              ui::palette::backdrop.packed());
  if (!picture) return;
  ui::drawImage(
      showingGl_ ? ui::Texture::imguiTexture(gl_->colourTexture(), glPictures_) : texture_.imguiId(), place_,
      showingGl_);
}

/// Why there is no picture, or none worth looking at; over all else.
void WalkPanel::drawNotice(const PanelContext& context, const ImVec2& low, const ImVec2& size) const {
  const auto say = [&](const ui::Colour& colour, const std::string& text) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float room = size.x - ui::scaled(60), margin = ui::scaled(14);
    const ImVec2 textSize = ImGui::CalcTextSize(text.c_str(), nullptr, false, room);
    const ImVec2 at(low.x + (size.x - textSize.x) / 2, low.y + size.y / 2 - textSize.y / 2);
    list.AddRectFilled({at.x - margin, at.y - margin},
                       {at.x + textSize.x + margin, at.y + textSize.y + margin},
                       ui::palette::backdrop.withOpacity(0.86F).packed(), ui::scaled(5));
    ImFont* font = context.window.fonts().regular;
    list.AddText(font, font->FontSize, at, colour.packed(), text.c_str(), nullptr, room);
  };
  const Session& session = context.actions.session;
  if (session.built() && session.built()->layout->regions.empty())
    say(ui::palette::text, tr("No cells yet. Click a free place on the plan to add one."));
  else if (!problem_.empty())
    say(ui::palette::danger, problem_);
  else if (nothingBaked(session) && session.shippedWalk())
    say(ui::palette::text, tr("This walk has no captures: it was exported before anything was baked."));
  else if (nothingBaked(session) && !previewing_)
    say(ui::palette::text, tr("Nothing is baked yet. Press Bake (Ctrl+B) to see this place."));
  else if (!session.walk())
    say(ui::palette::muted, tr("Loading captures…"));
}

void WalkPanel::drawStatistics(PanelContext& context, const ImVec2& low, const ImVec2& size) const {
  Session& session = context.actions.session;
  const Layout& layout = *session.built()->layout;
  const auto region = layout.regionAt(glm::dvec2(context.state().walker.pose().eye));
  std::string where = tr("outside");
  if (region) {
    const Region& r = layout.regions[std::size_t(*region)];
    const char* kind = r.kind == RegionKind::ring ? tr("ring") : tr("gap");
    where = session.shippedWalk() ? fmt::format("{} {}", kind, r.id.i)
                                  : fmt::format("{} ({}, {})", kind, r.id.i, r.id.j);
  }
  std::string text = where;
  if (shown_.valid && problem_.empty() && !previewing_) {
    text += trf("   {} images", shown_.stats.images);
    if (shown_.stats.missingImages > 0) text += trf(" (+{} missing)", shown_.stats.missingImages);
    text += shown_.holeShare >= 0 ? trf("   holes {}", ui::formatPercent(shown_.holeShare)) : "";
    text += fmt::format("   {}×{}   {:.1f} ms", shown_.view.width, shown_.view.height,
                        shown_.stats.totalSeconds * 1000);
    if (showingGl_) text += "   OpenGL";
  }
  ImFont* small = context.window.fonts().small;
  float y = low.y + size.y - ui::scaled(11);  // lines go upwards from here
  const auto line = [&](const std::string& words) {
    y -= small->FontSize;
    ui::drawLabel(*ImGui::GetWindowDrawList(), small, {low.x + ui::scaled(12), y}, ui::palette::text,
                  words.c_str());
    y -= ui::scaled(8);
  };
  line(text);
  if (const auto& figures = session.variants().figures(); figures && session.captures()) {
    line(trf("against {} rays per pixel", VariantCompare::kTruthRays));
    line(nowText(*figures, session.captures()->bytes));
    line(keptText(*figures));
  }
  if (const auto& compared = session.comparing().compared()) {
    line(againstText(*compared) + (session.comparing().tracing() ? tr(", more on the way") : ""));
    line(figuresText(*compared));
  }
  if (shown_.valid)
    if (const std::string words = capturesAwaitedText(shown_.stats); !words.empty()) line(words);
  const bool lit = session.shippedWalk() || (session.walk() && session.walk()->walk.surfaceLight);
  if (session.walk() && !lit && !nothingBaked(session)) line(tr("near geometry unlit until a bake ends"));
  if (session.streaming()) line(tr("captures are being read"));
  if (session.walk() && session.walk()->coarse > 0) line(coarseText(*session.walk()));
}

}  // namespace acentric::editor
