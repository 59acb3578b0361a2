// Packed captures of versions kCodedCapture and kDisplayCapture: pictures of colours, range-coded samples.
#include <algorithm>
#include <array>

#include "engine/base/contract.h"
#include "engine/store/capture_store.h"
#include "engine/store/colour_picture.h"
#include "engine/store/deep_colours.h"
#include "engine/store/pack_parts.h"
#include "engine/store/sample_coder.h"
#include "engine/store/still_picture.h"

namespace acentric {
namespace {

constexpr std::uint64_t kPixelBytes = 6;  ///< of a picture's three planes
/// Of a sample, with all that it may have, and what is kept of it while colours are read.
constexpr std::uint64_t kHeldBytes = 29, kHeldPlaneBytes = sizeof(SurfacePlane);

/// How the colours of a pack are kept.
struct Colours {
  ColourScale scale;
  int quality;
  float exposure = 1;  ///< of what is shown
  bool asPictures() const { return quality < kLosslessColours; }
  ColourCoder coder() const {
    static const ColourCoder radiance(ColourScale::radiance);
    return scale == ColourScale::radiance ? radiance : ColourCoder(scale, exposure);
  }
  DeepColourShape deep(int rows) const { return {rows, quality, mostCodeOf(scale)}; }
};

/// What reading a list takes besides its blocks: its pixels, its samples, their planes.
std::uint64_t claimOf(const SampleShape& shape) {
  return std::uint64_t(shape.camera.columns) * std::uint64_t(shape.camera.rows) + kHeldBytes * shape.samples +
         kHeldPlaneBytes * shape.planes;
}

template <class Samples>
auto colourLanes(Samples& samples) {
  return std::array{laneOf(samples.colour, 0, 2), laneOf(samples.colour, 2, 2), laneOf(samples.colour, 4, 2)};
}

struct ListHead {
  std::uint64_t samples = 0, planes = 0, streamBytes = 0, deepBytes = 0;
  bool stepped = false;  ///< distances are numbered by the capture's steps
};

/// One list of samples on its way into a file.
class ListWriter {
 public:
  ListWriter(const Capture& capture, const CaptureSamples& samples, const Colours& colours)
      : samples_(samples),
        colours_(colours),
        shape_{capture.camera, samples.sampleCount(), !samples.mirror.empty(), samples.planes.size(),
               codedStep(samples, capture.distanceStep)} {}

  Status code(const std::stop_token& stop) {
    if (samples_.columnStart.empty()) return {};
    stream_ = codeSamples(samples_, shape_);
    if (!colours_.asPictures()) return {};
    std::vector<ColourCodes> codes;
    codes.reserve(samples_.sampleCount());
    const ColourCoder coder = colours_.coder();
    for (const HalfColour& colour : samples_.colour) codes.push_back(coder.codesOf(colour));
    area_ = areaOf(samples_);
    const int bits = bitsOf(colours_.scale);
    const StillPicture picture = pictureOf(samples_, area_, codes, bits);
    for (const PictureArea& piece : piecesOf(area_)) {
      if (stop.stop_requested()) return fail(ErrorKind::cancelled, "writing was stopped");
      auto coded = encodeStill(pieceOf(picture, piece), colours_.quality);
      if (!coded) return tl::unexpected(coded.error());
      const auto read = decodeStill(*coded, piece.columns, piece.rows, bits);
      if (!read) return tl::unexpected(read.error());
      takePiece(*read, area_, piece, samples_, codes);
      pieces_.push_back(std::move(*coded));
    }
    deep_ = codeDeepColours(samples_, colours_.deep(shape_.camera.rows), codes);
    return {};
  }
  void describe(BlockFileWriter& file) const {
    file.describe(std::uint64_t(shape_.samples));
    file.describe(std::uint64_t(shape_.planes));
    file.describe(std::uint64_t(stream_.size()));
    file.describe(std::uint64_t(deep_.size()));
    file.describe(std::uint8_t(shape_.distanceStep > 0 ? 1 : 0));
  }
  Status add(BlockFileWriter& file) const {
    if (stream_.empty()) return {};
    file.claim(claimOf(shape_));
    if (Status added = file.addStream(stream_); !added) return added;
    if (!colours_.asPictures()) return file.addRecords(colourLanes(samples_), samples_.sampleCount());
    file.claim(kPixelBytes * area_.pixels());
    for (const std::vector<std::byte>& piece : pieces_)
      if (Status added = file.addBlock(piece); !added) return added;
    return file.addStream(deep_);
  }

