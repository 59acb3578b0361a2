#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

#include "engine/base/file.h"
#include "engine/store/capture_exr.h"
#include "engine/store/capture_store.h"
#include "engine/store/exr_memory.h"
#include "engine/store/keyed.h"

namespace acentric {
namespace {

constexpr std::array kColourChannels = {"R", "G", "B", "A"};
constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// zlib's fast end: about three times the speed of its default for a tenth more bytes.
constexpr int kZipLevel = 2;

/// Walks samples, stored by columns, row by row: where each column's next sample is.
class RowWalk {
 public:
  explicit RowWalk(const CaptureSamples& samples)
      : samples_(samples), next_(samples.columnStart.begin(), samples.columnStart.end() - 1) {}

  struct Samples {
    std::uint32_t first;
    std::uint32_t count;
  };
  /// The samples of a pixel; call for every column, rows in order.
  Samples take(std::size_t column, std::size_t row) {
    const std::uint32_t first = next_[column], end = samples_.columnStart[column + 1];
    std::uint32_t& next = next_[column];
    while (next < end && samples_.row[next] == row) ++next;
    return {first, next - first};
  }

 private:
  const CaptureSamples& samples_;
  std::vector<std::uint32_t> next_;
};

/// Size, channels and compression of a list of samples, that of a capture with `mirrors` or without.
Imf::Header headerFor(const ColumnCamera& camera, const CaptureSamples& samples, bool mirrors) {
  const bool deep = samples.maxLayers() > 1;
  Imf::Header header(camera.columns, camera.rows, 1, Imath::V2f(0, 0), 1, Imf::INCREASING_Y,
                     deep ? Imf::ZIPS_COMPRESSION : Imf::ZIP_COMPRESSION);
  header.zipCompressionLevel() = kZipLevel;
  if (deep) header.setType(Imf::DEEPSCANLINE);
  for (const char* name : kColourChannels) header.channels().insert(name, Imf::Channel(Imf::HALF));
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  header.channels().insert("W", Imf::Channel(Imf::FLOAT));
  header.channels().insert(kRolesChannel, Imf::Channel(Imf::UINT));
  if (mirrors) header.channels().insert(kMirrorChannel, Imf::Channel(Imf::UINT));
  return header;
}

void addAttributes(Imf::Header& header, const Capture& capture, const ContentKey& key,
                   const ContentKey& checksum) {
  const ColumnCamera& camera = capture.camera;
  header.insert(kAttributeVersion, Imf::IntAttribute(kCaptureExrVersion));
  header.insert(kAttributeKey, Imf::StringAttribute(key.toHex()));
  header.insert(kAttributeChecksum, Imf::StringAttribute(checksum.toHex()));
  const glm::dvec3& centre = camera.centreOfProjection;
  header.insert(kAttributeCentre, Imf::V3dAttribute(Imath::V3d(centre.x, centre.y, centre.z)));
  header.insert(kAttributeLowAzimuth, Imf::DoubleAttribute(camera.lowAzimuth));
  header.insert(kAttributeFov, Imf::DoubleAttribute(camera.fovRadians));
  header.insert(kAttributeTop, Imf::DoubleAttribute(camera.topElevation));
  header.insert(kAttributeBottom, Imf::DoubleAttribute(camera.bottomElevation));
  header.insert(kAttributeStep, Imf::DoubleAttribute(capture.distanceStep));
  if (capture.background.runCount() == 0) return;
  const auto radiance = [&](const char* name, const glm::vec3& c) {
    header.insert(name, Imf::V3fAttribute(Imath::V3f(c.x, c.y, c.z)));
  };
  radiance(kAttributeZenith, capture.background.sky.zenith);
  radiance(kAttributeHorizon, capture.background.sky.horizon);
  radiance(kAttributeGround, capture.background.sky.ground);
}

/// Distance along the ray of a sample of this row.
float rayDistance(double rayPerHorizontal, float inverseDistance) {
  return inverseDistance > 0 ? static_cast<float>(rayPerHorizontal / static_cast<double>(inverseDistance))
                             : kInfinity;
}

double rayPerHorizontal(const ColumnCamera& camera, std::size_t row) {
  return std::hypot(1.0, camera.tangentAt(static_cast<double>(row) + 0.5));
}

template <class T>
char* slicePointer(T& value) {
  return reinterpret_cast<char*>(&value);
}

/// Thrown out of the loops over lines.
struct Stopped {};
void obey(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Stopped{};
}

struct Pixel {
  HalfColour colour;
  float z;
  float w;
  std::uint32_t roles;
  std::uint32_t mirror;
};

/// `File`: a whole file or a part of one. Colours are premultiplied.
template <class File>
void writeFlat(File&& file, const ColumnCamera& camera, const CaptureSamples& samples,
               const std::stop_token& stop) {
  const std::size_t columns = static_cast<std::size_t>(camera.columns);
  const bool mirrors = file.header().channels().findChannel(kMirrorChannel) != nullptr;
  std::vector<Pixel> line(columns);
  Imf::FrameBuffer buffer;  // one line, used again for every row
  const auto slice = [&](const char* name, Imf::PixelType type, auto& value) {
    buffer.insert(name, Imf::Slice(type, slicePointer(value), sizeof(Pixel), 0));
  };
  for (int channel = 0; channel < 4; ++channel)
    slice(kColourChannels[static_cast<std::size_t>(channel)], Imf::HALF, line[0].colour[channel]);
  slice("Z", Imf::FLOAT, line[0].z);
  slice("W", Imf::FLOAT, line[0].w);
  slice(kRolesChannel, Imf::UINT, line[0].roles);
  if (mirrors) slice(kMirrorChannel, Imf::UINT, line[0].mirror);
  file.setFrameBuffer(buffer);
  RowWalk walk(samples);
  for (std::size_t row = 0; row < static_cast<std::size_t>(camera.rows); ++row) {
    obey(stop);
    const double perHorizontal = rayPerHorizontal(camera, row);
    for (std::size_t x = 0; x < columns; ++x) {
      const auto [first, count] = walk.take(columns - 1 - x, row);
      if (count == 0) {
        line[x] = {HalfColour(0), kInfinity, kNoDistance, 0, 0};
        continue;
      }
      const float w = samples.inverseDistance[first];
      const std::uint32_t mirror = mirrors ? samples.mirror[first] : 0;
      line[x] = {samples.colour[first], rayDistance(perHorizontal, w), w, samples.roles[first], mirror};
    }
    file.writePixels(1);
  }
}

template <class File>
void writeDeep(File&& file, const ColumnCamera& camera, const CaptureSamples& samples,
               const std::stop_token& stop) {
  const std::size_t columns = static_cast<std::size_t>(camera.columns);
  const bool mirrors = file.header().channels().findChannel(kMirrorChannel) != nullptr;
  std::vector<Pixel> line;  // its samples, one behind the other
  std::vector<unsigned int> counts(columns);
  // Pointers to the first sample of each pixel of the line, for every channel.
  std::array<std::vector<char*>, 8> pointers;
  for (auto& channel : pointers) channel.resize(columns);
  Imf::DeepFrameBuffer buffer;
  buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, slicePointer(counts[0]), sizeof(unsigned int), 0));
  const auto slice = [&](const char* name, Imf::PixelType type, std::size_t channel) {
    buffer.insert(name,
                  Imf::DeepSlice(type, slicePointer(pointers[channel][0]), sizeof(char*), 0, sizeof(Pixel)));
  };
  for (std::size_t channel = 0; channel < 4; ++channel) slice(kColourChannels[channel], Imf::HALF, channel);
  slice("Z", Imf::FLOAT, 4);
  slice("W", Imf::FLOAT, 5);
  slice(kRolesChannel, Imf::UINT, 6);
  if (mirrors) slice(kMirrorChannel, Imf::UINT, 7);
  file.setFrameBuffer(buffer);
  RowWalk walk(samples);
  for (std::size_t row = 0; row < static_cast<std::size_t>(camera.rows); ++row) {
    obey(stop);
    const double perHorizontal = rayPerHorizontal(camera, row);
    line.clear();
    for (std::size_t x = 0; x < columns; ++x) {
      const auto [first, count] = walk.take(columns - 1 - x, row);
      counts[x] = count;
      for (std::uint32_t i = first; i < first + count; ++i) {
        const float w = samples.inverseDistance[i];
        line.push_back({samples.colour[i], rayDistance(perHorizontal, w), w, samples.roles[i],
                        mirrors ? std::uint32_t(samples.mirror[i]) : 0});
      }
    }
    Pixel* next = line.data();
    for (std::size_t x = 0; x < columns; next += counts[x++]) {
      if (counts[x] == 0) continue;
      for (std::size_t channel = 0; channel < 4; ++channel)
        pointers[channel][x] = slicePointer(next->colour[static_cast<int>(channel)]);
      pointers[4][x] = slicePointer(next->z);
      pointers[5][x] = slicePointer(next->w);
      pointers[6][x] = slicePointer(next->roles);
      pointers[7][x] = slicePointer(next->mirror);
    }
    file.writePixels(1);
  }
}

