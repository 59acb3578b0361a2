#include "editor/panels/walk_overlays.h"

#include <algorithm>

#include "editor/panels/frame_graph.h"
#include "editor/panels/image_list.h"
#include "editor/session/truth_compare.h"
#include "ui/theme.h"

namespace acentric::editor {
namespace {

constexpr float kMargin = 10, kBelowLabels = 34;
constexpr float kMinimapWidth = 220, kListWidth = 300;

}  // namespace

float WalkOverlays::graphHeight(const PanelContext& context, float walkHeight) const {
  return context.actions.state.showFrameTimes ? std::clamp(0.32F * walkHeight, 96.0F, 168.0F) : 0;
}

bool WalkOverlays::cover(const glm::dvec2& position) const {
  return std::ranges::any_of(boxes_, [&](const Box& box) {
    return position.x >= double(box.low.x) && position.x < double(box.high.x) &&
           position.y >= double(box.low.y) && position.y < double(box.high.y);
  });
}

void WalkOverlays::follow(const WalkShown& shown) {
  const bool same = of_.loaded == shown.loaded && of_.frame == shown.frame &&
                    of_.settings == shown.settings && samePlace(of_.view, shown.view) &&
                    sameSize(of_.view, shown.view);
  if (same) return;
  of_ = shown;
  images_ = usedImages(*shown.loaded, shown.view, shown.settings, shown.frame.get());
}

WalkOverlays::Box WalkOverlays::drawMinimap(PanelContext& context, ImDrawList& list, const Box& room,
                                            const SourceColours& colours) {
  const float width = std::min(ui::scaled(kMinimapWidth), 0.5F * (room.high.x - room.low.x));
  const Box box{{room.high.x - width, room.low.y},
                {room.high.x, room.low.y + std::min(0.8F * width, 0.6F * (room.high.y - room.low.y))}};
  minimap_.draw(context, list, box.low, box.high, of_.loaded->walk.layout, images_, colours, pointedAt_);
  return box;
}

void WalkOverlays::drawSpotlight(ImDrawList& list, const ui::FittedImage& place) {
  if (!pointedAt_ || !of_.frame) return;
  if (spotlightOf_ != pointedAt_ || spotlightIn_ != of_.frame) {
    const ColourImage veil = spotlight(*of_.frame, *pointedAt_);
    spotlight_.upload(veil.width, veil.height, {&veil.pixels.front().x, veil.pixels.size() * sizeof(Rgba8)});
    spotlightOf_ = pointedAt_;
    spotlightIn_ = of_.frame;
  }
  list.AddImage(spotlight_.imguiId(), {float(place.min.x), float(place.min.y)},
                {float(place.min.x + place.size.x), float(place.min.y + place.size.y)});
}

void WalkOverlays::draw(PanelContext& context, ImDrawList& list, const ImVec2& low, const ImVec2& high,
                        const ui::FittedImage& place, const WalkShown& shown, const SourceColours* colours,
                        const FrameTimes& times) {
  const EditorState& state = context.state();
  boxes_.clear();
  const float graph = graphHeight(context, high.y - low.y);
  if (graph > 0) boxes_.push_back({{low.x, high.y - graph}, high});
  Box room{
      {low.x + ui::scaled(kMargin), low.y + ui::scaled(compares(state.walkLook) ? kBelowLabels : kMargin)},
      {high.x - ui::scaled(kMargin), high.y - graph - ui::scaled(kMargin)}};
  const bool images = needColours(state) && shown.loaded && colours != nullptr;
  if (images)
    follow(shown);
  else
    of_ = {};  // captures that the walk has dropped must not be kept
  if (!state.showImages) pointedAt_.reset();
  drawSpotlight(list, place);
  if (state.showMinimap && images) {
    const Box box = drawMinimap(context, list, room, *colours);
    boxes_.push_back(box);
    room.low.y = box.high.y + 6;
  }
  if (graph > 0) drawFrameGraph(context, list, {low.x, high.y - graph}, high, times);
  if (!state.showImages || !images || room.high.y - room.low.y < 40) return;
  const Box box{{room.high.x - std::min(ui::scaled(kListWidth), room.high.x - room.low.x), room.low.y},
                {room.high.x, std::min(room.high.y, room.low.y + imageListHeight(images_.size()))}};
  const std::optional<int> before = pointedAt_;
  pointedAt_ = drawImageList(context, box.low, box.high, images_, *colours);
  if (pointedAt_ != before) context.window.pacer().request();
  boxes_.push_back(box);
}

}  // namespace acentric::editor
