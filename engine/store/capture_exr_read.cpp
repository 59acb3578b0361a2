#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <new>
#include <stdexcept>

#include "engine/base/file.h"
#include "engine/store/capture_exr.h"
#include "engine/store/capture_store.h"
#include "engine/store/exr_memory.h"
#include "engine/store/keyed.h"

namespace acentric {
namespace {

/// Deflate packs no more than this into a byte: a picture of more cannot be in the file.
constexpr std::uint64_t kMaxDeflateRatio = 1032;

/// Carries an error out through OpenEXR's exceptions.
struct Refusal {
  ErrorKind kind;
  std::string message;
};

[[noreturn]] void refuse(std::string message, ErrorKind kind = ErrorKind::malformed) {
  throw Refusal{kind, std::move(message)};
}

template <class Attribute>
auto attribute(const Imf::Header& header, const char* name) {
  const auto* found = header.findTypedAttribute<Attribute>(name);
  if (found == nullptr) refuse(fmt::format("has no attribute '{}': it is no capture of this program", name));
  return found->value();
}

ContentKey keyAttribute(const Imf::Header& header, const char* name) {
  const auto key = ContentKey::fromHex(attribute<Imf::StringAttribute>(header, name));
  if (!key) refuse(fmt::format("attribute '{}': {}", name, key.error().message));
  return *key;
}

void checkChannel(const Imf::Header& header, const char* name, Imf::PixelType type) {
  const Imf::Channel* channel = header.channels().findChannel(name);
  if (channel == nullptr || channel->type != type || channel->xSampling != 1 || channel->ySampling != 1)
    refuse(fmt::format("channel {} is missing or of another type than a capture's", name));
}

ColumnCamera cameraOf(const Imf::Header& header, std::uint64_t fileBytes) {
  const Imath::Box2i& window = header.dataWindow();
  if (window.min.x != 0 || window.min.y != 0 || window.max.x < 0 || window.max.y < 0 ||
      window.max.x > 65534 || window.max.y > 65534)
    refuse("its data window is not that of a capture");
  ColumnCamera camera;
  camera.columns = window.max.x + 1;
  camera.rows = window.max.y + 1;
  // Four bytes for a pixel's sample count at least.
  if (4 * static_cast<std::uint64_t>(camera.columns) * static_cast<std::uint64_t>(camera.rows) >
      kMaxDeflateRatio * fileBytes)
    refuse("claims more pixels than a file of its size holds");
  const Imath::V3d centre = attribute<Imf::V3dAttribute>(header, kAttributeCentre);
  camera.centreOfProjection = {centre.x, centre.y, centre.z};
  camera.lowAzimuth = attribute<Imf::DoubleAttribute>(header, kAttributeLowAzimuth);
  camera.fovRadians = attribute<Imf::DoubleAttribute>(header, kAttributeFov);
  camera.topElevation = attribute<Imf::DoubleAttribute>(header, kAttributeTop);
  camera.bottomElevation = attribute<Imf::DoubleAttribute>(header, kAttributeBottom);
  if (const Status sound = camera.check(); !sound) refuse(sound.error().message);
  return camera;
}

/// All zero in a file that shows none.
Sky skyOf(const Imf::Header& header) {
  if (header.findTypedAttribute<Imf::V3fAttribute>(kAttributeZenith) == nullptr) return {};
  const auto radiance = [&](const char* name) {
    const Imath::V3f c = attribute<Imf::V3fAttribute>(header, name);
    return glm::vec3(c.x, c.y, c.z);
  };
  return {radiance(kAttributeZenith), radiance(kAttributeHorizon), radiance(kAttributeGround)};
}

std::uint8_t rolesOf(std::uint32_t stored) {
  if (stored > 0xff) refuse(fmt::format("a sample names roles that no capture has ({:#x})", stored));
  return static_cast<std::uint8_t>(stored);
}

std::uint8_t mirrorOf(std::uint32_t stored) {
  if (stored > 0xff) refuse(fmt::format("a sample names a mirror that no capture has ({})", stored));
  return static_cast<std::uint8_t>(stored);
}

/// A part of the file and where its samples go.
struct Part {
  Imf::MultiPartInputFile& file;
  int number;
  std::uint64_t fileBytes;
  const ColumnCamera& camera;
  bool mirrors;  ///< has a channel of them
  CaptureSamples& samples;

