#include <png.h>

#include "engine/export/bundle_read.h"

namespace acentric {

Result<ColourImage> decodePng(std::span<const std::byte> bytes, const std::string& name) {
  constexpr std::uint64_t kMostPixels = std::uint64_t(1) << 28;
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const auto failed = [&] {
    std::string reason = png.message;
    png_image_free(&png);
    return fail(ErrorKind::malformed, "is no sound PNG: " + reason, name);
  };
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) return failed();
  if (std::uint64_t(png.width) * png.height > kMostPixels) {
    png_image_free(&png);
    return fail(ErrorKind::tooLarge, "has more than 2^28 pixels", name);
  }
  png.format = PNG_FORMAT_RGBA;
  ColourImage image(int(png.width), int(png.height));
  if (png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr) == 0) return failed();
  return image;
}

}  // namespace acentric
