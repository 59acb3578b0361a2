#include "engine/export/webp.h"

#include <fmt/format.h>
#include <webp/encode.h>

#include <algorithm>

#include "engine/base/contract.h"
#include "engine/image/colour.h"
#include "engine/image/colour_quality.h"

namespace acentric {
namespace {

constexpr int kLosslessEffort = 6;  // of 0..9

/// A picture and what it becomes, freed with this.
struct Encoding {
  WebPPicture picture{};
  WebPMemoryWriter out{};
  Encoding() = default;
  Encoding(const Encoding&) = delete;
  Encoding& operator=(const Encoding&) = delete;
  ~Encoding() {
    WebPPictureFree(&picture);
    WebPMemoryWriterClear(&out);
  }
};

}  // namespace

Result<std::vector<std::byte>> encodeWebp(const ColourImage& image, int quality) {
  require(quality >= 0 && quality <= kLosslessColours, "a picture's quality is 0..100");
  if (std::max(image.width, image.height) > kLargestWebp)
    return fail(ErrorKind::tooLarge,
                fmt::format("a texture of {} x {} pixels exceeds the {} a side that WebP can have: scale it "
                            "down, or take PNG",
                            image.width, image.height, kLargestWebp));
  Encoding work;
  WebPConfig config;
  WebPMemoryWriterInit(&work.out);
  if (WebPPictureInit(&work.picture) == 0 || WebPConfigInit(&config) == 0)
    return fail(ErrorKind::internal, "libwebp is of another version than it was built for");
  if (quality == kLosslessColours)
    WebPConfigLosslessPreset(&config, kLosslessEffort);
  else
    config.quality = float(quality), config.use_sharp_yuv = 1;
  config.exact = 1;
  work.picture.width = image.width, work.picture.height = image.height;
  work.picture.use_argb = 1;
  work.picture.writer = WebPMemoryWrite;
  work.picture.custom_ptr = &work.out;
  const bool opaque = isOpaque(image);
  const auto* codes = reinterpret_cast<const std::uint8_t*>(image.pixels.data());
  const auto import = opaque ? WebPPictureImportRGBX : WebPPictureImportRGBA;
  if (import(&work.picture, codes, image.width * 4) == 0 || WebPEncode(&config, &work.picture) == 0)
    return fail(ErrorKind::outOfSpace,
                fmt::format("a WebP cannot be written (error {} of libwebp)", int(work.picture.error_code)));
  const auto* bytes = reinterpret_cast<const std::byte*>(work.out.mem);
  return std::vector<std::byte>(bytes, bytes + work.out.size);
}

}  // namespace acentric
