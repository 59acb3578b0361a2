/// The picture of the walk panel: when it is drawn anew, by whom, and what is said of it.
#include <fmt/format.h>

#include <algorithm>

#include "editor/panels/walk_panel.h"
#include "editor/session/mesh_text.h"
#include "engine/geometry/conventions.h"
#include "ui/canvas_draw.h"
#include "ui/image_view.h"
#include "ui/text_format.h"

namespace acentric::editor {
namespace {

constexpr Rgba8 kHoleColour{13, 14, 16, 255};

bool samePlace(const PerspectiveView& a, const PerspectiveView& b) {
  return a.eye == b.eye && a.yawRadians == b.yawRadians && a.pitchRadians == b.pitchRadians &&
         a.fovRadians == b.fovRadians;
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

bool WalkPanel::stale(const PanelContext& context, const PerspectiveView& full) const {
  const Session& session = context.actions.session;
  return !shown_.valid || shown_.loaded != session.walk() || !samePlace(shown_.view, full) ||
         shown_.view.width != full.width || shown_.view.height != full.height ||
         shown_.settings != session.project().view;
}

void WalkPanel::requestFrame(PanelContext& context) {
  Session& session = context.session();
  if (!session.walk() || area_.x < 16 || area_.y < 16) return;
  if (onOpenGl(session.project().view.renderer)) return drawWithGl(context);
  if (gl_) gl_->stopBuilding();
  const PerspectiveView full = viewAt(context, 1);
  if (requested_ || !stale(context, full)) return;
  const bool moving = context.state().walker.moving() || looking_ || !samePlace(shown_.view, full);
  const double scale = moving ? resolution_.movingScale() : 1.0;
  renderer_.request({session.walk(), viewAt(context, scale), session.project().view, scale});
  requested_ = true;
}

const SourceColours& WalkPanel::coloursOf(const std::shared_ptr<const Layout>& layout) {
  if (!colours_ || colouredLayout_ != layout) colours_.emplace(*layout);
  colouredLayout_ = layout;
  return *colours_;
}

void WalkPanel::show(const Frame& frame) {
  const auto& layout = shown_.loaded->walk.layout;
  const ColourImage colour = shown_.look == WalkLook::sources
                                 ? sourcePicture(frame, coloursOf(layout), SourceRoles(*layout, shown_.view))
                                 : ColourImage();
  const ColourImage& from = shown_.look == WalkLook::sources ? colour : frame.colour;
  pixels_.resize(from.pixels.size() * 4);
  for (std::size_t i = 0; i < from.pixels.size(); ++i) {
    const PixelSource source = frame.source.pixels[i];
    Rgba8 pixel = from.pixels[i];
    if (shown_.look == WalkLook::holes && (source == kSourceHole || source == kSourceInvented))
      pixel = kInventedColour;
    else if (source == kSourceHole)
      pixel = kHoleColour;
    pixels_[4 * i] = pixel.r;
    pixels_[4 * i + 1] = pixel.g;
    pixels_[4 * i + 2] = pixel.b;
    pixels_[4 * i + 3] = 255;
  }
  texture_.upload(from.width, from.height, pixels_);
  showingGl_ = false;
}

void WalkPanel::nameSource(const glm::dvec2& pointer) const {
  const Image<PixelSource>& source = lastFrame_.source;
  if (shown_.look != WalkLook::sources || showingGl_ || source.empty() || looking_) return;
  const glm::dvec2 at = (pointer - place_.min) / place_.size * glm::dvec2(source.width, source.height);
  if (at.x < 0 || at.y < 0 || at.x >= source.width || at.y >= source.height) return;
  const PixelSource here = source.at(int(at.x), int(at.y));
  const Layout& layout = *shown_.loaded->walk.layout;
  const SourceRole role = SourceRoles(layout, shown_.view).of(here);
  std::string text = sourceName(layout, here) + (role == SourceRole::otherHand ? " (other hand)" : "");
  for (const MeshCost& cost : shown_.stats.meshes)
    if (sourceOfCamera(cost.camera) == here) text += "\n" + meshText(cost);
  ui::tooltip(text);
}

void WalkPanel::takePicture(PanelContext& context) {
  auto picture = renderer_.take();
  if (picture) {
    requested_ = false;
    context.window.pacer().request(1);
    const WalkRequest& request = picture->request;
    shown_ = {request.loaded,
              request.view,
              request.settings,
              context.state().walkLook,
              picture->frame.stats,
              -1,
              true};
    problem_ = picture->problem;
    if (problem_.empty()) {
      renderer_.recycle(std::move(lastFrame_));
      lastFrame_ = std::move(picture->frame);
      resolution_.measured(request.scale, lastFrame_.stats.totalSeconds);
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

void WalkPanel::openGl() {
  if (gl_ || !glProblem_.empty()) return;
  auto created = GlRenderer::create(
      {.waitForCaptures = false, .backgroundThreads = std::max(1, threads_ / 2), .wake = wake_});
  if (created)
    gl_ = std::move(*created);
  else
    glProblem_ = created.error().describe();
}

bool WalkPanel::receive(PanelContext& context) {
  const Result<bool> ready = gl_->receive();
  if (gl_->anyToReceive()) context.window.pacer().request(1);
  if (!ready) problem_ = ready.error().describe();
  return ready && *ready;
}

void WalkPanel::drawWithGl(PanelContext& context) {
  Session& session = context.session();
  openGl();
  if (!gl_) {
    problem_ = "The OpenGL renderer is not available here: " + glProblem_;
    return;
  }
  const PerspectiveView full = viewAt(context, 1);
  const WalkLook look = context.state().walkLook;
  const bool plain = look == WalkLook::picture;
  const bool news = receive(context);
  if (!news && !stale(context, full) && shown_.look == look && showingGl_ == plain) return;
  const bool moving = context.state().walker.moving() || looking_ || !samePlace(shown_.view, full);
  const double scale = moving ? resolution_.movingScale() : 1.0;
  const PerspectiveView view = viewAt(context, scale);
  const auto stats = gl_->draw(session.walk()->walk, view, session.project().view);
  shown_ = {session.walk(), view, session.project().view, look, stats ? *stats : FrameStats{}, -1, true};
  if (stats) resolution_.measured(scale, stats->totalSeconds);
  if (moving) context.window.pacer().request();  // the full picture follows once the eye rests
  problem_ = stats ? "" : stats.error().describe();
  if (!stats) return;
  if (context.log.on())
    context.log.event(
        "glframe",
        fmt::format("{}x{} images {} meshes {} awaited {} points {} captures {} missing {}", view.width,
                    view.height, stats->images, stats->meshes.size(), stats->meshesAwaited,
                    stats->pointsForMeshes, stats->capturesAwaited, stats->missingImages));
  showingGl_ = true;
  if (plain) return;
  lastFrame_ = gl_->readBack();
  shown_.holeShare =
      double(lastFrame_.holeCount()) / double(std::max<std::size_t>(1, lastFrame_.source.pixels.size()));
  show(lastFrame_);
}

void WalkPanel::drawPicture(PanelContext& context, const ImVec2& low, const ImVec2& size) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, {low.x + size.x, low.y + size.y}, ui::palette::backdrop.packed());
  const auto say = [&](const ui::Colour& colour, const std::string& text) {
    const ImVec2 textSize = ImGui::CalcTextSize(text.c_str(), nullptr, false, size.x - 60);
    const ImVec2 at(low.x + (size.x - textSize.x) / 2, low.y + size.y / 2 - textSize.y / 2);
    list.AddRectFilled({at.x - 14, at.y - 10}, {at.x + textSize.x + 14, at.y + textSize.y + 10},
                       ui::palette::backdrop.withOpacity(0.86F).packed(), 5);
    ImFont* font = context.window.fonts().regular;
    list.AddText(font, font->FontSize, at, colour.packed(), text.c_str(), nullptr, size.x - 60);
  };
  const bool picture = showingGl_ ? gl_ != nullptr : !texture_.empty();
  if (shown_.valid && picture) {
    const double aspect = double(shown_.view.width) / shown_.view.height;
    place_ = ui::fitImage(ui::fromIm(low), ui::fromIm(size), aspect);
    ui::drawImage(showingGl_ ? ui::Texture::imguiTexture(gl_->colourTexture()) : texture_.imguiId(), place_,
                  showingGl_);
  }
  const Session& session = context.session();
  if (!problem_.empty())
    say(ui::palette::danger, problem_);
  else if (session.captures() && session.captures()->baked == 0 && !session.baking().running() &&
           (!session.walk() || session.walk()->coarse == 0))
    say(ui::palette::text, "Nothing is baked yet. Press Bake (Ctrl+B) to see this place.");
  else if (!session.walk())
    say(ui::palette::muted, "Loading captures…");
}

void WalkPanel::drawStatistics(PanelContext& context, const ImVec2& low, const ImVec2& size) const {
  const Session& session = context.actions.session;
  const Layout& layout = *session.built()->layout;
  const auto region = layout.regionAt(glm::dvec2(context.state().walker.pose().eye));
  std::string where = "outside";
  if (region) {
    const Region& r = layout.regions[std::size_t(*region)];
    where = fmt::format("{} ({}, {})", r.kind == RegionKind::ring ? "ring" : "gap", r.id.i, r.id.j);
  }
  std::string text = where;
  if (shown_.valid && problem_.empty()) {
    text += fmt::format("   {} images", shown_.stats.images);
    if (shown_.stats.missingImages > 0) text += fmt::format(" (+{} missing)", shown_.stats.missingImages);
    text += shown_.holeShare >= 0 ? fmt::format("   holes {}", ui::formatPercent(shown_.holeShare)) : "";
    text += fmt::format("   {}×{}   {:.1f} ms", shown_.view.width, shown_.view.height,
                        shown_.stats.totalSeconds * 1000);
  }
  ImFont* small = context.window.fonts().small;
  float y = low.y + size.y - 11;  // lines go upwards from here
  const auto line = [&](const std::string& words) {
    y -= small->FontSize;
    ui::drawLabel(*ImGui::GetWindowDrawList(), small, {low.x + 12, y}, ui::palette::text, words.c_str());
    y -= 8;
  };
  line(text);
  if (shown_.valid)
    for (const std::string& words :
         {meshSumText(shown_.stats), meshesAwaitedText(shown_.stats), capturesAwaitedText(shown_.stats)})
      if (!words.empty()) line(words);
  if (session.walk() && !session.walk()->walk.surfaceLight) line("near geometry unlit until a bake ends");
  if (session.streaming()) line("captures are being read");
  if (session.walk() && session.walk()->coarse > 0) line(coarseText(*session.walk()));
}

}  // namespace acentric::editor
