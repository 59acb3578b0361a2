/// Packs to what is drawn. The pictures in a pack are decoded by the browser: findPictures tells them, the
/// page gives each back as RGBA8, and readPack takes them in their order. web/src/engine/pack_reader.ts is
/// the other side of these functions. One pack at a time.

#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "engine/store/block_file.h"
#include "engine/store/colour_picture.h"
#include "engine/store/keyed.h"
#include "engine/store/still_picture.h"
#include "web/runtime/capture_part.h"
#include "web/runtime/module.h"

namespace acentric {
namespace {

struct Picture {
  std::vector<std::byte> file;
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

struct State {
  std::vector<std::byte> pack;
  std::vector<Picture> pictures;
  std::size_t taken = 0;  ///< of the pictures
  std::vector<std::byte> part;
  LargeVector<Rgba8> colours;
  LargeVector<std::uint32_t> covers;
  std::vector<glm::uvec2> runs;
} state;

bool startsWith(std::span<const std::byte> bytes, std::size_t at, std::string_view text) {
  return bytes.size() >= at + text.size() && std::memcmp(bytes.data() + at, text.data(), text.size()) == 0;
}
/// An AVIF file: a box that says so, of a length of four bytes.
bool isAvif(std::span<const std::byte> bytes) { return startsWith(bytes, 4, "ftypavif"); }

/// Before a browser decodes it: do all sizes that the file names (ISO/IEC 23008-12, "ispe") fit a picture of
/// a pack?
bool hasSensibleSize(std::span<const std::byte> file) {
  constexpr std::size_t kSize = 16;  // "ispe", flags, width, height
  const auto number = [&](std::size_t at) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | std::uint64_t(file[at + i]);
    return value;
  };
  bool any = false;
  for (std::size_t at = 0; at + kSize <= file.size(); ++at) {
    if (!startsWith(file, at, "ispe")) continue;
    const std::uint64_t width = number(at + 8), height = number(at + 12);
    if (width > std::uint64_t(kMostPictureSide) || height > std::uint64_t(kMostPictureSide) ||
        width * height > std::uint64_t(kMostPiecePixels))
      return false;
    any = true;
  }
  return any;
}

Status find() {
  auto file = BlockFileReader::of(state.pack, "", BlockFileKind::capture);
  if (!file) return tl::unexpected(file.error());
  while (!file->atEnd()) {
    Picture picture;
    picture.file.resize(file->nextSize());
    if (Status read = file->nextBlock(picture.file); !read) return read;
    if (!isAvif(picture.file)) continue;
    if (!hasSensibleSize(picture.file))
      return file->malformed("a picture of its colours has no sensible size");
    state.pictures.push_back(std::move(picture));
  }
  return {};
}

/// Texels of patches in whole rows of the texture that holds them.
void addTexels(const DisplayCapture& capture) {
  if (!capture.patches) return;  // it shows the background alone
  const DisplayPatches& patches = *capture.patches;
  const std::size_t texels = patches.cover.size();
  const std::size_t end = state.covers.size() + (texels + kTexelsAcross - 1) / kTexelsAcross * kTexelsAcross;
  state.colours.insert(state.colours.end(), patches.colour.begin(), patches.colour.end());
  state.covers.insert(state.covers.end(), patches.cover.begin(), patches.cover.end());
  state.colours.resize(end), state.covers.resize(end);
}

}  // namespace

/// In place of libavif: the pictures that the browser decoded, in their order.
Result<StillPicture> decodeStill(std::span<const std::byte>, int width, int height, int bits) {
  if (state.taken >= state.pictures.size() || state.pictures[state.taken].width != width ||
      state.pictures[state.taken].height != height)
    return fail(ErrorKind::malformed, "a picture of its colours has another size than it needs");
  const std::vector<std::uint8_t>& rgba = state.pictures[state.taken++].rgba;
  StillPicture picture{width, height, bits, {}};
  for (auto& plane : picture.planes) plane.resize(rgba.size() / 4);
  const float scale = float((1 << bits) - 1) / 255;
  for (std::size_t i = 0; i < rgba.size() / 4; ++i) {
    const ColourCodes codes =
        lumaAndChroma(scale * glm::vec3(rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]), bits);
    for (std::size_t p = 0; p < 3; ++p) picture.planes[p][i] = codes[p];
  }
  return picture;
}

}  // namespace acentric

using namespace acentric;

/// Room for `bytes` of a pack, which findPictures and readPack then read. What was read before is let go.
EXPORTED(takePack) std::byte* takePack(std::size_t bytes) {
  state = {};
  state.pack.resize(bytes);
  return state.pack.data();
}
/// How many there are; -1 where the pack is damaged.
EXPORTED(findPictures) int findPictures() {
  const Status found = find();
  if (!found) moduleMessage = found.error().message;
  return found ? int(state.pictures.size()) : -1;
}
EXPORTED(pictureFile) const std::byte* pictureFile(std::size_t picture) {
  return state.pictures[picture].file.data();
}
EXPORTED(pictureBytes) std::size_t pictureBytes(std::size_t picture) {
  return state.pictures[picture].file.size();
}
/// Room for the picture as the browser decoded it: rows of RGBA8.
EXPORTED(takePicture) std::uint8_t* takePicture(std::size_t picture, int width, int height) {
  Picture& taken = state.pictures[picture];
  taken = {{}, width, height, {}};
  taken.rgba.resize(4 * std::size_t(width) * std::size_t(height));
  return taken.rgba.data();
}

/// Addresses of arrays.
struct PageCapture {
  std::uint32_t partBytes;
  const std::byte* part;  ///< capture_part.h
  std::uint32_t texels;   ///< a multiple of kTexelsAcross
  const Rgba8* colours;
  const std::uint32_t* covers;
  std::uint32_t runs;  ///< of the background
  const glm::uvec2*
      runWords;  ///< of each: first row, and one below the last in the high half; roles that need it
};

/// Once all its pictures are there. Null where the pack is damaged.
EXPORTED(readPack) const PageCapture* readPack(float exposure) {
  static PageCapture page;
  auto read = keyedCaptureOf(std::move(state.pack), "");
  if (!read) {
    moduleMessage = read.error().message;
    return nullptr;
  }
  state.pictures.clear();
  if (read->value.sampleCount() > 0 && !read->value.hasSilhouettes()) {
    moduleMessage = "it is of an earlier version of captures: export the walk again";
    return nullptr;
  }
  DisplayCapture capture = prepareForDisplay(read->value, exposure);
  read->value = {};
  PartWriter writer;
  addTexels(capture);
  writer(std::uint32_t(state.covers.size()));  // where the texels of reflections begin
  if (capture.reflections) addTexels(*capture.reflections);
  writePart(writer, capture);
  state.part = std::move(writer.bytes);
  const CaptureBackground& background = capture.background.runs;
  for (std::size_t i = 0; i < background.runCount(); ++i)
    state.runs.emplace_back(background.firstRow[i] | std::uint32_t(background.endRow[i]) << 16,
                            background.roles[i]);
  page = {std::uint32_t(state.part.size()),
          state.part.data(),
          std::uint32_t(state.covers.size()),
          state.colours.data(),
          state.covers.data(),
          std::uint32_t(state.runs.size()),
          state.runs.data()};
  return &page;
}
