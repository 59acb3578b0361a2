#include "engine/store/still_picture.h"

#include <avif/avif.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>

#include "engine/base/contract.h"

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
using Image = std::unique_ptr<avifImage, Destroy<avifImageDestroy>>;
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

tl::unexpected<Error> malformed(const char* message) { return fail(ErrorKind::malformed, message); }

}  // namespace

Result<std::vector<std::byte>> encodeStill(const StillPicture& picture, int quality) {
  require(quality >= 0 && quality <= kBestPictureQuality, "a picture's quality is 0..99");
  const Image image(avifImageCreate(std::uint32_t(picture.width), std::uint32_t(picture.height),
                                    std::uint32_t(picture.bits), AVIF_PIXEL_FORMAT_YUV444));
  const Encoder encoder(avifEncoderCreate());
  if (!image || !encoder) return fail(ErrorKind::outOfSpace, "not enough memory");
  image->yuvRange = AVIF_RANGE_FULL;
  image->colorPrimaries = AVIF_COLOR_PRIMARIES_BT709;
  image->transferCharacteristics = AVIF_TRANSFER_CHARACTERISTICS_SRGB;
  image->matrixCoefficients = AVIF_MATRIX_COEFFICIENTS_BT709;
  avifImageAllocatePlanes(image.get(), AVIF_PLANES_YUV);
  for (int p = 0; p < 3; ++p) {
    if (image->yuvPlanes[p] == nullptr) return fail(ErrorKind::outOfSpace, "not enough memory");
    const std::size_t row = std::size_t(picture.width);
    for (std::size_t y = 0; y < std::size_t(picture.height); ++y)
      copyRow(picture.planes[p].data() + y * row, image->yuvPlanes[p] + y * image->yuvRowBytes[p], row,
              picture.bits);
  }
  encoder->codecChoice = AVIF_CODEC_CHOICE_AOM;
  encoder->maxThreads = 1;
  encoder->speed = kEncoderSpeed;
  encoder->minQuantizer = encoder->maxQuantizer = quantiserOf(quality, picture.bits);
  Output out;
  if (const avifResult done = avifEncoderAddImage(encoder.get(), image.get(), 1, AVIF_ADD_IMAGE_FLAG_SINGLE);
      done != AVIF_RESULT_OK)
    return fail(ErrorKind::internal, std::string("colours cannot be coded: ") + avifResultToString(done));
  if (const avifResult done = avifEncoderFinish(encoder.get(), &out.data); done != AVIF_RESULT_OK)
    return fail(ErrorKind::internal, std::string("colours cannot be coded: ") + avifResultToString(done));
  const auto* bytes = reinterpret_cast<const std::byte*>(out.data.data);
  return std::vector<std::byte>(bytes, bytes + out.data.size);
}

Result<StillPicture> decodeStill(std::span<const std::byte> file, int width, int height, int bits) {
  const Decoder decoder(avifDecoderCreate());
  if (!decoder) return fail(ErrorKind::outOfSpace, "not enough memory");
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
  if (!fits() || decoder->alphaPresent || decoder->imageCount != 1)
    return malformed("a picture of its colours has another size or kind than it needs");
  if (avifDecoderNextImage(decoder.get()) != AVIF_RESULT_OK || !fits())
    return malformed("a picture of its colours is damaged");
  StillPicture picture{width, height, bits, {}};
  const std::size_t row = std::size_t(width);
  for (int p = 0; p < 3; ++p) {
    if (image.yuvPlanes[p] == nullptr) return malformed("a picture of its colours is damaged");
    picture.planes[p].resize(row * std::size_t(height));
    for (std::size_t y = 0; y < std::size_t(height); ++y)
      copyRow(image.yuvPlanes[p] + y * image.yuvRowBytes[p], picture.planes[p].data() + y * row, row, bits);
  }
  return picture;
}

}  // namespace acentric
