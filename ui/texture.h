#pragma once
/// An RGBA8 picture on the graphics card, for showing. Needs the window's context; main thread only.

#include <imgui.h>
#include <cstdint>
#include <span>

namespace acentric::ui {

class Texture {
 public:
  Texture() = default;
  ~Texture();
  Texture(Texture&& other) noexcept;
  Texture& operator=(Texture&& other) noexcept;

  /// Uploads width x height pixels, 4 bytes each, row 0 on top. `smooth`: linear filter, else nearest.
  void upload(int width, int height, std::span<const std::uint8_t> rgba, bool smooth = true);
  void clear();
  bool empty() const { return id_ == 0; }
  int width() const { return width_; }
  int height() const { return height_; }
  ImTextureID imguiId() const { return imguiTexture(id_, content_); }

  /// ImGui's handle of any OpenGL texture name. It says too which picture the texture holds, by a number that
  /// other pictures do not have, so that the window knows when it must draw it again (damage.h).
  static ImTextureID imguiTexture(unsigned name, std::uint32_t content);

 private:
  unsigned id_ = 0;
  int width_ = 0;
  int height_ = 0;
  std::uint32_t content_ = 0;
};

}  // namespace acentric::ui
