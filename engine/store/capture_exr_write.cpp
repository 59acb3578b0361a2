#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>

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

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::array kColourChannels = {"R", "G", "B", "A"};
/// zlib's fast end: about three times the speed of its default for a tenth more bytes.
constexpr int kZipLevel = 2;

/// Walks a capture, stored by columns, row by row: where each column's next sample is.
class RowWalk {
 public:
  explicit RowWalk(const Capture& capture)
      : capture_(capture), next_(capture.columnStart.begin(), capture.columnStart.end() - 1) {}

  struct Samples {
    std::uint32_t first;
    std::uint32_t count;
  };
  /// The samples of a pixel; call for every column, rows in order.
  Samples take(std::size_t column, std::size_t row) {
    const std::uint32_t first = next_[column], end = capture_.columnStart[column + 1];
    std::uint32_t& next = next_[column];
    while (next < end && capture_.row[next] == row) ++next;
    return {first, next - first};
  }

 private:
  const Capture& capture_;
  std::vector<std::uint32_t> next_;
};

Imf::Header headerFor(const Capture& capture, const ContentKey& key, const ContentKey& checksum,
                      Imf::Compression compression) {
  const ColumnCamera& camera = capture.camera;
  Imf::Header header(camera.columns, camera.rows, 1, Imath::V2f(0, 0), 1, Imf::INCREASING_Y, compression);
  header.zipCompressionLevel() = kZipLevel;
  for (const char* name : kColourChannels) header.channels().insert(name, Imf::Channel(Imf::HALF));
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  header.channels().insert("W", Imf::Channel(Imf::FLOAT));
  header.channels().insert(kRolesChannel, Imf::Channel(Imf::UINT));
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
  return header;
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

void writeFlat(const Capture& capture, const std::vector<HalfColour>& colours, const Imf::Header& header,
               Imf::OStream& stream) {
  struct Pixel {
    HalfColour colour;
    float z;
    float w;
    std::uint32_t roles;
  };
  const std::size_t columns = static_cast<std::size_t>(capture.camera.columns);
  std::vector<Pixel> line(columns);
  Imf::FrameBuffer buffer;  // one line, used again for every row
  for (int channel = 0; channel < 4; ++channel)
    buffer.insert(kColourChannels[static_cast<std::size_t>(channel)],
                  Imf::Slice(Imf::HALF, slicePointer(line[0].colour[channel]), sizeof(Pixel), 0));
  buffer.insert("Z", Imf::Slice(Imf::FLOAT, slicePointer(line[0].z), sizeof(Pixel), 0));
  buffer.insert("W", Imf::Slice(Imf::FLOAT, slicePointer(line[0].w), sizeof(Pixel), 0));
  buffer.insert(kRolesChannel, Imf::Slice(Imf::UINT, slicePointer(line[0].roles), sizeof(Pixel), 0));
  Imf::OutputFile file(stream, header, 0);
  file.setFrameBuffer(buffer);
  RowWalk walk(capture);
  for (std::size_t row = 0; row < static_cast<std::size_t>(capture.camera.rows); ++row) {
    const double perHorizontal = rayPerHorizontal(capture.camera, row);
    for (std::size_t x = 0; x < columns; ++x) {
      const auto [first, count] = walk.take(columns - 1 - x, row);
      if (count == 0) {
        line[x] = {HalfColour(0), kInfinity, kNoSample, 0};
        continue;
      }
      const float w = capture.inverseDistance[first];
      line[x] = {colours[first], rayDistance(perHorizontal, w), w, capture.roles[first]};
    }
    file.writePixels(1);
  }
}

void writeDeep(const Capture& capture, std::vector<HalfColour>& colours, Imf::Header header,
               Imf::OStream& stream) {
  header.setType(Imf::DEEPSCANLINE);
  const std::size_t columns = static_cast<std::size_t>(capture.camera.columns);
  std::vector<float> w = capture.inverseDistance, z(capture.sampleCount());
  std::vector<std::uint32_t> roles(capture.roles.begin(), capture.roles.end());
  std::vector<unsigned int> counts(columns);
  // Pointers to the first sample of each pixel of one line, for every channel; its samples lie one behind the
  // other.
  std::array<std::vector<char*>, 7> pointers;
  for (auto& channel : pointers) channel.resize(columns);
  Imf::DeepFrameBuffer buffer;
  buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, slicePointer(counts[0]), sizeof(unsigned int), 0));
  for (std::size_t channel = 0; channel < 4; ++channel)
    buffer.insert(kColourChannels[channel], Imf::DeepSlice(Imf::HALF, slicePointer(pointers[channel][0]),
                                                           sizeof(char*), 0, sizeof(HalfColour)));
  buffer.insert("Z",
                Imf::DeepSlice(Imf::FLOAT, slicePointer(pointers[4][0]), sizeof(char*), 0, sizeof(float)));
  buffer.insert("W",
                Imf::DeepSlice(Imf::FLOAT, slicePointer(pointers[5][0]), sizeof(char*), 0, sizeof(float)));
  buffer.insert(kRolesChannel, Imf::DeepSlice(Imf::UINT, slicePointer(pointers[6][0]), sizeof(char*), 0,
                                              sizeof(std::uint32_t)));
  Imf::DeepScanLineOutputFile file(stream, header, 0);
  file.setFrameBuffer(buffer);
  RowWalk walk(capture);
  for (std::size_t row = 0; row < static_cast<std::size_t>(capture.camera.rows); ++row) {
    const double perHorizontal = rayPerHorizontal(capture.camera, row);
    for (std::size_t x = 0; x < columns; ++x) {
      const auto [first, count] = walk.take(columns - 1 - x, row);
      counts[x] = count;
      if (count == 0) continue;
      for (std::uint32_t i = first; i < first + count; ++i) z[i] = rayDistance(perHorizontal, w[i]);
      for (std::size_t channel = 0; channel < 4; ++channel)
        pointers[channel][x] = slicePointer(colours[first][static_cast<int>(channel)]);
      pointers[4][x] = slicePointer(z[first]);
      pointers[5][x] = slicePointer(w[first]);
      pointers[6][x] = slicePointer(roles[first]);
    }
    file.writePixels(1);
  }
}

Status writeExr(const Capture& capture, const ContentKey& key, const std::filesystem::path& path) {
  if (Status sound = capture.check(); !sound) return sound;
  std::vector<HalfColour> colours(capture.sampleCount());
  for (std::size_t i = 0; i < colours.size(); ++i) colours[i] = premultiplied(capture.colour[i]);
  const ContentKey checksum = checksumOf(key, capture, colours);
  ExrMemoryOutput memory(path.string());
  if (capture.maxLayers() <= 1)
    writeFlat(capture, colours, headerFor(capture, key, checksum, Imf::ZIP_COMPRESSION), memory);
  else
    writeDeep(capture, colours, headerFor(capture, key, checksum, Imf::ZIPS_COMPRESSION), memory);
  return writeFileAtomically(path, memory.bytes());
}

}  // namespace

Status writeCaptureExr(const Capture& capture, const ContentKey& key, const std::filesystem::path& path) {
  return withinMemory(path, [&]() -> Status {
    try {
      return writeExr(capture, key, path);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      return fail(ErrorKind::internal, std::string("OpenEXR refused to write: ") + error.what(),
                  path.string());
    }
  });
}

}  // namespace acentric
