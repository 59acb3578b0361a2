#include "editor/overlays/bake_signs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "editor/overlays/scale_legend.h"
#include "ui/canvas_draw.h"
#include "ui/text_format.h"
#include "ui/theme.h"
#include "ui/translate.h"

namespace acentric::editor {
namespace {
namespace palette = ui::palette;
constexpr float kHalfTurn = 3.14159265F;
}  // namespace

ui::Colour colourOf(BakeState state) {
  switch (state) {
    case BakeState::missing:
      return palette::missing;
    case BakeState::partial:
      return palette::partly;
    case BakeState::stale:
      return palette::outdated;
    case BakeState::baked:
      return palette::done;
    case BakeState::baking:
      return palette::accent;
    case BakeState::failed:
      return palette::danger;
  }
  return palette::muted;
}

void drawBakeSign(ImDrawList& list, const ImVec2& at, BakeState state, float radius) {
  const ImU32 ink = colourOf(state).packed();
  const float r = radius, w = std::max(1.2F, radius * 0.22F);
  const auto line = [&](float x0, float y0, float x1, float y1) {
    list.AddLine({at.x + r * x0, at.y + r * y0}, {at.x + r * x1, at.y + r * y1}, ink, w);
  };
  list.AddCircleFilled(at, r + 2.5F, palette::backdrop.withOpacity(0.72F).packed(), 20);
  switch (state) {
    case BakeState::missing:
      list.AddCircle(at, r * 0.8F, ink, 20, w);
      break;
    case BakeState::partial:
      list.AddCircle(at, r * 0.8F, ink, 20, w);
      list.PathArcTo(at, r * 0.8F, 0.5F * kHalfTurn, 1.5F * kHalfTurn, 12);
      list.PathFillConvex(ink);
      break;
    case BakeState::stale:
      list.AddCircle(at, r * 0.9F, ink, 20, w);
      line(0, 0, 0, -0.55F);
      line(0, 0, 0.42F, 0.22F);
      break;
    case BakeState::baked:
      line(-0.75F, 0.05F, -0.2F, 0.6F);
      line(-0.2F, 0.6F, 0.8F, -0.6F);
      break;
    case BakeState::baking:
      list.PathArcTo(at, r * 0.8F, -0.3F * kHalfTurn, 1.3F * kHalfTurn, 16);
      list.PathStroke(ink, 0, w);
      list.AddTriangleFilled({at.x + r * 0.1F, at.y - r * 1.05F}, {at.x + r * 0.95F, at.y - r * 0.95F},
                             {at.x + r * 0.4F, at.y - r * 0.25F}, ink);
      break;
    case BakeState::failed:
      line(-0.65F, -0.65F, 0.65F, 0.65F);
      line(-0.65F, 0.65F, 0.65F, -0.65F);
      break;
  }
}

void drawBakeLegend(ImDrawList& list, const ui::CanvasView& view, std::span<const BakeState> regions,
                    ImFont* font) {
  std::array<std::size_t, kBakeStates> counts{};
  for (const BakeState state : regions) ++counts[std::size_t(state)];
  ScaleLegend legend{regions.empty() ? tr("No cells yet") : tr("Regions by bake state"), "", "", {}};
  for (int s = 0; s < kBakeStates; ++s)
    if (counts[std::size_t(s)] > 0)
      legend.lines.push_back(
          {fmt::format("{}  {}", nameOf(BakeState(s)), ui::formatCount(counts[std::size_t(s)])),
           palette::muted,
           [s](ImDrawList& on, const ImVec2& at) { drawBakeSign(on, at, BakeState(s), ui::scaled(4.5F)); }});
  drawScaleLegend(list, view, legend, font);
}

}  // namespace acentric::editor
