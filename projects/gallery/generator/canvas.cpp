#include "projects/gallery/generator/canvas.h"

#include <stb_image_write.h>

#include <algorithm>
#include <cmath>

#include "engine/base/contract.h"

namespace acentric::gallery {
namespace {

float linearOf(float coded) {
  return coded <= 0.04045f ? coded / 12.92f : std::pow((coded + 0.055f) / 1.055f, 2.4f);
}

unsigned char codeOf(float linear) {
  const float v = std::clamp(linear, 0.0f, 1.0f);
  const float coded = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
  return static_cast<unsigned char>(std::lround(255 * coded));
}

void appendBytes(void* context, void* data, int size) {
  const auto* first = static_cast<const std::byte*>(data);
  auto* out = static_cast<std::vector<std::byte>*>(context);
  out->insert(out->end(), first, first + size);
}

}  // namespace

glm::vec3 colour(unsigned hex) {
  const auto channel = [&](unsigned shift) {
    return linearOf(static_cast<float>((hex >> shift) & 255U) / 255.0f);
  };
  return {channel(16), channel(8), channel(0)};
}

glm::vec3 gradient(const std::vector<glm::vec3>& stops, float t) {
  const float place = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(stops.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  return glm::mix(stops[low], stops[low + 1], place - static_cast<float>(low));
}

Canvas::Canvas(int width, int height, const glm::vec3& ground)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), ground),
      alpha_(pixels_.size(), 1.0f) {}

glm::vec3& Canvas::at(int x, int y) {
  return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(x)];
}
const glm::vec3& Canvas::at(int x, int y) const {
  return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(x)];
}
float& Canvas::alphaAt(int x, int y) {
  return alpha_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
}

void Canvas::fill(const std::function<glm::vec3(const glm::vec2&)>& paint) {
  over([&](const glm::vec2& p) { return glm::vec4(paint(p), 1); });
}

void Canvas::over(const std::function<glm::vec4(const glm::vec2&)>& paint) {
  const float scale = 1 / static_cast<float>(height_);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const glm::vec4 c =
          paint(glm::vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) * scale);
      at(x, y) = glm::mix(at(x, y), glm::vec3(c), std::clamp(c.w, 0.0f, 1.0f));
    }
}

void Canvas::mark(const glm::vec2& boxMin, const glm::vec2& boxMax,
                  const std::function<float(const glm::vec2&)>& inside, const glm::vec3& tint,
                  float opacity) {
  const auto pixels = static_cast<float>(height_);
  const auto first = [&](float v) { return static_cast<int>(std::floor(v * pixels)) - 1; };
  const int x0 = std::max(0, first(boxMin.x)), x1 = std::min(width_ - 1, first(boxMax.x) + 3);
  const int y0 = std::max(0, first(boxMin.y)), y1 = std::min(height_ - 1, first(boxMax.y) + 3);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const glm::vec2 p = glm::vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) / pixels;
      const float coverage = opacity * std::clamp(0.5f - inside(p) * pixels, 0.0f, 1.0f);
      if (coverage > 0) at(x, y) = glm::mix(at(x, y), tint, coverage);
    }
}

void Canvas::disc(const glm::vec2& centre, float radius, const glm::vec3& tint, float opacity) {
  mark(
      centre - radius, centre + radius, [&](const glm::vec2& p) { return glm::length(p - centre) - radius; },
      tint, opacity);
}

void Canvas::stroke(const glm::vec2& from, const glm::vec2& to, float width, const glm::vec3& tint,
                    float opacity) {
  const glm::vec2 along = to - from;
  const float squared = std::max(glm::dot(along, along), 1e-12f);
  mark(
      glm::min(from, to) - width, glm::max(from, to) + width,
      [&](const glm::vec2& p) {
        const float t = std::clamp(glm::dot(p - from, along) / squared, 0.0f, 1.0f);
        return glm::length(p - from - t * along) - 0.5f * width;
      },
      tint, opacity);
}

void Canvas::rectangle(const glm::vec2& min, const glm::vec2& max, const glm::vec3& tint, float opacity) {
  const glm::vec2 centre = 0.5f * (min + max), half = 0.5f * (max - min);
  mark(
      min, max,
      [&](const glm::vec2& p) {
        const glm::vec2 d = glm::abs(p - centre) - half;
        return std::max(d.x, d.y);
      },
      tint, opacity);
}

std::vector<unsigned char> Canvas::bytes(bool withAlpha) const {
  std::vector<unsigned char> out;
  out.reserve(pixels_.size() * (withAlpha ? 4 : 3));
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    out.insert(out.end(), {codeOf(pixels_[i].x), codeOf(pixels_[i].y), codeOf(pixels_[i].z)});
    if (withAlpha)
      out.push_back(static_cast<unsigned char>(std::lround(255 * std::clamp(alpha_[i], 0.0f, 1.0f))));
  }
  return out;
}

std::vector<std::byte> Canvas::encodePng(bool withAlpha) const {
  const auto data = bytes(withAlpha);
  const int channels = withAlpha ? 4 : 3;
  std::vector<std::byte> out;
  const int done =
      stbi_write_png_to_func(appendBytes, &out, width_, height_, channels, data.data(), width_ * channels);
  require(done != 0, "a picture in memory can be encoded as PNG");
  return out;
}

std::vector<std::byte> Canvas::encodeJpeg(int quality) const {
  const auto data = bytes(false);
  std::vector<std::byte> out;
  const int done = stbi_write_jpg_to_func(appendBytes, &out, width_, height_, 3, data.data(), quality);
  require(done != 0, "a picture in memory can be encoded as JPEG");
  return out;
}

std::vector<std::byte> normalMapPng(int size, float metres, const std::function<float(int, int)>& height) {
  std::vector<unsigned char> data;
  const float step = 2 * metres / static_cast<float>(size);
  const auto wrapped = [&](int i) { return (i + size) % size; };
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      // Green points up in the picture, that is towards smaller y.
      const float dx = (height(wrapped(x + 1), y) - height(wrapped(x - 1), y)) / step;
      const float dy = (height(x, wrapped(y - 1)) - height(x, wrapped(y + 1))) / step;
      const glm::vec3 normal = glm::normalize(glm::vec3(-dx, -dy, 1));
      for (int i = 0; i < 3; ++i)
        data.push_back(static_cast<unsigned char>(std::lround(127.5f * (normal[i] + 1))));
    }
  std::vector<std::byte> out;
  const int done = stbi_write_png_to_func(appendBytes, &out, size, size, 3, data.data(), 3 * size);
  require(done != 0, "a normal map in memory can be encoded as PNG");
  return out;
}

}  // namespace acentric::gallery
