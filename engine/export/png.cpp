#include "engine/export/png.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>

namespace acentric {
namespace {

png_image described(int width, int height, png_uint_32 format) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = png_uint_32(width), png.height = png_uint_32(height);
  png.format = format;
  return png;
}

Result<std::vector<std::byte>> encode(png_image png, const void* values) {
  std::vector<std::byte> bytes(PNG_IMAGE_PNG_SIZE_MAX(png));
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, values, 0, nullptr) == 0)
    return fail(ErrorKind::outOfSpace, std::string("a PNG cannot be written: ") + png.message);
  bytes.resize(size);
  return bytes;
}

}  // namespace

Result<ColourImage> decodePng(std::span<const std::byte> bytes, int width, int height,
                              const std::string& name) {
  png_image png = described(0, 0, 0);
  const auto failed = [&] {
    std::string reason = png.message;
    png_image_free(&png);
    return fail(ErrorKind::malformed, "is no sound PNG: " + reason, name);
  };
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) return failed();
  if (png.width != png_uint_32(width) || png.height != png_uint_32(height)) {
    const std::string size = fmt::format("{} x {}", png.width, png.height);
    png_image_free(&png);
    return fail(ErrorKind::malformed,
                fmt::format("is {} pixels large, and the index says {} x {}", size, width, height), name);
  }
  png.format = PNG_FORMAT_RGBA;
  ColourImage image(width, height);
  if (png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr) == 0) return failed();
  return image;
}

Result<std::vector<std::byte>> encodePng(const ColourImage& image) {
  const bool opaque = std::ranges::all_of(image.pixels, [](const Rgba8& p) { return p.a == 255; });
  std::vector<std::uint8_t> codes;
  codes.reserve(image.pixels.size() * (opaque ? 3 : 4));
  for (const Rgba8& p : image.pixels) {
    codes.insert(codes.end(), {p.r, p.g, p.b});
    if (!opaque) codes.push_back(p.a);
  }
  return encode(described(image.width, image.height, opaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA),
                codes.data());
}

Result<std::vector<std::byte>> encodePng(int width, int height, std::span<const std::uint16_t> values) {
  return encode(described(width, height, PNG_FORMAT_LINEAR_Y), values.data());
}

}  // namespace acentric
