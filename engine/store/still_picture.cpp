#include "engine/store/still_picture.h"

#include <avif/avif.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "engine/base/contract.h"
#include "engine/image/colour.h"

namespace acentric {
namespace {

/// Of 0 (slowest) to 10.
constexpr int kEncoderSpeed = 7;

template <auto destroy>
struct Destroy {
  template <class T>
  void operator()(T* value) const {
    destroy(value);
  }
};
using AvifImage = std::unique_ptr<avifImage, Destroy<avifImageDestroy>>;
using Encoder = std::unique_ptr<avifEncoder, Destroy<avifEncoderDestroy>>;
using Decoder = std::unique_ptr<avifDecoder, Destroy<avifDecoderDestroy>>;

struct Output {
  avifRWData data = AVIF_DATA_EMPTY;
  Output() = default;
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output() { avifRWDataFree(&data); }
};

/// What 8 bits show takes 3.8 times the codes in 10 bits of radiance, and the codec's steps, at 8 bits a
/// quarter, rise with the quantiser from 8 to 40 as 1 to 4.
int quantiserOf(int quality, int bits) {
  const double coarser = bits == 8 ? 2.6 : 1;
  const double part = double(kBestPictureQuality - quality) / kBestPictureQuality;
  return std::min(int(std::lround(coarser * part * AVIF_QUANTIZER_WORST_QUALITY)),
                  AVIF_QUANTIZER_WORST_QUALITY);
}

/// Rows of samples of one byte or two, as they lie in an image.
template <class From, class To>
void copyRow(const From* from, To* to, std::size_t count, int bits) {
  if (bits > 8)
    std::memcpy(to, from, count * sizeof(std::uint16_t));
  else
    std::copy_n(from, count, to);
}

tl::unexpected<Error> noMemory() { return fail(ErrorKind::outOfSpace, "not enough memory"); }

/// With room for its planes; null without memory for it.
AvifImage imageOf(int width, int height, int bits, avifPlanesFlags planes) {
  AvifImage image(avifImageCreate(std::uint32_t(width), std::uint32_t(height), std::uint32_t(bits),
                                  AVIF_PIXEL_FORMAT_YUV444));
  if (!image) return image;
  image->yuvRange = AVIF_RANGE_FULL;
  image->colorPrimaries = AVIF_COLOR_PRIMARIES_BT709;
  image->transferCharacteristics = AVIF_TRANSFER_CHARACTERISTICS_SRGB;
  image->matrixCoefficients = AVIF_MATRIX_COEFFICIENTS_BT709;
  avifImageAllocatePlanes(image.get(), planes);
  const bool whole =
      std::ranges::all_of(image->yuvPlanes, [](const auto* plane) { return plane != nullptr; }) &&
      (image->alphaPlane != nullptr || (planes & AVIF_PLANES_A) == 0);
  return whole ? std::move(image) : AvifImage();
}

Result<std::vector<std::byte>> encode(const avifImage& image, int quality) {
  const Encoder encoder(avifEncoderCreate());
  if (!encoder) return noMemory();
  encoder->codecChoice = AVIF_CODEC_CHOICE_AOM;
  encoder->maxThreads = 1;
  encoder->speed = kEncoderSpeed;
  encoder->minQuantizer = encoder->maxQuantizer = quantiserOf(quality, int(image.depth));
  encoder->minQuantizerAlpha = encoder->maxQuantizerAlpha = AVIF_QUANTIZER_LOSSLESS;
  Output out;
  avifResult done = avifEncoderAddImage(encoder.get(), &image, 1, AVIF_ADD_IMAGE_FLAG_SINGLE);
  if (done == AVIF_RESULT_OK) done = avifEncoderFinish(encoder.get(), &out.data);
  if (done != AVIF_RESULT_OK)
    return fail(ErrorKind::internal, std::string("colours cannot be coded: ") + avifResultToString(done));
  const auto* bytes = reinterpret_cast<const std::byte*>(out.data.data);
  return std::vector<std::byte>(bytes, bytes + out.data.size);
}

/// Its image is `width` by `height` and has so many bits, or it is refused before that is decoded.
Result<Decoder> decode(std::span<const std::byte> file, int width, int height, int bits, bool mayHaveAlpha) {
  Decoder decoder(avifDecoderCreate());
  if (!decoder) return noMemory();
  decoder->maxThreads = 1;
  decoder->imageSizeLimit = std::uint32_t(width) * std::uint32_t(height);
  decoder->imageDimensionLimit = std::uint32_t(kMostPictureSide);
  decoder->imageCountLimit = 1;
  decoder->ignoreExif = decoder->ignoreXMP = AVIF_TRUE;
  decoder->requestedSource = AVIF_DECODER_SOURCE_PRIMARY_ITEM;
  if (avifDecoderSetIOMemory(decoder.get(), reinterpret_cast<const std::uint8_t*>(file.data()),
                             file.size()) != AVIF_RESULT_OK ||
      avifDecoderParse(decoder.get()) != AVIF_RESULT_OK)
    return malformed("a picture of its colours cannot be read");
  const avifImage& image = *decoder->image;
  const auto fits = [&] {
    return image.width == std::uint32_t(width) && image.height == std::uint32_t(height) &&
           image.depth == std::uint32_t(bits) && image.yuvFormat == AVIF_PIXEL_FORMAT_YUV444;
  };
  if (!fits() || (decoder->alphaPresent && !mayHaveAlpha) || decoder->imageCount != 1)
    return malformed("a picture of its colours has another size or kind than it needs");
  if (avifDecoderNextImage(decoder.get()) != AVIF_RESULT_OK || !fits() ||
      std::ranges::any_of(image.yuvPlanes, [](const auto* plane) { return plane == nullptr; }))
    return malformed("a picture of its colours is damaged");
  return decoder;
}

/// Of the image's own planes to colours and back.
avifRGBImage colourView(avifImage& image, std::uint8_t* pixels, bool alpha) {
  avifRGBImage view;
  avifRGBImageSetDefaults(&view, &image);
  view.depth = 8, view.format = AVIF_RGB_FORMAT_RGBA, view.ignoreAlpha = alpha ? AVIF_FALSE : AVIF_TRUE;
  view.pixels = pixels, view.rowBytes = image.width * std::uint32_t(sizeof(Rgba8));
  return view;
}

}  // namespace

Result<std::vector<std::byte>> encodeStill(const StillPicture& picture, int quality) {
  require(quality >= 0 && quality <= kBestPictureQuality, "a picture's quality is 0..99");
  const AvifImage image = imageOf(picture.width, picture.height, picture.bits, AVIF_PLANES_YUV);
  if (!image) return noMemory();
  const std::size_t row = std::size_t(picture.width);
  for (int p = 0; p < 3; ++p)
    for (std::size_t y = 0; y < std::size_t(picture.height); ++y)
      copyRow(picture.planes[p].data() + y * row, image->yuvPlanes[p] + y * image->yuvRowBytes[p], row,
              picture.bits);
  return encode(*image, quality);
}

Result<StillPicture> decodeStill(std::span<const std::byte> file, int width, int height, int bits) {
  const auto decoder = decode(file, width, height, bits, false);
  if (!decoder) return tl::unexpected(decoder.error());
  const avifImage& image = *(*decoder)->image;
  StillPicture picture{width, height, bits, {}};
  const std::size_t row = std::size_t(width);
  for (int p = 0; p < 3; ++p) {
    picture.planes[p].resize(row * std::size_t(height));
    for (std::size_t y = 0; y < std::size_t(height); ++y)
      copyRow(image.yuvPlanes[p] + y * image.yuvRowBytes[p], picture.planes[p].data() + y * row, row, bits);
  }
  return picture;
}

Result<std::vector<std::byte>> encodeStill(const ColourImage& colours, int quality) {
  require(quality >= 0 && quality <= kBestPictureQuality, "a picture's quality is 0..99");
  require(std::max(colours.width, colours.height) <= kMostPictureSide, "a picture's sides have a limit");
  const bool opaque = isOpaque(colours);
  const AvifImage image =
      imageOf(colours.width, colours.height, 8, opaque ? AVIF_PLANES_YUV : AVIF_PLANES_ALL);
  if (!image) return noMemory();
  ColourImage pixels = colours;  // libavif takes what it only reads as it takes what it writes
  const avifRGBImage view = colourView(*image, &pixels.pixels.data()->r, !opaque);
  if (avifImageRGBToYUV(image.get(), &view) != AVIF_RESULT_OK)
    return fail(ErrorKind::internal, "colours cannot be turned into luma and chroma");
  return encode(*image, quality);
}

Result<ColourImage> decodeStillColours(std::span<const std::byte> file, int width, int height) {
  const auto decoder = decode(file, width, height, 8, true);
  if (!decoder) return tl::unexpected(decoder.error());
  avifImage& image = *(*decoder)->image;
  ColourImage colours(width, height, Rgba8(255));
  avifRGBImage view = colourView(image, &colours.pixels.data()->r, image.alphaPlane != nullptr);
  if (avifImageYUVToRGB(&image, &view) != AVIF_RESULT_OK)
    return malformed("a picture of its colours is of a kind that cannot be read");
  return colours;
}

bool isStill(std::span<const std::byte> file) {
  constexpr std::string_view kBegins = "ftypavif";
  return file.size() >= 4 + kBegins.size() &&
         std::memcmp(file.data() + 4, kBegins.data(), kBegins.size()) == 0;
}

}  // namespace acentric
