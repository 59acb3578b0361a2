#include "engine/image/files/image_files.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <array>
#include <exception>
#include <new>
#include <string_view>

#include "engine/base/file.h"
#include "engine/image/colour.h"
#include "engine/image/png_check.h"

namespace acentric {
namespace fs = std::filesystem;
namespace {

constexpr int kMaxChannels = 16;

/// Library exceptions end here.
template <class T, class Body>
T guarded(const std::string& name, const Body& body) {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory for this picture", name);
  } catch (const std::exception& error) {
    return fail(ErrorKind::unreadable, error.what(), name);
  }
}

struct Signature {
  std::string_view bytes;
  std::size_t offset;
  const char* format;  ///< OpenImageIO's name
};

/// The bytes decide, not the name: models often name a JPEG ".png", and pictures inside a model have no name.
std::string formatOf(std::span<const std::byte> bytes) {
  using namespace std::string_view_literals;
  static constexpr std::array kSignatures = {
      Signature{"\x89PNG\r\n\x1a\n"sv, 0, "png"},
      Signature{"\xff\xd8\xff"sv, 0, "jpeg"},
      Signature{"GIF8"sv, 0, "gif"},
      Signature{"WEBP"sv, 8, "webp"},
      Signature{"BM"sv, 0, "bmp"},
      Signature{"II*\0"sv, 0, "tiff"},
      Signature{"MM\0*"sv, 0, "tiff"},
      Signature{"\x76\x2f\x31\x01"sv, 0, "openexr"},
      Signature{"#?"sv, 0, "hdr"},
      Signature{"8BPS"sv, 0, "psd"},
      Signature{"DDS "sv, 0, "dds"},
  };
  for (const Signature& signature : kSignatures) {
    if (bytes.size() < signature.offset + signature.bytes.size()) continue;
    const bool matches =
        std::equal(signature.bytes.begin(), signature.bytes.end(),
                   bytes.begin() + static_cast<std::ptrdiff_t>(signature.offset), [](char a, std::byte b) {
                     return static_cast<unsigned char>(a) == std::to_integer<unsigned char>(b);
                   });
    if (matches) return signature.format;
  }
  return {};
}

/// Targa has no signature, only a plausible header; it is recognised by name.
bool isNamedTarga(const std::string& name) {
  std::string extension = fs::path(name).extension().string();
  for (char& letter : extension) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return extension == ".tga";
}

struct ChannelMap {
  int red, green, blue, alpha;  ///< alpha -1: opaque
};

ChannelMap channelsOf(const OIIO::ImageSpec& spec) {
  const bool grey = spec.nchannels <= 2;
  ChannelMap map{0, grey ? 0 : 1, grey ? 0 : 2, -1};
  if (spec.nchannels == 2 || spec.nchannels >= 4)
    map.alpha = spec.alpha_channel >= 0 && spec.alpha_channel < spec.nchannels ? spec.alpha_channel
                                                                               : spec.nchannels - 1;
  return map;
}

ColourImage spreadBytes(const OIIO::ImageSpec& spec, const std::vector<std::uint8_t>& raw, bool associated) {
  const ChannelMap map = channelsOf(spec);
  ColourImage image(spec.width, spec.height);
  const std::uint8_t* in = raw.data();
  for (Rgba8& out : image.pixels) {
    out = Rgba8(in[map.red], in[map.green], in[map.blue], map.alpha < 0 ? std::uint8_t(255) : in[map.alpha]);
    if (associated && out.a > 0 && out.a < 255)
      for (int channel = 0; channel < 3; ++channel)
        out[channel] = static_cast<std::uint8_t>(std::min(255, (out[channel] * 255 + out.a / 2) / out.a));
    in += spec.nchannels;
  }
  return image;
}

/// Floating-point pictures hold linear light; brighter than 1 is clipped.
ColourImage encodeLinear(const OIIO::ImageSpec& spec, const std::vector<float>& raw, bool associated) {
  const ChannelMap map = channelsOf(spec);
  ColourImage image(spec.width, spec.height);
  const float* in = raw.data();
  for (Rgba8& out : image.pixels) {
    const float alpha = map.alpha < 0 ? 1.0f : in[map.alpha];
    const float scale = associated && alpha > 0 ? 1 / alpha : 1.0f;
    out = Rgba8(srgbCodeFromLinear(in[map.red] * scale), srgbCodeFromLinear(in[map.green] * scale),
                srgbCodeFromLinear(in[map.blue] * scale),
                static_cast<std::uint8_t>(alpha > 0 ? std::min(alpha, 1.0f) * 255.0f + 0.5f : 0.0f));
    in += spec.nchannels;
  }
  return image;
}

Status checkSpec(const OIIO::ImageSpec& spec, const std::string& name, std::size_t maxPixels) {
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 ||
      spec.nchannels > kMaxChannels)
    return fail(ErrorKind::malformed,
                fmt::format("a picture of {} x {} x {} with {} channels makes no sense", spec.width,
                            spec.height, spec.depth, spec.nchannels),
                name);
  if (spec.deep) return fail(ErrorKind::unsupported, "is a deep picture; flatten it first", name);
  const std::size_t pixels = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  if (pixels > maxPixels)
    return fail(ErrorKind::tooLarge,
                fmt::format("{} x {} pixels exceed the limit of {}; scale the picture down", spec.width,
                            spec.height, maxPixels),
                name);
  return {};
}