 private:
  const CaptureSamples& samples_;
  Colours colours_;
  SampleShape shape_;
  PictureArea area_;
  std::vector<std::byte> stream_, deep_;
  std::vector<std::vector<std::byte>> pieces_;
};

Status writeCoded(const Capture& capture, const ContentKey& key, const std::filesystem::path& path,
                  const Colours& colours, const std::stop_token& stop) {
  require(colours.quality >= 0 && colours.quality <= kLosslessColours, "a quality of colours is 0..100");
  require(!capture.shown, "what is written has radiance");
  if (Status sound = capture.check(); !sound) return sound;
  BlockFileWriter file(BlockFileKind::capture, key, stop,
                       colours.scale == ColourScale::display ? kDisplayCapture : kCodedCapture);
  describeHead(file, capture);
  file.describe(std::uint8_t(colours.quality));
  file.describe(capture.planeTolerance);
  ListWriter surfaces(capture, capture, colours), reflections(capture, capture.reflections, colours);
  for (ListWriter* list : {&surfaces, &reflections})
    if (Status coded = list->code(stop); !coded) return coded;
  surfaces.describe(file);
  reflections.describe(file);
  if (Status added = surfaces.add(file); !added) return added;
  if (capture.background.runCount() > 0)
    if (Status added = addBackground(file, capture.background); !added) return added;
  if (Status added = reflections.add(file); !added) return added;
  return file.write(path);
}

ListHead describedList(BlockFileReader& file) {
  ListHead head;
  head.samples = file.described<std::uint64_t>();
  head.planes = file.described<std::uint64_t>();
  head.streamBytes = file.described<std::uint64_t>();
  head.deepBytes = file.described<std::uint64_t>();
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

Status takeColours(BlockFileReader& file, const ListHead& head, int rows, const Colours& colours,
                   CaptureSamples& out) {
  const PictureArea area = areaOf(out);
  if (!file.mayHold(kPixelBytes * area.pixels()))
    return file.malformed("its pictures are larger than its size allows");
  std::vector<ColourCodes> codes(out.sampleCount());
  std::vector<std::byte> bytes;
  for (const PictureArea& piece : piecesOf(area)) {
    bytes.resize(file.nextSize());
    if (Status read = file.nextBlock(bytes); !read) return read;
    const auto decoded = decodeStill(bytes, piece.columns, piece.rows, bitsOf(colours.scale));
    if (!decoded) return file.malformed(decoded.error().message);
    takePiece(*decoded, area, piece, out, codes);
  }
  const auto deep = file.nextStream(head.deepBytes);
  if (!deep) return tl::unexpected(deep.error());
  if (Status decoded = decodeDeepColours(*deep, out, colours.deep(rows), codes); !decoded)
    return file.malformed(decoded.error().message);
  const ColourCoder coder = colours.coder();
  for (std::size_t i = 0; i < out.sampleCount(); ++i) {
    const HalfColour colour = coder.colourOf(codes[i]);
    out.colour[i] = {colour.r, colour.g, colour.b, out.colour[i].a};
  }
  return {};
}

Status takeList(BlockFileReader& file, const ListHead& head, const SampleShape& shape, const Colours& colours,
                CaptureSamples& out) {
  if (Status read = takeStream(file, head, shape, out); !read) return read;
  if (!colours.asPictures()) return file.nextRecords(colourLanes(out), out.sampleCount());
  return takeColours(file, head, shape.camera.rows, colours, out);
}

Result<Capture> readCoded(BlockFileReader& file, const AcceptPack& accept) {
  Capture capture;
  const PackCounts counts = describedHead(file, capture);
  const Colours colours{file.version() == kDisplayCapture ? ColourScale::display : ColourScale::radiance,
                        file.described<std::uint8_t>()};
  capture.planeTolerance = file.described<double>();
  capture.shown = colours.scale == ColourScale::display;
  const ListHead surfaces = describedList(file), reflections = describedList(file);
  const bool mirrors = reflections.samples > 0;
  const ColumnCamera& camera = capture.camera;
  if (!file.describedAll() || !counts.sized || counts.samples != surfaces.samples ||
      colours.quality > kLosslessColours || (capture.shown && !colours.asPictures()) || !camera.check() ||
      (!mirrors && (reflections.planes > 0 || reflections.streamBytes > 0 || reflections.deepBytes > 0)))
    return file.malformed("its description makes no sense");
  const auto shapeOf = [&](const ListHead& list) {
    return SampleShape{camera, std::size_t(list.samples), mirrors, std::size_t(list.planes),
                       list.stepped ? capture.distanceStep : 0};
  };
  const SampleShape shapes[] = {shapeOf(surfaces), shapeOf(reflections)};
  for (const ListHead* list : {&surfaces, &reflections})
    if (list->samples > kMaxCaptureSamples || list->planes > kMaxCaptureSamples ||
        list->streamBytes > file.rawBytes() || list->deepBytes > file.rawBytes())
      return file.malformed("its number of samples contradicts its size");
  const auto columns = std::uint64_t(camera.columns);
  const std::uint64_t backgroundBytes =
      counts.runs > 0 ? kColumnBytes * columns + kRunBytes * counts.runs : 0;
  if (counts.runs > kMaxCaptureSamples || backgroundBytes > file.rawBytes() ||
      !file.mayHold(claimOf(shapes[0]) + (mirrors ? claimOf(shapes[1]) : 0)))
    return file.malformed("its number of samples contradicts its size");
  if (accept)
    if (Status accepted = accept({camera, surfaces.samples, reflections.samples}); !accepted)
      return tl::unexpected(accepted.error());
  if (Status read = takeList(file, surfaces, shapes[0], colours, capture); !read)
    return tl::unexpected(read.error());
  if (counts.runs > 0)
    if (Status read = takeBackground(file, columns, counts.runs, capture.background); !read)
      return tl::unexpected(read.error());
  if (mirrors)
    if (Status read = takeList(file, reflections, shapes[1], colours, capture.reflections); !read)
      return tl::unexpected(read.error());
  return capture;
}

Result<Keyed<Capture>> readWhole(Result<BlockFileReader> file, const AcceptPack& accept = {}) {
  if (!file) return tl::unexpected(file.error());
  auto capture = readCoded(*file, accept);
  if (!capture) return tl::unexpected(capture.error());
  if (!file->atEnd()) return file->malformed("has more blocks than its description needs");
  if (Status sound = capture->check(); !sound) return file->malformed(sound.error().describe());
  return Keyed<Capture>{file->key(), std::move(*capture)};
}

}  // namespace

Status writeCodedPack(const Capture& capture, const ContentKey& key, const std::filesystem::path& path,
                      int colourQuality, const std::stop_token& stop) {
  return withinMemory(path, [&] {
    return writeCoded(capture, key, path, {ColourScale::radiance, colourQuality}, stop);
  });
}

Status writeDisplayPack(const Capture& capture, const ContentKey& key, const std::filesystem::path& path,
                        int colourQuality, float exposure, const std::stop_token& stop) {
  require(colourQuality < kLosslessColours, "what is shown is kept as pictures");
  return withinMemory(path, [&] {
    return writeCoded(capture, key, path, {ColourScale::display, colourQuality, exposure}, stop);
  });
}

Result<Keyed<Capture>> readKeyedCapturePack(const std::filesystem::path& path) {
  return withinMemory(path, [&] { return readWhole(BlockFileReader::open(path, BlockFileKind::capture)); });
}

Result<Keyed<Capture>> keyedCaptureOf(std::vector<std::byte> bytes, const std::string& name,
                                      const AcceptPack& accept) {
  return withinMemory(name, [&] {
    return readWhole(BlockFileReader::of(std::move(bytes), name, BlockFileKind::capture), accept);
  });
}

Result<Capture> readCapturePack(const std::filesystem::path& path) {
  return withoutKey(readKeyedCapturePack(path));
}

}  // namespace acentric
