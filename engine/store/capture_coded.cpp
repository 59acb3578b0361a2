// Packed captures of version kCodedCapture: pictures of colours, range-coded samples. What reads them is
// apart from what reads plain ones, so that runtimes of bundles need no codec.
#include <algorithm>
#include <array>

#include "engine/base/contract.h"
#include "engine/store/capture_store.h"
#include "engine/store/colour_tiles.h"
#include "engine/store/pack_parts.h"
#include "engine/store/sample_coder.h"
#include "engine/store/still_picture.h"

namespace acentric {
namespace {

/// Pictures are cut into strips of rows with at most so many pixels, each a file of its own.
constexpr int kMostStripPixels = 1 << 22;
constexpr std::uint64_t kPixelBytes = 6;  ///< of a picture's three planes
/// Of a sample, with all that it may have, and its place in a picture.
constexpr std::uint64_t kHeldBytes = 26;

const ColourCoder& colourCoder() {
  static const ColourCoder coder;
  return coder;
}

constexpr std::uint64_t kHeldPlaneBytes = sizeof(SurfacePlane);

/// What reading a list takes besides its blocks: its pixels, its samples, their planes.
std::uint64_t claimOf(const SampleShape& shape) {
  return std::uint64_t(shape.camera.columns) * std::uint64_t(shape.camera.rows) + kHeldBytes * shape.samples +
         kHeldPlaneBytes * shape.planes;
}
std::uint64_t pictureBytes(const ColourTiles& tiles) {
  return kPixelBytes * std::uint64_t(tiles.width) * std::uint64_t(tiles.height);
}

int stripRows(int width) {
  return std::max(kColourTile, kMostStripPixels / width / kColourTile * kColourTile);
}

template <class Samples>
auto colourLanes(Samples& samples) {
  return std::array{laneOf(samples.colour, 0, 2), laneOf(samples.colour, 2, 2), laneOf(samples.colour, 4, 2)};
}

struct ListHead {
  std::uint64_t samples = 0, planes = 0, streamBytes = 0;
  bool stepped = false;  ///< distances are numbered by the capture's steps
};

Status addPictures(BlockFileWriter& file, const CaptureSamples& samples, const ColourTiles& tiles,
                   int quality, const std::stop_token& stop) {
  const StillPicture whole = pictureOf(samples, tiles, colourCoder());
  const std::size_t width = std::size_t(whole.width);
  for (int top = 0; top < whole.height; top += stripRows(whole.width)) {
    if (stop.stop_requested()) return fail(ErrorKind::cancelled, "writing was stopped");
    StillPicture strip{whole.width, std::min(stripRows(whole.width), whole.height - top), {}};
    for (int p = 0; p < 3; ++p) {
      const auto begin = whole.planes[p].begin() + std::ptrdiff_t(std::size_t(top) * width);
      strip.planes[p].assign(begin, begin + std::ptrdiff_t(std::size_t(strip.height) * width));
    }
    const auto coded = encodeStill(strip, quality);
    if (!coded) return tl::unexpected(coded.error());
    if (Status added = file.addBlock(*coded); !added) return added;
  }
  return {};
}

/// One list of samples on its way into a file.
class ListWriter {
 public:
  ListWriter(const Capture& capture, const CaptureSamples& samples, int quality)
      : samples_(samples), quality_(quality) {
    shape_ = {capture.camera, samples.sampleCount(), !samples.mirror.empty(), samples.planes.size(),
              codedStep(samples, capture.distanceStep)};
    if (samples.columnStart.empty()) return;
    stream_ = codeSamples(samples, shape_);
    if (quality < kLosslessColours)
      tiles_ = layOutColours(samples, shape_.camera.rows,
                             &samples == static_cast<const CaptureSamples*>(&capture));
  }
  void describe(BlockFileWriter& file) const {
    file.describe(std::uint64_t(shape_.samples));
    file.describe(std::uint64_t(shape_.planes));
    file.describe(std::uint64_t(stream_.size()));
    file.describe(std::uint8_t(shape_.distanceStep > 0 ? 1 : 0));
  }
  Status add(BlockFileWriter& file, const std::stop_token& stop) const {
    if (stream_.empty()) return {};
    file.claim(claimOf(shape_));
    if (Status added = file.addStream(stream_); !added) return added;
    if (quality_ >= kLosslessColours) return file.addRecords(colourLanes(samples_), samples_.sampleCount());
    file.claim(pictureBytes(tiles_));
    return addPictures(file, samples_, tiles_, quality_, stop);
  }

