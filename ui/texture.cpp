#include "ui/texture.h"

#include <epoxy/gl.h>

#include <cstdint>
#include <utility>

#include "ui/content_hash.h"

namespace acentric::ui {

Texture::~Texture() { clear(); }

Texture::Texture(Texture&& other) noexcept
    : id_(std::exchange(other.id_, 0)),
      width_(other.width_),
      height_(other.height_),
      content_(other.content_) {}

Texture& Texture::operator=(Texture&& other) noexcept {
  if (this != &other) {
    clear();
    id_ = std::exchange(other.id_, 0);
    width_ = other.width_;
    height_ = other.height_;
    content_ = other.content_;
  }
  return *this;
}

void Texture::upload(int width, int height, std::span<const std::uint8_t> rgba, bool smooth) {
  if (width <= 0 || height <= 0 || rgba.size() < std::size_t(width) * std::size_t(height) * 4) return;
  const bool resized = id_ == 0 || width != width_ || height != height_;
  if (id_ == 0) glGenTextures(1, &id_);
  glBindTexture(GL_TEXTURE_2D, id_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  if (resized)
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  else
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  const GLint filter = smooth ? GL_LINEAR : GL_NEAREST;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glBindTexture(GL_TEXTURE_2D, 0);
  width_ = width;
  height_ = height;
  ContentHash hash;
  hash.add(width);
  hash.add(smooth);
  hash.add(rgba.first(std::size_t(width) * std::size_t(height) * 4));
  content_ = std::uint32_t(hash.value());
}

void Texture::clear() {
  if (id_ != 0) glDeleteTextures(1, &id_);
  id_ = 0;
}

ImTextureID Texture::imguiTexture(unsigned name, std::uint32_t content) {
  // ImGui's OpenGL backend reads the lower half.
  static_assert(sizeof(ImTextureID) == 8 && sizeof name == 4);
  return reinterpret_cast<ImTextureID>(std::uintptr_t(content) << 32 | name);
}

}  // namespace acentric::ui