void writeWhole(const ColumnCamera& camera, const CaptureSamples& surfaces, const Imf::Header& header,
                Imf::OStream& stream, const std::stop_token& stop) {
  if (header.hasType())
    writeDeep(Imf::DeepScanLineOutputFile(stream, header, 0), camera, surfaces, stop);
  else
    writeFlat(Imf::OutputFile(stream, header, 0), camera, surfaces, stop);
}

void writeParts(const ColumnCamera& camera, const CaptureSamples& surfaces, const CaptureSamples& reflections,
                const Imf::Header& header, Imf::OStream& stream, const std::stop_token& stop) {
  std::array headers = {header, headerFor(camera, reflections, true)};
  headers[0].setName(kSurfacesPart);
  headers[1].setName(kReflectionsPart);
  for (Imf::Header& part : headers)
    if (!part.hasType()) part.setType(Imf::SCANLINEIMAGE);
  Imf::MultiPartOutputFile file(stream, headers.data(), int(headers.size()), false, 0);
  const auto write = [&](int part, const CaptureSamples& samples) {
    if (headers[static_cast<std::size_t>(part)].type() == Imf::DEEPSCANLINE)
      writeDeep(Imf::DeepScanLineOutputPart(file, part), camera, samples, stop);
    else
      writeFlat(Imf::OutputPart(file, part), camera, samples, stop);
  };
  write(0, surfaces);
  write(1, reflections);
}