template <class Value>
Result<std::vector<Value>> readPixels(OIIO::ImageInput& input, const OIIO::ImageSpec& spec,
                                      OIIO::TypeDesc type, const std::string& name) {
  std::vector<Value> raw(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                         static_cast<std::size_t>(spec.nchannels));
  if (!input.read_image(0, 0, 0, spec.nchannels, type, raw.data()))
    return fail(ErrorKind::malformed, "pixels cannot be decoded: " + input.geterror(), name);
  return raw;
}

Result<ColourImage> decode(std::span<const std::byte> bytes, const std::string& name, std::size_t maxPixels) {
  std::string format = formatOf(bytes);
  if (format.empty() && isNamedTarga(name)) format = "targa";
  if (format.empty())
    return fail(ErrorKind::unsupported, "is no picture of a known format; convert it to PNG or JPEG", name);
  if (format == "png")
    if (Status whole = checkPng(bytes, name); !whole) return tl::unexpected(whole.error());
  auto input = OIIO::ImageInput::create(format);
  if (!input || !input->supports("ioproxy")) {
    OIIO::geterror();  // fetched so that it is not pending for somebody else
    return fail(ErrorKind::unsupported,
                "pictures of format " + format + " are not read; convert it to PNG or JPEG", name);
  }
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  input->set_ioproxy(&memory);
  OIIO::ImageSpec spec;
  if (!input->open(name, spec, hints))
    return fail(ErrorKind::malformed, "cannot be read as " + format + ": " + input->geterror(), name);
  if (auto sound = checkSpec(spec, name, maxPixels); !sound) return tl::unexpected(sound.error());

  const bool keepsStraightAlpha = spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
  const bool associated = !keepsStraightAlpha && (format == "openexr" || format == "tiff");
  if (spec.format.is_floating_point()) {
    auto raw = readPixels<float>(*input, spec, OIIO::TypeDesc::FLOAT, name);
    if (!raw) return tl::unexpected(raw.error());
    return encodeLinear(spec, *raw, associated);
  }
  auto raw = readPixels<std::uint8_t>(*input, spec, OIIO::TypeDesc::UINT8, name);
  if (!raw) return tl::unexpected(raw.error());
  return spreadBytes(spec, *raw, associated);
}

/// Writes `data` (pixel stride `stride` bytes) by the format that the temporary's extension names.
Status writeWith(const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* data, std::size_t stride,
                 const fs::path& temporary, const std::string& name) {
  auto output = OIIO::ImageOutput::create(temporary.string());
  if (!output)
    return fail(ErrorKind::unsupported,
                "no picture format goes by this extension; use .png, .jpg or .exr (" + OIIO::geterror() + ")",
                name);
  OIIO::ImageSpec wanted = spec;
  if (wanted.nchannels == 4 && !output->supports("alpha")) wanted.nchannels = 3;
  if (!output->open(temporary.string(), wanted))
    return fail(ErrorKind::unreadable, "cannot be written: " + output->geterror(), name);
  const bool written = output->write_image(type, data, static_cast<OIIO::stride_t>(stride));
  const bool closed = output->close();
  if (!written || !closed) return fail(ErrorKind::unreadable, "writing failed: " + output->geterror(), name);
  return {};
}

Result<ColourImage> decodeGuarded(std::span<const std::byte> bytes, const std::string& name,
                                  std::size_t maxPixels) {
  return guarded<Result<ColourImage>>(name, [&] { return decode(bytes, name, maxPixels); });
}

/// Writes atomically, as writeWith does.
Status write(const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* data, std::size_t stride,
             const fs::path& path) {
  return guarded<Status>(path.string(), [&] {
    return replaceFileAtomically(path, [&](const fs::path& temporary) {
      return writeWith(spec, type, data, stride, temporary, path.string());
    });
  });
}

Status writeColour(const ColourImage& image, const fs::path& path) {
  OIIO::ImageSpec spec(image.width, image.height, 4, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("CompressionQuality", 92);
  return write(spec, OIIO::TypeDesc::UINT8, image.pixels.data(), sizeof(Rgba8), path);
}

Status writeFloat(const FloatImage& image, const fs::path& path, const char* channel) {
  OIIO::ImageSpec spec(image.width, image.height, 1, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {channel};
  spec.attribute("compression", "zip");
  return write(spec, OIIO::TypeDesc::FLOAT, image.pixels.data(), sizeof(float), path);
}

Status writeLatLong(const LinearImage& radiance, const FloatImage& distance, const fs::path& path) {
  constexpr float kLargestHalf = 65504;
  std::vector<glm::vec4> pixels(radiance.pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = {glm::min(radiance.pixels[i], glm::vec3(kLargestHalf)), distance.pixels[i]};
  OIIO::ImageSpec spec(radiance.width, radiance.height, 4, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"R", "G", "B", "Z"};
  spec.channelformats = {OIIO::TypeDesc::HALF, OIIO::TypeDesc::HALF, OIIO::TypeDesc::HALF,
                         OIIO::TypeDesc::FLOAT};
  spec.alpha_channel = -1, spec.z_channel = 3;
  spec.attribute("compression", "zip");
  spec.attribute("textureformat", "LatLong Environment");
  return write(spec, OIIO::TypeDesc::FLOAT, pixels.data(), sizeof(glm::vec4), path);
}

}  // namespace
}  // namespace acentric

extern "C" const acentric::ImageFiles acentric_image_files{acentric::decodeGuarded, acentric::writeColour,
                                                           acentric::writeFloat, acentric::writeLatLong};
