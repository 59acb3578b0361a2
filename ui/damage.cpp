#include "ui/damage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/canvas_gl.h"
#include "ui/content_hash.h"

namespace acentric::ui {
namespace {

struct Box {
  glm::vec2 low{0}, high{0};
};

glm::vec2 pixelsOf(const ImDrawData& data, float x, float y) {
  return {(x - data.DisplayPos.x) * data.FramebufferScale.x,
          (y - data.DisplayPos.y) * data.FramebufferScale.y};
}

Box clipOf(const ImDrawData& data, const ImDrawCmd& command) {
  const ImVec4& clip = command.ClipRect;
  return {pixelsOf(data, clip.x, clip.y), pixelsOf(data, clip.z, clip.w)};
}

int heightOf(const ImDrawData& data) {
  return int(std::lround(data.DisplaySize.y * data.FramebufferScale.y));
}

/// The pixels that ImGui's backend and canvases clip to: they cut fractions off, counting y from below.
PixelRect scissorOf(const ImDrawData& data, const ImDrawCmd& command) {
  const auto [low, high] = clipOf(data, command);
  const int bottom = heightOf(data) - int(float(heightOf(data)) - high.y);
  return {{int(low.x), bottom - int(high.y - low.y)}, {int(low.x) + int(high.x - low.x), bottom}};
}

/// What they cut to just these pixels.
ImVec4 clipRectOf(const ImDrawData& data, const PixelRect& pixels) {
  constexpr float kBit = 0.1F;  // of a pixel, so that rounding cuts none off
  const ImVec2 scale = data.FramebufferScale, at = data.DisplayPos;
  return {(float(pixels.min.x) + kBit) / scale.x + at.x, (float(pixels.min.y) - 2 * kBit) / scale.y + at.y,
          (float(pixels.max.x) + 2 * kBit) / scale.x + at.x, (float(pixels.max.y) - kBit) / scale.y + at.y};
}

bool isReset(const ImDrawCmd& command) { return command.UserCallback == ImDrawCallback_ResetRenderState; }

/// Of the corners of a command's triangles.
Box boxOf(const ImDrawData& data, const ImDrawList& list, const ImDrawCmd& command) {
  Box box{glm::vec2(1e9F), glm::vec2(-1e9F)};
  for (unsigned i = 0; i < command.ElemCount; ++i) {
    const ImDrawIdx index = list.IdxBuffer[int(command.IdxOffset + i)];
    const ImVec2& at = list.VtxBuffer[int(command.VtxOffset + index)].pos;
    const glm::vec2 pixel = pixelsOf(data, at.x, at.y);
    box.low = glm::min(box.low, pixel), box.high = glm::max(box.high, pixel);
  }
  return box;
}

}  // namespace

void Damage::addTo(const glm::vec2& low, const glm::vec2& high, std::uint64_t content) {
  if (!(low.x < high.x) || !(low.y < high.y)) return;
  const glm::vec2 most(count_ - 1);
  const glm::ivec2 first(glm::clamp(glm::floor(low / float(kTile)), glm::vec2(0), most));
  const glm::ivec2 last(glm::clamp(glm::floor(high / float(kTile)), glm::vec2(0), most));
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) {
      std::uint64_t& tile = tiles_[std::size_t(y) * std::size_t(count_.x) + std::size_t(x)];
      tile = (tile ^ content) * 0x9e3779b97f4a7c15ULL;
      tile ^= tile >> 29;  // later ones depend on all bits of earlier ones
    }
}

