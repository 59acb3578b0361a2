#include "editor/panels/walk_compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ui/canvas_draw.h"
#include "ui/keys.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {
namespace palette = ui::palette;

constexpr double kGripPixels = 7;  ///< to either side of the border
constexpr float kLabelY = 9, kLabelX = 12;

void upload(ui::Texture& texture, const ColourImage& picture) {
  texture.upload(picture.width, picture.height,
                 {&picture.pixels.front().x, picture.pixels.size() * sizeof(Rgba8)});
}

float widthOf(ImFont* font, const std::string& text) {
  return font->CalcTextSizeA(font->FontSize, 2000, 0, text.c_str()).x;
}

}  // namespace

bool WalkCompare::onBorder(const PanelContext& context, const glm::dvec2& position) const {
  const EditorState& state = context.actions.state;
  const glm::dvec2 inside = position - place_.min;
  return isSplit(state.walkLook) && inside.y >= 0 && inside.y < place_.size.y &&
         std::abs(inside.x - state.splitAt * place_.size.x) <= kGripPixels;
}

bool WalkCompare::handle(PanelContext& context, const ui::InputEvent& event) {
  using Kind = ui::InputEvent::Kind;
  if (event.kind == Kind::buttonPress && !context.inputBlocked && event.code == ui::mouse::left &&
      onBorder(context, event.position))
    return dragging_ = true;
  if (!dragging_) return false;
  if (event.kind == Kind::buttonRelease) dragging_ = false;
  if (event.kind == Kind::move)
    context.state().splitAt =
        std::clamp((event.position.x - place_.min.x) / std::max(1.0, place_.size.x), 0.0, 1.0);
  return true;
}

WalkCompare::Sides WalkCompare::sidesOf(PanelContext& context, const Truth* truth) const {
  if (context.state().walkLook == WalkLook::variant) {
    const VariantCompare& variants = context.session().variants();
    const bool there = variants.frame() != nullptr;
    const std::string waiting =
        variants.problem().empty() ? tr("the kept variant is drawn once the eye rests") : variants.problem();
    return {there, true, there ? tr("kept") : waiting, tr("now"), tr("now")};
  }
  const bool there = truth != nullptr;
  const bool tracing = context.session().comparing().tracing();
  return {there, false, tr("walk"),
          there     ? describe(*truth)
          : tracing ? tr("tracing the truth")
                    : tr("the truth is traced once the eye rests"),
          tr("truth")};
}

void WalkCompare::drawSplit(PanelContext& context, ImDrawList& list, const Sides& sides) {
  const auto share = float(context.state().splitAt);
  const ImVec2 low = ui::imVec(place_.min), high = ui::imVec(place_.min + place_.size);
  const float x = low.x + share * (high.x - low.x);
  const ImVec2 from(sides.left ? low.x : x, low.y), to(sides.left ? x : high.x, high.y);
  if (sides.there && !texture_.empty())
    list.AddImage(texture_.imguiId(), from, to, {sides.left ? 0 : share, 0}, {sides.left ? share : 1, 1});
  else
    list.AddRectFilled(from, to, palette::backdrop.withOpacity(0.45F).packed());
  const bool held =
      dragging_ || (!context.inputBlocked && onBorder(context, ui::fromIm(ImGui::GetMousePos())));
  const ImU32 colour = (held ? palette::accent : palette::text).packed();
  list.AddLine({x, low.y}, {x, high.y}, palette::backdrop.withOpacity(0.7F).packed(), 4);
  list.AddLine({x, low.y}, {x, high.y}, colour, held ? 2.5F : 1.5F);
  const ImVec2 grip(x, 0.5F * (low.y + high.y));
  list.AddCircleFilled(grip, 9, palette::backdrop.withOpacity(0.85F).packed());
  list.AddCircle(grip, 9, colour, 0, 1.5F);
  list.AddTriangleFilled({grip.x - 6, grip.y}, {grip.x - 2, grip.y - 4}, {grip.x - 2, grip.y + 4}, colour);
  list.AddTriangleFilled({grip.x + 6, grip.y}, {grip.x + 2, grip.y + 4}, {grip.x + 2, grip.y - 4}, colour);
  if (held) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  context.log.rect("walk.border", x - 3, low.y, x + 3, high.y);

  ImFont* font = context.window.fonts().small;
  list.PushClipRect(low, {x - 2, high.y}, true);
  ui::drawLabel(list, font, {low.x + kLabelX, low.y + kLabelY},
                (sides.there || !sides.left ? palette::text : palette::muted), sides.leftName.c_str());
  list.PopClipRect();
  const float room = high.x - x - 2 * kLabelX;
  const float width = widthOf(font, sides.rightName);
  list.PushClipRect({x + 2, low.y}, high, true);
  ui::drawLabel(list, font, {width > room ? x + kLabelX : high.x - kLabelX - width, low.y + kLabelY},
                sides.there || sides.left ? palette::text : palette::muted,
                width > room ? sides.shortName : sides.rightName.c_str());
  list.PopClipRect();
}

void WalkCompare::drawDifference(PanelContext& context, ImDrawList& list,
                                 const std::shared_ptr<const Truth>& truth,
                                 const std::shared_ptr<const Frame>& frame) {
  const bool there = truth != nullptr && frame != nullptr;
  if (there) ui::drawImage(texture_.imguiId(), place_, false);
  const std::string name = there ? trf("difference from {}, ×{}", describe(*truth), shownGain_)
                                 : std::string(tr("the difference is shown once the eye rests"));
  ui::drawLabel(list, context.window.fonts().small,
                {float(place_.min.x) + kLabelX, float(place_.min.y) + kLabelY},
                there ? palette::text : palette::muted, name.c_str());
}

/// What is to be shown goes to the graphics card when it is another.
void WalkCompare::follow(PanelContext& context, const std::shared_ptr<const Truth>& truth,
                         const std::shared_ptr<const Frame>& frame) {
  const EditorState& state = context.state();
  const bool difference = state.walkLook == WalkLook::difference;
  const std::shared_ptr<const Frame>& kept = context.session().variants().frame();
  const bool variant = state.walkLook == WalkLook::variant;
  const std::shared_ptr<const void> other =
      variant ? std::shared_ptr<const void>(kept) : std::shared_ptr<const void>(truth);
  const std::shared_ptr<const Frame> of = difference ? frame : nullptr;
  const int gain = difference ? state.differenceGain : 0;
  if (!other || (difference && !frame)) return;
  if (other == shownOther_ && of == shownFrame_ && gain == shownGain_) return;
  upload(texture_, variant      ? kept->colour
                   : difference ? differenceImage(frame->colour, truth->frame.colour, gain)
                                : truth->frame.colour);
  shownOther_ = other;
  shownFrame_ = of;
  shownGain_ = gain;
}

void WalkCompare::draw(PanelContext& context, ImDrawList& list, const ui::FittedImage& place,
                       const std::shared_ptr<const Frame>& frame) {
  place_ = place;
  if (!compares(context.state().walkLook)) {
    shownOther_.reset();
    shownFrame_.reset();
    dragging_ = false;
    return;
  }
  const std::shared_ptr<const Truth> truth = context.session().comparing().truth();
  follow(context, truth, frame);
  list.PushClipRect(ui::imVec(place.min), ui::imVec(place.min + place.size), true);
  if (isSplit(context.state().walkLook))
    drawSplit(context, list, sidesOf(context, truth.get()));
  else
    drawDifference(context, list, truth, frame);
  list.PopClipRect();
}

}  // namespace acentric::editor