  std::size_t columns() const { return static_cast<std::size_t>(camera.columns); }
  std::size_t rows() const { return static_cast<std::size_t>(camera.rows); }
};

/// Colours stay premultiplied, as they are in the file.
void readFlat(const Part& from) {
  struct Pixel {
    HalfColour colour;
    float w;
    std::uint32_t roles;
    std::uint32_t mirror;
  };
  const std::size_t columns = from.columns(), rows = from.rows();
  constexpr std::uint64_t kBytesPerPixel =
      20;  // R, G, B, A as half, Z, W as float, roles, before compression
  if (kBytesPerPixel * columns * rows > kMaxDeflateRatio * from.fileBytes)
    refuse("claims more pixels than a file of its size holds");
  std::vector<Pixel> pixels(columns * rows);  // column after column
  Imf::FrameBuffer buffer;
  const auto slice = [&](const char* name, Imf::PixelType type, auto& value) {
    buffer.insert(name, Imf::Slice(type, slicePointer(value), rows * sizeof(Pixel), sizeof(Pixel)));
  };
  for (int channel = 0; channel < 4; ++channel)
    slice(kColourChannels[static_cast<std::size_t>(channel)], Imf::HALF, pixels[0].colour[channel]);
  slice("W", Imf::FLOAT, pixels[0].w);
  slice(kRolesChannel, Imf::UINT, pixels[0].roles);
  if (from.mirrors) slice(kMirrorChannel, Imf::UINT, pixels[0].mirror);
  Imf::InputPart part(from.file, from.number);
  part.setFrameBuffer(buffer);
  for (int row = 0; row < from.camera.rows; ++row) {
    part.readPixels(row, row);
  }

  CaptureSamples& out = from.samples;
  std::size_t samples = 0;
  for (const Pixel& pixel : pixels) samples += pixel.w == kNoDistance ? 0 : 1;
  out.row.reserve(samples);
  out.inverseDistance.reserve(samples);
  out.colour.reserve(samples);
  out.roles.reserve(samples);
  out.mirror.reserve(from.mirrors ? samples : 0);
  for (std::size_t column = 0; column < columns; ++column) {
    const Pixel* pixel = &pixels[(columns - 1 - column) * rows];
    for (std::size_t row = 0; row < rows; ++row, ++pixel) {
      if (pixel->w == kNoDistance) continue;
      out.row.push_back(static_cast<std::uint16_t>(row));
      out.inverseDistance.push_back(pixel->w);
      out.colour.push_back(pixel->colour);
      out.roles.push_back(rolesOf(pixel->roles));
      if (from.mirrors) out.mirror.push_back(mirrorOf(pixel->mirror));
    }
    out.columnStart.push_back(static_cast<std::uint32_t>(out.row.size()));
  }
}

/// Turns the counts of a part's pixels (column after column) into rows and column starts, and each count into
/// the number of the pixel's first sample.
void placeSamples(std::vector<unsigned int>& counts, const Part& from) {
  const std::size_t columns = from.columns(), rows = from.rows();
  std::uint64_t total = 0;
  for (unsigned int count : counts) total += count;
  constexpr std::uint64_t bytesPerSample = 16;  // R, G, B, A as half, W as float, roles, before compression
  if (total > kMaxCaptureSamples || bytesPerSample * total > kMaxDeflateRatio * from.fileBytes)
    refuse("claims more samples than a file of its size holds");
  CaptureSamples& out = from.samples;
  out.row.reserve(total);
  for (std::size_t column = 0; column < columns; ++column) {
    unsigned int* count = &counts[(columns - 1 - column) * rows];
    for (std::size_t row = 0; row < rows; ++row, ++count) {
      const unsigned int first = static_cast<unsigned int>(out.row.size());
      out.row.insert(out.row.end(), *count, static_cast<std::uint16_t>(row));
      *count = first;
    }
    out.columnStart.push_back(static_cast<std::uint32_t>(out.row.size()));
  }
  out.inverseDistance.resize(total);
  out.colour.resize(total);
}

void readDeep(const Part& from) {
  const std::size_t columns = from.columns(), rows = from.rows();
  std::vector<unsigned int> counts(columns * rows);  // column after column
  std::array<std::vector<char*>, 7> pointers;        // of one line: to the first sample of each pixel
  for (auto& channel : pointers) channel.resize(columns);
  Imf::DeepFrameBuffer buffer;
  buffer.insertSampleCountSlice(
      Imf::Slice(Imf::UINT, slicePointer(counts[0]), rows * sizeof(unsigned int), sizeof(unsigned int)));
  const auto slice = [&](const char* name, Imf::PixelType type, std::size_t channel, std::size_t stride) {
    buffer.insert(name, Imf::DeepSlice(type, slicePointer(pointers[channel][0]), sizeof(char*), 0, stride));
  };
  for (std::size_t channel = 0; channel < 4; ++channel)
    slice(kColourChannels[channel], Imf::HALF, channel, sizeof(HalfColour));
  slice("W", Imf::FLOAT, 4, sizeof(float));
  slice(kRolesChannel, Imf::UINT, 5, sizeof(std::uint32_t));
  if (from.mirrors) slice(kMirrorChannel, Imf::UINT, 6, sizeof(std::uint32_t));
  Imf::DeepScanLineInputPart part(from.file, from.number);
  part.setFrameBuffer(buffer);
  part.readPixelSampleCounts(0, from.camera.rows - 1);

  std::vector<unsigned int> firstSample = counts;  // the part goes on reading `counts` itself
  placeSamples(firstSample, from);
  CaptureSamples& out = from.samples;
  std::vector<std::uint32_t> roles(out.row.size()), mirror(from.mirrors ? out.row.size() : 0);
  HalfColour nothing;
  float nowhere = 0;
  std::uint32_t nobody = 0;
  const bool empty = out.row.empty();
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t x = 0; x < columns; ++x) {
      // A pixel without samples gets a pointer too: to the next sample, or past the end, where nothing is
      // written.
      const std::size_t first = firstSample[x * rows + row];
      HalfColour* colour = empty ? &nothing : out.colour.data() + first;
      float* w = empty ? &nowhere : out.inverseDistance.data() + first;
      for (std::size_t channel = 0; channel < 4; ++channel)
        pointers[channel][x] = reinterpret_cast<char*>(colour) + 2 * channel;
      pointers[4][x] = reinterpret_cast<char*>(w);
      pointers[5][x] = reinterpret_cast<char*>(empty ? &nobody : roles.data() + first);
      if (from.mirrors) pointers[6][x] = reinterpret_cast<char*>(empty ? &nobody : mirror.data() + first);
    }
    part.readPixels(static_cast<int>(row), static_cast<int>(row));
  }
  out.roles.resize(roles.size());
  std::ranges::transform(roles, out.roles.begin(), rolesOf);
  out.mirror.resize(mirror.size());
  std::ranges::transform(mirror, out.mirror.begin(), mirrorOf);
}

