#include "editor/panels/frame_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ui/translate.h"

namespace acentric::editor {
namespace {
namespace palette = ui::palette;

constexpr float kMargin = 10, kLine = 17;
constexpr double kSmooth = 1.0 / 60, kLeastSmooth = 1.0 / 30;  ///< seconds: 60 and 30 frames a second
constexpr double kLeastTop = 0.040, kMostTop = 0.120;          ///< longer bars are cut off

ui::Colour colourOf(FramePart part) {
  switch (part) {
    case FramePart::plan:
      return ui::Colour::hex(0xb18cff);
    case FramePart::send:
      return palette::danger;
    case FramePart::captures:
      return palette::accent;
    case FramePart::local:
      return palette::good;
    case FramePart::fill:
      return palette::warning;
    case FramePart::present:
      return palette::faint;
  }
  return palette::text;
}

/// Words one after another in one line, each with its colour.
class LineOfText {
 public:
  LineOfText(ImDrawList& list, ImFont* font, const ImVec2& at, float right)
      : list_(list), font_(font), at_(at), left_(at.x), right_(right) {}
  void add(const ui::Colour& colour, const std::string& words, const ui::Colour* swatch = nullptr) {
    const float width = font_->CalcTextSizeA(font_->FontSize, 2000, 0, words.c_str()).x;
    const float mark = swatch != nullptr ? 13.0F : 0.0F;
    if (at_.x > left_ && at_.x + mark + width > right_) at_ = {left_, at_.y + kLine};
    if (swatch != nullptr)
      list_.AddRectFilled({at_.x, at_.y + 3}, {at_.x + 9, at_.y + 12}, swatch->packed(), 2);
    list_.AddText(font_, font_->FontSize, {at_.x + mark, at_.y}, colour.packed(), words.c_str());
    at_.x += mark + width + 14;
  }
  float bottom() const { return at_.y + kLine; }

 private:
  ImDrawList& list_;
  ImFont* font_;
  ImVec2 at_;
  float left_, right_;
};

float drawHeader(ImDrawList& list, ImFont* font, const ImVec2& low, const ImVec2& high,
                 const FrameTimes& times) {
  LineOfText words(list, font, {low.x + kMargin, low.y + 6}, high.x - kMargin);
  const Spread spread = times.spread();
  words.add(palette::text, trf("{} frames of the walk", spread.count));
  if (spread.count > 0) {
    words.add(palette::text, trf("median {:.1f} ms", 1e3 * spread.median));
    words.add(palette::text, fmt::format("p99 {:.1f} ms", 1e3 * spread.p99));
  }
  LineOfText legend(list, font, {low.x + kMargin, words.bottom()}, high.x - kMargin);
  for (std::size_t part = 0; part < kFrameParts; ++part) {
    const ui::Colour colour = colourOf(FramePart(part));
    legend.add(palette::muted, nameOf(FramePart(part)), &colour);
  }
  return legend.bottom() + 4;
}

std::string partsText(const FrameCost& frame) {
  std::string text = fmt::format("{:.2f} ms", 1e3 * frame.total());
  for (std::size_t part = 0; part < kFrameParts; ++part)
    text += fmt::format("\n{:.2f} ms   {}: {}", 1e3 * frame.seconds[part], nameOf(FramePart(part)),
                        helpFor(FramePart(part)));
  return text;
}

void drawLimit(ImDrawList& list, ImFont* font, float left, float right, float y, double seconds) {
  list.AddLine({left, y}, {right, y}, palette::text.withOpacity(0.35F).packed(), 1);
  const std::string text = fmt::format("{:.1f} ms", 1e3 * seconds);
  const float x = seconds > kSmooth ? left : left + 62;  // beside each other: they may be close
  list.AddText(font, font->FontSize, {x + 2, y - font->FontSize - 1},
               palette::text.withOpacity(0.8F).packed(), text.c_str());
}

}  // namespace

void drawFrameGraph(PanelContext& context, ImDrawList& list, const ImVec2& low, const ImVec2& high,
                    const FrameTimes& times) {
  ImFont* font = context.window.fonts().small;
  context.log.rect("walk.frameTimes", low.x, low.y, high.x, high.y);
  list.AddRectFilled(low, high, palette::backdrop.withOpacity(0.94F).packed());
  list.AddLine(low, {high.x, low.y}, palette::border.packed());
  list.PushClipRect(low, high, true);
  const float top = drawHeader(list, font, low, high, times);
  const float left = low.x + kMargin, right = high.x - kMargin, bottom = high.y - 8;
  const Spread spread = times.spread();
  const double most = std::clamp(1.1 * spread.p99, kLeastTop, kMostTop);
  const float scale = (bottom - top) / float(most);
  const float step = (right - left) / float(FrameTimes::kMost);
  const auto& frames = times.frames();
  const ImVec2 mouse = ImGui::GetMousePos();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const float x = right - step * float(frames.size() - i);
    float y = bottom;
    for (std::size_t part = 0; part < kFrameParts; ++part) {
      const float next = std::max(top, y - scale * float(frames[i].seconds[part]));
      list.AddRectFilled({x, next}, {x + std::max(1.0F, step * 0.85F), y},
                         colourOf(FramePart(part)).packed());
      y = next;
    }
    if (!context.inputBlocked && mouse.x >= x && mouse.x < x + step && mouse.y >= top && mouse.y < bottom)
      ImGui::SetTooltip("%s", partsText(frames[i]).c_str());
  }
  for (const double limit : {kSmooth, kLeastSmooth})
    drawLimit(list, font, left, right, bottom - scale * float(limit), limit);
  list.AddLine({left, bottom}, {right, bottom}, palette::border.packed());
  if (frames.empty())
    list.AddText(font, font->FontSize, {left, 0.5F * (top + bottom)}, palette::muted.packed(),
                 tr("No frame yet: walk, or look around."));
  list.PopClipRect();
}

}  // namespace acentric::editor