Status writeExr(const Capture& capture, const ContentKey& key, const std::filesystem::path& path,
                const std::stop_token& stop) {
  if (Status sound = capture.check(); !sound) return sound;
  std::vector<HalfColour> colours(capture.sampleCount());
  obey(stop);
  std::ranges::transform(capture.colour, colours.begin(), premultiplied);
  const ContentKey checksum = checksumOf(key, capture, colours);
  obey(stop);
  const CaptureSamples surfaces = withBackground(capture, std::move(colours));
  obey(stop);
  Imf::Header header = headerFor(capture.camera, surfaces, capture.hasReflections());
  addAttributes(header, capture, key, checksum);
  ExrMemoryOutput memory(path.string());
  if (capture.hasReflections())
    writeParts(capture.camera, surfaces, capture.reflections, header, memory, stop);
  else
    writeWhole(capture.camera, surfaces, header, memory, stop);
  return writeFileAtomically(path, memory.parts(), stop);
}

}  // namespace

Status writeCaptureExr(const Capture& capture, const ContentKey& key, const std::filesystem::path& path,
                       const std::stop_token& stop) {
  return withinMemory(path, [&]() -> Status {
    try {
      return writeExr(capture, key, path, stop);
    } catch (const Stopped&) {
      return fail(ErrorKind::cancelled, "writing was stopped", path.string());
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      return fail(ErrorKind::internal, std::string("OpenEXR refused to write: ") + error.what(),
                  path.string());
    }
  });
}

}  // namespace acentric