void readPart(const Part& from) {
  const Imf::Header& header = from.file.header(from.number);
  const Imf::Compression compression = header.compression();
  if (compression != Imf::NO_COMPRESSION && compression != Imf::RLE_COMPRESSION &&
      compression != Imf::ZIPS_COMPRESSION && compression != Imf::ZIP_COMPRESSION)
    refuse("is compressed in a way that captures are not; save it with ZIP or ZIPS", ErrorKind::unsupported);
  for (const char* channel : kColourChannels) checkChannel(header, channel, Imf::HALF);
  checkChannel(header, "W", Imf::FLOAT);
  checkChannel(header, kRolesChannel, Imf::UINT);
  if (from.mirrors) checkChannel(header, kMirrorChannel, Imf::UINT);
  from.samples.columnStart.reserve(from.columns() + 1);
  from.samples.columnStart.push_back(0);
  const std::string type = header.hasType() ? header.type() : Imf::SCANLINEIMAGE;
  if (type == Imf::SCANLINEIMAGE)
    readFlat(from);
  else if (type == Imf::DEEPSCANLINE)
    readDeep(from);
  else
    refuse("is tiled; captures are stored by scanlines");
}

Keyed<Capture> readExr(const std::string& name, std::span<const std::byte> bytes) {
  ExrMemoryInput memory(name, bytes);
  Imf::MultiPartInputFile file(memory, 0, false);
  if (file.parts() > 2) refuse("has more parts than a capture: surfaces and reflections");
  const Imf::Header& header = file.header(0);
  if (const int version = attribute<Imf::IntAttribute>(header, kAttributeVersion);
      version != kCaptureExrVersion)
    refuse(fmt::format("has format version {}, this program reads {}; bake it anew", version,
                       kCaptureExrVersion),
           ErrorKind::unsupported);

  Keyed<Capture> result{keyAttribute(header, kAttributeKey), {}};
  Capture& capture = result.value;
  capture.camera = cameraOf(header, bytes.size());
  capture.distanceStep = attribute<Imf::DoubleAttribute>(header, kAttributeStep);
  const bool mirrors = file.parts() == 2;
  readPart({file, 0, bytes.size(), capture.camera, mirrors, capture});
  if (mirrors) {
    if (file.header(1).name() != kReflectionsPart || file.header(1).dataWindow() != header.dataWindow())
      refuse("its second part does not hold the reflections of the first");
    readPart({file, 1, bytes.size(), capture.camera, true, capture.reflections});
  }

  if (const Status taken = takeBackground(capture, skyOf(header), capture.background); !taken)
    refuse(taken.error().message);
  if (checksumOf(result.key, capture, capture.colour) != keyAttribute(header, kAttributeChecksum))
    refuse("is damaged or was edited: its checksum differs");
  for (HalfColour& colour : capture.colour) colour = straightened(colour);
  if (const Status sound = capture.check(); !sound) refuse(sound.error().describe());
  return result;
}

}  // namespace

Result<Keyed<Capture>> readKeyedCaptureExr(const std::filesystem::path& path) {
  return withinMemory(path, [&]() -> Result<Keyed<Capture>> {
    const auto bytes = readFile(path);
    if (!bytes) return tl::unexpected(bytes.error());
    try {
      return readExr(path.string(), *bytes);
    } catch (const Refusal& refusal) {
      return fail(refusal.kind, refusal.message, path.string());
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      return fail(ErrorKind::malformed, std::string("cannot be read as OpenEXR: ") + error.what(),
                  path.string());
    }
  });
}

Result<Capture> readCaptureExr(const std::filesystem::path& path) {
  return withoutKey(readKeyedCaptureExr(path));
}

}  // namespace acentric