void Damage::addCommand(const ImDrawData& data, const ImDrawList& list, const ImDrawCmd& command) {
  const Box clip = clipOf(data, command);
  if (isReset(command)) return;
  ContentHash whole;
  whole.add(command.ClipRect);
  whole.add(command.TextureId);
  if (command.UserCallback != nullptr) {
    whole.add(contentOf(command));
    return addTo(clip.low, clip.high, whole.value());
  }
  for (unsigned i = 0; i + 2 < command.ElemCount; i += 3) {
    ImDrawVert corners[3];
    Box box{glm::vec2(1e9F), glm::vec2(-1e9F)};
    for (unsigned k = 0; k < 3; ++k) {
      const ImDrawIdx index = list.IdxBuffer[int(command.IdxOffset + i + k)];
      corners[k] = list.VtxBuffer[int(command.VtxOffset + index)];
      const glm::vec2 pixel = pixelsOf(data, corners[k].pos.x, corners[k].pos.y);
      box.low = glm::min(box.low, pixel), box.high = glm::max(box.high, pixel);
    }
    ContentHash triangle = whole;
    triangle.add(corners);
    addTo(glm::max(box.low, clip.low), glm::min(box.high, clip.high), triangle.value());
  }
}

std::vector<PixelRect> Damage::rectsOf(const std::vector<std::uint64_t>& former) const {
  std::vector<PixelRect> rects;  // in tiles
  const auto changed = [&](int x, int y) {
    const std::size_t t = std::size_t(y) * std::size_t(count_.x) + std::size_t(x);
    return tiles_[t] != former[t];
  };
  for (int y = 0; y < count_.y; ++y)
    for (int x = 0; x < count_.x; ++x) {
      if (!changed(x, y)) continue;
      const int first = x;
      while (x < count_.x && changed(x, y)) ++x;
      const auto above = std::ranges::find_if(rects, [&](const PixelRect& rect) {
        return rect.max.y == y && rect.min.x == first && rect.max.x == x;
      });
      if (above != rects.end())
        ++above->max.y;
      else
        rects.push_back({{first, y}, {x, y + 1}});
    }
  if (rects.size() > kMost) {
    PixelRect all = rects.front();
    for (const PixelRect& rect : rects)
      all.min = glm::min(all.min, rect.min), all.max = glm::max(all.max, rect.max);
    rects.assign(1, all);
  }
  for (PixelRect& rect : rects) rect.min *= kTile, rect.max = glm::min(rect.max * kTile, size_);
  return rects;
}

std::vector<PixelRect> Damage::update(const ImDrawData& data) {
  const glm::ivec2 size(std::lround(data.DisplaySize.x * data.FramebufferScale.x), heightOf(data));
  const bool all = tiles_.empty() || size != size_;
  size_ = size;
  if (size.x < 1 || size.y < 1) return tiles_.clear(), std::vector<PixelRect>();
  count_ = (size + kTile - 1) / kTile;
  const std::vector<std::uint64_t> former =
      std::exchange(tiles_, std::vector<std::uint64_t>(std::size_t(count_.x) * std::size_t(count_.y)));
  for (int n = 0; n < data.CmdListsCount; ++n)
    for (const ImDrawCmd& command : data.CmdLists[n]->CmdBuffer) addCommand(data, *data.CmdLists[n], command);
  if (all) return {{{0, 0}, size}};
  return rectsOf(former);
}

void clipTo(ImDrawData& data, const std::vector<PixelRect>& rects) {
  for (int n = 0; n < data.CmdListsCount; ++n) {
    ImDrawList& list = *data.CmdLists[n];
    ImVector<ImDrawCmd> kept;
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (isReset(command)) {
        if (!kept.empty() && kept.back().UserCallback != nullptr && !isReset(kept.back()))
          kept.push_back(command);
        continue;
      }
      PixelRect seen = scissorOf(data, command);
      if (command.UserCallback == nullptr) {
        const Box box = boxOf(data, list, command);
        seen.min = glm::max(seen.min, glm::ivec2(glm::floor(box.low)));
        seen.max = glm::min(seen.max, glm::ivec2(glm::ceil(box.high)));
      }
      for (const PixelRect& rect : rects) {
        const PixelRect shown{glm::max(seen.min, rect.min), glm::min(seen.max, rect.max)};
        if (shown.min.x >= shown.max.x || shown.min.y >= shown.max.y) continue;
        ImDrawCmd part = command;
        part.ClipRect = clipRectOf(data, shown);
        kept.push_back(part);
      }
    }
    list.CmdBuffer.swap(kept);
  }
}

}  // namespace acentric::ui
