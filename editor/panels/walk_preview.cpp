#include "editor/panels/walk_preview.h"

#include <fmt/format.h>

#include "ui/canvas_draw.h"
#include "ui/translate.h"

namespace acentric::editor {

void WalkPreview::clear() {
  if (!tracer_) return;
  stream_.clear();
  texture_.clear();
  tracer_.reset();
}

bool WalkPreview::draw(PanelContext& context, const PerspectiveView& view, const ImVec2& low,
                       const ImVec2& high) {
  const RayScenePtr& rays = context.session().built()->rays;
  if (!tracer_ || &tracer_->rays() != rays.get()) {
    clear();
    tracer_ = std::make_shared<const PreviewTracer>(rays);
  }
  stream_.want({tracer_, view, kNoCut});
  if (stream_.shown() ? stream_.take() : stream_.takeWithin(PreviewStream::kFirstWait)) {
    const PreviewShown& shown = *stream_.shown();
    const ColourImage& colour = shown.picture.colour;
    texture_.upload(colour.width, colour.height,
                    {&colour.pixels.front().x, colour.pixels.size() * sizeof(Rgba8)});
    context.window.pacer().request(1);
    if (shown.scale >= 1) context.log.event("walkpreview", fmt::format("{}x{}", colour.width, colour.height));
  }
  if (texture_.empty()) return false;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddImage(texture_.imguiId(), low, high);
  ui::drawLabel(list, context.window.fonts().small, {low.x + ui::scaled(12), low.y + ui::scaled(9)},
                ui::palette::text, tr("Not baked yet: a quick picture, without light. Ctrl+B bakes."));
  return true;
}

}  // namespace acentric::editor
