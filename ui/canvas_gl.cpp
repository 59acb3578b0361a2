#include "ui/canvas_gl.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace acentric::ui {
namespace {

constexpr std::size_t kTableWidth = 2048;

void renderNow(const ImDrawList*, const ImDrawCmd* command) {
  const ImDrawData& data = *ImGui::GetDrawData();
  const ImVec2 scale = data.FramebufferScale;
  const ImVec4& clip = command->ClipRect;
  const float left = (clip.x - data.DisplayPos.x) * scale.x;
  const float right = (clip.z - data.DisplayPos.x) * scale.x;
  const float bottom = (data.DisplaySize.y - (clip.w - data.DisplayPos.y)) * scale.y;
  const float top = (data.DisplaySize.y - (clip.y - data.DisplayPos.y)) * scale.y;
  if (right <= left || top <= bottom) return;
  glScissor(int(left), int(bottom), int(right - left), int(top - bottom));
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glActiveTexture(GL_TEXTURE0);
  glBindSampler(0, 0);
  static_cast<const CanvasRender*>(command->UserCallbackData)
      ->render({{data.DisplayPos.x, data.DisplayPos.y}, {data.DisplaySize.x, data.DisplaySize.y}});
}

}  // namespace

void ColourTable::upload(std::span<const std::uint32_t> words) {
  rows_ = int((words.size() + kTableWidth - 1) / kTableWidth);
  ContentHash hash;
  hash.add(words);
  content_ = hash.value();
  if (rows_ == 0) return texture_.reset();
  std::vector<std::uint32_t> whole(words.begin(), words.end());
  whole.resize(std::size_t(rows_) * kTableWidth, 0);
  glBindTexture(GL_TEXTURE_2D, texture_.made());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R32UI, GLsizei(kTableWidth), rows_, 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
               whole.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glBindTexture(GL_TEXTURE_2D, 0);
}

void ColourTable::bind() const {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture_.name());
}

void addView(ContentHash& hash, const CanvasView& view) {
  for (const glm::dvec2& pair : {view.areaMin(), view.areaSize(), view.centre()}) hash.add(pair);
  hash.add(view.pixelsPerMetre());
}

void forVisibleTiles(const GlProgram& program, const CanvasView& view, const CanvasTarget& target,
                     const CanvasTiles& tiles, double marginPixels,
                     const std::function<void(std::size_t tile)>& draw) {
  program.set("uTable", 0);
  program.set("uPixelsPerMetre", float(view.pixelsPerMetre()));
  program.set("uTargetMin", float(target.min.x), float(target.min.y));
  program.set("uTargetSize", float(target.size.x), float(target.size.y));
  const int originAt = program.location("uPixelsFromOrigin");
  for (std::size_t t = 0; t < tiles.tiles.size(); ++t) {
    if (!onScreen(view, tiles.tiles[t].box, marginPixels)) continue;
    const glm::vec2 origin(view.screenFromWorld(tiles.tiles[t].origin));
    glUniform2f(originAt, origin.x, origin.y);
    draw(t);
  }
}

void addRender(ImDrawList& list, CanvasRender* render) {
  list.AddCallback(&renderNow, render);
  list.AddCallback(ImDrawCallback_ResetRenderState, nullptr);
}

std::uint64_t contentOf(const ImDrawCmd& command) {
  return static_cast<const CanvasRender*>(command.UserCallbackData)->content;
}

void uploadTo(GlName<GlKind::buffer>& buffer, unsigned target, const void* data, std::size_t bytes) {
  glBindBuffer(target, buffer.made());
  glBufferData(target, GLsizeiptr(bytes), data, GL_STATIC_DRAW);
}

}  // namespace acentric::ui