 private:
  const CaptureSamples& samples_;
  int quality_;
  SampleShape shape_;
  std::vector<std::byte> stream_;
  ColourTiles tiles_;
};

Status writeCoded(const Capture& capture, const ContentKey& key, const std::filesystem::path& path,
                  int colourQuality, const std::stop_token& stop) {
  require(colourQuality >= 0 && colourQuality <= kLosslessColours, "a quality of colours is 0..100");
  if (Status sound = capture.check(); !sound) return sound;
  BlockFileWriter file(BlockFileKind::capture, key, stop, kCodedCapture);
  describeHead(file, capture);
  file.describe(std::uint8_t(colourQuality));
  file.describe(capture.planeTolerance);
  const ListWriter surfaces(capture, capture, colourQuality),
      reflections(capture, capture.reflections, colourQuality);
  surfaces.describe(file);
  reflections.describe(file);
  if (Status added = surfaces.add(file, stop); !added) return added;
  if (capture.background.runCount() > 0)
    if (Status added = addBackground(file, capture.background); !added) return added;
  if (Status added = reflections.add(file, stop); !added) return added;
  return file.write(path);
}

ListHead describedList(BlockFileReader& file) {
  ListHead head;
  head.samples = file.described<std::uint64_t>();
  head.planes = file.described<std::uint64_t>();
  head.streamBytes = file.described<std::uint64_t>();
  head.stepped = file.described<std::uint8_t>() != 0;
  return head;
}

Status takeStream(BlockFileReader& file, const ListHead& head, const SampleShape& shape,
                  CaptureSamples& out) {
  const auto stream = file.nextStream(head.streamBytes);
  if (!stream) return tl::unexpected(stream.error());
  if (Status decoded = decodeSamples(*stream, shape, out); !decoded)
    return file.malformed(decoded.error().message);
  return {};
}

Status takePictures(BlockFileReader& file, const SampleShape& shape, bool whole, CaptureSamples& out) {
  const ColourTiles tiles = layOutColours(out, shape.camera.rows, whole);
  if (!file.mayHold(pictureBytes(tiles)))
    return file.malformed("its pictures are larger than its size allows");
  const std::size_t width = std::size_t(tiles.width);
  std::vector<StillPicture> strips;
  std::vector<std::byte> bytes;
  const int rows = tiles.height > 0 ? stripRows(tiles.width) : 1;
  for (int top = 0; top < tiles.height; top += rows) {
    bytes.resize(file.nextSize());
    if (Status read = file.nextBlock(bytes); !read) return read;
    auto decoded = decodeStill(bytes, tiles.width, std::min(rows, tiles.height - top));
    if (!decoded) return file.malformed(decoded.error().message);
    strips.push_back(std::move(*decoded));
  }
  const std::size_t inStrip = width * std::size_t(rows);
  for (std::size_t i = 0; i < out.sampleCount(); ++i) {
    const StillPicture& from = strips[tiles.place[i] / inStrip];
    const std::size_t at = tiles.place[i] % inStrip;
    const HalfColour colour =
        colourCoder().colourOf({from.planes[0][at], from.planes[1][at], from.planes[2][at]});
    out.colour[i] = {colour.r, colour.g, colour.b, out.colour[i].a};
  }
  return {};
}

Status takeList(BlockFileReader& file, const ListHead& head, const SampleShape& shape, int quality,
                bool whole, CaptureSamples& out) {
  if (Status read = takeStream(file, head, shape, out); !read) return read;
  if (quality >= kLosslessColours) return file.nextRecords(colourLanes(out), out.sampleCount());
  return takePictures(file, shape, whole, out);
}

Result<Capture> readCoded(BlockFileReader& file) {
  Capture capture;
  const PackCounts counts = describedHead(file, capture);
  const int quality = file.described<std::uint8_t>();
  capture.planeTolerance = file.described<double>();
  const ListHead surfaces = describedList(file), reflections = describedList(file);
  const bool mirrors = reflections.samples > 0;
  const ColumnCamera& camera = capture.camera;
  if (!file.describedAll() || !counts.sized || counts.samples != surfaces.samples ||
      quality > kLosslessColours || !camera.check() ||
      (!mirrors && (reflections.planes > 0 || reflections.streamBytes > 0)))
    return file.malformed("its description makes no sense");
  const auto shapeOf = [&](const ListHead& list) {
    return SampleShape{camera, list.samples, mirrors, list.planes, list.stepped ? capture.distanceStep : 0};
  };
  const SampleShape shapes[] = {shapeOf(surfaces), shapeOf(reflections)};
  for (const ListHead* list : {&surfaces, &reflections})
    if (list->samples > kMaxCaptureSamples || list->planes > kMaxCaptureSamples ||
        list->streamBytes > file.rawBytes())
      return file.malformed("its number of samples contradicts its size");
  const auto columns = std::uint64_t(camera.columns);
  const std::uint64_t backgroundBytes =
      counts.runs > 0 ? kColumnBytes * columns + kRunBytes * counts.runs : 0;
  if (counts.runs > kMaxCaptureSamples || backgroundBytes > file.rawBytes() ||
      !file.mayHold(claimOf(shapes[0]) + (mirrors ? claimOf(shapes[1]) : 0)))
    return file.malformed("its number of samples contradicts its size");
  if (Status read = takeList(file, surfaces, shapes[0], quality, true, capture); !read)
    return tl::unexpected(read.error());
  if (counts.runs > 0)
    if (Status read = takeBackground(file, columns, counts.runs, capture.background); !read)
      return tl::unexpected(read.error());
  if (mirrors)
    if (Status read = takeList(file, reflections, shapes[1], quality, false, capture.reflections); !read)
      return tl::unexpected(read.error());
  return capture;
}

Result<Keyed<Capture>> readEither(Result<BlockFileReader> file) {
  if (!file) return tl::unexpected(file.error());
  return wholePack(*file, file->version() == kCodedCapture ? readCoded(*file) : readPlain(*file));
}

}  // namespace

Status writeCodedPack(const Capture& capture, const ContentKey& key, const std::filesystem::path& path,
                      int colourQuality, const std::stop_token& stop) {
  return withinMemory(path, [&] { return writeCoded(capture, key, path, colourQuality, stop); });
}

Result<Keyed<Capture>> readKeyedCapturePack(const std::filesystem::path& path) {
  return withinMemory(path, [&] { return readEither(BlockFileReader::open(path, BlockFileKind::capture)); });
}

Result<Keyed<Capture>> keyedCaptureOf(std::vector<std::byte> bytes, const std::string& name) {
  return withinMemory(
      name, [&] { return readEither(BlockFileReader::of(std::move(bytes), name, BlockFileKind::capture)); });
}

Result<Capture> readCapturePack(const std::filesystem::path& path) {
  return withoutKey(readKeyedCapturePack(path));
}

}  // namespace acentric
